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
        private static readonly Quantity[][] Parts =
            Array.ConvertAll(new[] { StatePart.Motion, StatePart.Instruments, StatePart.Strains },
                part => RowsOf(Quantities.OfWire, part));
        private static readonly Quantity[] OfCatheter = RowsOf(Quantities.OfCatheter, StatePart.Instruments);

        private readonly Moment _moment = new Moment();
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
            Begin(session);
            for (int part = 0; part < Parts.Length; part++)
            {
                Add(session, (StatePart)part);
            }
        }

        /// <summary>Reads one part off.</summary>
        public void Read(SimulationSession session, StatePart part)
        {
            Begin(session);
            Add(session, part);
        }

        /// <summary>Reads where the wire is in its vessel, of several states.</summary>
        /// <param name="positions">Of the nodes of one state after another, units.</param>
        /// <param name="nodes">Of a state.</param>
        public void ReadPlaces(SimulationSession session, double[] positions, int nodes)
        {
            Begin(session);
            var points = new Vector3d[nodes];
            for (int start = 0; start < positions.Length; start += 3 * nodes)
            {
                MemoryMarshal.Cast<double, Vector3d>(positions.AsSpan(start, 3 * nodes)).CopyTo(points);
                _moment.Lumen = session.PlaceOf(points);
                Add(Quantities.OfLumen, "");
            }
        }

        private static Quantity[] RowsOf(Quantity[] table, StatePart part) =>
            Array.FindAll(table, row => row.Answer != null && row.Part == part);

        private void Begin(SimulationSession session)
        {
            _moment.GoTo(session.Simulation);
            _fields.Clear();
            Count = 0;
        }

        private void Add(SimulationSession session, StatePart part)
        {
            Add(Parts[(int)part], "");
            if (part != StatePart.Instruments)
            {
                return;
            }
            _moment.Lumen = session.PlaceOf(_moment.State.Positions);
            Add(Quantities.OfLumen, "");
            for (int k = 0; k < _moment.Catheters.Count; k++)
            {
                string number = (k + 1).ToString(CultureInfo.InvariantCulture);
                _moment.CatheterIndex = k;
                Add(OfCatheter, number);
                _moment.Lumen = session.PlaceOf(_moment.Catheter.Positions);
                Add(Quantities.OfLumen, number);
            }
        }

        // Rows of one array stand side by side. An array whose first row the run does not have is not there; of a row
        // further on that it does not have the numbers are NaN.
        private void Add(Quantity[] table, string number)
        {
            for (int from = 0, to; from < table.Length; from = to)
            {
                int begin = Count;
                Put(table[from].Read(_moment), 0);
                for (to = from + 1; to < table.Length && table[to].Answer == table[from].Answer; to++)
                {
                    if (Count > begin)
                    {
                        Put(table[to].Read(_moment), table[to].Letters.Length);
                    }
                }
                if (Count > begin)
                {
                    _fields.Add(new Field(table[from].Answer + number, Count - begin));
                }
            }
        }

        private void Put(ReadOnlySpan<double> numbers, int atLeast)
        {
            int length = Math.Max(numbers.Length, atLeast);
            if (Numbers.Length < Count + length)
            {
                double[] longer = Numbers;
                Array.Resize(ref longer, 2 * (Count + length));
                Numbers = longer;
            }
            Span<double> into = Numbers.AsSpan(Count, length);
            into.Fill(double.NaN);
            numbers.CopyTo(into);
            Count += length;
        }
    }
}
