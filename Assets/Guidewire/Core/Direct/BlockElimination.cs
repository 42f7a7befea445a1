using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>The three kernels of the block-tridiagonal LDL^T factorisation, written out component by component.
    /// With the names of <see cref="RodBlock"/> one block is eliminated by
    ///   U = B A^-1, C -= U B^T, V = D A^-1, E -= V B^T, A+ -= V D^T              (the position x),
    ///   G = E C^-1, A+ -= G E^T, H = F C^-1, B+ -= H E^T, C+ -= H F^T            (the rotation theta).</summary>
    /// <remarks>x of one node never meets theta of the next element but one, so the elimination fills nothing in: 234
    /// multiplications a block against some 400 of a dense 6x6 sweep. A 3x3 block is inverted by cofactors (one
    /// division), and its leading minors are at hand, whose signs count the negative eigenvalues (Sylvester's law of
    /// inertia). The blocks are well conditioned (EA against GA; EI against GJ), which is what the explicit inverse
    /// asks for. </remarks>
    internal static class BlockElimination
    {
        /// <summary>Eliminates one block, with its right-hand side, from the block after it. The block is overwritten:
        /// A, B, C, D, E, F become A^-1, U, C^-1, V, G, H.</summary>
        /// <returns>The number of eigenvalues of A and C (as eliminated) that are not positive, 0 to 6.</returns>
        [MethodImpl(Compiled.AtOnce)]
        public static int Eliminate(ref RodBlock block, ref RodBlock next, ref RodVector y, ref RodVector nextY)
        {
            // Position block: A^-1, then what its elimination leaves on theta and on the next position.
            double a11 = block.A11;
            double a21 = block.A21; double a22 = block.A22;
            double a31 = block.A31; double a32 = block.A32; double a33 = block.A33;
            double pm = a11 * a22 - a21 * a21;
            double p11 = a22 * a33 - a32 * a32;
            double p21 = a31 * a32 - a21 * a33;
            double p31 = a21 * a32 - a22 * a31;
            double pDet = a11 * p11 + a21 * p21 + a31 * p31;
            double pScale = 1.0 / pDet;
            double p22 = (a11 * a33 - a31 * a31) * pScale;
            double p32 = (a21 * a31 - a11 * a32) * pScale;
            double p33 = pm * pScale;
            p11 *= pScale;
            p21 *= pScale;
            p31 *= pScale;
            int negative = CountNegative(a11, pm, pDet);
            block.A11 = p11;
            block.A21 = p21; block.A22 = p22;
            block.A31 = p31; block.A32 = p32; block.A33 = p33;
            double b11 = block.B11; double b12 = block.B12; double b13 = block.B13;
            double b21 = block.B21; double b22 = block.B22; double b23 = block.B23;
            double b31 = block.B31; double b32 = block.B32; double b33 = block.B33;
            double u11 = b11 * p11 + b12 * p21 + b13 * p31;
            double u12 = b11 * p21 + b12 * p22 + b13 * p32;
            double u13 = b11 * p31 + b12 * p32 + b13 * p33;
            double u21 = b21 * p11 + b22 * p21 + b23 * p31;
            double u22 = b21 * p21 + b22 * p22 + b23 * p32;
            double u23 = b21 * p31 + b22 * p32 + b23 * p33;
            double u31 = b31 * p11 + b32 * p21 + b33 * p31;
            double u32 = b31 * p21 + b32 * p22 + b33 * p32;
            double u33 = b31 * p31 + b32 * p32 + b33 * p33;
            block.B11 = u11; block.B12 = u12; block.B13 = u13;
            block.B21 = u21; block.B22 = u22; block.B23 = u23;
            block.B31 = u31; block.B32 = u32; block.B33 = u33;
            double c11 = block.C11;
            double c21 = block.C21; double c22 = block.C22;
            double c31 = block.C31; double c32 = block.C32; double c33 = block.C33;
            c11 -= u11 * b11 + u12 * b12 + u13 * b13;
            c21 -= u21 * b11 + u22 * b12 + u23 * b13;
            c22 -= u21 * b21 + u22 * b22 + u23 * b23;
            c31 -= u31 * b11 + u32 * b12 + u33 * b13;
            c32 -= u31 * b21 + u32 * b22 + u33 * b23;
            c33 -= u31 * b31 + u32 * b32 + u33 * b33;
            double d11 = block.D11; double d12 = block.D12; double d13 = block.D13;
            double d21 = block.D21; double d22 = block.D22; double d23 = block.D23;
            double d31 = block.D31; double d32 = block.D32; double d33 = block.D33;
            double v11 = d11 * p11 + d12 * p21 + d13 * p31;
            double v12 = d11 * p21 + d12 * p22 + d13 * p32;
            double v13 = d11 * p31 + d12 * p32 + d13 * p33;
            double v21 = d21 * p11 + d22 * p21 + d23 * p31;
            double v22 = d21 * p21 + d22 * p22 + d23 * p32;
            double v23 = d21 * p31 + d22 * p32 + d23 * p33;
            double v31 = d31 * p11 + d32 * p21 + d33 * p31;
            double v32 = d31 * p21 + d32 * p22 + d33 * p32;
            double v33 = d31 * p31 + d32 * p32 + d33 * p33;
            block.D11 = v11; block.D12 = v12; block.D13 = v13;
            block.D21 = v21; block.D22 = v22; block.D23 = v23;
            block.D31 = v31; block.D32 = v32; block.D33 = v33;
            double e11 = block.E11; double e12 = block.E12; double e13 = block.E13;
            double e21 = block.E21; double e22 = block.E22; double e23 = block.E23;
            double e31 = block.E31; double e32 = block.E32; double e33 = block.E33;
            e11 -= v11 * b11 + v12 * b12 + v13 * b13;
            e12 -= v11 * b21 + v12 * b22 + v13 * b23;
            e13 -= v11 * b31 + v12 * b32 + v13 * b33;
            e21 -= v21 * b11 + v22 * b12 + v23 * b13;
            e22 -= v21 * b21 + v22 * b22 + v23 * b23;
            e23 -= v21 * b31 + v22 * b32 + v23 * b33;
            e31 -= v31 * b11 + v32 * b12 + v33 * b13;
            e32 -= v31 * b21 + v32 * b22 + v33 * b23;
            e33 -= v31 * b31 + v32 * b32 + v33 * b33;
            next.A11 -= v11 * d11 + v12 * d12 + v13 * d13;
            next.A21 -= v21 * d11 + v22 * d12 + v23 * d13;
            next.A22 -= v21 * d21 + v22 * d22 + v23 * d23;
            next.A31 -= v31 * d11 + v32 * d12 + v33 * d13;
            next.A32 -= v31 * d21 + v32 * d22 + v33 * d23;
            next.A33 -= v31 * d31 + v32 * d32 + v33 * d33;

            // Rotation block: C^-1, then what its elimination leaves on the next position and rotation.
            double rm = c11 * c22 - c21 * c21;
            double r11 = c22 * c33 - c32 * c32;
            double r21 = c31 * c32 - c21 * c33;
            double r31 = c21 * c32 - c22 * c31;
            double rDet = c11 * r11 + c21 * r21 + c31 * r31;
            double rScale = 1.0 / rDet;
            double r22 = (c11 * c33 - c31 * c31) * rScale;
            double r32 = (c21 * c31 - c11 * c32) * rScale;
            double r33 = rm * rScale;
            r11 *= rScale;
            r21 *= rScale;
            r31 *= rScale;
            negative += CountNegative(c11, rm, rDet);
            block.C11 = r11;
            block.C21 = r21; block.C22 = r22;
            block.C31 = r31; block.C32 = r32; block.C33 = r33;
            double g11 = e11 * r11 + e12 * r21 + e13 * r31;
            double g12 = e11 * r21 + e12 * r22 + e13 * r32;
            double g13 = e11 * r31 + e12 * r32 + e13 * r33;
            double g21 = e21 * r11 + e22 * r21 + e23 * r31;
            double g22 = e21 * r21 + e22 * r22 + e23 * r32;
            double g23 = e21 * r31 + e22 * r32 + e23 * r33;
            double g31 = e31 * r11 + e32 * r21 + e33 * r31;
            double g32 = e31 * r21 + e32 * r22 + e33 * r32;
            double g33 = e31 * r31 + e32 * r32 + e33 * r33;
            block.E11 = g11; block.E12 = g12; block.E13 = g13;
            block.E21 = g21; block.E22 = g22; block.E23 = g23;
            block.E31 = g31; block.E32 = g32; block.E33 = g33;
            next.A11 -= g11 * e11 + g12 * e12 + g13 * e13;
            next.A21 -= g21 * e11 + g22 * e12 + g23 * e13;
            next.A22 -= g21 * e21 + g22 * e22 + g23 * e23;
            next.A31 -= g31 * e11 + g32 * e12 + g33 * e13;
            next.A32 -= g31 * e21 + g32 * e22 + g33 * e23;
            next.A33 -= g31 * e31 + g32 * e32 + g33 * e33;
            double f11 = block.F11; double f12 = block.F12; double f13 = block.F13;
            double f21 = block.F21; double f22 = block.F22; double f23 = block.F23;
            double f31 = block.F31; double f32 = block.F32; double f33 = block.F33;
            double h11 = f11 * r11 + f12 * r21 + f13 * r31;
            double h12 = f11 * r21 + f12 * r22 + f13 * r32;
            double h13 = f11 * r31 + f12 * r32 + f13 * r33;
            double h21 = f21 * r11 + f22 * r21 + f23 * r31;
            double h22 = f21 * r21 + f22 * r22 + f23 * r32;
            double h23 = f21 * r31 + f22 * r32 + f23 * r33;
            double h31 = f31 * r11 + f32 * r21 + f33 * r31;
            double h32 = f31 * r21 + f32 * r22 + f33 * r32;
            double h33 = f31 * r31 + f32 * r32 + f33 * r33;
            block.F11 = h11; block.F12 = h12; block.F13 = h13;
            block.F21 = h21; block.F22 = h22; block.F23 = h23;
            block.F31 = h31; block.F32 = h32; block.F33 = h33;
            next.B11 -= h11 * e11 + h12 * e12 + h13 * e13;
            next.B12 -= h11 * e21 + h12 * e22 + h13 * e23;
            next.B13 -= h11 * e31 + h12 * e32 + h13 * e33;
            next.B21 -= h21 * e11 + h22 * e12 + h23 * e13;
            next.B22 -= h21 * e21 + h22 * e22 + h23 * e23;
            next.B23 -= h21 * e31 + h22 * e32 + h23 * e33;
            next.B31 -= h31 * e11 + h32 * e12 + h33 * e13;
            next.B32 -= h31 * e21 + h32 * e22 + h33 * e23;
            next.B33 -= h31 * e31 + h32 * e32 + h33 * e33;
            next.C11 -= h11 * f11 + h12 * f12 + h13 * f13;
            next.C21 -= h21 * f11 + h22 * f12 + h23 * f13;
            next.C22 -= h21 * f21 + h22 * f22 + h23 * f23;
            next.C31 -= h31 * f11 + h32 * f12 + h33 * f13;
            next.C32 -= h31 * f21 + h32 * f22 + h33 * f23;
            next.C33 -= h31 * f31 + h32 * f32 + h33 * f33;

            // The right-hand side goes along: y = L^-1 r, then the diagonal.
            double x1 = y.X1, x2 = y.X2, x3 = y.X3;
            double t1 = y.T1 - (u11 * x1 + u12 * x2 + u13 * x3);
            double t2 = y.T2 - (u21 * x1 + u22 * x2 + u23 * x3);
            double t3 = y.T3 - (u31 * x1 + u32 * x2 + u33 * x3);
            nextY.X1 -= v11 * x1 + v12 * x2 + v13 * x3 + g11 * t1 + g12 * t2 + g13 * t3;
            nextY.X2 -= v21 * x1 + v22 * x2 + v23 * x3 + g21 * t1 + g22 * t2 + g23 * t3;
            nextY.X3 -= v31 * x1 + v32 * x2 + v33 * x3 + g31 * t1 + g32 * t2 + g33 * t3;
            nextY.T1 -= h11 * t1 + h12 * t2 + h13 * t3;
            nextY.T2 -= h21 * t1 + h22 * t2 + h23 * t3;
            nextY.T3 -= h31 * t1 + h32 * t2 + h33 * t3;
            y.X1 = p11 * x1 + p21 * x2 + p31 * x3;
            y.X2 = p21 * x1 + p22 * x2 + p32 * x3;
            y.X3 = p31 * x1 + p32 * x2 + p33 * x3;
            y.T1 = r11 * t1 + r21 * t2 + r31 * t3;
            y.T2 = r21 * t1 + r22 * t2 + r32 * t3;
            y.T3 = r31 * t1 + r32 * t2 + r33 * t3;
            return negative;
        }

        /// <summary>One block of y := D^-1 L^-1 y with a factorisation that is kept.</summary>
        [MethodImpl(Compiled.AtOnce)]
        public static void Forward(in RodBlock block, ref RodVector y, ref RodVector nextY)
        {
            double x1 = y.X1, x2 = y.X2, x3 = y.X3;
            double t1 = y.T1 - (block.B11 * x1 + block.B12 * x2 + block.B13 * x3);
            double t2 = y.T2 - (block.B21 * x1 + block.B22 * x2 + block.B23 * x3);
            double t3 = y.T3 - (block.B31 * x1 + block.B32 * x2 + block.B33 * x3);
            nextY.X1 -= block.D11 * x1 + block.D12 * x2 + block.D13 * x3
                + block.E11 * t1 + block.E12 * t2 + block.E13 * t3;
            nextY.X2 -= block.D21 * x1 + block.D22 * x2 + block.D23 * x3
                + block.E21 * t1 + block.E22 * t2 + block.E23 * t3;
            nextY.X3 -= block.D31 * x1 + block.D32 * x2 + block.D33 * x3
                + block.E31 * t1 + block.E32 * t2 + block.E33 * t3;
            nextY.T1 -= block.F11 * t1 + block.F12 * t2 + block.F13 * t3;
            nextY.T2 -= block.F21 * t1 + block.F22 * t2 + block.F23 * t3;
            nextY.T3 -= block.F31 * t1 + block.F32 * t2 + block.F33 * t3;
            y.X1 = block.A11 * x1 + block.A21 * x2 + block.A31 * x3;
            y.X2 = block.A21 * x1 + block.A22 * x2 + block.A32 * x3;
            y.X3 = block.A31 * x1 + block.A32 * x2 + block.A33 * x3;
            y.T1 = block.C11 * t1 + block.C21 * t2 + block.C31 * t3;
            y.T2 = block.C21 * t1 + block.C22 * t2 + block.C32 * t3;
            y.T3 = block.C31 * t1 + block.C32 * t2 + block.C33 * t3;
        }

        /// <summary>One block of z := L^-T z, from the last block to the first.</summary>
        [MethodImpl(Compiled.AtOnce)]
        public static void Backward(in RodBlock block, ref RodVector z, in RodVector nextZ)
        {
            double x1 = nextZ.X1, x2 = nextZ.X2, x3 = nextZ.X3;
            double s1 = nextZ.T1, s2 = nextZ.T2, s3 = nextZ.T3;
            double t1 = z.T1 - (block.E11 * x1 + block.E21 * x2 + block.E31 * x3)
                - (block.F11 * s1 + block.F21 * s2 + block.F31 * s3);
            double t2 = z.T2 - (block.E12 * x1 + block.E22 * x2 + block.E32 * x3)
                - (block.F12 * s1 + block.F22 * s2 + block.F32 * s3);
            double t3 = z.T3 - (block.E13 * x1 + block.E23 * x2 + block.E33 * x3)
                - (block.F13 * s1 + block.F23 * s2 + block.F33 * s3);
            z.T1 = t1;
            z.T2 = t2;
            z.T3 = t3;
            z.X1 -= block.D11 * x1 + block.D21 * x2 + block.D31 * x3
                + block.B11 * t1 + block.B21 * t2 + block.B31 * t3;
            z.X2 -= block.D12 * x1 + block.D22 * x2 + block.D32 * x3
                + block.B12 * t1 + block.B22 * t2 + block.B32 * t3;
            z.X3 -= block.D13 * x1 + block.D23 * x2 + block.D33 * x3
                + block.B13 * t1 + block.B23 * t2 + block.B33 * t3;
        }

        /// <summary>Eigenvalues of a symmetric 3x3 matrix that are not positive, from its leading minors: each change
        /// of sign in 1, m1, m2, m3 is a negative one. A minor that is 0 or not a number counts as negative.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static int CountNegative(double m1, double m2, double m3)
        {
            if (m1 > 0.0 && m2 > 0.0 && m3 > 0.0)
            {
                return 0;
            }
            return (m1 > 0.0 ? 0 : 1) + (m1 * m2 > 0.0 ? 0 : 1) + (m2 * m3 > 0.0 ? 0 : 1);
        }
    }
}
