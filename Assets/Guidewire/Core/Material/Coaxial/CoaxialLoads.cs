using System;

namespace Guidewire.Core
{
    /// <summary>Loads on coaxial instruments: each acts on the material of the instrument that it is for, wherever that
    /// is along the chain, and that instrument bears its part along the axis (<see cref="AxialForces"/>).</summary>
    /// <remarks>What is before the outermost hub, or in a sheath before the chain, has no weight and bears no
    /// load.</remarks>
    internal sealed class CoaxialLoads
    {
        private readonly CoaxialJoints _joints;
        private readonly AxialForces _axial;
        private readonly CoaxialInstrument[] _instrument;
        private readonly PrescribedLoads[] _loads;
        private readonly Vector3d[] _perLength;   // N/m
        private readonly Vector3d[] _tip;         // N
        private readonly double[] _factor;        // of point loads
        private Vector3d _gravity;                // m/s^2
        private RodShape _shape = null!;          // these and the next are of a derivative
        private HubSpeeds _speeds = null!;
        private double[] _stationSpeeds = null!;
        private double _workRate;                 // N

        /// <summary>Makes the loads of each instrument of a rod, the outermost one first.</summary>
        public CoaxialLoads(CoaxialRod rod, CoaxialInstrument[] instruments, PrescribedLoads[] loads)
        {
            _joints = rod.Joints;
            _axial = rod.Axial;
            _instrument = instruments;
            _loads = loads;
            _perLength = new Vector3d[loads.Length];
            _tip = new Vector3d[loads.Length];
            _factor = new double[loads.Length];
        }

        /// <summary>Sets all that is prescribed at a time, s, where the instruments are.</summary>
        /// <param name="force">Receives the force on each node of the chain, N.</param>
        public void Set(Vector3d[] force, double time)
        {
            _gravity = _loads[0].GravityAt(time);
            for (int i = 0; i < _loads.Length; i++)
            {
                _perLength[i] = _loads[i].DistributedForceAt(time);
                _tip[i] = _loads[i].DistalForceAt(time, Vector3d.UnitZ);
                _factor[i] = _loads[i].PointLoadsFactor(time);
            }
            Place(force);
        }

        /// <summary>Places the same loads anew where the instruments are.</summary>
        public void Place(Vector3d[] force)
        {
            Array.Clear(force, 0, _joints.ElementCount + 1);
            _axial.ClearLoads();
            AddAll(force);
        }

        /// <summary>A derivative of their potential, N, with all nodes held. What comes in at the outermost hub has
        /// none there.</summary>
        /// <param name="speeds">Of the instruments.</param>
        /// <param name="stations">Of the chain's nodes along it.</param>
        public double EnergyRate(RodShape shape, HubSpeeds speeds, double[] stations)
        {
            (_shape, _speeds, _stationSpeeds) = (shape, speeds, stations);
            _workRate = 0.0;
            AddAll(null);
            return -_workRate;
        }

        private void AddAll(Vector3d[]? force)
        {
            for (int i = 0; i < _instrument.Length; i++)
            {
                double lead = _joints.LeadOf(i);
                foreach (PointLoad load in _loads[i].PointLoads)
                {
                    AddAt(force, i, load.At - lead, _factor[i] * load.Force);
                }
                AddAt(force, i, _joints.Hubs.Ends[i], _tip[i]);
                if (_gravity != Vector3d.Zero || _perLength[i] != Vector3d.Zero)
                {
                    AddPerLength(force, i);
                }
            }
        }

        // Those of each piece in an element at the piece's middle.
        private void AddPerLength(Vector3d[]? force, int instrument)
        {
            InstrumentProfile profile = _instrument[instrument].Profile;
            double[] station = _joints.Stations;
            double lead = _joints.LeadOf(instrument);
            int piece = profile.PieceAt(lead + station[0]);
            for (int j = 0; j < _joints.ElementCount && station[j] < _joints.Hubs.Ends[instrument]; j++)
            {
                double at = station[j];
                // A tip may be beyond the last node by what is too short for an element.
                double end = j == _joints.ElementCount - 1 ? _joints.Hubs.Ends[instrument]
                    : Math.Min(station[j + 1], _joints.Hubs.Ends[instrument]);
                while (at < end)
                {
                    bool isLast = piece == profile.Pieces.Length - 1;
                    double next = isLast ? end : Math.Min(profile.Borders[piece + 1] - lead, end);
                    if (next > at)
                    {
                        AddOn(force, instrument, j, (0.5 * (at + next) - station[j]) / (station[j + 1] - station[j]),
                            (next - at) * (_perLength[instrument] + profile.Pieces[piece].LineDensity * _gravity));
                    }
                    at = Math.Max(at, next);
                    piece += !isLast && profile.Borders[piece + 1] - lead <= at ? 1 : 0;
                }
            }
        }

        private void AddAt(Vector3d[]? force, int instrument, double station, in Vector3d load)
        {
            double[] stations = _joints.Stations;
            if (station < stations[0] || load == Vector3d.Zero)
            {
                return;
            }
            int j = 0;
            while (j < _joints.ElementCount - 1 && station > stations[j + 1])
            {
                j++;
            }
            AddOn(force, instrument, j, (station - stations[j]) / (stations[j + 1] - stations[j]), load);
        }

        // On the nodes beside it by the lever rule, so that it does the same work; or to the derivative of that work.
        private void AddOn(Vector3d[]? force, int instrument, int element, double fraction, in Vector3d load)
        {
            if (force == null)
            {
                double first = _stationSpeeds[element];
                double moves = _speeds.Instruments[instrument] - first
                    - fraction * (_stationSpeeds[element + 1] - first);
                _workRate += moves / (_joints.Stations[element + 1] - _joints.Stations[element])
                    * Vector3d.Dot(load, _shape.X[element + 1] - _shape.X[element]);
                return;
            }
            force[element] += (1.0 - fraction) * load;
            force[element + 1] += fraction * load;
            _axial.AddLoad(instrument, element, fraction, load);
        }
    }
}
