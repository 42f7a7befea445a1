namespace Guidewire.Core
{
    /// <summary>Friction at one contact point in the current step: on element j at s; its normal force, and its elastic
    /// displacement at the start of the step.</summary>
    internal struct FrictionContact
    {
        /// <summary>Of the anchor.</summary>
        public int Index;

        /// <summary>j.</summary>
        public int Element;

        /// <summary>s.</summary>
        public double Position;

        /// <summary>n.</summary>
        public Vector3d Normal;

        /// <summary>mu N.</summary>
        public double Limit;

        /// <summary>k, N/m.</summary>
        public double Stiffness;

        /// <summary>d at the step's start, m, along the wall.</summary>
        public Vector3d Start;
    }
}
