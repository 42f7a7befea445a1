namespace Guidewire.Core
{
    /// <summary>The spring between two frames: its stiffness EI/(w l) about d1 and about d2 and GJ/(w l) about d3 in
    /// N m, and its rotation vector at rest, w l times the rest curvature. w is the joint's weight, 1 away from the
    /// clamps.</summary>
    internal struct Joint
    {
        public double Bend1;
        public double Bend2;
        public double Twist;
        public Vector3d Rest;
    }
}
