namespace Guidewire.Core
{
    /// <summary>Energy of a wire held straight in its sheath: only the part of a joint's wire beyond the exit bends. It
    /// cuts the joints of <see cref="BendTwistTerm"/> at the exit, and has the energy of the straightened
    /// part.</summary>
    /// <remarks>With a and f compliance and turn at rest beyond the exit (<see cref="CoaxialPieces"/>), and W the
    /// energy of what is before it, a joint has |theta - f|^2/(2 a) + W. The exit lies at a position along the wire
    /// that follows from the hub's, not from the nodes: so the energy depends on the hub, and its slope is the force by
    /// which a bent wire is driven out of a sheath without friction (<see cref="Release"/>).</remarks>
    internal sealed class SheathEnergy : EnergyTerm
    {
        private static readonly double[] NoLead = { 0.0 };

        private readonly CoaxialRod _rod;
        private readonly BendTwistEnergy<RotationVectorLaw> _bending;
        private double _held;                   // J

        /// <summary>Of a wire alone, with joint 0 for all that is before it.</summary>
        public SheathEnergy(CoaxialRod rod, BendTwistEnergy<RotationVectorLaw> bending)
        {
            _rod = rod;
            _bending = bending;
            Remesh();
        }

        /// <inheritdoc/>
        public override void Remesh() => Cut(_rod.Joints.ElementCount);

        /// <inheritdoc/>
        public override void SetTime(double time)
        {
            CoaxialHubs? hubs = _rod.Hubs;
            if (hubs != null)
            {
                SetExit(hubs.SheathedAt(time));
                _bending.TurnProximal(hubs.Outer.AheadAt(time));
            }
        }

        /// <summary>The exit is this far from the hub along the wire, m.</summary>
        public void SetExit(double sheathed)
        {
            if (sheathed != _rod.Joints.Sheathed)
            {
                Cut(_rod.SetHubs(NoLead, sheathed));
            }
        }

        /// <summary>Energy of what is kept straight, J, all that is still in the sheath among it.</summary>
        public override double Value(RodShape shape) => _held;

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
        }

        // Joints beyond these are as they were, and outside.
        private void Cut(int changed)
        {
            CoaxialJoints joints = _rod.Joints;
            _held = joints.HeldInLead;
            for (int k = 0; k < changed && k < joints.ElementCount; k++)
            {
                _bending.SetJoint(k, joints[k].Alone);
                _held += joints[k].Held;
            }
        }
    }
}
