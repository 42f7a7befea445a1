using System;

namespace Guidewire.Core
{
    /// <summary>Positions, orientations and velocities that a run starts from instead of the straight wire.</summary>
    public sealed class RodStart
    {
        /// <summary>A start for a wire of n = <c>orientations.Length</c> elements.</summary>
        /// <param name="positions">n + 1 sphere positions in units.</param>
        /// <param name="orientations">n orientations; normalised on use.</param>
        /// <param name="velocities">n + 1 velocities in unit/s, or null for rest.</param>
        /// <param name="angularVelocities">n angular velocities in rad/s, body frame, or null for rest.</param>
        /// <exception cref="ArgumentException">An array's length does not fit the others.</exception>
        public RodStart(Vector3d[] positions, Quaterniond[] orientations, Vector3d[]? velocities,
            Vector3d[]? angularVelocities)
        {
            int n = orientations.Length;
            if (positions.Length != n + 1 || (velocities ?? positions).Length != n + 1
                || (angularVelocities != null && angularVelocities.Length != n))
            {
                throw new ArgumentException(
                    "a start needs n + 1 positions and velocities and n orientations and angular velocities");
            }
            Positions = positions;
            Orientations = orientations;
            Velocities = velocities ?? new Vector3d[n + 1];
            AngularVelocities = angularVelocities ?? new Vector3d[n];
        }

        /// <summary>n + 1 sphere positions in units.</summary>
        public Vector3d[] Positions { get; }

        /// <summary>Whether a run had come here: it may then be through an open rim of a wall.</summary>
        internal bool IsReached { get; set; }

        /// <summary>n orientations.</summary>
        public Quaterniond[] Orientations { get; }

        /// <summary>n + 1 velocities in unit/s.</summary>
        public Vector3d[] Velocities { get; }

        /// <summary>n angular velocities in rad/s, body frame.</summary>
        public Vector3d[] AngularVelocities { get; }
    }
}
