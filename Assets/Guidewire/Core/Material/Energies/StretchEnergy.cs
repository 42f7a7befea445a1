using System;
using System.Runtime.CompilerServices;
#if NET8_0_OR_GREATER
using System.Runtime.Intrinsics;
#endif

namespace Guidewire.Core
{
    /// <summary>Stretch and shear of the elements: l/2 Gamma^T K Gamma with Gamma = p - e3, p = R^T (x_(j+1) - x_j)/l
    /// and K = diag(GA, GA, EA) (thesis, stretch constraint, as an energy).</summary>
    /// <remarks>With n = K Gamma along the element's axes and M = K [p] - [n], where [a] b = a x b:
    ///   force on x_(j+1): R n;   couple on theta: l n x p;   d(force)/d(theta) = R M;   d(force)/dx = R K R^T/l;
    ///   d(couple)/d(theta) = l ([p]^T K [p] + sym(n p^T) - (n . p) 1).
    /// The third column of M is 0: a turn about the element's own axis leaves a straight element alone.</remarks>
    internal sealed class StretchEnergy : EnergyTerm
    {
        private readonly MaterialRod _rod;
        private readonly double[] _length;   // m
        private readonly double[] _shear;    // GA, N
        private readonly double[] _stretch;  // EA, N
        private readonly Vector3d[]? _rest;  // p at rest, where it is not e3

        private bool _dropsGeometricStiffness;

        /// <summary>Makes the energy of a rod with these elements.</summary>
        /// <param name="rest">p at which each element has no stress, or null for e3.</param>
        public StretchEnergy(MaterialRod rod, Vector3d[]? rest = null)
        {
            _rest = rest;
            _rod = rod;
            _length = rod.Length;
            _shear = rod.ShearStiffness;
            _stretch = rod.StretchStiffness;
        }

        /// <summary>Leaves the part of compressed elements' second derivatives out that goes with their force, which
        /// is not positive.</summary>
        public override void DropGeometricStiffness(bool isOn) => _dropsGeometricStiffness = isOn;

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            int first = 0;
#if NET8_0_OR_GREATER
            if (HasLanes)
            {
                first = StretchLanes.AddValue(shape, _length, _shear, _stretch, 0, _rod.ElementCount, ref sum);
            }
#endif
            for (int j = first; j < _rod.ElementCount; j++)
            {
                Vector3d n = Stress(shape, j, out Vector3d p);
                Vector3d strain = p - (_rest == null ? Vector3d.UnitZ : _rest[j]);
                sum += 0.5 * _length[j] * (n.X * strain.X + n.Y * strain.Y + n.Z * strain.Z);
            }
            return sum;
        }

        /// <summary>n = K Gamma of element j along its own axes, N, and p, the element's chord over its
        /// length.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Vector3d Stress(RodShape shape, int j, out Vector3d p)
        {
            Vector3d d = (1.0 / _length[j]) * (shape.X[j + 1] - shape.X[j]);
            p = Quaterniond.Rotate(shape.Q[j].Conjugate, d);
            return _rest == null ? new Vector3d(_shear[j] * p.X, _shear[j] * p.Y, _stretch[j] * (p.Z - 1.0))
                : StressFrom(_rest[j], p, j);
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            int end = to < _rod.ElementCount ? to : _rod.ElementCount;
            double largest = 0.0;
#if NET8_0_OR_GREATER
            if (HasLanes)
            {
                from = StretchLanes.AddGradient(shape, _length, _shear, _stretch, gradient, from, end, ref largest);
            }
#endif
            for (int j = from; j < end; j++)
            {
                Vector3d n = Stress(shape, j, out Vector3d p);
                largest = Math.Max(largest, n.LengthSquared);
                Vector3d force = Quaterniond.Rotate(shape.Q[j], n);
                AddForce(ref gradient[j], ref gradient[j + 1], force, n, p, _length[j]);
            }
            measured.IncludeForce(Math.Sqrt(largest));
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            int end = to < _rod.ElementCount ? to : _rod.ElementCount;
#if NET8_0_OR_GREATER
            if (HasLanes)
            {
                from = StretchLanes.AddBlocks(shape, _length, _shear, _stretch, blocks, gradient, from, end,
                    _dropsGeometricStiffness);
            }
#endif
            for (int j = from; j < end; j++)
            {
                double l = _length[j];
                double shear = _shear[j];
                double excess = _stretch[j] - shear;
                Quaterniond q = shape.Q[j];
                Vector3d d1 = q.Director1;
                Vector3d d2 = q.Director2;
                Vector3d d3 = q.Director3;
                Vector3d d = (1.0 / l) * (shape.X[j + 1] - shape.X[j]);
                Vector3d p = new Vector3d(Vector3d.Dot(d1, d), Vector3d.Dot(d2, d), Vector3d.Dot(d3, d));
                Vector3d n = _rest == null ? new Vector3d(shear * p.X, shear * p.Y, _stretch[j] * (p.Z - 1.0))
                    : StressFrom(_rest[j], p, j);
                Vector3d force = n.X * d1 + n.Y * d2 + n.Z * d3;
                AddForce(ref gradient[j], ref gradient[j + 1], force, n, p, l);

                // (x, x): (GA 1 + (EA - GA) d3 d3^T)/l, with the opposite sign between the two nodes.
                double k = excess / l;
                double h11 = shear / l + k * d3.X * d3.X;
                double h22 = shear / l + k * d3.Y * d3.Y;
                double h33 = shear / l + k * d3.Z * d3.Z;
                double h21 = k * d3.Y * d3.X;
                double h31 = k * d3.Z * d3.X;
                double h32 = k * d3.Z * d3.Y;
                ref RodBlock block = ref blocks[j];
                ref RodBlock next = ref blocks[j + 1];
                block.A11 += h11; block.A21 += h21; block.A22 += h22;
                block.A31 += h31; block.A32 += h32; block.A33 += h33;
                next.A11 += h11; next.A21 += h21; next.A22 += h22;
                next.A31 += h31; next.A32 += h32; next.A33 += h33;
                block.D11 -= h11; block.D12 -= h21; block.D13 -= h31;
                block.D21 -= h21; block.D22 -= h22; block.D23 -= h32;
                block.D31 -= h31; block.D32 -= h32; block.D33 -= h33;

                // (x+, theta) = R M, column by column: (a d2 - (EA - GA) p2 d3, -a d1 + (EA - GA) p1 d3, 0).
                Vector3d g = _dropsGeometricStiffness && n.Z < 0.0 ? Vector3d.Zero : n;
                double a = shear * p.Z - g.Z;
                Vector3d first = a * d2 - (excess * p.Y) * d3;
                Vector3d second = (excess * p.X) * d3 - a * d1;
                block.E11 += first.X; block.E21 += first.Y; block.E31 += first.Z;
                block.E12 += second.X; block.E22 += second.Y; block.E32 += second.Z;
                block.B11 -= first.X; block.B12 -= first.Y; block.B13 -= first.Z;
                block.B21 -= second.X; block.B22 -= second.Y; block.B23 -= second.Z;

                if (_rest != null)
                {
                    AddShearedRest(ref block, d1, d2, d3, shear * _rest[j]);
                }

                // (theta, theta): l (GA (|p|^2 1 - p p^T) + (EA - GA) r r^T + sym(n p^T) - (n . p) 1), r = (-p2, p1,
                // 0).
                double diagonal = l * (shear * p.LengthSquared - Vector3d.Dot(g, p));
                double ls = l * shear;
                double le = l * excess;
                double lh = 0.5 * l;
                block.C11 += diagonal - ls * p.X * p.X + le * p.Y * p.Y + l * g.X * p.X;
                block.C22 += diagonal - ls * p.Y * p.Y + le * p.X * p.X + l * g.Y * p.Y;
                block.C33 += diagonal - ls * p.Z * p.Z + l * g.Z * p.Z;
                block.C21 += lh * (g.X * p.Y + g.Y * p.X) - (ls + le) * p.X * p.Y;
                block.C31 += lh * (g.X * p.Z + g.Z * p.X) - ls * p.X * p.Z;
                block.C32 += lh * (g.Y * p.Z + g.Z * p.Y) - ls * p.Y * p.Z;
            }
        }

#if NET8_0_OR_GREATER
        private bool HasLanes => _rest == null && Rows4.IsSupported;
#endif

        private Vector3d StressFrom(in Vector3d rest, in Vector3d p, int j) =>
            new Vector3d(_shear[j] * (p.X - rest.X), _shear[j] * (p.Y - rest.Y), _stretch[j] * (p.Z - rest.Z));

        /// <summary>What (x+, theta) = R M has more where an element is sheared at rest, s = GA p_rest: a third column
        /// s2 d1 - s1 d2, and -s2 d3 and s1 d3 in the first and second.</summary>
        private static void AddShearedRest(ref RodBlock block, in Vector3d d1, in Vector3d d2, in Vector3d d3,
            in Vector3d s)
        {
            Vector3d first = -s.Y * d3;
            Vector3d second = s.X * d3;
            Vector3d third = s.Y * d1 - s.X * d2;
            block.E11 += first.X; block.E21 += first.Y; block.E31 += first.Z;
            block.E12 += second.X; block.E22 += second.Y; block.E32 += second.Z;
            block.E13 += third.X; block.E23 += third.Y; block.E33 += third.Z;
            block.B11 -= first.X; block.B12 -= first.Y; block.B13 -= first.Z;
            block.B21 -= second.X; block.B22 -= second.Y; block.B23 -= second.Z;
            block.B31 -= third.X; block.B32 -= third.Y; block.B33 -= third.Z;
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static void AddForce(ref RodVector node, ref RodVector next, in Vector3d force, in Vector3d n,
            in Vector3d p, double l)
        {
            node.AddX(-force);
            next.AddX(force);
            node.T1 += l * (n.Y * p.Z - n.Z * p.Y);
            node.T2 += l * (n.Z * p.X - n.X * p.Z);
            node.T3 += l * (n.X * p.Y - n.Y * p.X);
        }
    }

#if NET8_0_OR_GREATER
    /// <summary><see cref="StretchEnergy"/> of elements with p = e3 at rest, four at a time, with its formulas in its
    /// order: the same bits. Every method begins at one element and returns the first that is left.</summary>
    internal static class StretchLanes
    {
        private const int Stride = 48;   // numbers of a RodBlock
        private const int Step = 6;      // and of a RodVector

        /// <summary>Adds the energies of elements to a sum, J.</summary>
        public static int AddValue(RodShape shape, double[] length, double[] shear, double[] stretch, int from, int end,
            ref double sum)
        {
            double total = sum;
            int j = from;
            for (; j + 4 <= end; j += 4)
            {
                Vector256<double> l = Vector256.LoadUnsafe(ref length[j]);
                Vector3d4 n = Stress(shape, l, shear, stretch, Quaterniond4.Load(ref shape.Q[j]), j, out Vector3d4 p);
                Vector256<double> products = n.X * p.X + n.Y * p.Y + n.Z * (p.Z - Vector256.Create(1.0));
                total = Rows4.Sum(total, Vector256.Create(0.5) * l * products);
            }
            sum = total;
            return j;
        }

        /// <summary>Adds the gradients of elements.</summary>
        /// <param name="largest">In and out: largest square of a force, N^2.</param>
        public static int AddGradient(RodShape shape, double[] length, double[] shear, double[] stretch,
            RodVector[] gradient, int from, int end, ref double largest)
        {
            Vector256<double> squares = Vector256<double>.Zero;
            int j = from;
            for (; j + 4 <= end; j += 4)
            {
                Vector256<double> l = Vector256.LoadUnsafe(ref length[j]);
                Quaterniond4 q = Quaterniond4.Load(ref shape.Q[j]);
                Vector3d4 n = Stress(shape, l, shear, stretch, q, j, out Vector3d4 p);
                squares = Vector256.Max(squares, n.LengthSquared);
                AddForce(ref gradient[j], ref gradient[j + 1], Quaterniond4.Rotate(q, n), n, p, l);
            }
            largest = Math.Max(Math.Max(Math.Max(largest, squares.GetElement(0)), squares.GetElement(1)),
                Math.Max(squares.GetElement(2), squares.GetElement(3)));
            return j;
        }

        /// <summary>Adds gradients and blocks of elements.</summary>
        public static int AddBlocks(RodShape shape, double[] length, double[] shears, double[] stretch,
            RodBlock[] blocks, RodVector[] gradient, int from, int end, bool dropsGeometricStiffness)
        {
            Vector256<double> one = Vector256.Create(1.0);
            Vector256<double> sign = Vector256.Create(-0.0);
            Vector256<double> dropped = dropsGeometricStiffness
                ? Vector256<double>.AllBitsSet : Vector256<double>.Zero;
            int j = from;
            for (; j + 4 <= end; j += 4)
            {
                Vector256<double> l = Vector256.LoadUnsafe(ref length[j]);
                Vector256<double> shear = Vector256.LoadUnsafe(ref shears[j]);
                Vector256<double> axial = Vector256.LoadUnsafe(ref stretch[j]);
                Vector256<double> excess = axial - shear;
                Quaterniond4 q = Quaterniond4.Load(ref shape.Q[j]);
                Vector3d4 d1 = q.Director1;
                Vector3d4 d2 = q.Director2;
                Vector3d4 d3 = q.Director3;
                Vector3d4 d = (one / l) * (Vector3d4.Load(ref shape.X[j + 1]) - Vector3d4.Load(ref shape.X[j]));
                var p = new Vector3d4(Vector3d4.Dot(d1, d), Vector3d4.Dot(d2, d), Vector3d4.Dot(d3, d));
                var n = new Vector3d4(shear * p.X, shear * p.Y, axial * (p.Z - one));
                AddForce(ref gradient[j], ref gradient[j + 1], n.X * d1 + n.Y * d2 + n.Z * d3, n, p, l);

                ref RodBlock block = ref blocks[j];
                ref RodBlock next = ref blocks[j + 1];
                Vector256<double> even = shear / l;
                Vector256<double> k = excess / l;
                Vector256<double> h11 = even + k * d3.X * d3.X;
                Vector256<double> h22 = even + k * d3.Y * d3.Y;
                Vector256<double> h33 = even + k * d3.Z * d3.Z;
                Vector256<double> h21 = k * d3.Y * d3.X;
                Vector256<double> h31 = k * d3.Z * d3.X;
                Vector256<double> h32 = k * d3.Z * d3.Y;
                Rows4.Add(ref next.A11, Stride, h11, h21, h31, Rows4.Nothing);
                Rows4.Add(ref next.A22, Stride, h22, h32);
                Rows4.Add(ref next.A33, Stride, h33, Rows4.Nothing);

                Vector256<double> free = Vector256.AndNot(Vector256<double>.AllBitsSet,
                    dropped & Vector256.LessThan(n.Z, Vector256<double>.Zero));
                var g = new Vector3d4(n.X & free, n.Y & free, n.Z & free);
                Vector256<double> a = shear * p.Z - g.Z;
                Vector3d4 first = a * d2 - (excess * p.Y) * d3;
                Vector3d4 second = (excess * p.X) * d3 - a * d1;
                Rows4.Add(ref block.A11, Stride, h11, h21, h31, first.X ^ sign);
                Rows4.Add(ref block.B21, Stride, second.X ^ sign, Rows4.Nothing, h11 ^ sign, h21 ^ sign);
                Rows4.Add(ref block.D31, Stride, h31 ^ sign, h22, h32, first.Y ^ sign);
                Rows4.Add(ref block.B22, Stride, second.Y ^ sign, Rows4.Nothing, h21 ^ sign, h22 ^ sign);
                Rows4.Add(ref block.D32, Stride, h32 ^ sign, h33, first.Z ^ sign, second.Z ^ sign);

                Vector256<double> ls = l * shear;
                Vector256<double> le = l * excess;
                Vector256<double> lh = Vector256.Create(0.5) * l;
                Vector256<double> diagonal = l * (shear * p.LengthSquared - Vector3d4.Dot(g, p));
                Vector256<double> c11 = diagonal - ls * p.X * p.X + le * p.Y * p.Y + l * g.X * p.X;
                Vector256<double> c22 = diagonal - ls * p.Y * p.Y + le * p.X * p.X + l * g.Y * p.Y;
                Vector256<double> c33 = diagonal - ls * p.Z * p.Z + l * g.Z * p.Z;
                Vector256<double> c21 = lh * (g.X * p.Y + g.Y * p.X) - (ls + le) * p.X * p.Y;
                Vector256<double> c31 = lh * (g.X * p.Z + g.Z * p.X) - ls * p.X * p.Z;
                Vector256<double> c32 = lh * (g.Y * p.Z + g.Z * p.Y) - ls * p.Y * p.Z;
                Rows4.Add(ref block.D13, Stride, h31 ^ sign, h32 ^ sign, h33 ^ sign, c11);
                Rows4.Add(ref block.C21, Stride, c21, c31, first.X, first.Y);
                Rows4.Add(ref block.E31, Stride, first.Z, Rows4.Nothing);
                Rows4.Add(ref block.C22, Stride, c22, c32, second.X, second.Y);
                Rows4.Add(ref block.E32, Stride, second.Z, Rows4.Nothing);
                Rows4.Add(ref block.C33, Stride, c33, Rows4.Nothing);
            }
            return j;
        }

        // StretchEnergy.Stress.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector3d4 Stress(RodShape shape, Vector256<double> l, double[] shears, double[] stretch,
            Quaterniond4 q, int j, out Vector3d4 p)
        {
            Vector256<double> one = Vector256.Create(1.0);
            Vector3d4 d = (one / l) * (Vector3d4.Load(ref shape.X[j + 1]) - Vector3d4.Load(ref shape.X[j]));
            p = Quaterniond4.Rotate(q.Conjugate, d);
            Vector256<double> shear = Vector256.LoadUnsafe(ref shears[j]);
            return new Vector3d4(shear * p.X, shear * p.Y, Vector256.LoadUnsafe(ref stretch[j]) * (p.Z - one));
        }

        // StretchEnergy.AddForce.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static void AddForce(ref RodVector node, ref RodVector next, Vector3d4 force, Vector3d4 n, Vector3d4 p,
            Vector256<double> l)
        {
            Vector256<double> sign = Vector256.Create(-0.0);
            Vector3d4 couple = l * Vector3d4.Cross(n, p);
            Rows4.Add(ref next.X1, Step, force.X, force.Y, force.Z, Rows4.Nothing);
            Rows4.Add(ref node.X1, Step, force.X ^ sign, force.Y ^ sign, force.Z ^ sign, couple.X);
            Rows4.Add(ref node.T2, Step, couple.Y, couple.Z);
        }
    }
#endif
}
