using System;

namespace Guidewire.Core
{
    /// <summary>The derivatives of the joints of coaxial instruments by their twist angles; the second ones as rows of
    /// the first angles of all elements, then of the second ones.</summary>
    /// <remarks>With M = d2E/(dphi dz) and dphi = T dtheta_b - T^T dtheta_a an angle z meets the rotations by T^T M and
    /// -T M. At the tip of an instrument the frame before the joint is turned by the angle z_c of the one that goes on,
    /// R: dz_c turns it as e3 dz_c does, and takes as much from the angles of all others. With C, F, g of that frame
    /// z_c meets theta_a by R (C e3 + 1/2 e3 x g - T M) and theta_b by F e3 + T^T M.</remarks>
    internal sealed class CoaxialTwistRows
    {
        private readonly CoaxialJoints _joints;
        private TwistRow _clamp;               // what falls on the hub's angles, which are not unknown

        /// <summary>Makes the rows of these joints.</summary>
        public CoaxialTwistRows(CoaxialJoints joints)
        {
            _joints = joints;
            Rows = new TwistRow[joints.InnerCount * (joints.Capacity + 1)];
        }

        /// <summary>How many there are of each angle.</summary>
        public int Count => _joints.ElementCount + 1;

        /// <summary>The rows.</summary>
        public TwistRow[] Rows { get; }

        /// <summary>Whether second derivatives by angles are to be positive.</summary>
        public bool DropsGeometricStiffness { get; set; }

        /// <summary>Adds the gradient by the angles on both sides of the joint at node k, which is no tip.</summary>
        public void AddGradient(RodVector[] gradient, int k, in CoaxialJointState s)
        {
            int at = _joints.ElementCount + 2 + k;
            double weight = _joints[k].First.Weight;
            if (k > 0)
            {
                gradient[at - 1].T3 += (1.0 - weight) * s.First.Slope - s.First.Couple;
            }
            gradient[at].T3 += weight * s.First.Slope + s.First.Couple;
            if (_joints.InnerCount > 1)
            {
                AddSecond(gradient, k, s.Second);
            }
        }

        // Of the innermost of three instruments.
        private void AddSecond(RodVector[] gradient, int k, in CoaxialPartState part)
        {
            int at = _joints.ElementCount + 2 + k;
            double weight = _joints[k].Second.Weight;
            if (k > 0)
            {
                gradient[at - 1].T2 += (1.0 - weight) * part.Slope - part.Couple;
            }
            gradient[at].T2 += weight * part.Slope + part.Couple;
        }

        /// <summary>The same at a tip, where the frame before it is turned by the angle of the instrument that goes
        /// on.</summary>
        /// <param name="turned">Gradient by a turn of that frame about its axis.</param>
        public void AddTipGradient(RodVector[] gradient, int k, in CoaxialJointState s, double turned)
        {
            int frame = _joints.CarrierOf(k);
            ref RodVector before = ref gradient[_joints.ElementCount + 1 + k];
            double onFrame = s.First.Couple - (1.0 - _joints[k].First.Weight) * s.First.Slope;
            if (_joints.InnerCount > 1)
            {
                double second = (1.0 - _joints[k].Second.Weight) * s.Second.Slope - s.Second.Couple;
                onFrame -= second;
                if (frame == 2 && _joints.CarrierOf(k - 1) == 0)
                {
                    before.T3 += second;   // the tip of the one between ends there
                }
                else if (frame == 1)
                {
                    AddSecond(gradient, k, s.Second);
                }
            }
            onFrame += turned;
            before.T3 += frame == 1 ? onFrame : 0.0;
            before.T2 += frame == 2 ? onFrame : 0.0;
        }

        /// <summary>Adds what the joint at node k says, which is no tip.</summary>
        public void Add(int k, in CoaxialJointState s)
        {
            ref readonly CoaxialJoint joint = ref _joints[k];
            int frame = _joints.CarrierOf(k);
            if (frame == 0)
            {
                Add(k, 1, s.Turn, s.First, joint.First, Kept(s.First.Second, s.MixedSecond));
            }
            if (_joints.InnerCount > 1)
            {
                Add(k, 2, s.Turn, s.Second, joint.Second, Kept(s.Second.Second, s.MixedSecond));
                AddMixed(k, s.MixedSecond, joint.First.Weight, joint.Second.Weight);
            }
        }

        /// <summary>Adds what the joint at node k says, a tip.</summary>
        /// <param name="own">Blocks of the joint by the frame before it.</param>
        /// <param name="g">Gradient by the same.</param>
        public void AddTip(int k, in CoaxialJointState s, in RodBlock own, in RodVector g)
        {
            ref readonly CoaxialJoint joint = ref _joints[k];
            double first = 1.0 - joint.First.Weight;
            double second = 1.0 - joint.Second.Weight;
            double stiffness = joint.First.Twist + joint.Second.Twist;
            Vector3d mixed = -(first * s.First.Mixed) + -(second * s.Second.Mixed) + stiffness * Vector3d.UnitZ;
            double both = first * first * s.First.Second + second * second * s.Second.Second
                + 2.0 * first * second * s.MixedSecond + stiffness;
            int frame = _joints.CarrierOf(k);
            ref TwistRow row = ref Row(k - 1, frame);
            double c = Math.Cos(s.FrameBefore);
            double si = Math.Sin(s.FrameBefore);
            double half = DropsGeometricStiffness ? 0.0 : 0.5;
            Vector3d along = TurnedFrame.TimesT(s.Turn, mixed, 0.5);
            row.Turn += Turned(new Vector3d(own.C31 - half * g.T2, own.C32 + half * g.T1, own.C33) - along, c, si);
            row.NextTurn += new Vector3d(own.F13, own.F23, own.F33) + TurnedFrame.TimesT(s.Turn, mixed, -0.5);
            row.Diagonal += Kept(both, 0.0) + own.C33 - 2.0 * along.Z;
            int before = _joints.CarrierOf(k - 1);
            int other = frame == 1 ? 2 : 1;
            if (_joints.InnerCount > 1 && other > before)
            {
                // Of the others only the second one has an angle before the joint.
                double slope = first * s.MixedSecond + second * s.Second.Second;
                AddOther(k, other, frame, s, slope, c, si);
            }
        }

        private void AddOther(int k, int other, int frame, in CoaxialJointState s, double slope, double c, double si)
        {
            ref readonly CoaxialPart part = ref _joints[k].Second;
            double w = part.Weight;
            double second = Kept(s.Second.Second, s.MixedSecond);
            Vector3d before = (1.0 - w) * s.Second.Mixed - part.Twist * Vector3d.UnitZ;
            ref TwistRow row = ref Row(k - 1, other);
            Vector3d along = TurnedFrame.TimesT(s.Turn, before, 0.5);
            row.Turn -= Turned(along, c, si);
            row.NextTurn += TurnedFrame.TimesT(s.Turn, before, -0.5);
            row.Diagonal += (1.0 - w) * (1.0 - w) * second + part.Twist;
            Row(k - 1, 1).Other += Unkept(-(1.0 - w) * slope) - part.Twist - along.Z;
            if (other > frame)
            {
                Vector3d after = w * s.Second.Mixed + part.Twist * Vector3d.UnitZ;
                ref TwistRow next = ref Row(k, other);
                Vector3d afterAlong = TurnedFrame.TimesT(s.Turn, after, 0.5);
                next.Turn += TurnedFrame.TimesT(s.Turn, after, -0.5);
                next.Diagonal += w * w * second + part.Twist;
                row.TurnOfNext -= Turned(afterAlong, c, si);
                row.NextTwist += w * (1.0 - w) * second - part.Twist;
                Row(k - 1, frame).NextOther += Unkept(-w * slope) + part.Twist - afterAlong.Z;
            }
        }

        private void Add(int k, int instrument, in Vector3d turn, in CoaxialPartState s, in CoaxialPart part,
            double second)
        {
            double w = part.Weight;
            double stiffness = part.Twist;
            ref TwistRow row = ref Row(k - 1, instrument);
            ref TwistRow next = ref Row(k, instrument);
            row.Diagonal += (1.0 - w) * (1.0 - w) * second + stiffness;
            next.Diagonal += w * w * second + stiffness;
            row.NextTwist += w * (1.0 - w) * second - stiffness;
            Vector3d before = (1.0 - w) * s.Mixed - stiffness * Vector3d.UnitZ;
            Vector3d after = w * s.Mixed + stiffness * Vector3d.UnitZ;
            row.Turn -= TurnedFrame.TimesT(turn, before, 0.5);
            row.NextTurn += TurnedFrame.TimesT(turn, before, -0.5);
            row.TurnOfNext -= TurnedFrame.TimesT(turn, after, 0.5);
            next.Turn += TurnedFrame.TimesT(turn, after, -0.5);
        }

        // Of both angles before and after a joint.
        private void AddMixed(int k, double mixed, double first, double second)
        {
            double m = Unkept(mixed);
            Row(k - 1, 1).Other += (1.0 - first) * (1.0 - second) * m;
            Row(k, 1).Other += first * second * m;
            Row(k - 1, 1).NextOther += (1.0 - first) * second * m;
            Row(k - 1, 2).NextOther += (1.0 - second) * first * m;
        }

        /// <summary>Adds what the last half element holds.</summary>
        public void AddLast(in AngleHessian hessian)
        {
            int last = _joints.ElementCount - 1;
            int carrier = _joints.CarrierOf(last);
            if (carrier == 0)
            {
                Row(last, 1).Diagonal += Kept(hessian.First, hessian.Mixed);
            }
            if (_joints.InnerCount > 1)
            {
                Row(last, 2).Diagonal += Kept(hessian.Second, hessian.Mixed);
                Row(last, 1).Other += Unkept(hessian.Mixed);
            }
        }

        private ref TwistRow Row(int element, int instrument) =>
            ref element < 0 ? ref _clamp : ref Rows[(instrument - 1) * Count + element];

        // Where they are to be positive, at least as much as all of them together have.
        private double Kept(double second, double mixed) =>
            DropsGeometricStiffness ? Math.Max(second, 0.0) + Math.Abs(mixed) : second;

        private double Unkept(double mixed) => DropsGeometricStiffness ? 0.0 : mixed;

        private static Vector3d Turned(in Vector3d v, double c, double s) =>
            new Vector3d(c * v.X - s * v.Y, s * v.X + c * v.Y, v.Z);
    }

    /// <summary>Second derivatives of an energy by two angles, J.</summary>
    internal struct AngleHessian
    {
        public double First;
        public double Second;
        public double Mixed;
    }

    /// <summary>Derivatives by the turns of a frame that is an element's turned about its d3 by an angle, R, as those
    /// of the element: theta' = R^T theta.</summary>
    internal static class TurnedFrame
    {
        /// <summary>Adds a gradient by that frame to the element's.</summary>
        /// <param name="angle">From the element to the frame about d3, radians.</param>
        public static void Add(ref RodVector to, double angle, in RodVector g)
        {
            double c = Math.Cos(angle);
            double s = Math.Sin(angle);
            to.T1 += c * g.T1 - s * g.T2;
            to.T2 += s * g.T1 + c * g.T2;
            to.T3 += g.T3;
        }

        /// <summary>Adds second derivatives by that frame to the element's: R C R^T and F R^T.</summary>
        /// <param name="c">Cosine of the angle.</param>
        /// <param name="s">Its sine.</param>
        public static void Add(ref RodBlock to, in RodBlock from, double c, double s)
        {
            double x1 = c * from.C11 - s * from.C21;
            double x2 = c * from.C21 - s * from.C22;
            double y1 = s * from.C11 + c * from.C21;
            double y2 = s * from.C21 + c * from.C22;
            to.C11 += c * x1 - s * x2;
            to.C21 += c * y1 - s * y2;
            to.C22 += s * y1 + c * y2;
            to.C31 += c * from.C31 - s * from.C32;
            to.C32 += s * from.C31 + c * from.C32;
            to.C33 += from.C33;
            to.F11 += c * from.F11 - s * from.F12; to.F12 += s * from.F11 + c * from.F12; to.F13 += from.F13;
            to.F21 += c * from.F21 - s * from.F22; to.F22 += s * from.F21 + c * from.F22; to.F23 += from.F23;
            to.F31 += c * from.F31 - s * from.F32; to.F32 += s * from.F31 + c * from.F32; to.F33 += from.F33;
        }

        /// <summary>Gives T v with T = (1 - c |phi|^2) 1 + c phi phi^T + [phi]/2 (<see cref="RotationVectorLaw"/>), or
        /// T^T v
        /// with half negative.</summary>
        public static Vector3d TimesT(in Vector3d phi, in Vector3d v, double half)
        {
            double square = phi.LengthSquared;
            double c = RotationVector.CotangentFactor(square);
            return (1.0 - c * square) * v + (c * Vector3d.Dot(phi, v)) * phi + half * Vector3d.Cross(phi, v);
        }
    }
}
