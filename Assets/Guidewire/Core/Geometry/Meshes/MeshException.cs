using System;

namespace Guidewire.Core
{
    /// <summary>A mesh that cannot be a vessel. The message is one line and names what is wrong, by count.</summary>
    public sealed class MeshException : Exception
    {
        /// <summary>Makes the exception with this line.</summary>
        public MeshException(string message)
            : base(message)
        {
        }
    }
}
