namespace Guidewire.Core
{
    /// <summary>The follower loads at the wire's end: a couple and a force along the axes of the end, each times a
    /// factor over time.</summary>
    /// <remarks>The end is half an element beyond the middle of the last one, whose axes the terms know. Over that half
    /// the wire turns by l/2 times its mean curvature, rest + B^-1 (m + l/4 e3 x f), which is as constant along these
    /// axes as m and f are; so along the element's axes both are turned by it. Without this turn they would point
    /// wrong by an angle of first order in l, unless the couple bends or twists only (n = 30, m = 2 EI/L and a force
    /// 2 EI/L^2: 0.26 % of L at the tip).</remarks>
    internal sealed class TipFollowers
    {
        private readonly JointSide _end;
        private readonly double _half;          // of the last element, m
        private readonly Vector3d _moment;      // N m
        private readonly Vector3d _force;       // N
        private readonly TimeTable? _momentTable;
        private readonly TimeTable? _forceTable;

        /// <summary>Makes those of a scene.</summary>
        public TipFollowers(MaterialRod rod, SceneParameters scene)
        {
            int last = rod.ElementCount - 1;
            _end = rod.EndOf(last);
            _half = 0.5 * rod.Length[last];
            _moment = scene.TipMoment;
            _force = scene.TipFollowerForce;
            _momentTable = scene.TipMomentTable;
            _forceTable = scene.TipFollowerForceTable;
            Moment.Varies = _momentTable != null && _moment != Vector3d.Zero;
            Force.Varies = _forceTable != null && _force != Vector3d.Zero;
            Set(0.0);
        }

        /// <summary>The couple on the last element.</summary>
        public TipMoment Moment { get; } = new TipMoment();

        /// <summary>The force on the last node.</summary>
        public TipFollowerForce Force { get; } = new TipFollowerForce();

        /// <summary>The keys of those there are.</summary>
        public string Keys => Force.HasPotential ? "tipMoment"
            : Moment.HasPotential ? "tipFollowerForce" : "tipMoment and tipFollowerForce";

        /// <summary>Sets the loads of this time, s.</summary>
        public void SetTime(double time)
        {
            if (Moment.Varies || Force.Varies)
            {
                Set(time);
            }
        }

        /// <summary>Says whether they change after this time, s.</summary>
        public bool ChangeAfter(double time)
        {
            return (Moment.Varies && _momentTable!.ChangesFrom(time))
                || (Force.Varies && _forceTable!.ChangesFrom(time));
        }

        private void Set(double time)
        {
            Vector3d moment = (_momentTable == null ? 1.0 : _momentTable.At(time)) * _moment;
            Vector3d force = (_forceTable == null ? 1.0 : _forceTable.At(time)) * _force;
            Vector3d bend = moment + 0.5 * _half * Vector3d.Cross(Vector3d.UnitZ, force);
            Vector3d curvature = _end.RestCurvature
                + new Vector3d(bend.X / _end.Bend1, bend.Y / _end.Bend2, bend.Z / _end.Twist);
            Quaterniond turn = RotationVector.Exp(_half * curvature);
            Moment.Moment = Quaterniond.Rotate(turn, moment);
            Force.Force = Quaterniond.Rotate(turn, force);
        }
    }
}
