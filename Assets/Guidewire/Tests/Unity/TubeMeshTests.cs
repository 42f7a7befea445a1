using Guidewire.Core;
using Guidewire.Runtime;
using NUnit.Framework;
using UnityEngine;

namespace Guidewire.Unity.Tests
{
    public sealed class TubeMeshTests
    {
        private const int PerElement = 4;
        private const int Sides = 12;
        private const float Radius = 5f;
        private const float Rounding = 1e-3f;    // units: float at 300 units has steps of 3e-5

        private static RodState Bent()
        {
            var state = new RodState(6, 60.0, 1.0, 0.0);
            for (int i = 0; i <= 6; i++)
            {
                double angle = 0.15 * i;
                state.Place(i, new Vector3d(0.0, 66.0 * (1.0 - System.Math.Cos(angle)), 66.0 * System.Math.Sin(angle)));
            }
            return state;
        }

        private static TubeMesh Write(RodState state)
        {
            var tube = new TubeMesh(state.SphereCount, PerElement, Sides);
            Assert.That(tube.Write(state, Radius, new float[state.SphereCount]), Is.True);
            return tube;
        }

        [Test]
        public void RingOfASphere_LiesAroundIt()
        {
            RodState state = Bent();
            TubeMesh tube = Write(state);
            for (int i = 0; i <= 6; i++)
            {
                Vector3 centre = state.Positions[i].ToUnity();
                Vector3 sum = Vector3.zero;
                for (int k = 0; k < Sides; k++)
                {
                    Vector3 vertex = tube.Vertices[tube.RingOf(i) + k];
                    Assert.That(Vector3.Distance(vertex, centre), Is.EqualTo(Radius).Within(Rounding), "sphere " + i);
                    sum += vertex;
                }
                Assert.That(Vector3.Distance(sum / Sides, centre), Is.LessThan(Rounding), "sphere " + i);
            }
        }

        [Test]
        public void EveryTriangle_LooksOutwards()
        {
            TubeMesh tube = Write(Bent());
            for (int t = 0; t < tube.Triangles.Length; t += 3)
            {
                int a = tube.Triangles[t];
                int b = tube.Triangles[t + 1];
                int c = tube.Triangles[t + 2];
                Vector3 face = Vector3.Cross(tube.Vertices[b] - tube.Vertices[a], tube.Vertices[c] - tube.Vertices[a]);
                if (face.magnitude > Rounding)
                {
                    Assert.That(Vector3.Dot(face, tube.Normals[a]), Is.GreaterThan(0f), "triangle " + t / 3);
                }
            }
        }

        [Test]
        public void Normals_HaveUnitLength()
        {
            foreach (Vector3 normal in Write(Bent()).Normals)
            {
                Assert.That(normal.magnitude, Is.EqualTo(1f).Within(1e-4f));
            }
        }

        [Test]
        public void StraightWire_GivesAStraightTubeWithRoundEnds()
        {
            TubeMesh tube = Write(new RodState(3, 30.0, 1.0, -10.0));
            float lowest = 0f;
            float highest = 0f;
            foreach (Vector3 vertex in tube.Vertices)
            {
                lowest = Mathf.Min(lowest, vertex.z);
                highest = Mathf.Max(highest, vertex.z);
                float outside = Mathf.Max(-10f - vertex.z, vertex.z - 20f);
                float expected = outside > 0f ? Mathf.Sqrt(Mathf.Max(0f, Radius * Radius - outside * outside)) : Radius;
                Assert.That(Mathf.Sqrt(vertex.x * vertex.x + vertex.y * vertex.y), Is.EqualTo(expected).Within(0.01f));
            }
            Assert.That(lowest, Is.EqualTo(-10f - Radius).Within(Rounding));
            Assert.That(highest, Is.EqualTo(20f + Radius).Within(Rounding));
        }

        [Test]
        public void PositionThatIsNotFinite_LeavesTheTubeAsItWas()
        {
            RodState state = Bent();
            TubeMesh tube = Write(state);
            Vector3 before = tube.Vertices[40];
            state.Place(3, new Vector3d(double.NaN, 0.0, 0.0));
            Assert.That(tube.Write(state, Radius, new float[7]), Is.False);
            Assert.That(tube.Vertices[40], Is.EqualTo(before));
        }

        [Test]
        public void SpheresInOnePlace_GiveFiniteVertices()
        {
            var state = new RodState(3, 30.0, 1.0, 0.0);
            for (int i = 0; i <= 3; i++)
            {
                state.Place(i, Vector3d.Zero);
            }
            foreach (Vector3 vertex in Write(state).Vertices)
            {
                Assert.That(vertex.IsFinite(), Is.True);
            }
        }
    }
}
