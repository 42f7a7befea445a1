using System.Runtime.CompilerServices;
#if NET8_0_OR_GREATER
using System.Diagnostics.CodeAnalysis;
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;
#endif

namespace Guidewire.Core
{
    /// <summary>The three kernels of the block-tridiagonal LDL^T factorisation, written out component by component.
    /// With the names of <see cref="RodBlock"/>, A = L P L^T and C = L' R L'^T (L, L' unit lower triangles, P, R
    /// diagonal), one block is eliminated by
    ///   W = B L^-T, U = W P^-1, C -= W U^T, W = D L^-T, V = W P^-1, E -= W U^T, A+ -= W V^T     (the position x),
    ///   W = E L'^-T, G = W R^-1, A+ -= W G^T, W = F L'^-T, H = W R^-1, B+ -= W G^T, C+ -= W H^T (the rotation theta).
    /// </summary>
    /// <remarks>x of one node never meets theta of the next element but one, so the elimination fills nothing in: 228
    /// multiplications a block against some 400 of a dense 6x6 elimination. The pivots of a 3x3 block are ratios of its
    /// leading minors m1, m2, m3: P^-1 = diag(1/m1, m1/m2, m2/m3), so its three divisions do not wait for each other,
    /// nor do the products with L^-1, whose three entries are formed first; the minors' signs count the negative
    /// eigenvalues (Sylvester's law of inertia). A row is finished before the next is begun, and finished rows are read
    /// back from the block: the few numbers at work then fit the registers.</remarks>
    internal static class BlockElimination
    {
        /// <summary>Eliminates one block, with its right-hand side, from the block after it. The block is overwritten:
        /// B, D, E, F become U, V, G, H; A and C become P^-1 and R^-1 on their diagonals; below stand -l21, -l32 and
        /// l21 l32 - l31 of the inverses of L and L', the first two without their signs.</summary>
        /// <returns>The number of eigenvalues of A and C (as eliminated) that are not positive, 0 to 6.</returns>
        public static int Eliminate(ref RodBlock block, ref RodBlock next, ref RodVector y, ref RodVector nextY)
        {
            // Position block: its factors, then what its elimination leaves on theta and on the next position.
            double a11 = block.A11;
            double a21 = block.A21; double a22 = block.A22;
            double a31 = block.A31; double a32 = block.A32; double a33 = block.A33;
            double pMinor = a11 * a22 - a21 * a21;
            double pMixed = a11 * a32 - a21 * a31;
            double pDet = a33 * pMinor + a31 * (a21 * a32 - a22 * a31) - a32 * pMixed;
            double p1 = 1.0 / a11;
            double pInverse = 1.0 / pMinor;
            double p2 = a11 * pInverse;
            double p3 = pMinor / pDet;
            double p21 = a21 * p1;
            double p32 = pMixed * pInverse;
            double p31 = p21 * p32 - a31 * p1;
            block.A11 = p1;
            block.A21 = p21; block.A22 = p2;
            block.A31 = p31; block.A32 = p32; block.A33 = p3;
            int negative = CountNegative(a11, pMinor, pDet);
            double s11 = block.B11;
            double s12 = block.B12 - s11 * p21;
            double s13 = block.B13 - block.B12 * p32 + s11 * p31;
            block.B11 = s11 * p1; block.B12 = s12 * p2; block.B13 = s13 * p3;
            double c11 = block.C11 - (s11 * block.B11 + s12 * block.B12 + s13 * block.B13);
            double s21 = block.B21;
            double s22 = block.B22 - s21 * p21;
            double s23 = block.B23 - block.B22 * p32 + s21 * p31;
            block.B21 = s21 * p1; block.B22 = s22 * p2; block.B23 = s23 * p3;
            double c21 = block.C21 - (s21 * block.B11 + s22 * block.B12 + s23 * block.B13);
            double c22 = block.C22 - (s21 * block.B21 + s22 * block.B22 + s23 * block.B23);
            double s31 = block.B31;
            double s32 = block.B32 - s31 * p21;
            double s33 = block.B33 - block.B32 * p32 + s31 * p31;
            block.B31 = s31 * p1; block.B32 = s32 * p2; block.B33 = s33 * p3;
            double c31 = block.C31 - (s31 * block.B11 + s32 * block.B12 + s33 * block.B13);
            double c32 = block.C32 - (s31 * block.B21 + s32 * block.B22 + s33 * block.B23);
            double c33 = block.C33 - (s31 * block.B31 + s32 * block.B32 + s33 * block.B33);
            double d11 = block.D11;
            double d12 = block.D12 - d11 * p21;
            double d13 = block.D13 - block.D12 * p32 + d11 * p31;
            block.D11 = d11 * p1; block.D12 = d12 * p2; block.D13 = d13 * p3;
            double e11 = block.E11 - (d11 * block.B11 + d12 * block.B12 + d13 * block.B13);
            double e12 = block.E12 - (d11 * block.B21 + d12 * block.B22 + d13 * block.B23);
            double e13 = block.E13 - (d11 * block.B31 + d12 * block.B32 + d13 * block.B33);
            double n11 = next.A11 - (d11 * block.D11 + d12 * block.D12 + d13 * block.D13);
            double d21 = block.D21;
            double d22 = block.D22 - d21 * p21;
            double d23 = block.D23 - block.D22 * p32 + d21 * p31;
            block.D21 = d21 * p1; block.D22 = d22 * p2; block.D23 = d23 * p3;
            double e21 = block.E21 - (d21 * block.B11 + d22 * block.B12 + d23 * block.B13);
            double e22 = block.E22 - (d21 * block.B21 + d22 * block.B22 + d23 * block.B23);
            double e23 = block.E23 - (d21 * block.B31 + d22 * block.B32 + d23 * block.B33);
            double n21 = next.A21 - (d21 * block.D11 + d22 * block.D12 + d23 * block.D13);
            double n22 = next.A22 - (d21 * block.D21 + d22 * block.D22 + d23 * block.D23);
            double d31 = block.D31;
            double d32 = block.D32 - d31 * p21;
            double d33 = block.D33 - block.D32 * p32 + d31 * p31;
            block.D31 = d31 * p1; block.D32 = d32 * p2; block.D33 = d33 * p3;
            double e31 = block.E31 - (d31 * block.B11 + d32 * block.B12 + d33 * block.B13);
            double e32 = block.E32 - (d31 * block.B21 + d32 * block.B22 + d33 * block.B23);
            double e33 = block.E33 - (d31 * block.B31 + d32 * block.B32 + d33 * block.B33);
            double n31 = next.A31 - (d31 * block.D11 + d32 * block.D12 + d33 * block.D13);
            double n32 = next.A32 - (d31 * block.D21 + d32 * block.D22 + d33 * block.D23);
            double n33 = next.A33 - (d31 * block.D31 + d32 * block.D32 + d33 * block.D33);

            // Rotation block: its factors, then what its elimination leaves on the next position and rotation.
            double rMinor = c11 * c22 - c21 * c21;
            double rMixed = c11 * c32 - c21 * c31;
            double rDet = c33 * rMinor + c31 * (c21 * c32 - c22 * c31) - c32 * rMixed;
            double r1 = 1.0 / c11;
            double rInverse = 1.0 / rMinor;
            double r2 = c11 * rInverse;
            double r3 = rMinor / rDet;
            double r21 = c21 * r1;
            double r32 = rMixed * rInverse;
            double r31 = r21 * r32 - c31 * r1;
            block.C11 = r1;
            block.C21 = r21; block.C22 = r2;
            block.C31 = r31; block.C32 = r32; block.C33 = r3;
            negative += CountNegative(c11, rMinor, rDet);
            double x11 = e11;
            double x12 = e12 - x11 * r21;
            double x13 = e13 - e12 * r32 + x11 * r31;
            block.E11 = x11 * r1; block.E12 = x12 * r2; block.E13 = x13 * r3;
            next.A11 = n11 - (x11 * block.E11 + x12 * block.E12 + x13 * block.E13);
            double x21 = e21;
            double x22 = e22 - x21 * r21;
            double x23 = e23 - e22 * r32 + x21 * r31;
            block.E21 = x21 * r1; block.E22 = x22 * r2; block.E23 = x23 * r3;
            next.A21 = n21 - (x21 * block.E11 + x22 * block.E12 + x23 * block.E13);
            next.A22 = n22 - (x21 * block.E21 + x22 * block.E22 + x23 * block.E23);
            double x31 = e31;
            double x32 = e32 - x31 * r21;
            double x33 = e33 - e32 * r32 + x31 * r31;
            block.E31 = x31 * r1; block.E32 = x32 * r2; block.E33 = x33 * r3;
            next.A31 = n31 - (x31 * block.E11 + x32 * block.E12 + x33 * block.E13);
            next.A32 = n32 - (x31 * block.E21 + x32 * block.E22 + x33 * block.E23);
            next.A33 = n33 - (x31 * block.E31 + x32 * block.E32 + x33 * block.E33);
            double t11 = block.F11;
            double t12 = block.F12 - t11 * r21;
            double t13 = block.F13 - block.F12 * r32 + t11 * r31;
            block.F11 = t11 * r1; block.F12 = t12 * r2; block.F13 = t13 * r3;
            next.B11 -= t11 * block.E11 + t12 * block.E12 + t13 * block.E13;
            next.B12 -= t11 * block.E21 + t12 * block.E22 + t13 * block.E23;
            next.B13 -= t11 * block.E31 + t12 * block.E32 + t13 * block.E33;
            next.C11 -= t11 * block.F11 + t12 * block.F12 + t13 * block.F13;
            double t21 = block.F21;
            double t22 = block.F22 - t21 * r21;
            double t23 = block.F23 - block.F22 * r32 + t21 * r31;
            block.F21 = t21 * r1; block.F22 = t22 * r2; block.F23 = t23 * r3;
            next.B21 -= t21 * block.E11 + t22 * block.E12 + t23 * block.E13;
            next.B22 -= t21 * block.E21 + t22 * block.E22 + t23 * block.E23;
            next.B23 -= t21 * block.E31 + t22 * block.E32 + t23 * block.E33;
            next.C21 -= t21 * block.F11 + t22 * block.F12 + t23 * block.F13;
            next.C22 -= t21 * block.F21 + t22 * block.F22 + t23 * block.F23;
            double t31 = block.F31;
            double t32 = block.F32 - t31 * r21;
            double t33 = block.F33 - block.F32 * r32 + t31 * r31;
            block.F31 = t31 * r1; block.F32 = t32 * r2; block.F33 = t33 * r3;
            next.B31 -= t31 * block.E11 + t32 * block.E12 + t33 * block.E13;
            next.B32 -= t31 * block.E21 + t32 * block.E22 + t33 * block.E23;
            next.B33 -= t31 * block.E31 + t32 * block.E32 + t33 * block.E33;
            next.C31 -= t31 * block.F11 + t32 * block.F12 + t33 * block.F13;
            next.C32 -= t31 * block.F21 + t32 * block.F22 + t33 * block.F23;
            next.C33 -= t31 * block.F31 + t32 * block.F32 + t33 * block.F33;

            // The right-hand side goes along: y = L^-1 r, then the diagonal.
            double y1 = y.X1;
            double y2 = y.X2 - p21 * y1;
            double y3 = y.X3 - p32 * y.X2 + p31 * y1;
            double z1 = y.T1 - (block.B11 * y1 + block.B12 * y2 + block.B13 * y3);
            double s2 = y.T2 - (block.B21 * y1 + block.B22 * y2 + block.B23 * y3);
            double z2 = s2 - r21 * z1;
            double z3 = y.T3 - (block.B31 * y1 + block.B32 * y2 + block.B33 * y3) - r32 * s2 + r31 * z1;
            nextY.X1 -= block.D11 * y1 + block.D12 * y2 + block.D13 * y3
                + block.E11 * z1 + block.E12 * z2 + block.E13 * z3;
            nextY.X2 -= block.D21 * y1 + block.D22 * y2 + block.D23 * y3
                + block.E21 * z1 + block.E22 * z2 + block.E23 * z3;
            nextY.X3 -= block.D31 * y1 + block.D32 * y2 + block.D33 * y3
                + block.E31 * z1 + block.E32 * z2 + block.E33 * z3;
            nextY.T1 -= block.F11 * z1 + block.F12 * z2 + block.F13 * z3;
            nextY.T2 -= block.F21 * z1 + block.F22 * z2 + block.F23 * z3;
            nextY.T3 -= block.F31 * z1 + block.F32 * z2 + block.F33 * z3;
            y.X1 = p1 * y1;
            y.X2 = p2 * y2;
            y.X3 = p3 * y3;
            y.T1 = r1 * z1;
            y.T2 = r2 * z2;
            y.T3 = r3 * z3;
            return negative;
        }

        /// <summary>One block of y := D^-1 L^-1 y with a factorisation that is kept.</summary>
        public static void Forward(in RodBlock block, ref RodVector y, ref RodVector nextY)
        {
            double y1 = y.X1;
            double y2 = y.X2 - block.A21 * y1;
            double y3 = y.X3 - block.A32 * y.X2 + block.A31 * y1;
            double z1 = y.T1 - (block.B11 * y1 + block.B12 * y2 + block.B13 * y3);
            double s2 = y.T2 - (block.B21 * y1 + block.B22 * y2 + block.B23 * y3);
            double z2 = s2 - block.C21 * z1;
            double z3 = y.T3 - (block.B31 * y1 + block.B32 * y2 + block.B33 * y3) - block.C32 * s2 + block.C31 * z1;
            nextY.X1 -= block.D11 * y1 + block.D12 * y2 + block.D13 * y3
                + block.E11 * z1 + block.E12 * z2 + block.E13 * z3;
            nextY.X2 -= block.D21 * y1 + block.D22 * y2 + block.D23 * y3
                + block.E21 * z1 + block.E22 * z2 + block.E23 * z3;
            nextY.X3 -= block.D31 * y1 + block.D32 * y2 + block.D33 * y3
                + block.E31 * z1 + block.E32 * z2 + block.E33 * z3;
            nextY.T1 -= block.F11 * z1 + block.F12 * z2 + block.F13 * z3;
            nextY.T2 -= block.F21 * z1 + block.F22 * z2 + block.F23 * z3;
            nextY.T3 -= block.F31 * z1 + block.F32 * z2 + block.F33 * z3;
            y.X1 = block.A11 * y1;
            y.X2 = block.A22 * y2;
            y.X3 = block.A33 * y3;
            y.T1 = block.C11 * z1;
            y.T2 = block.C22 * z2;
            y.T3 = block.C33 * z3;
        }

        /// <summary>Computes one block of z := L^-T z, from the last block to the first.</summary>
        public static void Backward(in RodBlock block, ref RodVector z, in RodVector nextZ)
        {
            double x1 = nextZ.X1, x2 = nextZ.X2, x3 = nextZ.X3;
            double s1 = nextZ.T1, s2 = nextZ.T2, s3 = nextZ.T3;
            double u1 = z.T1 - (block.E11 * x1 + block.E21 * x2 + block.E31 * x3)
                - (block.F11 * s1 + block.F21 * s2 + block.F31 * s3);
            double u2 = z.T2 - (block.E12 * x1 + block.E22 * x2 + block.E32 * x3)
                - (block.F12 * s1 + block.F22 * s2 + block.F32 * s3);
            double u3 = z.T3 - (block.E13 * x1 + block.E23 * x2 + block.E33 * x3)
                - (block.F13 * s1 + block.F23 * s2 + block.F33 * s3);
            double t1 = u1 - block.C21 * u2 + block.C31 * u3;
            double t2 = u2 - block.C32 * u3;
            double v1 = z.X1 - (block.D11 * x1 + block.D21 * x2 + block.D31 * x3)
                - (block.B11 * t1 + block.B21 * t2 + block.B31 * u3);
            double v2 = z.X2 - (block.D12 * x1 + block.D22 * x2 + block.D32 * x3)
                - (block.B12 * t1 + block.B22 * t2 + block.B32 * u3);
            double v3 = z.X3 - (block.D13 * x1 + block.D23 * x2 + block.D33 * x3)
                - (block.B13 * t1 + block.B23 * t2 + block.B33 * u3);
            z.X1 = v1 - block.A21 * v2 + block.A31 * v3;
            z.X2 = v2 - block.A32 * v3;
            z.X3 = v3;
            z.T1 = t1;
            z.T2 = t2;
            z.T3 = u3;
        }

        /// <summary>Eigenvalues of a symmetric 3x3 matrix that are not positive, from its leading minors: each change
        /// of sign in 1, m1, m2, m3 is a negative one. A minor that is 0 or not a number counts as negative.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static int CountNegative(double m1, double m2, double m3)
        {
            if (m1 > 0.0 && m2 > 0.0 && m3 > 0.0)
            {
                return 0;
            }
            return (m1 > 0.0 ? 0 : 1) + (m1 * m2 > 0.0 ? 0 : 1) + (m2 * m3 > 0.0 ? 0 : 1);
        }
    }

#if NET8_0_OR_GREATER
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
#endif
}
