using System;

namespace Guidewire.Core
{
    /// <summary>Where a hub is over time: how far it has gone along its axis and how far it has turned about it. Only
    /// differences count.</summary>
    public sealed class DriveTable
    {
        /// <summary>A table of both.</summary>
        /// <param name="insertion">m.</param>
        /// <param name="rotation">rad; more than one turn counts.</param>
        /// <exception cref="ArgumentException">A hub that jumps.</exception>
        public DriveTable(TimeTable insertion, TimeTable rotation)
        {
            if (insertion.HasJumps || rotation.HasJumps)
            {
                throw new ArgumentException("a hub cannot be at two places at one time: times have to increase from row"
                    + " to row");
            }
            Insertion = insertion;
            Rotation = rotation;
        }

        /// <summary>m.</summary>
        public TimeTable Insertion { get; }

        /// <summary>rad.</summary>
        public TimeTable Rotation { get; }

        /// <summary>From when on the hub stands still, s.</summary>
        public double End => Insertion.End;
    }
}
