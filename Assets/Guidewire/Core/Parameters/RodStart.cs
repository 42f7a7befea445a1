using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Positions, orientations and velocities that a run starts from instead of the straight wire.</summary>
    public sealed class RodStart
    {
        /// <summary>Largest angle between an element's d3 and the line between its spheres that can be meant, degrees:
        /// a wire shears by less than a degree.</summary>
        public const double LargestShear = 45.0;

        /// <summary>Makes a start for a wire of n = <c>orientations.Length</c> elements.</summary>
        /// <param name="positions">n + 1 sphere positions in units.</param>
        /// <param name="orientations">n orientations; normalised on use.</param>
        /// <param name="velocities">n + 1 velocities in unit/s, or null for rest.</param>
        /// <param name="angularVelocities">n angular velocities in rad/s, body frame, or null for rest.</param>
        /// <exception cref="ArgumentException">An array's length does not fit the others.</exception>
        public RodStart(Vector3d[] positions, Quaterniond[] orientations, Vector3d[]? velocities,
            Vector3d[]? angularVelocities)
        {
            int n = orientations.Length;
            if (n == 0 || positions.Length != n + 1 || (velocities ?? positions).Length != n + 1
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

        /// <summary>How far the hub has come since the start of the scene: displacement along its axis, m, and
        /// rotation, rad. Instruments in a sheath or in one another need it; null: the hub is where the positions
        /// begin.</summary>
        public (double Insertion, double Turn)? Hub { get; set; }

        /// <summary>Where the catheters around the wire are, the outermost one first.</summary>
        public IReadOnlyList<RodStart> Catheters { get; set; } = Array.Empty<RodStart>();

        /// <summary>Whether a run had come here: it may then be through an open rim of a wall.</summary>
        internal bool IsReached { get; set; }

        /// <summary>Where the sheath of that run ends, m, to the bit; null: where the scene says.</summary>
        internal Vector3d? ExitOfSheath { get; set; }

        /// <summary>The n orientations.</summary>
        public Quaterniond[] Orientations { get; }

        /// <summary>Frame of the proximal clamp of a material, normalised on use; null: what the first elements make it
        /// (<see cref="ClampExtrapolation"/>). With pbd a clamp holds the first element itself.</summary>
        public Quaterniond? ProximalFrame { get; set; }

        /// <summary>The same for the distal clamp and the last elements.</summary>
        public Quaterniond? DistalFrame { get; set; }

        /// <summary>n + 1 velocities in unit/s.</summary>
        public Vector3d[] Velocities { get; }

        /// <summary>n angular velocities in rad/s, body frame.</summary>
        public Vector3d[] AngularVelocities { get; }

        /// <summary>Writes or restores it.</summary>
        internal void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(Positions);
            snapshot.Serialize(Orientations);
            snapshot.Serialize(Velocities);
            snapshot.Serialize(AngularVelocities);
            ProximalFrame = snapshot.Serialize(ProximalFrame ?? Quaterniond.Identity);
            DistalFrame = snapshot.Serialize(DistalFrame ?? Quaterniond.Identity);
            if (ExitOfSheath is Vector3d exit)
            {
                ExitOfSheath = snapshot.Serialize(exit);
            }
        }

        /// <summary>Orientations of elements along the chords between positions: the first is z, [0, 0, 1], turned the
        /// shortest way, and none is turned about its own axis against the one before.</summary>
        /// <param name="positions">n + 1, no two successive ones the same; units.</param>
        public static Quaterniond[] AlongChords(Vector3d[] positions)
        {
            var orientations = new Quaterniond[positions.Length - 1];
            Quaterniond frame = Quaterniond.Identity;
            for (int j = 0; j < orientations.Length; j++)
            {
                frame = Turned(frame, Vector3d.Normalize(positions[j + 1] - positions[j]));
                orientations[j] = frame;
            }
            return orientations;
        }

        /// <summary>A frame turned the shortest way so that its third axis has this direction, a unit vector.</summary>
        internal static Quaterniond Turned(in Quaterniond frame, in Vector3d direction)
        {
            Vector3d axis = Vector3d.Cross(frame.Director3, direction);
            double sine = axis.Length;
            double cosine = Vector3d.Dot(frame.Director3, direction);
            return sine > 0.0
                ? Quaterniond.Normalize(Quaterniond.FromAxisAngle(axis / sine, Math.Atan2(sine, cosine)) * frame)
                : cosine < 0.0 ? Quaterniond.FromAxisAngle(frame.Director1, Math.PI) * frame : frame;
        }

        /// <summary>Which element is sheared by more than <see cref="LargestShear"/> or has no length, in one line, or
        /// null.</summary>
        public string? FindShear()
        {
            for (int j = 0; j < Orientations.Length; j++)
            {
                Vector3d along = Positions[j + 1] - Positions[j];
                Vector3d axis = Quaterniond.Normalize(Orientations[j]).Director3;
                double angle = Math.Atan2(Vector3d.Cross(axis, along).Length, Vector3d.Dot(axis, along)) * 180.0
                    / Math.PI;
                if (along == Vector3d.Zero)
                {
                    return string.Format(CultureInfo.InvariantCulture,
                        "positions[{0}] and positions[{1}] coincide: element {0} has no length", j, j + 1);
                }
                if (!(angle <= LargestShear))
                {
                    return string.Format(CultureInfo.InvariantCulture, "orientations[{0}] is {1:0} degrees off the line"
                        + " from positions[{0}] to positions[{2}], at most {3:0} are allowed: it must rotate z, [0, "
                        + "0, 1], into the direction of its element", j, angle, j + 1, LargestShear);
                }
            }
            return null;
        }
    }
}
