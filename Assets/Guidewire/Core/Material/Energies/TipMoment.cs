namespace Guidewire.Core
{
    /// <summary>A couple on the last element that turns with it: constant along the element's own axes.</summary>
    /// <remarks>In a plane, and about the tip's own axis in a pure twist, it has the potential -m times the angle. In
    /// space it has none: the work on a closed path of frames is not 0. It then enters by its work since the anchor,
    /// -m . log(conj(q_anchor) q), whose second derivative at the anchor is 0; the part of the tangent that no energy
    /// carries, [m]/2 on the last element, the solver adds on its own (<see cref="FollowerTangent"/>). Such a couple
    /// can drive the wire for ever: a straight round wire (GJ = 0.77 EI) without other loads has one equilibrium only,
    /// and that flutters, drag or not, beyond m L/EI = 3.60 across its axis and 4.15 along it.</remarks>
    internal sealed class TipMoment : EnergyTerm
    {
        private Quaterniond _anchor = Quaterniond.Identity;

        /// <summary>m along the axes of the last element, N m.</summary>
        public Vector3d Moment { get; set; }

        /// <summary>Whether the couple changes in time, so that it is one also where it is 0 now.</summary>
        public bool Varies { get; set; }

        /// <summary>True of no couple.</summary>
        public override bool HasPotential => Moment == Vector3d.Zero && !Varies;

        /// <summary>Gives 0: no work yet.</summary>
        public override double AnchoredValue(double before) => 0.0;

        /// <inheritdoc/>
        public override void Anchor(RodShape shape) => _anchor = shape.Q[shape.ElementCount - 1];

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            if (Moment == Vector3d.Zero)
            {
                return 0.0;
            }
            Quaterniond turned = _anchor.Conjugate * shape.Q[shape.ElementCount - 1];
            return -Vector3d.Dot(Moment, RotationVector.Log(turned));
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            int last = shape.ElementCount - 1;
            if (from <= last && last < to)
            {
                gradient[last].AddT(-Moment);
            }
        }
    }
}
