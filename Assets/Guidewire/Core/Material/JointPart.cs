namespace Guidewire.Core
{
    /// <summary>The part beyond a cut of the wire that a joint stands for, and the energy of the rest.</summary>
    internal struct JointPart
    {
        /// <summary>Length beyond the cut, m, weighed by the joint's hat function.</summary>
        public double Length;

        /// <summary>Sum of lambda/EI about d1 beyond it, 1/(N m).</summary>
        public double Compliance1;

        /// <summary>The same about d2.</summary>
        public double Compliance2;

        /// <summary>Turn at rest beyond it, rad.</summary>
        public Vector3d Rest;

        /// <summary>Energy of what is before the cut, kept straight, J.</summary>
        public double Held;
    }
}
