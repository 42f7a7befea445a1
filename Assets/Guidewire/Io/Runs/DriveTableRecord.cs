using System;
using System.Collections.Generic;
using System.Linq;
using System.Text;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Records how a session's hubs are steered, as tables for driveFile that repeat the run with the same
    /// bits.</summary>
    /// <remarks>A steered hub moves by metresPerUnit * push in a step, a hub with a table by the difference of two of
    /// its values. The two are the same double where the displacement is a multiple of 2^-48 m, since sums of those are
    /// exact up to 16 m. So the steering of a recorded session is rounded to such displacements (3.6e-15 m), and turns
    /// to multiples of 2^-40 rad.</remarks>
    internal sealed class DriveTableRecord
    {
        private const double Grain = 1.0 / (1L << 48);      // m
        private const double TurnGrain = 1.0 / (1L << 40);  // rad
        private const double Most = 16.0;       // m, up to which sums of grains are exact
        private const double MostTurn = 8192.0; // rad
        private const double Constant = 1e-6;   // of a step: so long before and after its end a table stands still
        private const double Stopped = 1e-9;    // m: a hub that went less far by more than that came to another one
        private const string TooFar = "a hub was driven by more than 16 m or 8192 rad, where a table rounds";
        private const int Tries = 200;          // displacements beside the wanted one; about every second is met

        private readonly double _timeStep;
        private readonly double _metres;
        private readonly bool[] _meetsOthers;   // by hub: others or a sheath may stop or carry it, no force limit
        private readonly List<Row>[] _rows;
        private readonly double[] _carried;     // by hub, m: how far others have carried it

        private readonly struct Row
        {
            public Row(double insertion, double turn)
            {
                Insertion = insertion;
                Turn = turn;
            }

            public readonly double Insertion;   // m
            public readonly double Turn;        // rad
        }

        /// <summary>Begins the record of a run at its start.</summary>
        public DriveTableRecord(SimulationParameters parameters)
        {
            IReadOnlyList<Catheter> catheters = parameters.Scene.Catheters;
            _timeStep = parameters.Method.TimeStep;
            _metres = parameters.Scene.MetresPerUnit;
            _carried = new double[1 + catheters.Count];
            _meetsOthers = new bool[_carried.Length];
            _rows = new List<Row>[_carried.Length];
            for (int hub = 0; hub < _rows.Length; hub++)
            {
                double limit = (hub == 0 ? parameters.Drive : catheters[hub - 1].Drive).HubForceLimit;
                _meetsOthers[hub] = (catheters.Count > 0 || parameters.Scene.Sheath != null) && !(limit > 0.0);
                _rows[hub] = new List<Row> { default };
            }
            Problem = parameters.Drive.Steering == null ? "no hand steers this run"
                : parameters.Method.Solver == Solver.Direct && parameters.Drive.Kind == Drive.Displace ? ""
                : "only a wire of solver direct with drive \"displace\" takes a drive table";
        }

        /// <summary>Why no table says how the hubs were steered, in one phrase; empty where one does.</summary>
        public string Problem { get; private set; }

        /// <summary>Says that from here on no table does.</summary>
        public void End(string why)
        {
            Problem = Problem.Length > 0 ? Problem : why;
        }

        /// <summary>Rounds push (units) and turn (rad) of each hub in a step to values that a table repeats.</summary>
        public void Round(double[] motion)
        {
            for (int k = 0; k < motion.Length && Problem.Length == 0; k += 2)
            {
                if (!IsExact(_metres * motion[k], motion[k + 1]))
                {
                    End(TooFar);
                    return;
                }
                motion[k] = ExactPush(motion[k], _metres);
                motion[k + 1] = Math.Round(motion[k + 1] / TurnGrain) * TurnGrain;
            }
        }

        /// <summary>Gives a push in a step, units, near a wanted one, of which metres times it is a multiple of the
        /// grain.</summary>
        internal static double ExactPush(double wanted, double metres)
        {
            double middle = Math.Round(metres * wanted / Grain);
            for (int k = 0; k < Tries; k++)
            {
                double displacement = (middle + (k + 1) / 2 * (k % 2 == 1 ? 1 : -1)) * Grain;
                long push = BitConverter.DoubleToInt64Bits(displacement / metres);
                for (int next = -1; next <= 1 && displacement != 0.0; next++)
                {
                    double near = BitConverter.Int64BitsToDouble(push + next);
                    if (metres * near == displacement)
                    {
                        return near;
                    }
                }
                if (displacement == 0.0)
                {
                    return 0.0;
                }
            }
            return wanted;    // every second displacement is met
        }

        /// <summary>Takes a step that has ended.</summary>
        /// <param name="motion">Push (units) and turn (rad) of each hub in it, rounded.</param>
        public void Add(double[] motion, Simulation simulation)
        {
            if (Problem.Length > 0)
            {
                return;
            }
            for (int hub = 0; hub < _rows.Length; hub++)
            {
                Row last = _rows[hub][^1];
                double displacement = _metres * motion[2 * hub];
                double end = last.Insertion + displacement;
                double reached = IsStoppedByOthers(hub, displacement, simulation)
                    ? InsertionOf(simulation, hub) - _carried[hub] : end;
                if (Math.Abs(reached - end) > Stopped && (reached - end) * displacement < 0.0)
                {
                    if (IsOpposed(motion, hub))
                    {
                        End("hubs that met were driven against each other: a hub that rests is carried along");
                    }
                    end = reached;
                }
                else if (Math.Abs(reached - end) > Stopped)
                {
                    _carried[hub] += reached - end;    // a hub that carries this one along does so again
                }
                var row = new Row(end, last.Turn + motion[2 * hub + 1]);
                _rows[hub].Add(row);
                if (!IsExact(row.Insertion, row.Turn))
                {
                    End(TooFar);
                }
            }
        }

        private static bool IsExact(double way, double turn) => Math.Abs(way) < Most && Math.Abs(turn) < MostTurn;

        // A hub that slips does so again; one wire alone may be driven on where it is withdrawn, not at the exit.
        private bool IsStoppedByOthers(int hub, double displacement, Simulation simulation)
        {
            return _meetsOthers[hub] && (_rows.Length > 1 || displacement > 0.0) && double.IsNaN(
                hub == 0 ? simulation.Hub()!.SlippedFrom : simulation.Catheters()[hub - 1].SlippedFrom);
        }

        private static bool IsOpposed(double[] motion, int hub)
        {
            for (int k = 0; k < motion.Length; k += 2)
            {
                if (motion[k] * motion[2 * hub] < 0.0)
                {
                    return true;
                }
            }
            return false;
        }

        /// <summary>Sets the tables as drives of a steered run's parameters, and its end.</summary>
        public void SetDrives(SimulationParameters parameters)
        {
            parameters.Method.MaxSimulationSteps = _rows[0].Count - 1;
            for (int hub = 0; hub < _rows.Length; hub++)
            {
                DriveParameters drive = hub == 0 ? parameters.Drive : parameters.Scene.Catheters[hub - 1].Drive;
                drive.Steering = null;
                drive.InsertionSpeed = 0.0;
                drive.DisplacementPerStep = 0.0;
                drive.Table = TableOf(hub);
            }
        }

        private static double InsertionOf(Simulation simulation, int hub)
        {
            return hub == 0 ? simulation.Hub()!.Insertion : simulation.Catheters()[hub - 1].Insertion;
        }

        /// <summary>Gives what was steered of a hub since the start, as a table for driveFile.</summary>
        /// <remarks>A step asks for the values at its beginning and at its end. The time of those differs from a
        /// multiple of the step by roundings, so around each multiple the value is constant.</remarks>
        public string ToCsv(int hub)
        {
            var text = new StringBuilder("time,insertion,rotation\n");
            foreach ((double time, Row row) in Moments(hub))
            {
                text.Append(NumberText.Shortest(time)).Append(',').Append(NumberText.Shortest(row.Insertion))
                    .Append(',').Append(NumberText.Shortest(row.Turn)).Append('\n');
            }
            return text.ToString();
        }

        private DriveTable TableOf(int hub)
        {
            (double Time, Row Row)[] moments = Moments(hub).ToArray();
            double[] times = Array.ConvertAll(moments, moment => moment.Time);
            return new DriveTable(new TimeTable(times, Array.ConvertAll(moments, moment => moment.Row.Insertion)),
                new TimeTable(times, Array.ConvertAll(moments, moment => moment.Row.Turn)));
        }

        private IEnumerable<(double Time, Row Row)> Moments(int hub)
        {
            for (int step = 0; step < _rows[hub].Count; step++)
            {
                double before = step == 0 ? 0.0 : Constant;
                yield return (step * _timeStep - before * _timeStep, _rows[hub][step]);
                yield return (step * _timeStep + Constant * _timeStep, _rows[hub][step]);
            }
        }
    }
}
