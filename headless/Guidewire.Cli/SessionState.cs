using System;
using System.Collections.Generic;
using System.Globalization;
using System.Runtime.InteropServices;
using Guidewire.Core;
using Guidewire.Io;

namespace Guidewire.Cli
{
    /// <summary>The numbers of a session's state, one array after another: of n rod elements and n + 1 spheres, in the
    /// order of <see cref="Fields"/>, row by row.</summary>
    internal sealed class SessionState
    {
        private readonly Vector3d[] _one = new Vector3d[1];
        private readonly List<Field> _fields = new List<Field>();

        /// <summary>An array of a state.</summary>
        public readonly struct Field
        {
            public Field(string name, int count)
            {
                Name = name;
                Count = count;
            }

            /// <summary>The name that it has in an answer.</summary>
            public string Name { get; }

            /// <summary>How many numbers it has.</summary>
            public int Count { get; }
        }

        /// <summary>The arrays that there are.</summary>
        public IReadOnlyList<Field> Fields => _fields;

        /// <summary>All numbers; the first <see cref="Count"/> are those of the state.</summary>
        public double[] Numbers { get; private set; } = Array.Empty<double>();

        /// <summary>How many there are.</summary>
        public int Count { get; private set; }

        /// <summary>Reads all parts of a session off as it is now.</summary>
        public void Read(SimulationSession session)
        {
            Clear();
            TakeMotion(session.Simulation);
            TakeInstruments(session);
            TakeStrains(session.Simulation);
        }

        /// <summary>Reads one part off.</summary>
        public void Read(SimulationSession session, StatePart part)
        {
            Simulation simulation = session.Simulation;
            Clear();
            switch (part)
            {
                case StatePart.Motion:
                    TakeMotion(simulation);
                    break;
                case StatePart.Instruments:
                    TakeInstruments(session);
                    break;
                default:
                    TakeStrains(simulation);
                    break;
            }
        }

        /// <summary>Reads where the wire is in its vessel, of several states.</summary>
        /// <param name="positions">Of the nodes of one state after another, units.</param>
        /// <param name="nodes">Of a state.</param>
        public void ReadPlaces(SimulationSession session, double[] positions, int nodes)
        {
            Clear();
            var points = new Vector3d[nodes];
            for (int start = 0; start < positions.Length; start += 3 * nodes)
            {
                MemoryMarshal.Cast<double, Vector3d>(positions.AsSpan(start, 3 * nodes)).CopyTo(points);
                Put("lumen", session.PlaceOf(points));
            }
        }

        private void Clear()
        {
            _fields.Clear();
            Count = 0;
        }

        private void TakeMotion(Simulation simulation)
        {
            RodState state = simulation.State;
            Put("positions", state.Positions);
            Put("velocities", state.Velocities);
            Put("orientations", state.Orientations);
            Put("angularVelocities", state.AngularVelocities);
            if (simulation.Contacts is ContactRecord contacts)
            {
                Put("contactForces", contacts.Forces);
                PutOne("reaction", contacts.Reaction);
                PutSoft("wallDisplacements", contacts.Displacements);
            }
        }

        private void TakeInstruments(SimulationSession session)
        {
            Simulation simulation = session.Simulation;
            RodState state = simulation.State;
            if (simulation.Hub() is HubRecord hub)
            {
                Put(hub, state.Positions[state.ElementCount]);
            }
            Put("lumen", session.PlaceOf(state.Positions));
            IReadOnlyList<CoaxialRecord> catheters = simulation.Catheters();
            for (int k = 0; k < catheters.Count; k++)
            {
                string number = (k + 1).ToString(CultureInfo.InvariantCulture);
                Put("positions" + number, catheters[k].Positions);
                Put("velocities" + number, catheters[k].Velocities);
                Put("orientations" + number, catheters[k].Orientations);
                Put("angularVelocities" + number, catheters[k].AngularVelocities);
                Put("catheter" + number, catheters[k]);
                Put("lumen" + number, session.PlaceOf(catheters[k].Positions));
                if (simulation.Contacts != null)
                {
                    Put("contactForces" + number, catheters[k].ContactForces);
                    PutSoft("wallDisplacements" + number, catheters[k].WallDisplacements);
                }
            }
        }

        private void TakeStrains(Simulation simulation)
        {
            if (simulation.Stress() is StressRecord stress)
            {
                Put("strain", stress.Strain);
                Put("force", stress.Force);
                Put("curvature", stress.Curvature);
                Put("couple", stress.Couple);
            }
            if (simulation.Energies() is Vector3d energies)
            {
                PutOne("energy", energies);
            }
        }

        private void Put(HubRecord hub, in Vector3d tip)
        {
            Span<double> numbers = Next("hub", 1, 14);
            numbers[0] = hub.Insertion;
            numbers[1] = hub.Turn;
            numbers[2] = hub.Force;
            numbers[3] = hub.Torque;
            numbers[4] = tip.X;
            numbers[5] = tip.Y;
            numbers[6] = tip.Z;
            numbers[7] = hub.TipDirection.X;
            numbers[8] = hub.TipDirection.Y;
            numbers[9] = hub.TipDirection.Z;
            numbers[10] = hub.Twist;
            numbers[11] = hub.LargestCurvature;
            numbers[12] = hub.LengthInBody ?? double.NaN;
            numbers[13] = hub.SpheresInBody ?? double.NaN;
        }

        private void Put(string name, CoaxialRecord catheter)
        {
            Span<double> numbers = Next(name, 1, 12);
            Vector3d tip = catheter.Positions[catheter.Positions.Length - 1];
            Vector3d direction = catheter.Orientations[catheter.Orientations.Length - 1].Director3;
            numbers[0] = catheter.Insertion;
            numbers[1] = catheter.Turn;
            numbers[2] = catheter.Force;
            numbers[3] = catheter.Torque;
            numbers[4] = tip.X;
            numbers[5] = tip.Y;
            numbers[6] = tip.Z;
            numbers[7] = direction.X;
            numbers[8] = direction.Y;
            numbers[9] = direction.Z;
            numbers[10] = catheter.Extension;
            numbers[11] = catheter.Overlap;
        }

        private void Put(string name, LumenPlace? found)
        {
            if (found is LumenPlace place)
            {
                Span<double> numbers = Next(name, 1, 9);
                numbers[0] = place.IsInside ? 1.0 : 0.0;
                numbers[1] = place.IsAtTarget ? 1.0 : 0.0;
                numbers[2] = place.Near;
                numbers[3] = place.Branch;
                numbers[4] = place.Distance;
                numbers[5] = place.Left;
                numbers[6] = place.Point.X;
                numbers[7] = place.Point.Y;
                numbers[8] = place.Point.Z;
            }
        }

        private void Put(string name, Vector3d[] values) =>
            MemoryMarshal.Cast<Vector3d, double>(values).CopyTo(Next(name, values.Length, 3));

        // Rigid walls have none.
        private void PutSoft(string name, Vector3d[] displacements)
        {
            if (displacements.Length > 0)
            {
                Put(name, displacements);
            }
        }

        private void PutOne(string name, in Vector3d value)
        {
            _one[0] = value;
            Put(name, _one);
        }

        private void Put(string name, Quaterniond[] values) =>
            MemoryMarshal.Cast<Quaterniond, double>(values).CopyTo(Next(name, values.Length, 4));

        private Span<double> Next(string name, int rows, int columns)
        {
            int length = rows * columns;
            if (Numbers.Length < Count + length)
            {
                double[] numbers = Numbers;
                Array.Resize(ref numbers, 2 * (Count + length));
                Numbers = numbers;
            }
            _fields.Add(new Field(name, length));
            Count += length;
            return Numbers.AsSpan(Count - length, length);
        }
    }
}
