using System.Linq;
using Guidewire.Io;
using Newtonsoft.Json.Linq;

namespace Guidewire.Benchmarks
{
    /// <summary>What contact of a wire with itself costs: where it touches nothing of its own, and with some twenty
    /// columns beside the blocks along the wire.</summary>
    internal static class SelfContactCost
    {
        private const int Turns = 9;
        private const int Elements = 120;

        /// <summary>Prints both as ratios of processor time in this process.</summary>
        public static void Print()
        {
            foreach (string name in new[] { "torque", "branch", "insertion-accurate" })
            {
                PrintWithout(name);
            }
            PrintColumns();
        }

        // Step by step in turns, so that both have the same machine; the median of all steps' ratios says little.
        private static void PrintWithout(string name)
        {
            var with = new List<double>();
            var without = new List<double>();
            for (int turn = 0; turn < Turns; turn++)
            {
                using SimulationSession on = Open(name, true);
                using SimulationSession off = Open(name, false);
                double own = 0.0;
                double other = 0.0;
                while (on.Simulation.Outcome == Outcome.Running)
                {
                    own += Time(on.Simulation);
                    other += Time(off.Simulation);
                }
                with.Add(own);
                without.Add(other);
            }
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "{0}.json, which does not touch itself: {1:0.000} of the time without self-contact, the least of {2}"
                + " turns", name, with.Min() / without.Min(), Turns));
        }

        private static SimulationSession Open(string name, bool touches) => SimulationSession.Open(
            Path.Combine("params", name + ".json"),
            new[] { new KeyValuePair<string, JToken>("selfContact", touches) }, false);

        private static double Time(Simulation run)
        {
            long start = Stopwatch.GetTimestamp();
            run.Step();
            return Stopwatch.GetTimestamp() - start;
        }

        // A Newton iteration of one system with columns against the same without, in turns.
        private static void PrintColumns()
        {
            foreach (int count in new[] { 10, 20, 40 })
            {
                MaterialRod rod = MaterialRod.Round(Elements, 0.12, 0.18e-3, 60e9, 23e9, 6450.0);
                var terms = new RodTerms(rod, new RodSupports());
                var shape = new RodShape(Elements);
                for (int i = 0; i < Elements; i++)
                {
                    shape.X[i + 1] = shape.X[i] + rod.Length[i] * Vector3d.UnitZ;
                    shape.Q[i] = Quaterniond.Identity;
                }
                var plain = new NewtonIteration(terms, shape, 0);
                var with = new NewtonIteration(terms, shape, count);
                var both = new Interleaved(() => with.Repeat(), () => plain.Repeat());
                Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                    "{0} columns, n = {1}: {2:0.00} times a Newton iteration without", count, Elements, both.Ratio));
            }
        }

        // Assembly, elimination and solution.
        private sealed class NewtonIteration
        {
            private readonly EnergyTerm[] _terms;
            private readonly RodShape _shape;
            private readonly BlockTridiagonal _system;
            private readonly RodVector[] _gradient;
            private readonly RodVector[] _direction;

            public NewtonIteration(RodTerms terms, RodShape shape, int columns)
            {
                _terms = columns == 0 ? terms.All : terms.With(new Crossings(columns));
                _shape = shape;
                _system = new BlockTridiagonal(terms.Rod, terms.Supports);
                _gradient = new RodVector[_system.VectorCapacity];
                _direction = new RodVector[_system.VectorCapacity];
            }

            public void Repeat()
            {
                for (int k = 0; k < 50; k++)
                {
                    _system.Factorise(_terms, _shape, _gradient, _direction, 1.0);
                    _system.Back(_direction);
                }
            }
        }

        // Springs across the wire between elements that are no neighbours, five columns for each crossing.
        private sealed class Crossings : EnergyTerm
        {
            private readonly int _count;

            public Crossings(int count) => _count = count;

            public override double Value(RodShape shape) => 0.0;

            public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
                ref GradientMeasures measured)
            {
            }

            public override void AddColumns(RodShape shape, LowRank columns)
            {
                for (int k = 0; k < _count; k++)
                {
                    int first = 10 + 2 * (k / 5);
                    Vector3d across = k % 2 == 0 ? Vector3d.UnitX : Vector3d.UnitY;
                    var one = new RodVector(across, default);
                    var other = new RodVector(-across, default);
                    columns.Add(first, Elements - first, one, one, other, other, 1.0 + k);
                }
            }
        }
    }
}
