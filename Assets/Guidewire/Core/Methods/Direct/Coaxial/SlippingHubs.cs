using System;

namespace Guidewire.Core
{
    /// <summary>The hubs of coaxial instruments, of which some have a hubForceLimit: a step is taken again, with other
    /// displacements of those, until none has more than its force.</summary>
    /// <remarks>In each trial of one hub those of the instruments inside it are found anew.</remarks>
    internal sealed class SlippingHubs
    {
        private readonly InstrumentSet _instruments;
        private readonly MaterialDrive[] _drives;
        private readonly HubSlip[] _slips;
        private readonly StepStart _start;
        private readonly Func<bool> _step;
        private readonly double[] _insertions;   // when the step began, m
        private bool _isFirst;                   // of its trials

        /// <summary>Those of these instruments.</summary>
        /// <param name="start">Saves and restores a step's start.</param>
        /// <param name="step">Takes the step with the displacements that drives are given; false where it has no
        /// solution.</param>
        public SlippingHubs(InstrumentSet instruments, StepStart start, Func<bool> step)
        {
            _instruments = instruments;
            _drives = instruments.Drives;
            _slips = instruments.Slips;
            _start = start;
            _step = step;
            _insertions = new double[_drives.Length];
            AreLimited = Array.Exists(_slips, slip => slip.IsLimited);
        }

        /// <summary>Whether one of them has a limit.</summary>
        public bool AreLimited { get; }

        /// <summary>One step, whose start has been saved.</summary>
        /// <returns>False where it has no solution.</returns>
        public bool Step()
        {
            _isFirst = true;
            for (int i = 0; i < _drives.Length; i++)
            {
                _insertions[i] = _drives[i].Insertion;
            }
            bool isDone = Step(0);
            for (int i = 0; i < _drives.Length; i++)
            {
                _drives[i].OverrideDisplacement(null);
                _slips[i].EndStep(isDone && _slips[i].IsLimited ? _instruments.ForceOf(i) : 0.0);
            }
            return isDone;
        }

        private bool Step(int hub)
        {
            if (hub == _drives.Length)
            {
                return Try();
            }
            HubSlip slip = _slips[hub];
            slip.Begin();
            bool isDone;
            do
            {
                _drives[hub].OverrideDisplacement(slip.Displacement);
                isDone = Step(hub + 1);
            }
            while (slip.NeedsAnother(_drives[hub].Insertion - _insertions[hub],
                isDone && slip.IsLimited ? _instruments.ForceOf(hub) : double.NaN, _instruments.Work.IsScarce));
            return isDone;
        }

        private bool Try()
        {
            if (!_isFirst)
            {
                _start.Restore();
                _instruments.Work.Count();
            }
            _isFirst = false;
            return _step();
        }
    }
}
