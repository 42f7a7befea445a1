using System;

namespace Guidewire.Core
{
    /// <summary>How far the hubs of coaxial instruments may go: none passes the next one nor the exit of a sheath, and
    /// the tips inside stay in the outermost catheter by an element at least. A hub that is pressed against another
    /// carries it along. The hub of an instrument alone goes on to the exit of its sheath, and back until the tip is
    /// there.</summary>
    internal sealed class HubOrder
    {
        private const double Nowhere = 1e9;     // m, farther than any drive goes

        private readonly CoaxialInstrument[] _instrument;
        private readonly SheathEnd? _sheath;
        private readonly MaterialDrive[] _drives;
        private readonly CoaxialHubs _hubs;
        private readonly double[] _move;        // of each hub in the next step, m
        private readonly double[] _inside;      // how far each tip may go back, m
        private readonly double[] _gap;         // how far each hub is behind the next one around it, m

        /// <summary>Of the hubs of a setup at their start.</summary>
        public HubOrder(CoaxialSetup setup, MaterialDrive[] drives, CoaxialHubs hubs)
        {
            _instrument = setup.Instruments;
            _sheath = setup.Sheath;
            _drives = drives;
            _hubs = hubs;
            _move = new double[drives.Length];
            _inside = new double[drives.Length];
            _gap = new double[drives.Length];
            for (int i = 1; i < drives.Length; i++)
            {
                int hub = i;
                drives[i - 1].LetPress(drives[i], time => hubs.LeadAt(hub, time) - hubs.LeadAt(hub - 1, time));
            }
            LimitAlone(0.0);
        }

        /// <summary>Where an instrument alone is at a time says how far its hub may go in all of the run.</summary>
        public void LimitAlone(double time)
        {
            if (_drives.Length == 1)
            {
                double outside = _sheath!.Outside(_hubs.Outer.PositionAt(time));
                _drives[0].Limit(-outside - _instrument[0].Rod.TotalLength, -outside);
            }
        }

        /// <summary>Sets how far several may go in the step that begins at a time.</summary>
        public void Limit(double time)
        {
            int last = _drives.Length - 1;
            if (last == 0)
            {
                return;
            }
            for (int i = 1; i <= last; i++)
            {
                double lead = _hubs.LeadAt(i, time);
                double[] station = _instrument[i].Stations;
                _inside[i] = station[station.Length - 1] - lead - _instrument[0].Rod.Length[0];
                _gap[i] = lead - _hubs.LeadAt(i - 1, time);
            }
            double toExit = _sheath == null ? Nowhere : _hubs.SheathedAt(time);
            _drives[0].Limit(-Nowhere, toExit);
            _move[0] = _drives[0].NextMove(time);
            LimitInner(time, false);
            // What is to rest inside may hold back what is around it.
            for (int i = last - 1; i > 0; i--)
            {
                _drives[i].Limit(Math.Min(0.0, Math.Max(_move[0] - _inside[i], _move[i + 1] - _gap[i + 1])),
                    Math.Max(0.0, _gap[i] + _move[i - 1]));
                _move[i] = _drives[i].NextMove(time);
            }
            double forward = toExit;
            for (int i = 1; i <= last; i++)
            {
                forward = Math.Min(forward, Math.Max(0.0, _inside[i] + _move[i]));
            }
            _drives[0].Limit(Math.Min(0.0, _move[1] - _gap[1]), forward);
            if (last > 1)
            {
                _move[0] = _drives[0].NextMove(time);
                LimitInner(time, true);
            }
        }

        // isLast: what is inside has been limited before, and goes no farther than it was to go then.
        private void LimitInner(double time, bool isLast)
        {
            for (int i = 1; i < _drives.Length; i++)
            {
                double back = _move[0] - _inside[i];
                back = isLast && i + 1 < _drives.Length ? Math.Max(back, _move[i + 1] - _gap[i + 1]) : back;
                _drives[i].Limit(Math.Min(0.0, back), Math.Max(0.0, _gap[i] + _move[i - 1]));
                _move[i] = _drives[i].NextMove(time);
            }
        }
    }
}
