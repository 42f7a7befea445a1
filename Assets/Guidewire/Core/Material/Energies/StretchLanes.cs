#if NET8_0_OR_GREATER
using System;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace Guidewire.Core
{
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
}
#endif
