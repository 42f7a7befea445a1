using System;

namespace Guidewire.Core
{
    /// <summary>What is read off at the hub and at the tip of a wire with a material, at one moment, in SI
    /// units.</summary>
    /// <remarks>The hub is the proximal support; its axis is that of the clamp. Force and torque are those of the hub
    /// on the wire: a push and a turn to the right, as seen from the hub, are positive.</remarks>
    public sealed class HubRecord
    {
        private readonly double[] _jointLength;  // m
        private readonly Vector3d[] _turns;      // of the joints, rad

        internal HubRecord(MaterialRod rod, RodSupports supports)
        {
            _jointLength = rod.JointLengths(supports);
            _turns = new Vector3d[rod.ElementCount + 1];
        }

        /// <summary>How far the hub has gone along its axis since the start, m.</summary>
        public double Insertion { get; private set; }

        /// <summary>How far it has turned since the start, rad; more than one turn counts.</summary>
        public double Turn { get; private set; }

        /// <summary>Its force on the wire along its axis, N.</summary>
        public double Force { get; private set; }

        /// <summary>Its torque on the wire about its axis, N m.</summary>
        public double Torque { get; private set; }

        /// <summary>Direction of the last element, a unit vector.</summary>
        public Vector3d TipDirection { get; private set; }

        /// <summary>Twist of the wire from the hub to the tip, rad: the sum over all joints.</summary>
        public double Twist { get; private set; }

        /// <summary>Largest curvature of any joint, 1/m.</summary>
        public double LargestCurvature { get; private set; }

        /// <summary>Takes the wire as it is.</summary>
        internal void Take(RodTerms terms, RodShape shape, MaterialDrive drive, in Vector3d force, in Vector3d couple)
        {
            Vector3d axis = terms.Supports.HasProximalJoint ? shape.ProximalFrame.Director3 : shape.Q[0].Director3;
            Insertion = drive.Insertion;
            Turn = drive.Turn;
            Force = Vector3d.Dot(force, axis);
            Torque = Vector3d.Dot(couple, axis);
            TipDirection = shape.Q[shape.ElementCount - 1].Director3;
            terms.Bending.Measure(shape, _turns);
            Twist = 0.0;
            LargestCurvature = 0.0;
            for (int k = 0; k < _turns.Length; k++)
            {
                Vector3d turn = _turns[k];
                Twist += turn.Z;
                double bend = Math.Sqrt(turn.X * turn.X + turn.Y * turn.Y);
                LargestCurvature = Math.Max(LargestCurvature, bend / _jointLength[k]);
            }
        }
    }
}
