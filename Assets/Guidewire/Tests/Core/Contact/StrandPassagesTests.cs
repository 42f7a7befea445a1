using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Passages of a wire through itself on paths that are known.</summary>
    public sealed class StrandPassagesTests
    {
        [TestCase(0.3, 2, 1)]
        [TestCase(0.3, 300, 1)]     // steps far below the radius
        [TestCase(-1.5, 2, 0)]      // beside the strand
        public void StrandThroughStrand_Counts_BesideItDoesNot(double across, int steps, int expected)
        {
            Vector3d[] x = Loop(across, 0.5);
            var passages = new StrandPassages(0.05, x);
            for (int step = 1; step <= steps; step++)
            {
                passages.Update(Loop(across, 0.5 - 1.0 * step / steps));
            }
            passages.Update(Loop(across, -0.5), isLast: true);
            Assert.That(passages.Total, Is.EqualTo(expected));
        }

        [Test]
        public void ThereAndBackWithinALook_IsNoPassage_AndEachWayIsOne()
        {
            var passages = new StrandPassages(0.05, Loop(0.3, 0.5));
            passages.Update(Loop(0.3, 0.51));
            Assert.That(passages.Total, Is.Zero);
            passages.Update(Loop(0.3, -0.5));
            passages.Update(Loop(0.3, 0.5));
            Assert.That(passages.Total, Is.EqualTo(2));
        }

        [Test]
        public void SlidingAlongItself_IsNoPassage()
        {
            // A coil of two turns, one above the other, that advances along itself.
            Vector3d[] At(double shift)
            {
                var x = new Vector3d[81];
                for (int i = 0; i < x.Length; i++)
                {
                    double angle = 0.16 * (i + shift);
                    x[i] = new Vector3d(System.Math.Cos(angle), System.Math.Sin(angle), 0.02 * angle);
                }
                return x;
            }
            var passages = new StrandPassages(0.05, At(0.0));
            for (int step = 1; step <= 40; step++)
            {
                passages.Update(At(0.5 * step), isLast: true);
            }
            Assert.That(passages.Total, Is.Zero);
        }

        // Two strands that cross where the second one is so far across, at a height over the first.
        private static Vector3d[] Loop(double across, double height) => new[]
        {
            new Vector3d(-1.0, 0.0, 0.0), new Vector3d(0.1, 0.0, 0.0), new Vector3d(1.0, 0.0, 0.0),
            new Vector3d(2.0, 1.0, 0.0), new Vector3d(1.0, 2.0, height), new Vector3d(across, 1.0, height),
            new Vector3d(across, -0.9, height),
        };
    }
}
