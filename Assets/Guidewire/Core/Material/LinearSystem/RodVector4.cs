namespace Guidewire.Core
{
    /// <summary>Four <see cref="RodVector"/>s at once, and what <see cref="BlockElimination"/> does with one, done with
    /// four right-hand sides.</summary>
    internal struct RodVector4
    {
        public Double4 X1, X2, X3;
        public Double4 T1, T2, T3;

        /// <summary>Makes one of four.</summary>
        public RodVector4(in RodVector a, in RodVector b, in RodVector c, in RodVector d)
        {
            X1 = Double4.Of(a.X1, b.X1, c.X1, d.X1);
            X2 = Double4.Of(a.X2, b.X2, c.X2, d.X2);
            X3 = Double4.Of(a.X3, b.X3, c.X3, d.X3);
            T1 = Double4.Of(a.T1, b.T1, c.T1, d.T1);
            T2 = Double4.Of(a.T2, b.T2, c.T2, d.T2);
            T3 = Double4.Of(a.T3, b.T3, c.T3, d.T3);
        }

        /// <summary>One of them.</summary>
        public readonly RodVector this[int lane] => new RodVector
        {
            X1 = X1[lane], X2 = X2[lane], X3 = X3[lane], T1 = T1[lane], T2 = T2[lane], T3 = T3[lane],
        };

        /// <summary>Adds the others.</summary>
        public void Add(in RodVector4 v)
        {
            (X1, X2, X3) = (X1 + v.X1, X2 + v.X2, X3 + v.X3);
            (T1, T2, T3) = (T1 + v.T1, T2 + v.T2, T3 + v.T3);
        }

        /// <summary>The scalar products of one vector with each of the four.</summary>
        public static Double4 Dot(in RodVector a, in RodVector4 b) =>
            a.X1 * b.X1 + a.X2 * b.X2 + a.X3 * b.X3 + a.T1 * b.T1 + a.T2 * b.T2 + a.T3 * b.T3;

        /// <summary>One block of y := D^-1 L^-1 y, as <see cref="BlockElimination.Forward"/>.</summary>
        public static void Forward(in RodBlock block, ref RodVector4 y, ref RodVector4 nextY)
        {
            Double4 y1 = y.X1;
            Double4 y2 = y.X2 - block.A21 * y1;
            Double4 y3 = y.X3 - block.A32 * y.X2 + block.A31 * y1;
            Double4 z1 = y.T1 - (block.B11 * y1 + block.B12 * y2 + block.B13 * y3);
            Double4 s2 = y.T2 - (block.B21 * y1 + block.B22 * y2 + block.B23 * y3);
            Double4 z2 = s2 - block.C21 * z1;
            Double4 z3 = y.T3 - (block.B31 * y1 + block.B32 * y2 + block.B33 * y3) - block.C32 * s2 + block.C31 * z1;
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

        /// <summary>One block of z := L^-T z, as <see cref="BlockElimination.Backward"/>.</summary>
        public static void Backward(in RodBlock block, ref RodVector4 z, in RodVector4 nextZ)
        {
            Double4 x1 = nextZ.X1, x2 = nextZ.X2, x3 = nextZ.X3;
            Double4 s1 = nextZ.T1, s2 = nextZ.T2, s3 = nextZ.T3;
            Double4 u1 = z.T1 - (block.E11 * x1 + block.E21 * x2 + block.E31 * x3)
                - (block.F11 * s1 + block.F21 * s2 + block.F31 * s3);
            Double4 u2 = z.T2 - (block.E12 * x1 + block.E22 * x2 + block.E32 * x3)
                - (block.F12 * s1 + block.F22 * s2 + block.F32 * s3);
            Double4 u3 = z.T3 - (block.E13 * x1 + block.E23 * x2 + block.E33 * x3)
                - (block.F13 * s1 + block.F23 * s2 + block.F33 * s3);
            Double4 t1 = u1 - block.C21 * u2 + block.C31 * u3;
            Double4 t2 = u2 - block.C32 * u3;
            Double4 v1 = z.X1 - (block.D11 * x1 + block.D21 * x2 + block.D31 * x3)
                - (block.B11 * t1 + block.B21 * t2 + block.B31 * u3);
            Double4 v2 = z.X2 - (block.D12 * x1 + block.D22 * x2 + block.D32 * x3)
                - (block.B12 * t1 + block.B22 * t2 + block.B32 * u3);
            Double4 v3 = z.X3 - (block.D13 * x1 + block.D23 * x2 + block.D33 * x3)
                - (block.B13 * t1 + block.B23 * t2 + block.B33 * u3);
            z.X1 = v1 - block.A21 * v2 + block.A31 * v3;
            z.X2 = v2 - block.A32 * v3;
            z.X3 = v3;
            z.T1 = t1;
            z.T2 = t2;
            z.T3 = u3;
        }
    }
}
