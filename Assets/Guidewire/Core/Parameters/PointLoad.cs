namespace Guidewire.Core
{
    /// <summary>A force of constant direction at a point of the wire.</summary>
    public readonly struct PointLoad
    {
        /// <summary>Makes a force at a point of the wire.</summary>
        /// <param name="at">Length along the wire at rest from sphere 0, units.</param>
        /// <param name="force">N.</param>
        public PointLoad(double at, in Vector3d force)
        {
            At = at;
            Force = force;
        }

        /// <summary>Length along the wire at rest from sphere 0, units.</summary>
        public double At { get; }

        /// <summary>The force, N.</summary>
        public Vector3d Force { get; }
    }
}
