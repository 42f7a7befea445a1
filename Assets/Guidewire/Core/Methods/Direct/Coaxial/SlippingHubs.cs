using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>The hubs of coaxial instruments, of which some have a hubForceLimit: a step is taken again, with other
    /// displacements of those, until none has more than its force.</summary>
    /// <remarks>In each trial of one hub those of the instruments inside it are found anew.</remarks>
    internal sealed class SlippingHubs
    {
        private readonly MaterialDrive[] _drives;
        private readonly HubSlip[] _slips;
        private readonly StepStart _start;
        private readonly WorkLimit _work;
        private readonly Func<bool> _step;
        private readonly Func<int, double> _force;
        private readonly double[] _insertions;   // when the step began, m
        private bool _isFirst;                   // of its trials

        /// <summary>Those of these instruments, the outermost one first.</summary>
        /// <param name="start">Saves and restores a step's start.</param>
        /// <param name="work">Bounds the trials.</param>
        /// <param name="step">Takes the step with the displacements that drives are given; false where it has no
        /// solution.</param>
        /// <param name="force">Of a hub on its instrument after a step, N.</param>
        public SlippingHubs(MaterialDrive[] drives, HubSlip[] slips, StepStart start, WorkLimit work, Func<bool> step,
            Func<int, double> force)
        {
            _drives = drives;
            _slips = slips;
            _start = start;
            _work = work;
            _step = step;
            _force = force;
            _insertions = new double[drives.Length];
            AreLimited = Array.Exists(slips, slip => slip.IsLimited);
        }

        /// <summary>Whether one of them has a limit.</summary>
        public bool AreLimited { get; }

        /// <summary>One step, whose start is saved first.</summary>
        /// <returns>False where it has no solution.</returns>
        public bool Step()
        {
            _start.Save();
            _isFirst = true;
            for (int i = 0; i < _drives.Length; i++)
            {
                _insertions[i] = _drives[i].Insertion;
            }
            bool isDone = Step(0);
            for (int i = 0; i < _drives.Length; i++)
            {
                _drives[i].OverrideDisplacement(null);
                _slips[i].EndStep(isDone && _slips[i].IsLimited ? _force(i) : 0.0);
            }
            return isDone;
        }

        /// <summary>Adds what is not as asked of the hubs.</summary>
        /// <param name="isSheathed">Whether the catheter's hub ends at the exit of a sheath.</param>
        public void AddWarnings(bool isSheathed, List<RunWarning> warnings)
        {
            int last = _slips.Length - 1;
            for (int k = last; k >= 0; k--)
            {
                string name = k == last ? "the wire's hub" : last == 1 ? "the catheter's hub"
                    : k == 0 ? "the outer catheter's hub" : "the inner catheter's hub";
                string stops = k == last
                    ? "it met the catheter's hub, or the wire's tip came to the first element of the catheter"
                    : last == 1 ? "it met the wire's hub, or its first element came to the wire's tip"
                    : "it met the next hub, or its first element came to a tip inside";
                stops += k < last && isSheathed ? ", or its hub to the exit of the sheath" : "";
                if (_slips[k].Drive.FallsShort)
                {
                    warnings.Add(WarningTable.HubShortfall.With(name, _slips[k].Drive.Slip,
                        (_slips[k].IsLimited ? "it slipped at its hubForceLimit, or " : "") + stops));
                }
                if (_slips[k].FindExcess(name) is RunWarning excess)
                {
                    warnings.Add(excess);
                }
            }
        }

        /// <summary>Writes or restores what the steps had beyond the limits.</summary>
        public void Serialize(Snapshot snapshot)
        {
            foreach (HubSlip slip in _slips)
            {
                slip.Serialize(snapshot);
            }
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
                isDone && slip.IsLimited ? _force(hub) : double.NaN, _work.IsScarce));
            return isDone;
        }

        private bool Try()
        {
            if (!_isFirst)
            {
                _start.Restore();
                _work.Count();
            }
            _isFirst = false;
            return _step();
        }
    }
}
