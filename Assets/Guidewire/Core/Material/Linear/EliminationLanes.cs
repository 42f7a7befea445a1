#if NET8_0_OR_GREATER
using System.Diagnostics.CodeAnalysis;
using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;

namespace Guidewire.Core
{
    /// <summary><see cref="BlockElimination.Eliminate"/> with one column of three rows in a register, in the same
    /// order: the same bits.</summary>
    /// <remarks>What a block leaves on the next one stays in registers: written and read again at once, numbers that
    /// were stored four by four would have to wait for the memory wherever a load does not meet one store alone. A load
    /// of a column takes one number more than the column has, which is not used; a store spoils the number after the
    /// column, which is written afterwards. Columns 2 and 3 of a lower triangle stand in the lanes of their
    /// rows.</remarks>
    internal static class EliminationLanes
    {
        /// <summary>Eliminates blocks from (inclusive) to to (exclusive) with their right-hand sides.</summary>
        /// <param name="block">The block after the last of them is changed too, and belongs to the array.</param>
        /// <param name="y">So is its vector.</param>
        /// <returns>The number of eigenvalues that are not positive.</returns>
        public static int Eliminate(RodBlock[] block, RodVector[] y, int from, int to)
        {
            int negative = 0;
            ref RodBlock b = ref block[from];
            Columns a = new Columns(Load(ref b.A11), Load(ref b.D31), Load(ref b.D22));
            Columns s = new Columns(Load(ref b.B11), Load(ref b.B12), Load(ref b.B13));
            Columns c = new Columns(Load(ref b.C11), Load(ref b.F31), Load(ref b.F22));
            Vector256<double> x = Load(ref y[from].X1);
            Vector256<double> t = Load(ref y[from].T1);
            for (int i = from; i < to; i++)
            {
                b = ref block[i];
                ref RodBlock next = ref block[i + 1];
                ref RodVector z = ref y[i];
                ref RodVector nextY = ref y[i + 1];

                // The position: what its elimination leaves on theta, on the right-hand side and on the next position.
                var p = new Pivots(a);
                negative += p.Negative;
                s = p.Reduce(s);
                Columns u = p.Divide(s);
                c = c.Less(s, u);
                double y1 = x.GetElement(0);
                double y2 = x.GetElement(1) - p.L21 * y1;
                double y3 = x.GetElement(2) - p.L32 * x.GetElement(1) + p.L31 * y1;
                t -= u.One * Of(y1) + u.Two * Of(y2) + u.Three * Of(y3);
                Columns d = p.Reduce(new Columns(Load(ref b.D11), Load(ref b.D12), Load(ref b.D13)));
                Columns v = p.Divide(d);
                Columns e = Columns.Less(ref b.E11, ref b.E12, ref b.E13, d, u);
                a = Columns.Less(ref next.A11, ref next.D31, ref next.D22, d, v);
                x = v.One * Of(y1) + v.Two * Of(y2) + v.Three * Of(y3);
                u.One.StoreUnsafe(ref b.B11);
                v.One.StoreUnsafe(ref b.D11);
                u.Two.StoreUnsafe(ref b.B12);
                v.Two.StoreUnsafe(ref b.D12);
                u.Three.StoreUnsafe(ref b.B13);
                v.Three.StoreUnsafe(ref b.D13);
                p.Store(ref b.A11, ref b.A22, ref b.A33);
                z.X1 = p.D1 * y1;
                z.X2 = p.D2 * y2;
                z.X3 = p.D3 * y3;

                // The rotation: what its elimination leaves on the next position and rotation.
                var r = new Pivots(c);
                negative += r.Negative;
                double z1 = t.GetElement(0);
                double z2 = t.GetElement(1) - r.L21 * z1;
                double z3 = t.GetElement(2) - r.L32 * t.GetElement(1) + r.L31 * z1;
                e = r.Reduce(e);
                Columns g = r.Divide(e);
                a = a.Less(e, g);
                Columns f = r.Reduce(new Columns(Load(ref b.F11), Load(ref b.F12), Load(ref b.F13)));
                Columns h = r.Divide(f);
                s = Columns.Less(ref next.B11, ref next.B12, ref next.B13, f, g);
                c = Columns.Less(ref next.C11, ref next.F31, ref next.F22, f, h);
                x = Load(ref nextY.X1) - (x + g.One * Of(z1) + g.Two * Of(z2) + g.Three * Of(z3));
                t = Vector256.Create(nextY.T1, nextY.T2, nextY.T3, 0.0)
                    - (h.One * Of(z1) + h.Two * Of(z2) + h.Three * Of(z3));
                g.One.StoreUnsafe(ref b.E11);
                h.One.StoreUnsafe(ref b.F11);
                g.Two.StoreUnsafe(ref b.E12);
                h.Two.StoreUnsafe(ref b.F12);
                g.Three.StoreUnsafe(ref b.E13);
                h.Three.StoreUnsafe(ref b.F13);
                r.Store(ref b.C11, ref b.C22, ref b.C33);
                z.T1 = r.D1 * z1;
                z.T2 = r.D2 * z2;
                z.T3 = r.D3 * z3;
            }
            ref RodBlock last = ref block[to];
            last.A11 = a.One.GetElement(0); last.A21 = a.One.GetElement(1); last.A31 = a.One.GetElement(2);
            last.A22 = a.Two.GetElement(1); last.A32 = a.Two.GetElement(2); last.A33 = a.Three.GetElement(2);
            last.B11 = s.One.GetElement(0); last.B21 = s.One.GetElement(1); last.B31 = s.One.GetElement(2);
            last.B12 = s.Two.GetElement(0); last.B22 = s.Two.GetElement(1); last.B32 = s.Two.GetElement(2);
            last.B13 = s.Three.GetElement(0); last.B23 = s.Three.GetElement(1); last.B33 = s.Three.GetElement(2);
            last.C11 = c.One.GetElement(0); last.C21 = c.One.GetElement(1); last.C31 = c.One.GetElement(2);
            last.C22 = c.Two.GetElement(1); last.C32 = c.Two.GetElement(2); last.C33 = c.Three.GetElement(2);
            ref RodVector end = ref y[to];
            end.X1 = x.GetElement(0); end.X2 = x.GetElement(1); end.X3 = x.GetElement(2);
            end.T1 = t.GetElement(0); end.T2 = t.GetElement(1); end.T3 = t.GetElement(2);
            return negative;
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector256<double> Load(ref double first) => Vector256.LoadUnsafe(ref first);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector256<double> Of(double value) => Vector256.Create(value);

        // The three columns of a 3x3 matrix, rows in lanes 0 to 2.
        private readonly struct Columns
        {
            public readonly Vector256<double> One;
            public readonly Vector256<double> Two;
            public readonly Vector256<double> Three;

            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            public Columns(Vector256<double> one, Vector256<double> two, Vector256<double> three)
            {
                One = one;
                Two = two;
                Three = three;
            }

            // This less W U^T.
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            public Columns Less(Columns w, Columns u) =>
                new Columns(One - Product(w, u, 0x00), Two - Product(w, u, 0x55), Three - Product(w, u, 0xAA));

            // Columns in memory less W U^T.
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            public static Columns Less(ref double one, ref double two, ref double three, Columns w, Columns u)
            {
                return new Columns(Load(ref one) - Product(w, u, 0x00), Load(ref two) - Product(w, u, 0x55),
                    Load(ref three) - Product(w, u, 0xAA));
            }

            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            private static Vector256<double> Product(Columns w, Columns u, [ConstantExpected] byte row)
            {
                return w.One * Avx2.Permute4x64(u.One, row) + w.Two * Avx2.Permute4x64(u.Two, row)
                    + w.Three * Avx2.Permute4x64(u.Three, row);
            }
        }

        // The factors of a 3x3 block: the inverse of the diagonal and, but for the first two's signs, of L.
        private readonly struct Pivots
        {
            public readonly double D1;
            public readonly double D2;
            public readonly double D3;
            public readonly double L21;
            public readonly double L32;
            public readonly double L31;
            public readonly int Negative;

            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            public Pivots(Columns a)
            {
                double a11 = a.One.GetElement(0);
                double a21 = a.One.GetElement(1);
                double a22 = a.Two.GetElement(1);
                double a31 = a.One.GetElement(2);
                double a32 = a.Two.GetElement(2);
                double a33 = a.Three.GetElement(2);
                double minor = a11 * a22 - a21 * a21;
                double mixed = a11 * a32 - a21 * a31;
                double det = a33 * minor + a31 * (a21 * a32 - a22 * a31) - a32 * mixed;
                D1 = 1.0 / a11;
                double inverse = 1.0 / minor;
                D2 = a11 * inverse;
                D3 = minor / det;
                L21 = a21 * D1;
                L32 = mixed * inverse;
                L31 = L21 * L32 - a31 * D1;
                Negative = BlockElimination.CountNegative(a11, minor, det);
            }

            // B L^-T.
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            public Columns Reduce(Columns b) =>
                new Columns(b.One, b.Two - b.One * Of(L21), b.Three - b.Two * Of(L32) + b.One * Of(L31));

            // W D^-1.
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            public Columns Divide(Columns w) => new Columns(w.One * Of(D1), w.Two * Of(D2), w.Three * Of(D3));

            // Into the columns of a lower triangle that begin there.
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            public void Store(ref double one, ref double two, ref double three)
            {
                one = D1;
                Unsafe.Add(ref one, 1) = L21;
                Unsafe.Add(ref one, 2) = L31;
                two = D2;
                Unsafe.Add(ref two, 1) = L32;
                three = D3;
            }
        }
    }
}
#endif
