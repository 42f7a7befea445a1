using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What a neighbour list answers against the wall itself, while the wire goes to and fro.</summary>
    public sealed class NeighbourListTests
    {
        private const int Most = 8;              // elements
        private const double Skin = 0.2;
        private const int Others = 1 << 14;      // features that others find in a step: some ten steps clear a cache

        [TestCase("bumpy ball")]
        [TestCase("wavy tube")]
        public void Answers_AreThoseOfTheWall_WhateverComesAndGoes(string name)
        {
            ContactShape wall = TestShapes.Make(name);
            FeatureCache? cache = wall.FeatureCacheFor(Skin);
            var random = new RandomGeometry(79);
            var range = new double[Most];
            var list = new NeighbourList(new[] { wall }, range, Skin);
            var places = new[] { new Vector3d[Most + 1], new Vector3d[Most + 1] };
            var x = new Vector3d[Most + 1];
            int count = 4;
            int compared = 0;
            for (int t = 0; t < RandomGeometry.Cases(2000); t++)
            {
                if (t % 8 == 0)
                {
                    int? entered = t == 0 ? (int?)null : random.Index(Most) + 1 - count;
                    count += entered ?? 0;
                    list.KeepRanges();
                    Array.ForEach(places, nodes => Shift(nodes, entered, () => 0.7 * random.Point()));
                    Shift(range, entered, () => random.Number(0.02, 0.4));
                    for (int j = 0; j < Most; j++)
                    {
                        range[j] = random.Index(3) > 0 ? range[j] : random.Number(0.02, 0.4);
                    }
                    list.Remesh(count, entered);
                }
                for (int k = 0; k < Others && cache != null; k++)
                {
                    cache.Features.Add(default);
                }
                for (int i = 0; i <= count; i++)
                {
                    x[i] = places[random.Index(2)][i] + 0.1 * random.Point();
                }
                list.Follow(new[] { x });
                for (int i = 0; i <= count; i++)
                {
                    compared += AssertNode(wall, list, x, range, i, count) ? 1 : 0;
                }
                for (int j = 0; j < count; j++)
                {
                    compared += AssertElement(wall, list, x, range[j], j) ? 1 : 0;
                }
            }
            Assert.That(compared, Is.GreaterThan(200), "too little is near");
        }

        private static bool AssertNode(ContactShape wall, NeighbourList list, Vector3d[] x, double[] ranges, int i,
            int count)
        {
            double range = Math.Max(ranges[Math.Max(i - 1, 0)], ranges[Math.Min(i, count - 1)]);
            var exact = new StructList<ContactPoint>(8);
            wall.FindContactPoints(x[i], range, default, exact);
            if (!wall.Contains(x[i]) || exact.Count == 0)
            {
                return false;
            }
            Assert.That(list.NodeMayBeInRange(0, i, x), Is.True, "node " + i);
            var found = new StructList<ContactPoint>(8);
            wall.FindContactPoints(x[i], range, list.FeaturesOfNode(0, i, x[i]), found);
            Assert.That(Sum(found), Is.EqualTo(Sum(exact)).Within(1e-12), "node " + i);
            return true;

            static double Sum(StructList<ContactPoint> points)
            {
                double sum = 0.0;
                for (int k = 0; k < points.Count; k++)
                {
                    sum += points[k].Weight * points[k].Contact.Distance;
                }
                return sum;
            }
        }

        private static bool AssertElement(ContactShape wall, NeighbourList list, Vector3d[] x, double range, int j)
        {
            if (!wall.Contains(x[j]) || !wall.Contains(x[j + 1]))
            {
                return false;
            }
            int hint = -1;
            wall.Nearest(x[j], x[j + 1], double.PositiveInfinity, ref hint, out SurfaceContact contact);
            double distance = wall.UnsignedDistance(contact.Distance);
            Assert.That(list.ClearanceOf(0, x, j), Is.LessThan(distance + 1e-12), "element " + j);
            Assert.That(list.MayBeInRange(0, j, x) || distance > range, Is.True, "element " + j);
            double exact = Sum(default);
            Assert.That(Sum(list.FeaturesOf(0, j, x[j], x[j + 1])), Is.EqualTo(exact).Within(1e-12), "element " + j);
            return exact != 0.0;

            double Sum(FeatureRange features)
            {
                double sum = 0.0;
                var edges = new StructList<EdgeContact>(8);
                wall.FindEdgeContacts(x[j], x[j + 1], range, features, edges);
                for (int k = 0; k < edges.Count; k++)
                {
                    sum += edges[k].Distance <= range && edges[k].Distance > 0.0 ? edges[k].Weight : 0.0;
                }
                return sum;
            }
        }

        // What stood at k stands at k + by; all others are made anew, and everything is where by is null.
        private static void Shift<T>(T[] values, int? by, Func<T> make)
        {
            T[] were = (T[])values.Clone();
            for (int k = 0; k < values.Length; k++)
            {
                values[k] = k - by is int from && from >= 0 && from < were.Length ? were[from] : make();
            }
        }
    }
}
