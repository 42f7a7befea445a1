using System;

namespace Guidewire.Core
{
    /// <summary>The hubs of two coaxial instruments, which move along one axis.</summary>
    internal sealed class CoaxialHubs
    {
        private readonly Vector3d _axis;
        private readonly SheathEnd? _sheath;

        /// <summary>These two.</summary>
        /// <param name="axis">A unit vector.</param>
        /// <param name="sheath">In which they are, or null.</param>
        public CoaxialHubs(HubMotion outer, HubMotion inner, in Vector3d axis, SheathEnd? sheath)
        {
            _sheath = sheath;
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

        /// <summary>How far the outer one is from the exit of a sheath at a time, m; 0 without one.</summary>
        public double SheathedAt(double time)
        {
            return _sheath == null ? 0.0 : Math.Max(0.0, -_sheath.Outside(Outer.PositionAt(time)));
        }

        /// <summary>How far the inner one is turned against the outer one, radians.</summary>
        public double TwistAt(double time)
        {
            return Inner.TurnAt(time) - Outer.TurnAt(time);
        }
    }
}
