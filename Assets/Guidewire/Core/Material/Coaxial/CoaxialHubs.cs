namespace Guidewire.Core
{
    /// <summary>The hubs of two coaxial instruments, which move along one axis.</summary>
    internal sealed class CoaxialHubs
    {
        private readonly Vector3d _axis;

        /// <summary>These two.</summary>
        /// <param name="axis">A unit vector.</param>
        public CoaxialHubs(HubMotion outer, HubMotion inner, in Vector3d axis)
        {
            Outer = outer;
            Inner = inner;
            _axis = axis;
        }

        /// <summary>That of the outer instrument.</summary>
        public HubMotion Outer { get; }

        /// <summary>That of the inner one.</summary>
        public HubMotion Inner { get; }

        /// <summary>How far the inner one is behind the outer one at a time, m.</summary>
        public double LeadAt(double time)
        {
            return Vector3d.Dot(Outer.PositionAt(time) - Inner.PositionAt(time), _axis);
        }

        /// <summary>How far the inner one is turned against the outer one, radians.</summary>
        public double TwistAt(double time)
        {
            return Inner.TurnAt(time) - Outer.TurnAt(time);
        }
    }
}
