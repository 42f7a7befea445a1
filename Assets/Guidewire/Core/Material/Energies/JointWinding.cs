using System;

namespace Guidewire.Core
{
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
