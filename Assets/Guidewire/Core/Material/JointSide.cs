namespace Guidewire.Core
{
    /// <summary>The element on one side of a joint: the uniform element that would bend and twist as much
    /// there.</summary>
    internal struct JointSide
    {
        /// <summary>EI about d1, N m^2.</summary>
        public double Bend1;

        /// <summary>EI about d2, N m^2.</summary>
        public double Bend2;

        /// <summary>GJ about d3, N m^2.</summary>
        public double Twist;

        /// <summary>Curvature and twist at rest, rad/m.</summary>
        public Vector3d RestCurvature;

        /// <summary>Whether another is the same.</summary>
        public bool IsLike(in JointSide other)
        {
            return Bend1 == other.Bend1 && Bend2 == other.Bend2 && Twist == other.Twist
                && RestCurvature == other.RestCurvature;
        }
    }
}
