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

        /// <summary>For a step that touches what is exchanged here.</summary>
        public StepStart(Action<Snapshot> exchange)
        {
            _exchange = exchange;
        }

        /// <summary>Saves the state at which a step begins.</summary>
        public void Save()
        {
            _kept.RewindForWriting();
            _exchange(_kept);
        }

        /// <summary>Goes back to where it began.</summary>
        public void Restore()
        {
            _kept.RewindForReading();
            _exchange(_kept);
        }
    }
}
