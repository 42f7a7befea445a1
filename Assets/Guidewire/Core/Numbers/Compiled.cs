using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Compilation hints for the runtime.</summary>
    internal static class Compiled
    {
        /// <summary>In full at the first call: AggressiveOptimization, which netstandard2.1 knows by number
        /// only.</summary>
        public const MethodImplOptions AtOnce = (MethodImplOptions)512;
    }
}
