using System;

namespace Guidewire.Core
{
    /// <summary>Counts how often an instrument passes through itself, from the positions of its nodes alone: how often
    /// two of its elements, which are no neighbours, cross between one look and the next, every node on a straight
    /// line.</summary>
    /// <remarks>Two elements a0 + s u and b0 + t v can meet only where (a0 - b0) . (u x v) is 0, a cubic in the time.
    /// A look is due where a node has moved by the instrument's radius, or at the end of a longer step. With a method
    /// that keeps strands apart a straight line may still cut a strand round which a wire snapped in one step: there a
    /// passage also has to change the writhe, by 2 (Fuller 1971).</remarks>
    internal sealed class StrandPassages
    {
        private const double Touching = 1e-8;    // of the elements' lengths: a distance that is rounding
        private const double Jump = 1.4;         // of the writhe, 2 less what a motion of some diameters may take away
        private const int Halvings = 60;

        private readonly double _radius;
        private readonly Vector3d[] _from;
        private readonly StrandPairs _pairs;

        /// <summary>Makes the count of an instrument, from its radius and the nodes of its start, both in one
        /// unit.</summary>
        public StrandPassages(double radius, Vector3d[] start)
        {
            int n = start.Length - 1;
            _radius = radius;
            _from = (Vector3d[])start.Clone();
            _pairs = new StrandPairs(new double[n], new double[n], n, 0.0);
        }

        /// <summary>How many nodes the instrument has.</summary>
        public int NodeCount => _from.Length;

        /// <summary>Passages so far.</summary>
        public long Total { get; private set; }

        /// <summary>Takes where the nodes are.</summary>
        /// <param name="keepsApart">Whether the method keeps strands apart.</param>
        /// <param name="isLast">Whether a look is due, however little they have moved.</param>
        public void Update(Vector3d[] x, bool keepsApart = false, bool isLast = false)
        {
            int n = _from.Length - 1;
            double moved = 0.0;
            for (int i = 0; i <= n; i++)
            {
                moved = Math.Max(moved, (x[i] - _from[i]).LengthSquared);
            }
            if (!(moved <= double.MaxValue) || moved == 0.0 || (moved < _radius * _radius && !isLast))
            {
                return;
            }
            _pairs.Find(_from, x);
            long crossed = 0;
            for (int k = 0; k < _pairs.Pairs.Count; k++)
            {
                crossed += Crosses(_from, x, _pairs.Pairs[k].First, _pairs.Pairs[k].Second) ? 1 : 0;
            }
            if (crossed > 0 && keepsApart)
            {
                crossed = Math.Abs(Writhe(x) - Writhe(_from)) > Jump ? 1 : 0;
            }
            Total += crossed;
            Begin(x);
        }

        /// <summary>Takes where the nodes are when none has come near another strand.</summary>
        public void Begin(Vector3d[] x) => Array.Copy(x, _from, _from.Length);

        // The double integral of Gauss over the polyline: the signed solid angles of all pairs of its elements.
        private static double Writhe(Vector3d[] x)
        {
            double sum = 0.0;
            for (int i = 0; i + 1 < x.Length; i++)
            {
                for (int j = i + 2; j + 1 < x.Length; j++)
                {
                    Vector3d[] normal =
                    {
                        Vector3d.Cross(x[j] - x[i], x[j + 1] - x[i]),
                        Vector3d.Cross(x[j + 1] - x[i], x[j + 1] - x[i + 1]),
                        Vector3d.Cross(x[j + 1] - x[i + 1], x[j] - x[i + 1]),
                        Vector3d.Cross(x[j] - x[i + 1], x[j] - x[i]),
                    };
                    double angle = 0.0;
                    for (int k = 0; k < 4; k++)
                    {
                        double size = Math.Sqrt(normal[k].LengthSquared * normal[(k + 1) % 4].LengthSquared);
                        double cosine = size > 0.0 ? Vector3d.Dot(normal[k], normal[(k + 1) % 4]) / size : 0.0;
                        angle += Math.Asin(Math.Max(-1.0, Math.Min(1.0, cosine)));
                    }
                    double side = Vector3d.Dot(Vector3d.Cross(x[j + 1] - x[j], x[i + 1] - x[i]), x[j] - x[i]);
                    sum += Math.Sign(side) * angle;
                }
            }
            return sum / (2.0 * Math.PI);
        }

        /// <summary>Writes or restores what was counted.</summary>
        public void Serialize(Snapshot snapshot)
        {
            Total = snapshot.Serialize(Total);
            snapshot.Serialize(_from);
        }

        // Whether elements j and k cross an odd number of times.
        private static bool Crosses(Vector3d[] from, Vector3d[] to, int j, int k)
        {
            Vector3d d = from[j] - from[k];
            Vector3d u = from[j + 1] - from[j];
            Vector3d v = from[k + 1] - from[k];
            Vector3d dMove = to[j] - to[k] - d;
            Vector3d uMove = to[j + 1] - to[j] - u;
            Vector3d vMove = to[k + 1] - to[k] - v;
            Vector3d n0 = Vector3d.Cross(u, v);
            Vector3d n1 = Vector3d.Cross(u, vMove) + Vector3d.Cross(uMove, v);
            Vector3d n2 = Vector3d.Cross(uMove, vMove);
            double c0 = Vector3d.Dot(d, n0);
            double c1 = Vector3d.Dot(d, n1) + Vector3d.Dot(dMove, n0);
            double c2 = Vector3d.Dot(d, n2) + Vector3d.Dot(dMove, n1);
            double c3 = Vector3d.Dot(dMove, n2);
            double At(double time) => c0 + time * (c1 + time * (c2 + time * c3));
            bool crosses = false;
            double begin = 0.0;
            double root = Math.Sqrt(Math.Max(0.0, c2 * c2 - 3.0 * c1 * c3));
            double q = -(c2 + (c2 < 0.0 ? -root : root));
            double one = q / (3.0 * c3);
            double two = c1 / q;
            foreach (double turning in new[] { Math.Min(one, two), Math.Max(one, two), 1.0 })
            {
                double end = turning > begin && turning < 1.0 ? turning : 1.0;
                if (end > begin && At(begin) < 0.0 != At(end) < 0.0)
                {
                    double low = begin;
                    double high = end;
                    for (int halving = 0; halving < Halvings; halving++)
                    {
                        double middle = 0.5 * (low + high);
                        (low, high) = At(middle) < 0.0 == At(begin) < 0.0 ? (middle, high) : (low, middle);
                    }
                    crosses ^= Touch(from, to, j, k, high);
                }
                begin = turning > begin && turning < 1.0 ? turning : begin;
            }
            return crosses;
        }

        private static bool Touch(Vector3d[] from, Vector3d[] to, int j, int k, double time)
        {
            Vector3d a0 = Vector3d.Lerp(from[j], to[j], time);
            Vector3d a1 = Vector3d.Lerp(from[j + 1], to[j + 1], time);
            Vector3d b0 = Vector3d.Lerp(from[k], to[k], time);
            Vector3d b1 = Vector3d.Lerp(from[k + 1], to[k + 1], time);
            double near = Touching * (Vector3d.Distance(a0, a1) + Vector3d.Distance(b0, b1));
            return ClosestPoints.SegmentSegment(a0, a1, b0, b1, out _, out _) <= near * near;
        }
    }
}
