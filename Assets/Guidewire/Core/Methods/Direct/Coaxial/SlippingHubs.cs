using System;

namespace Guidewire.Core
{
    /// <summary>The hubs of coaxial instruments, of which some have a hubForceLimit: a step is taken again, with other
    /// displacements of those, until none has more than its force.</summary>
    /// <remarks>In each trial of one hub those of the instruments inside it are found anew.</remarks>
    internal sealed class SlippingHubs
    {
        private readonly DirectStep _step;
        private readonly MaterialDrive[] _drives;
        private readonly HubSlip[] _slips;
        private readonly StepStart _start;
        private readonly bool _areLimited;

        /// <summary>Those of a step.</summary>
        /// <param name="start">Restores its start.</param>
        public SlippingHubs(DirectStep step, StepStart start)
        {
            _step = step;
            _drives = step.Drives;
            _slips = step.Slips;
            _start = start;
            _areLimited = Array.Exists(_slips, slip => slip.IsLimited);
        }

        /// <summary>A step begins, whose start has been saved.</summary>
        public void BeginStep()
        {
            foreach (HubSlip slip in _slips)
            {
                slip.BeginStep();
            }
            BeginFrom(0);
        }

        /// <summary>Whether the step is to be taken again, from its start, with other displacements.</summary>
        /// <param name="isDone">Whether it has a solution with those that it had.</param>
        public bool NeedAnother(bool isDone)
        {
            WorkLimit work = _step.Dynamics.Work;
            for (int i = _drives.Length - 1; i >= 0 && _areLimited; i--)
            {
                double force = isDone && _slips[i].IsLimited ? Borne(i) : double.NaN;
                double around = i > 0 ? _drives[i - 1].Moved : 0.0;
                if (_slips[i].NeedsAnother(_drives[i].Moved, around, force, work.IsScarce))
                {
                    _start.Restore();
                    work.Count();
                    _drives[i].OverrideDisplacement(_slips[i].Displacement);
                    BeginFrom(i + 1);
                    return true;
                }
            }
            for (int i = 0; i < _drives.Length && _areLimited; i++)
            {
                _drives[i].OverrideDisplacement(null);
                _slips[i].EndStep(isDone && _slips[i].IsLimited ? _step.ForceOf(i) : 0.0, _step.Dynamics.Time);
            }
            return false;
        }

        // A hub that carries others along bears their forces too: what it has too much of it, they have too much.
        private double Borne(int hub)
        {
            double force = _step.ForceOf(hub);
            double sum = force;
            HubLimit own = _slips[hub].Limit;
            int sense = _drives[hub].Carried;
            for (int i = hub; sense != 0 && _drives[i].Carried == sense;)
            {
                i += sense;
                sum += _step.ForceOf(i);
                double excess = _slips[i].Limit.Excess(sum);
                force = sense * excess > 0.0
                    ? sense * Math.Max(sense * force, own.Of(sense) + Math.Abs(excess)) : force;
            }
            return force;
        }

        private void BeginFrom(int hub)
        {
            for (int i = hub; i < _drives.Length && _areLimited; i++)
            {
                _slips[i].Begin(_drives[i].AskedAt(_step.Dynamics.Time), i > 0 ? _slips[i - 1].Displacement : 0.0);
                _drives[i].OverrideDisplacement(_slips[i].Displacement);
            }
        }
    }
}
