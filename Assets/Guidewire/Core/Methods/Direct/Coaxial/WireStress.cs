namespace Guidewire.Core
{
    /// <summary>Strains, forces and couples of a wire among coaxial instruments, at its own joints and
    /// elements.</summary>
    /// <remarks>Its curvature is that of the shared centreline, linear between the joints of the chain, about the
    /// wire's own axes; its twist is its own. Couples follow by its own stiffness. Along the axis it has its own loads,
    /// and of what else is there (walls, inertia) the part of its EA in that of all; of the shear force that of its GA.
    /// In a sheath it is straight, and behind the outermost hub, where it has the force of its hub. That alone has
    /// friction in a lumen, and what bending in one another makes of a force along the axis.</remarks>
    internal sealed class WireStress
    {
        private readonly CoaxialInstrument _own;
        private readonly InnerInstrument _wire;
        private readonly Joint[] _joints;       // as if it were alone
        private readonly double[] _lengths;     // of wire that each stands for, m
        private readonly StressRecord _record;

        /// <summary>Makes one of the innermost instrument.</summary>
        /// <param name="wire">Where it is.</param>
        public WireStress(CoaxialSetup setup, InnerInstrument wire)
        {
            _wire = wire;
            _own = setup.Instruments[setup.Instruments.Length - 1];
            _joints = wire.Joints;
            _lengths = _own.Rod.JointLengths(InnerInstrument.Supports);
            _record = new StressRecord(_lengths);
        }

        /// <summary>The record at the time that was set last; the next call writes it anew.</summary>
        /// <param name="thrust">Of the wire's hub, N.</param>
        public StressRecord Record(RodDynamics dynamics, CoaxialJoints joints, double thrust)
        {
            CoaxialBendTwist bending = dynamics.Terms.CoaxialBending!;
            int wire = joints.InnerCount;
            double lead = joints.LeadOf(wire);
            int n = _own.Rod.ElementCount;
            int j = 0;
            for (int k = 0; k <= n; k++)
            {
                double at = _own.Stations[k] - lead;
                j = CoaxialShape.ElementAt(joints, at, j);
                Vector3d curvature = k == n ? Vector3d.Zero
                    : at < joints.Stations[0] ? CoaxialShape.LeadTwist(dynamics.Shape, bending, wire)
                    : Curvature(dynamics.Shape, bending, j, at);
                curvature = at < joints.Sheathed ? curvature.Z * Vector3d.UnitZ : curvature;
                Joint joint = _joints[k];
                Vector3d couple = _lengths[k] * curvature - joint.Rest;
                couple = new Vector3d(joint.Bend1 * couple.X, joint.Bend2 * couple.Y, joint.Twist * couple.Z)
                    + (_own.Rod.Fibres?.CoupleAt(k, curvature, at < joints.Sheathed) ?? Vector3d.Zero);
                _record.Curvature[k] = curvature;
                _record.Couple[k] = k == n ? Vector3d.Zero : Quaterniond.Rotate(_wire.Shape.Q[k], couple);
                if (k < n)
                {
                    TakeElement(dynamics, joints, k, at + 0.5 * _own.Rod.Length[k], j, thrust);
                }
            }
            return _record;
        }

        // Rad/m, at a place along the chain in element j.
        private static Vector3d Curvature(RodShape shape, CoaxialBendTwist bending, int j, double at)
        {
            CoaxialJoints joints = bending.Joints;
            Vector3d before = CoaxialShape.CurvatureOf(shape, bending, j, joints.InnerCount);
            if (j + 1 >= joints.ElementCount)
            {
                return before;
            }
            double fraction = (at - joints.Stations[j]) / (joints.Stations[j + 1] - joints.Stations[j]);
            return Vector3d.Lerp(before, CoaxialShape.CurvatureOf(shape, bending, j + 1, joints.InnerCount), fraction);
        }

        private void TakeElement(RodDynamics dynamics, CoaxialJoints joints, int element, double at, int j,
            double thrust)
        {
            MaterialRod rod = _own.Rod;
            Vector3d strain = new Vector3d(0.0, 0.0, -thrust / rod.StretchStiffness[element]);
            if (at >= joints.Stations[0])
            {
                RodShape shape = dynamics.Shape;
                j = CoaxialShape.ElementAt(joints, at, j);
                Vector3d force = dynamics.Terms.Stretch.Stress(shape, j, out Vector3d p);
                Quaterniond turn = _wire.Shape.Q[element].Conjugate * shape.Q[j];
                Vector3d shear = Quaterniond.Rotate(turn, new Vector3d(p.X, p.Y, 0.0));
                strain = new Vector3d(shear.X, shear.Y,
                    dynamics.Terms.Supports.Coaxial!.Axial.StrainOf(joints.InnerCount, j, force.Z));
            }
            _record.Strain[element] = strain;
            _record.Force[element] = Quaterniond.Rotate(_wire.Shape.Q[element], new Vector3d(
                rod.ShearStiffness[element] * strain.X, rod.ShearStiffness[element] * strain.Y,
                rod.StretchStiffness[element] * strain.Z));
        }
    }
}
