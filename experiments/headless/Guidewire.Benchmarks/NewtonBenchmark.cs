using BenchmarkDotNet.Attributes;
using Guidewire.Core;

namespace Guidewire.Benchmarks
{
    /// <summary>The direct solver on a bent wire that moves under its weight: one Newton iteration of a stage (assembly
    /// with factorisation, solution, the move), and one with the factorisation that is kept. What is
    /// remembered of the shape is forgotten between them.</summary>
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
        private InertiaEnergy _inertia = null!;

        /// <summary>n.</summary>
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
            _inertia = inertia;
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
            System.Array.Copy(_shape.X, inertia.FreePositions, Elements + 1);
            _system = new BlockTridiagonal(_rod, _supports);
            _gradient = new RodVector[_system.VectorCount];
            _direction = new RodVector[_system.VectorCount];
            Newton();
        }

        [Benchmark]
        [Work(1.0, "element")]
        public int Newton()
        {
            _inertia.BeginStage();
            int negative = _system.Factorise(_terms, _shape, _gradient, _direction, 0.0);
            _system.Back(_direction);
            Move();
            return negative;
        }

        [Benchmark]
        [Work(1.0, "element")]
        public void Kept()
        {
            _inertia.BeginStage();
            _system.Gradient(_terms, _shape, _gradient, _direction);
            _system.Solve(_direction);
            Move();
        }

        private void Move()
        {
            RodStep.Size(_direction, Elements, _rod.TotalLength, out _);
            RodStep.Apply(_rod, _supports, _shape, _direction, 1.0, _moved);
        }
    }
}
