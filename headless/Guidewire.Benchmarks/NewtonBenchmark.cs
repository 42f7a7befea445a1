using BenchmarkDotNet.Attributes;

namespace Guidewire.Benchmarks
{
    /// <summary>The direct solver on a bent wire that moves under its weight: one Newton iteration of a stage (assembly
    /// with factorisation, solution, the move), and one with the factorisation that is kept.</summary>
    public class NewtonBenchmark
    {
        private const double StageLength = 1e-3;  // s
        private const double Bend = 0.5;          // radians from end to end
        private const double Turn = 1e-3;         // of every element since the step's start, radians

        private BlockTridiagonal _system = null!;
        private EnergyTerm[] _terms = null!;
        private MaterialRod _rod = null!;
        private RodSupports _supports = null!;
        private RodShape _shape = null!;
        private RodShape _moved = null!;
        private RodVector[] _gradient = null!;
        private RodVector[] _direction = null!;
        private RodVector[] _step = null!;
        private RodBlock[] _blocks = null!;

        /// <summary>The number of elements n.</summary>
        [Params(30, 1000, 10000, 100000)]
        public int Elements { get; set; }

        [GlobalSetup]
        public void Setup()
        {
            _rod = MaterialRod.Round(Elements, 0.3, 0.5e-3, 60e9, 23e9, 6450.0);
            _supports = new RodSupports();
            var terms = new RodTerms(_rod, _supports);
            terms.Loads.Set(new Vector3d(0.0, -9.81, 0.0), Vector3d.Zero);
            var inertia = new InertiaEnergy(terms.Mass) { StageLength = StageLength };
            _terms = terms.With(inertia);
            _shape = new RodShape(Elements);
            _moved = new RodShape(Elements);
            for (int j = 0; j < Elements; j++)
            {
                _shape.Q[j] = Quaterniond.FromAxisAngle(Vector3d.UnitX, Bend * j / Elements);
                _shape.X[j + 1] = _shape.X[j] + _rod.Length[j] * _shape.Q[j].Director3;
            }
            inertia.BeginStep(_shape, StageLength);
            for (int j = 0; j < Elements; j++)
            {
                _shape.Q[j] *= RotationVector.Exp(new Vector3d(Turn, 0.5 * Turn, Turn));
            }
            Array.Copy(_shape.X, inertia.FreePositions, Elements + 1);
            _system = new BlockTridiagonal(_rod, _supports);
            _gradient = new RodVector[_system.VectorCount];
            _direction = new RodVector[_system.VectorCount];
            _blocks = new RodBlock[Elements + 2];
            Newton();
            _step = (RodVector[])_direction.Clone();
        }

        /// <summary>The parts of an iteration, and of what stands beside it in a search along the energy.</summary>
        public IEnumerable<(string Name, Action Part)> Parts()
        {
            EnergyTerm stretch = _terms[0];
            EnergyTerm bending = _terms[1];
            EnergyTerm inertia = _terms[_terms.Length - 1];
            EnergyTerm[] loads = _terms[2..^1];
            EnergyTerm[] regular = { inertia };
            yield return ("Newton iteration", () => Newton());
            yield return ("iteration, factorisation kept", Kept);
            yield return ("assembly, elimination", () => Factorise(_terms));
            yield return ("elimination and inertia blocks", () => Factorise(regular));
            yield return ("blocks: stretch", () => Blocks(stretch));
            yield return ("blocks: bend-twist", () => Blocks(bending));
            yield return ("blocks: inertia", () => Blocks(inertia));
            yield return ("blocks: loads", () => Array.ForEach(loads, Blocks));
            yield return ("back substitution", () => _system.Back(_direction));
            yield return ("forward and back substitution", () => _system.Solve(_direction));
            yield return ("size of the step", () => RodStep.Size(_step, Elements, _rod.TotalLength, out _));
            yield return ("move", () => RodStep.Apply(_rod, _supports, _shape, _step, 1.0, _moved));
            yield return ("move on straight lines", () => RodStep.ApplyStraight(_shape, _step, 1.0, _moved));
            yield return ("gradient", () => _system.Gradient(_terms, _shape, _gradient, _direction));
            yield return ("gradient: stretch", () => Gradient(stretch));
            yield return ("gradient: bend-twist", () => Gradient(bending));
            yield return ("gradient: inertia", () => Gradient(inertia));
            yield return ("value", () => EnergySum.Value(_terms, _shape, out _));
            yield return ("value: stretch", () => stretch.Value(_shape));
            yield return ("value: bend-twist", () => bending.Value(_shape));
            yield return ("value: inertia", () => inertia.Value(_shape));
            yield return ("anchor", () => EnergySum.Anchor(_terms, _shape));
        }

        [Benchmark]
        [Work(1.0, "element")]
        public int Newton()
        {
            int negative = _system.Factorise(_terms, _shape, _gradient, _direction, 0.0);
            _system.Back(_direction);
            Move();
            return negative;
        }

        [Benchmark]
        [Work(1.0, "element")]
        public void Kept()
        {
            _system.Gradient(_terms, _shape, _gradient, _direction);
            _system.Solve(_direction);
            Move();
        }

        private void Factorise(EnergyTerm[] terms) => _system.Factorise(terms, _shape, _gradient, _direction, 0.0);

        private void Blocks(EnergyTerm term) => term.AddBlocks(_shape, _blocks, _gradient, 0, Elements + 1);

        private void Gradient(EnergyTerm term)
        {
            var measured = default(GradientMeasures);
            term.AddGradient(_shape, _gradient, 0, Elements + 1, ref measured);
        }

        private void Move()
        {
            RodStep.Size(_direction, Elements, _rod.TotalLength, out _);
            RodStep.Apply(_rod, _supports, _shape, _direction, 1.0, _moved);
        }
    }

    /// <summary>What the parts of a Newton iteration of the direct solver cost, each timed in turns with the scalar
    /// sweep: blocks of every term, elimination, back substitution, the move, and what a line search adds.</summary>
    internal static class NewtonParts
    {
        private const int Calls = 3000;   // elements that one timed call passes, at least

        /// <summary>Prints a table of parts against numbers of elements.</summary>
        public static void Print()
        {
            int[] counts = { 30, 60, 1000 };
            var names = new List<string>();
            var cells = new List<string>();
            double each = 0.0;
            foreach (int n in counts)
            {
                var bench = new NewtonBenchmark { Elements = n };
                bench.Setup();
                int row = 0;
                foreach ((string name, Action part) in bench.Parts())
                {
                    Ratio(part, n, out double ratio, out each);
                    string cell = string.Format(CultureInfo.InvariantCulture, "{0,9:0.0} ({1:0.00})", ratio * each,
                        ratio);
                    if (row == names.Count)
                    {
                        names.Add(name);
                        cells.Add(string.Empty);
                    }
                    cells[row++] += cell;
                }
            }
            Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                "parts of a Newton iteration, ns an element (element-iterations of {0:0.0} ns), n = {1}", each,
                string.Join(", ", counts)));
            for (int row = 0; row < names.Count; row++)
            {
                Console.WriteLine("  {0,-34}{1}", names[row], cells[row]);
            }
        }

        // The shortest times of short calls: a busy machine interrupts some of them, but not all.
        private static void Ratio(Action part, int elements, out double ratio, out double each)
        {
            int calls = Math.Max(1, Calls / elements);
            SteppedWire sweep = MotionCost.Sweep();
            void Repeat()
            {
                for (int k = 0; k < calls; k++)
                {
                    part();
                }
            }
            var both = new Interleaved(Repeat, sweep.Step);
            each = both.SecondBest / MotionCost.ElementIterations;
            ratio = both.FirstBest / (calls * elements) / each;
        }
    }
}
