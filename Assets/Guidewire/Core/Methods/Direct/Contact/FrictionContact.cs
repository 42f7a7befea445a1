namespace Guidewire.Core
{
    /// <summary>Friction at one contact point in the current step: on element j at s; its normal force, and its elastic
    /// displacement at the start of the step.</summary>
    internal struct FrictionContact
    {
        /// <summary>The index of the anchor.</summary>
        public int Index;

        /// <summary>The element j.</summary>
        public int Element;

        /// <summary>The position s along it.</summary>
        public double Position;

        /// <summary>The wall's normal n.</summary>
        public Vector3d Normal;

        /// <summary>The limit mu N of the friction force.</summary>
        public double Limit;

        /// <summary>The tangential stiffness k, N/m.</summary>
        public double Stiffness;

        /// <summary>d at the step's start, m, along the wall.</summary>
        public Vector3d Start;

        /// <summary>Where the element's nodes were at the step's start, carried with the wall since, m.</summary>
        public (Vector3d First, Vector3d Second) From;

        /// <summary>The element's frame at the step's start, turned with the wall since.</summary>
        public Quaterniond Frame;
    }
}
