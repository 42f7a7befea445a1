using System;

namespace Guidewire.Core
{
    /// <summary>Results at the hub and the tip of a wire with a material at one time, in SI units.</summary>
    /// <remarks>The hub is the proximal support; its axis is that of the clamp. Force and torque are those of the hub
    /// on the wire: a thrust and a turn to the right, as seen from the hub, are positive.</remarks>
    public sealed class HubRecord
    {
        private readonly double[] _jointLength;  // m
        private readonly Vector3d[] _turns;      // of the joints, rad

        /// <param name="jointLengths">Of the wire that each joint stands for, m; they may change.</param>
        internal HubRecord(double[] jointLengths)
        {
            _jointLength = jointLengths;
            _turns = new Vector3d[jointLengths.Length];
        }

        /// <summary>Insertion of the hub since the start, m.</summary>
        public double Insertion { get; private set; }

        /// <summary>Rotation of the hub since the start, rad, also beyond one turn.</summary>
        public double Turn { get; private set; }

        /// <summary>Its force on the wire along its axis, N.</summary>
        public double Force { get; private set; }

        /// <summary>Its torque on the wire about its axis, N m.</summary>
        public double Torque { get; private set; }

        /// <summary>Its work on the wire since the start, J: mean force and torque of each step, by the scheme's
        /// weights, times how far it went and turned; against what drives a bent wire out of a sheath, the integral
        /// over what came out, by the mean of the moments before and after the step. NaN without walls.</summary>
        public double Work { get; internal set; }

        /// <summary>What of <see cref="Force"/> moves the wire against the drag of massDamping, N; NaN with
        /// catheters.</summary>
        public double Drag { get; internal set; } = double.NaN;
        /// <summary>The end of the first step in which the hub slipped at its force limit, s; NaN where it has
        /// not.</summary>
        public double SlippedFrom { get; internal set; } = double.NaN;

        /// <summary>With catheters, by how much the force is uncertain, N: root mean square over the run; else NaN.
        /// </summary>
        public double ForceError { get; internal set; } = double.NaN;

        /// <summary>Direction of the last element, a unit vector.</summary>
        public Vector3d TipDirection { get; private set; }

        /// <summary>Twist of the wire from the hub to the tip, rad: the sum over all joints.</summary>
        public double Twist { get; private set; }

        /// <summary>Largest curvature of any joint, 1/m.</summary>
        public double LargestCurvature { get; private set; }

        /// <summary>Length of the wire that is out of its sheath, m; null without a sheath.</summary>
        public double? LengthInBody { get; private set; }

        /// <summary>Spheres that are out of the sheath; null without a sheath.</summary>
        public int? SpheresInBody { get; private set; }

        /// <summary>Takes the wire as it is.</summary>
        /// <param name="force">Of the supports on node 0, N.</param>
        /// <param name="torque">Of the hub about its axis, N m.</param>
        /// <param name="ahead">How far the hub is ahead of the frame of joint 0, radians.</param>
        internal void Record(RodTerms terms, RodShape shape, MaterialDrive drive, in Vector3d force, double torque,
            double ahead)
        {
            terms.Bending.Measure(shape, _turns);
            double twist = -ahead;
            double largest = 0.0;
            for (int k = 0; k <= shape.ElementCount; k++)
            {
                Vector3d turn = _turns[k];
                twist += turn.Z;
                double bend = Math.Sqrt(turn.X * turn.X + turn.Y * turn.Y);
                double fraction = terms.Supports.FractionOutside(k);
                largest = fraction <= CoaxialJoints.MinFraction ? largest
                    : Math.Max(largest, bend / (fraction * _jointLength[k]));
            }
            double along = Vector3d.Dot(force, terms.HubAxis(shape));
            Record(drive, along + terms.SheathForce(shape), torque, shape.Q[shape.ElementCount - 1].Director3, twist,
                largest);
        }

        /// <summary>Takes what is known of it otherwise.</summary>
        internal void Record(MaterialDrive drive, double force, double torque, in Vector3d tipDirection, double twist,
            double largestCurvature)
        {
            Insertion = drive.Insertion;
            Turn = drive.Turn;
            Force = force;
            Torque = torque;
            Work = double.NaN;
            TipDirection = tipDirection;
            Twist = twist;
            LargestCurvature = largestCurvature;
        }

        /// <summary>Takes what of the wire is out of its sheath.</summary>
        /// <param name="length">m.</param>
        internal void TakeBody(int spheres, double length)
        {
            SpheresInBody = spheres;
            LengthInBody = length;
        }
    }
}
