using System;
using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The stiffness of a vessel's wall under a line load, against a beam on a foundation and a chain of
    /// springs.</summary>
    public sealed class VesselWallTests
    {
        [Test]
        public void WideVessel_IsABeamOnAFoundation()
        {
            const double modulus = 1e6;
            const double thickness = 1e-3;
            const double radius = 1.0;
            const double surrounding = 1e5;
            double bending = modulus * thickness * thickness * thickness / 9.0;
            double foundation = 2.0 / 3.0 * surrounding / radius;
            double beam = 2.0 * Math.Sqrt(2.0) * Math.Pow(bending, 0.25) * Math.Pow(foundation, 0.75);
            Assert.That(VesselWall.Stiffness(modulus, thickness, radius, surrounding),
                Is.EqualTo(beam).Within(2e-3 * beam));
        }

        /// <summary>A ring of straight pieces with hinges that bend, stretch, and press on springs; Cholesky's method.
        /// </summary>
        [TestCase(5e5, 3e-4, 3e-3, 1e4)]
        [TestCase(1e6, 1e-4, 2e-3, 5e3)]
        public void Ring_IsThatOfManyPieces(double modulus, double thickness, double radius, double surrounding)
        {
            const int count = 360;
            double length = 2.0 * radius * Math.Sin(Math.PI / count);
            double bending = modulus * Math.Pow(thickness, 3) / 9.0 / length;
            double stretching = 4.0 / 3.0 * modulus * thickness / length;
            double spring = 2.0 / 3.0 * surrounding / radius * 2.0 * Math.PI * radius / count;
            var matrix = new double[2 * count, 2 * count];
            for (int i = 0; i < count; i++)
            {
                AddOuter(matrix, stretching, (i, Along(i, 1)), ((i + 1) % count, -1.0 * Along(i, 1)));
                int before = (i + count - 1) % count;
                int after = (i + 1) % count;
                Vector3d first = (1.0 / length) * Across(before);
                Vector3d second = (1.0 / length) * Across(i);
                AddOuter(matrix, bending, (before, first), (i, -1.0 * (first + second)), (after, second));
                AddOuter(matrix, spring, (i, Radial(i)));
            }
            double[] load = new double[2 * count];
            load[0] = 1.0;
            double[] moved = Solve(matrix, load);
            double expected = 1.0 / moved[0];
            Assert.That(VesselWall.Stiffness(modulus, thickness, radius, surrounding),
                Is.EqualTo(expected).Within(1e-2 * expected));

            Vector3d Radial(int i) => new Vector3d(Math.Cos(2.0 * Math.PI * i / count),
                Math.Sin(2.0 * Math.PI * i / count), 0.0);
            Vector3d Along(int i, int step) => Vector3d.Normalize(Radial(i + step) - Radial(i));
            Vector3d Across(int i) => Vector3d.Cross(Vector3d.UnitZ, Along(i, 1));
        }

        private static void AddOuter(double[,] matrix, double factor, params (int Node, Vector3d Part)[] parts)
        {
            foreach ((int i, Vector3d a) in parts)
            {
                foreach ((int j, Vector3d b) in parts)
                {
                    matrix[2 * i, 2 * j] += factor * a.X * b.X;
                    matrix[2 * i, 2 * j + 1] += factor * a.X * b.Y;
                    matrix[2 * i + 1, 2 * j] += factor * a.Y * b.X;
                    matrix[2 * i + 1, 2 * j + 1] += factor * a.Y * b.Y;
                }
            }
        }

        private static double[] Solve(double[,] matrix, double[] right)
        {
            int n = right.Length;
            for (int k = 0; k < n; k++)
            {
                for (int i = k + 1; i < n; i++)
                {
                    double factor = matrix[i, k] / matrix[k, k];
                    for (int j = k; j < n && factor != 0.0; j++)
                    {
                        matrix[i, j] -= factor * matrix[k, j];
                    }
                    right[i] -= factor * right[k];
                }
            }
            for (int k = n - 1; k >= 0; k--)
            {
                for (int j = k + 1; j < n; j++)
                {
                    right[k] -= matrix[k, j] * right[j];
                }
                right[k] /= matrix[k, k];
            }
            return right;
        }

        /// <summary>Every third of these vertices is looked at, and each one that goes farther.</summary>
        [TestCase(0, 0.0)]
        [TestCase(0, 50.0)]
        [TestCase(1, 50.0)]
        [TestCase(5000, -50.0)]
        public void MisfitOfFrames_HasAlsoTheVertexThatAloneIsElsewhere(int vertex, double off)
        {
            var line = new Vector3d[41];
            for (int k = 0; k < line.Length; k++)
            {
                line[k] = new Vector3d(0.0, 0.0, 2.5 * k);
            }
            var rest = new Vector3d[5001];
            for (int i = 0; i < rest.Length; i++)
            {
                rest[i] = new Vector3d(3.0 * Math.Cos(0.7 * i), 3.0 * Math.Sin(0.7 * i), 100.0 * i / rest.Length);
            }
            Vector3d[][] frames = new double[] { 0.0, 1.0, 2.0, 1.0 }.Select(y =>
                rest.Select(x => x + new Vector3d(0.0, y, 0.0)).ToArray()).ToArray();
            double[][] rows = FrameFit.Rows(new[] { line }, 2.5, frames);
            frames[2][vertex] += new Vector3d(off, 0.0, 0.0);
            MotionCycle cycle = MotionCycle.Table(1.0, 0.0, new[] { 0.0, 0.25, 0.5, 0.75 }, rows, null);
            Assert.That(FrameFit.Misfit(cycle, new[] { line }, 2.5, frames).Largest,
                Is.EqualTo(Math.Abs(off)).Within(1e-3));
        }
    }
}
