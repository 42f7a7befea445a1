using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>A vessel's tree in cells of about the same length, from the inlet on: between two forks there are whole
    /// ones.</summary>
    internal sealed class VesselCells
    {
        private const int MaxCells = 1000;
        private const double PerRadius = 0.5;   // least length of a cell over the mean radius

        private readonly List<Vector3d> _middles = new List<Vector3d>();
        private readonly List<double> _radii = new List<double>();
        private readonly List<double> _lengths = new List<double>();
        private readonly List<int> _before = new List<int>();
        private readonly List<double> _shares = new List<double>();

        public VesselCells(VesselTree tree, Func<int, double?> given)
        {
            int count = tree.Points.Length;
            var after = new List<int>[count];
            double length = 0.0;
            double width = 0.0;
            for (int k = 0; k < count; k++)
            {
                after[k] = new List<int>();
                width += tree.Radii[k] / count;
                if (k > 0)
                {
                    after[tree.Before[k]].Add(k);
                    length += Vector3d.Distance(tree.Points[k], tree.Points[tree.Before[k]]);
                }
            }
            double side = Math.Max(length / MaxCells, PerRadius * width);
            // Chains between forks, each with the cell that it follows and its share of the flow.
            var waiting = new Queue<(int From, int First, int Cell, double Share)>();
            Branch(0, -1, 1.0);
            while (waiting.Count > 0)
            {
                (int from, int first, int cell, double share) = waiting.Dequeue();
                var chain = new List<int> { from, first };
                while (after[chain[^1]].Count == 1)
                {
                    chain.Add(after[chain[^1]][0]);
                }
                Branch(chain[^1], Add(tree, chain, side, cell, share), share);
            }
            (Middles, Radii, Lengths) = (_middles.ToArray(), _radii.ToArray(), _lengths.ToArray());
            (Before, Shares) = (_before.ToArray(), _shares.ToArray());

            void Branch(int point, int cell, double share)
            {
                double all = 0.0;
                foreach (int next in after[point])
                {
                    all += Weight(tree, after, next, given);
                }
                foreach (int next in after[point])
                {
                    waiting.Enqueue((point, next, cell, share * Weight(tree, after, next, given) / all));
                }
            }
        }

        /// <summary>The number of cells.</summary>
        public int Count => Before.Length;

        /// <summary>The cells' middles, mm.</summary>
        public Vector3d[] Middles { get; }

        /// <summary>The cells' radii, mm.</summary>
        public double[] Radii { get; }

        /// <summary>The cells' lengths, mm.</summary>
        public double[] Lengths { get; }

        /// <summary>The cell before each, smaller than its own number; -1 at the inlet.</summary>
        public int[] Before { get; }

        /// <summary>Flow through each over that at the inlet.</summary>
        public double[] Shares { get; }

        /// <summary>The cell whose sphere a point has the least power to.</summary>
        public static int Nearest(in Vector3d point, Vector3d[] middles, double[] radii)
        {
            int best = 0;
            double least = double.PositiveInfinity;
            for (int k = 0; k < middles.Length; k++)
            {
                double power = (point - middles[k]).LengthSquared - radii[k] * radii[k];
                if (power < least)
                {
                    (least, best) = (power, k);
                }
            }
            return best;
        }

        // Of the branch that begins with a point: as given, or the cube of the median of its radii.
        private static double Weight(VesselTree tree, List<int>[] after, int first, Func<int, double?> given)
        {
            if (given(first) is double flow)
            {
                return flow;
            }
            var radii = new List<double> { tree.Radii[first] };
            for (int k = first; after[k].Count == 1; k = after[k][0])
            {
                radii.Add(tree.Radii[after[k][0]]);
            }
            radii.Sort();
            double middle = radii[radii.Count / 2];
            return middle * middle * middle;
        }

        // Returns the chain's last cell.
        private int Add(VesselTree tree, List<int> chain, double side, int before, double share)
        {
            var at = new double[chain.Count];
            for (int k = 1; k < chain.Count; k++)
            {
                at[k] = at[k - 1] + Vector3d.Distance(tree.Points[chain[k]], tree.Points[chain[k - 1]]);
            }
            int cells = Math.Max(1, (int)(at[^1] / side));
            double length = Math.Max(at[^1] / cells, side);   // a branch shorter than a cell counts as one
            int segment = 1;
            for (int k = 0; k < cells; k++)
            {
                double middle = (k + 0.5) * at[^1] / cells;
                while (segment < chain.Count - 1 && at[segment] < middle)
                {
                    segment++;
                }
                double part = at[segment] > at[segment - 1]
                    ? (middle - at[segment - 1]) / (at[segment] - at[segment - 1]) : 0.0;
                (int one, int other) = (chain[segment - 1], chain[segment]);
                _middles.Add(tree.Points[one] + part * (tree.Points[other] - tree.Points[one]));
                _radii.Add(tree.Radii[one] + part * (tree.Radii[other] - tree.Radii[one]));
                _lengths.Add(length);
                _before.Add(k == 0 ? before : _before.Count - 1);
                _shares.Add(share);
            }
            return _before.Count - 1;
        }
    }
}
