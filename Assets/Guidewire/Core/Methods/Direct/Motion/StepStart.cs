using System;

namespace Guidewire.Core
{
    /// <summary>Snapshot of everything that a step may change, taken at its start: a step that is repeated begins with
    /// the same bits. Counters of work are not included.</summary>
    /// <remarks>Written into memory that is used anew, so that no step leaves garbage.</remarks>
    internal sealed class StepStart
    {
        private readonly Snapshot _kept = new Snapshot();
        private readonly Action<Snapshot> _exchange;
        private double _growth;    // of what is kept, at most; 0 once there is room for it

        /// <summary>For a step that touches what is exchanged here.</summary>
        /// <param name="rod">Whose elements may become more; null: they do not.</param>
        public StepStart(Action<Snapshot> exchange, MaterialRod? rod = null)
        {
            _exchange = exchange;
            _growth = rod == null ? 0.0 : (rod.Capacity + 1.0) / rod.ElementCount;
        }

        /// <summary>Saves the state at which a step begins.</summary>
        public void Save()
        {
            _kept.RewindForWriting();
            _exchange(_kept);
            if (_growth > 0.0)
            {
                _kept.Reserve(_growth);
                _growth = 0.0;
            }
        }

        /// <summary>Goes back to where it began.</summary>
        public void Restore()
        {
            _kept.RewindForReading();
            _exchange(_kept);
        }
    }
}
