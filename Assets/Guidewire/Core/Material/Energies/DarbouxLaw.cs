namespace Guidewire.Core
{
    /// <summary>Couple K sin(angle): the energy 1/2 K |2 v - theta0|^2 with v the imaginary part of conj(q_a) q_b,
    /// which is the Darboux vector (2/l) v of Kugelstadt and Schoemer 2016 as an energy.</summary>
    /// <remarks>Softer than the rotation vector by (kappa l)^2/6, and no couple above K has an equilibrium. With r =
    /// (v, w), A = w 1 + [v] and m = K (2 v - theta0): couples A^T m on b and -A m on a; second derivatives A^T K A, A
    /// K A^T and -A K A, less (m . v)/2 on the diagonal, and (m v^T + v m^T - (m . v) 1 + w [m])/2 between a and
    /// b.</remarks>
    internal readonly struct DarbouxLaw : IJointLaw
    {
        /// <inheritdoc/>
        public Vector3d Measure(in Quaterniond relative) => Strain(default, relative, out _, out _);

        /// <inheritdoc/>
        /// <remarks>A after - A^T before.</remarks>
        public Vector3d Rate(in Quaterniond relative, in Vector3d before, in Vector3d after)
        {
            Strain(default, relative, out Vector3d v, out double w);
            return w * (after - before) + Vector3d.Cross(v, before + after);
        }

        /// <inheritdoc/>
        /// <remarks>theta0 = 2 v is at most 2.</remarks>
        public Quaterniond AtRest(in Joint joint)
        {
            Vector3d v = 0.5 * joint.Rest;
            return new Quaterniond(v.X, v.Y, v.Z, System.Math.Sqrt(System.Math.Max(0.0, 1.0 - v.LengthSquared)));
        }

        /// <inheritdoc/>
        public double Value(in Joint joint, in Quaterniond relative)
        {
            Vector3d strain = Strain(joint, relative, out _, out _);
            return 0.5 * Vector3d.Dot(strain, Scale(joint, strain));
        }

        /// <inheritdoc/>
        public void AddGradient(in Joint joint, in Quaterniond relative, ref RodVector a, ref RodVector b)
        {
            Vector3d m = Scale(joint, Strain(joint, relative, out Vector3d v, out double w));
            AddCouple(m, v, w, ref a, ref b);
        }

        /// <inheritdoc/>
        public void AddBlocks(in Joint joint, in Quaterniond relative, ref RodVector a, ref RodVector b,
            ref RodBlock blockA, ref RodBlock blockB)
        {
            Vector3d m = Scale(joint, Strain(joint, relative, out Vector3d v, out double w));
            AddCouple(m, v, w, ref a, ref b);

            // Columns of A and of A^T.
            Vector3d c1 = new Vector3d(w, v.Z, -v.Y);
            Vector3d c2 = new Vector3d(-v.Z, w, v.X);
            Vector3d c3 = new Vector3d(v.Y, -v.X, w);
            Vector3d r1 = new Vector3d(w, -v.Z, v.Y);
            Vector3d r2 = new Vector3d(v.Z, w, -v.X);
            Vector3d r3 = new Vector3d(-v.Y, v.X, w);
            double s = Vector3d.Dot(m, v);
            AddSymmetric(ref blockB, joint, c1, c2, c3, 0.5 * s);
            AddSymmetric(ref blockA, joint, r1, r2, r3, 0.5 * s);

            // F = (b, a) is the transpose of (a, b): its entry (i, j) = -(column i of A) . K (row j of A) + ...
            Vector3d k1 = Scale(joint, r1);
            Vector3d k2 = Scale(joint, r2);
            Vector3d k3 = Scale(joint, r3);
            blockA.F11 += m.X * v.X - 0.5 * s - Vector3d.Dot(c1, k1);
            blockA.F22 += m.Y * v.Y - 0.5 * s - Vector3d.Dot(c2, k2);
            blockA.F33 += m.Z * v.Z - 0.5 * s - Vector3d.Dot(c3, k3);
            double xy = 0.5 * (m.X * v.Y + m.Y * v.X);
            double xz = 0.5 * (m.X * v.Z + m.Z * v.X);
            double yz = 0.5 * (m.Y * v.Z + m.Z * v.Y);
            Vector3d h = (0.5 * w) * m;
            blockA.F12 += xy + h.Z - Vector3d.Dot(c1, k2);
            blockA.F21 += xy - h.Z - Vector3d.Dot(c2, k1);
            blockA.F13 += xz - h.Y - Vector3d.Dot(c1, k3);
            blockA.F31 += xz + h.Y - Vector3d.Dot(c3, k1);
            blockA.F23 += yz + h.X - Vector3d.Dot(c2, k3);
            blockA.F32 += yz - h.X - Vector3d.Dot(c3, k2);
        }

        /// <summary>2 v - theta0, with the sign of the quaternion that makes the angle at most pi.</summary>
        private static Vector3d Strain(in Joint joint, in Quaterniond relative, out Vector3d v, out double w)
        {
            double sign = relative.W < 0.0 ? -1.0 : 1.0;
            v = sign * relative.Imaginary;
            w = sign * relative.W;
            return 2.0 * v - joint.Rest;
        }

        private static Vector3d Scale(in Joint joint, in Vector3d v) =>
            new Vector3d(joint.Bend1 * v.X, joint.Bend2 * v.Y, joint.Twist * v.Z);

        private static void AddCouple(in Vector3d m, in Vector3d v, double w, ref RodVector a, ref RodVector b)
        {
            Vector3d cross = Vector3d.Cross(m, v);
            b.T1 += w * m.X + cross.X;
            b.T2 += w * m.Y + cross.Y;
            b.T3 += w * m.Z + cross.Z;
            a.T1 -= w * m.X - cross.X;
            a.T2 -= w * m.Y - cross.Y;
            a.T3 -= w * m.Z - cross.Z;
        }

        private static void AddSymmetric(ref RodBlock block, in Joint joint, in Vector3d c1, in Vector3d c2,
            in Vector3d c3, double diagonal)
        {
            Vector3d k1 = Scale(joint, c1);
            Vector3d k2 = Scale(joint, c2);
            Vector3d k3 = Scale(joint, c3);
            block.C11 += Vector3d.Dot(c1, k1) - diagonal;
            block.C22 += Vector3d.Dot(c2, k2) - diagonal;
            block.C33 += Vector3d.Dot(c3, k3) - diagonal;
            block.C21 += Vector3d.Dot(c2, k1);
            block.C31 += Vector3d.Dot(c3, k1);
            block.C32 += Vector3d.Dot(c3, k2);
        }
    }
}
