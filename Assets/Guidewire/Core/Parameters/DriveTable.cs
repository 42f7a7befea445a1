using System;

namespace Guidewire.Core
{
    /// <summary>Motion of a hub over time: insertion along its axis and rotation about it. Only differences
    /// matter.</summary>
    public sealed class DriveTable
    {
        /// <summary>Makes a table of both.</summary>
        /// <param name="insertion">m.</param>
        /// <param name="rotation">rad; more than one turn counts.</param>
        /// <exception cref="ArgumentException">A hub that jumps.</exception>
        public DriveTable(TimeTable insertion, TimeTable rotation)
        {
            if (insertion.HasJumps || rotation.HasJumps)
            {
                throw new ArgumentException("the hub cannot be at two positions at one time: times have to increase "
                    + "from row to row");
            }
            Insertion = insertion;
            Rotation = rotation;
        }

        /// <summary>The insertion over time, m.</summary>
        public TimeTable Insertion { get; }

        /// <summary>The rotation over time, rad.</summary>
        public TimeTable Rotation { get; }

        /// <summary>The time from which on the hub stands still, s.</summary>
        public double End => Insertion.End;
    }
}
