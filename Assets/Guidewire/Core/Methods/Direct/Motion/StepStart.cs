using System;

namespace Guidewire.Core
{
    /// <summary>All that a step may touch, as it was when the step began: a step that is taken again begins with the
    /// same bits. Counts of the work that was done are no part of it.</summary>
    /// <remarks>Written into memory that is used anew, so that no step leaves garbage.</remarks>
    internal sealed class StepStart
    {
        private readonly Snapshot _kept = new Snapshot();
        private readonly Action<Snapshot> _serialize;

        /// <summary>For a step that touches what is serialized here.</summary>
        public StepStart(Action<Snapshot> serialize)
        {
            _serialize = serialize;
        }

        /// <summary>A step begins.</summary>
        public void Save()
        {
            _kept.WriteAnew();
            _serialize(_kept);
        }

        /// <summary>Goes back to where it began.</summary>
        public void Restore()
        {
            _kept.ReadAnew();
            _serialize(_kept);
        }
    }
}
