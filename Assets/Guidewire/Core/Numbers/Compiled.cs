using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Compilation hints for the runtime.</summary>
    internal static class Compiled
    {
        /// <summary>In full at the first call, for what runs long: AggressiveOptimization, which netstandard2.1 knows
        /// by number only. An image that is compiled ahead leaves such a method out.</summary>
        public const MethodImplOptions AtOnce = (MethodImplOptions)512;
    }
}
