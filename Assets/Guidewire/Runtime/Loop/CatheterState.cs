using System;
using Guidewire.Core;

namespace Guidewire.Runtime
{
    /// <summary>A catheter after a step.</summary>
    public sealed class CatheterState
    {
        internal CatheterState(int elements)
        {
            Positions = new Vector3d[elements + 1];
            Orientations = new Quaterniond[elements];
        }

        /// <summary>Its n + 1 nodes, units.</summary>
        public Vector3d[] Positions { get; }

        /// <summary>The orientations of its n elements.</summary>
        public Quaterniond[] Orientations { get; }

        /// <summary>The state of its hub.</summary>
        public HubState Hub { get; internal set; }

        /// <summary>Length over which the next instrument is in it, m.</summary>
        public double Overlap { get; internal set; }

        internal void CopyFrom(CoaxialRecord record)
        {
            Array.Copy(record.Positions, Positions, Positions.Length);
            Array.Copy(record.Orientations, Orientations, Orientations.Length);
            Overlap = record.Overlap;
            Hub = new HubState
            {
                Insertion = record.Insertion,
                Turn = record.Turn,
                Force = record.Force,
                Torque = record.Torque,
                Shortfall = record.Shortfall,
            };
        }

        internal void Interpolate(CatheterState older, CatheterState newer, double t)
        {
            WireState.Interpolate(older.Positions, newer.Positions, t, Positions);
            WireState.Interpolate(older.Orientations, newer.Orientations, t, Orientations);
            Overlap = newer.Overlap;
            Hub = newer.Hub;
        }
    }
}
