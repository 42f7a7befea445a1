using System;

namespace Guidewire.Core
{
    /// <summary>Bending and twist, whatever the joints' law, with the couples that its clamps exert.</summary>
    internal abstract class BendTwistTerm : EnergyTerm
    {
        /// <summary>What the fibres of the wire add; null where it is linear.</summary>
        public FibreBending? Fibres { get; set; }

        /// <summary>Turns the elements, from the proximal clamp on (without one from the first element), so that no
        /// joint but that of a distal clamp exerts a couple.</summary>
        /// <returns>False where they are so already because no joint is turned at rest.</returns>
        public abstract bool RelaxTurns(RodShape shape);

        /// <summary>Turn of each of the n+1 joints as their law measures it, to which the couple is proportional; 0
        /// where an end has no joint.</summary>
        public abstract void Measure(RodShape shape, Vector3d[] turns);

        /// <summary>Gives the same for joint k alone.</summary>
        public abstract Vector3d TurnOf(RodShape shape, int k);

        /// <summary>A joint in a shape: its law, its turn and, of several instruments, their angles.</summary>
        public abstract void Evaluate(RodShape shape, int k, out CoaxialJointState s);

        /// <summary>Couple that the piece after each of the n+1 joints exerts on the piece before it, N m, along the
        /// world's axes; 0 where an end has no joint.</summary>
        public abstract void Couples(RodShape shape, Vector3d[] couples);

        /// <summary>Gives the term of these n+1 joints under the supports' law.</summary>
        public static BendTwistTerm Create(Joint[] joints, RodSupports supports)
        {
            if (supports.Bend == BendLaw.Darboux)
            {
                return new BendTwistEnergy<DarbouxLaw>(joints, supports.HasProximalJoint, supports.HasDistalJoint);
            }
            return new BendTwistEnergy<RotationVectorLaw>(joints, supports.HasProximalJoint, supports.HasDistalJoint,
                supports.Winds);
        }

        /// <summary>A step begins at a time, s, from which on hubs inside slide.</summary>
        public virtual void BeginSlide(double time)
        {
        }

        /// <summary>How fast the turns of <see cref="Measure"/> grow, rad/s.</summary>
        /// <param name="spins">Of the elements along their own axes, rad/s.</param>
        /// <param name="proximal">Spin of the proximal frame along its own axes.</param>
        /// <param name="distal">Spin of the distal one.</param>
        /// <param name="rates">Receives n+1 rates; 0 where an end has no joint.</param>
        public abstract void MeasureRates(RodShape shape, Vector3d[] spins, in Vector3d proximal, in Vector3d distal,
            Vector3d[] rates);

        /// <summary>Gives the torque of a hub on its instrument, N m: dE/dturn of that hub.</summary>
        /// <param name="instrument">0 the outermost one.</param>
        public abstract double TurnCouple(RodShape shape, int instrument = 0);

        /// <summary>Couple of the proximal clamp on the rod, N m, along the world's axes; 0 without a clamp.</summary>
        public abstract Vector3d ProximalCouple(RodShape shape);

        /// <summary>Couple of the distal clamp on the rod, N m, along the world's axes; 0 without a clamp.</summary>
        public abstract Vector3d DistalCouple(RodShape shape);
    }

    /// <summary>Constitutive law of a joint between two frames a and b: its couple as a function of their relative
    /// rotation r = conj(q_a) q_b. Implemented by structs and used as a type argument, so that loops over joints have
    /// no virtual calls.</summary>
    internal interface IJointLaw
    {
        /// <summary>The turn from a to b at which the joint is free of couples.</summary>
        Quaterniond AtRest(in Joint joint);

        /// <summary>The turn to which the couple is proportional.</summary>
        Vector3d Measure(in Quaterniond relative);

        /// <summary>How fast that grows where the frames turn at these rates along their own axes, rad/s.</summary>
        Vector3d Rate(in Quaterniond relative, in Vector3d before, in Vector3d after);

        /// <summary>Gives the energy, J.</summary>
        double Value(in Joint joint, in Quaterniond relative);

        /// <summary>Adds the couples, N m, along the axes of a and of b (derivatives by their body-frame
        /// turns).</summary>
        void AddGradient(in Joint joint, in Quaterniond relative, ref RodVector a, ref RodVector b);

        /// <summary>Adds couples and second derivatives: C of a and of b, F of a.</summary>
        void AddBlocks(in Joint joint, in Quaterniond relative, ref RodVector a, ref RodVector b, ref RodBlock blockA,
            ref RodBlock blockB);
    }

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

    /// <summary>Turn w about d3 from which the first joint of instruments in a sheath is measured: it stands for all of
    /// them before it, and winds up by many turns.</summary>
    /// <remarks>A joint's orientation tells its turn up to pi. So it is theta = w e3 + Log of what is beyond w, and w
    /// is moved to theta before theta can be pi away from it.</remarks>
    internal sealed class JointWinding
    {
        private const double MaxWound = 1.0;  // radians of the joint from its winding

        private Quaterniond _wound = Quaterniond.Identity;

        /// <summary>w, radians.</summary>
        public double Turn { get; private set; }

        /// <summary>Gives a frame turned by w.</summary>
        public Quaterniond Wound(in Quaterniond frame) => frame * _wound;

        /// <summary>w is this from now on, radians.</summary>
        public void Set(double turn)
        {
            Turn = turn;
            _wound = Quaterniond.FromAxisAngle(Vector3d.UnitZ, turn);
        }

        /// <summary>Whether a joint is so far beyond w, radians, that it has to be moved.</summary>
        public static bool IsFar(double beyond) => Math.Abs(beyond) > MaxWound;

        /// <summary>Writes or restores w.</summary>
        public void Serialize(Snapshot snapshot) => Set(snapshot.Serialize(Turn));
    }
}
