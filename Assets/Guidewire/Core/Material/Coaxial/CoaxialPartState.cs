using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Derivatives of a joint's energy for one instrument with an angle of its own
    /// (<see cref="CoaxialPart"/>).</summary>
    internal struct CoaxialPartState
    {
        public double Before;     // its angle before the joint, from the joint's frame
        public double After;
        public double Slope;      // dE/dt
        public double Second;     // d2E/dt2
        public double Couple;     // dE/ddelta
        public Vector3d Mixed;    // d2E/(dphi dt)

        /// <summary>Gives the mean angle t.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly double Mean(in CoaxialPart part) => (1.0 - part.Weight) * Before + part.Weight * After;
    }
}
