namespace Guidewire.Core
{
    /// <summary>How a joint's couple depends on its angle.</summary>
    public enum BendLaw
    {
        /// <summary>Proportional to the rotation vector, up to half a turn.</summary>
        RotationVector,

        /// <summary>Proportional to the Darboux vector: K sin(angle) (Kugelstadt and Schoemer 2016).</summary>
        Darboux,
    }
}
