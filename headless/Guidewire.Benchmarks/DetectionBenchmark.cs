using BenchmarkDotNet.Attributes;

namespace Guidewire.Benchmarks
{
    /// <summary>Collision detection of one step for a wire along the wall of a bent tube, the same shape as meshes of a
    /// thousand, 50,000 and a million triangles: every element has a wall in reach, so each finds its nearest contact.
    /// The wire moves on along itself with every step and then back, so no step repeats the search of the last.
    /// </summary>
    public class DetectionBenchmark
    {
        private const int Elements = 100;
        private const double BendRadius = 100.0;    // units
        private const double TubeRadius = 10.0;
        private const double SphereRadius = 2.0;
        private const double Margin = 0.5;
        private const double Length = 300.0;        // of the wire
        private const double FromWall = 2.2;        // of the wire's core line
        private const double StepLength = 0.05;
        private const int StepsOneWay = 32;

        private ContactSearch _search = null!;
        private Vector3d[][] _wires = null!;        // at the start of each step of a cycle
        private int _step;

        [GlobalSetup(Target = nameof(Detect1e3))]
        public void Setup1e3() => Setup(10, 50);

        [GlobalSetup(Target = nameof(Detect5e4))]
        public void Setup5e4() => Setup(70, 358);

        [GlobalSetup(Target = nameof(Detect1e6))]
        public void Setup1e6() => Setup(316, 1582);

        [Benchmark]
        [Work(Elements, "element")]
        public void Detect1e3() => DetectStep();

        [Benchmark]
        [Work(Elements, "element")]
        public void Detect5e4() => DetectStep();

        [Benchmark]
        [Work(Elements, "element")]
        public void Detect1e6() => DetectStep();

        private void DetectStep()
        {
            int next = (_step + 1) % _wires.Length;
            _search.Find(_wires[_step], _wires[next]);
            _step = next;
        }

        private void Setup(int around, int along)
        {
            _search = new ContactSearch(new ContactShape[] { new MeshShape(BentTube(around, along)) }, Elements,
                Length / Elements, SphereRadius, SphereRadius + Margin, true);
            _wires = new Vector3d[2 * StepsOneWay][];
            for (int k = 0; k < _wires.Length; k++)
            {
                _wires[k] = Wire(StepLength * (StepsOneWay - Math.Abs(k - StepsOneWay)));
            }
        }

        // Along the outer wall, moved on along itself, units.
        private static Vector3d[] Wire(double motion)
        {
            var x = new Vector3d[Elements + 1];
            double r = BendRadius + TubeRadius - FromWall;
            for (int i = 0; i <= Elements; i++)
            {
                double angle = (3.0 * i + motion) / r;
                x[i] = new Vector3d(0.5 * Math.Sin(0.1 * i), r * Math.Cos(angle), r * Math.Sin(angle));
            }
            return x;
        }

        private static TriangleMesh BentTube(int around, int along)
        {
            var vertices = new Vector3d[around * (along + 1)];
            var triangles = new int[6 * around * along];
            for (int i = 0; i <= along; i++)
            {
                double angle = -0.1 + 3.3 * i / along;
                for (int k = 0; k < around; k++)
                {
                    double phi = 2.0 * Math.PI * k / around;
                    double r = BendRadius + TubeRadius * Math.Cos(phi);
                    vertices[i * around + k] = new Vector3d(
                        TubeRadius * Math.Sin(phi), r * Math.Cos(angle), r * Math.Sin(angle));
                }
            }
            int at = 0;
            for (int i = 0; i < along; i++)
            {
                for (int k = 0; k < around; k++)
                {
                    int a = i * around + k;
                    int b = i * around + (k + 1) % around;
                    foreach (int corner in new[] { a, b, b + around, a, b + around, a + around })
                    {
                        triangles[at++] = corner;
                    }
                }
            }
            var start = new Vector3d(0.0, BendRadius * Math.Cos(-0.1), BendRadius * Math.Sin(-0.1));
            var end = new Vector3d(0.0, BendRadius * Math.Cos(3.2), BendRadius * Math.Sin(3.2));
            return TriangleMesh.Create(vertices, triangles, new[] { start, end });
        }
    }
}
