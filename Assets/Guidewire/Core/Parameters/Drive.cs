namespace Guidewire.Core
{
    /// <summary>What moves sphere 0.</summary>
    public enum Drive
    {
        /// <summary>One displacement at the start, then held: the steady-state simulation of thesis 3.1.4.</summary>
        Hold,

        /// <summary>Moved every step along a fixed direction.</summary>
        Displace,

        /// <summary>Moved every step along the first rod element (thesis eq. 3.6).</summary>
        Push,

        /// <summary>Free, under an external force.</summary>
        Force,
    }
}
