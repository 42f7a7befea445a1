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
        private readonly double[] _insertions;   // when the step began, m
        private readonly bool _areLimited;

        /// <summary>Those of these instruments.</summary>
        /// <param name="start">Restores a step's start.</param>
        public SlippingHubs(InstrumentSet instruments, StepStart start)
        {
            _instruments = instruments;
            _drives = instruments.Drives;
            _slips = instruments.Slips;
            _start = start;
            _insertions = new double[_drives.Length];
            _areLimited = Array.Exists(_slips, slip => slip.IsLimited);
        }

        /// <summary>A step begins, whose start has been saved.</summary>
        public void BeginStep()
        {
            for (int i = 0; i < _drives.Length; i++)
            {
                _insertions[i] = _drives[i].Insertion;
            }
            BeginFrom(0);
        }

        /// <summary>Whether the step is to be taken again, from its start, with other displacements.</summary>
        /// <param name="isDone">Whether it has a solution with those that it had.</param>
        public bool NeedAnother(bool isDone)
        {
            for (int i = _drives.Length - 1; i >= 0 && _areLimited; i--)
            {
                double force = isDone && _slips[i].IsLimited ? _instruments.ForceOf(i) : double.NaN;
                if (_slips[i].NeedsAnother(_drives[i].Insertion - _insertions[i], force, _instruments.Work.IsScarce))
                {
                    _start.Restore();
                    _instruments.Work.Count();
                    _drives[i].OverrideDisplacement(_slips[i].Displacement);
                    BeginFrom(i + 1);
                    return true;
                }
            }
            for (int i = 0; i < _drives.Length && _areLimited; i++)
            {
                _drives[i].OverrideDisplacement(null);
                _slips[i].EndStep(isDone && _slips[i].IsLimited ? _instruments.ForceOf(i) : 0.0);
            }
            return false;
        }

        private void BeginFrom(int hub)
        {
            for (int i = hub; i < _drives.Length && _areLimited; i++)
            {
                _slips[i].Begin();
                _drives[i].OverrideDisplacement(null);
            }
        }
    }
}
