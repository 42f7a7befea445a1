namespace Guidewire.Core
{
    /// <summary>Placement of a vessel: x -> position + R (scale x), with the scale along the vessel's own
    /// axes.</summary>
    public readonly struct Placement
    {
        private readonly Quaterniond _orientation;
        private readonly Vector3d _scale;
        private readonly Vector3d _position;

        /// <summary>The placement with this position (units), orientation (of unit length) and scale (no component 0;
        /// negative ones mirror).</summary>
        public Placement(in Vector3d position, in Quaterniond orientation, in Vector3d scale)
        {
            _position = position;
            _orientation = orientation;
            _scale = scale;
        }

        /// <summary>Leaves everything where it is.</summary>
        public static Placement Identity =>
            new Placement(Vector3d.Zero, Quaterniond.Identity, new Vector3d(1.0, 1.0, 1.0));

        /// <summary>True when the vessel is mirrored, which turns its triangles inside out.</summary>
        public bool Mirrors => _scale.X * _scale.Y * _scale.Z < 0.0;

        /// <summary>Where the point stands.</summary>
        public Vector3d Apply(in Vector3d x)
        {
            var scaled = new Vector3d(_scale.X * x.X, _scale.Y * x.Y, _scale.Z * x.Z);
            return _position + Quaterniond.Rotate(_orientation, scaled);
        }

        /// <summary>The orientation of Euler angles in degrees, in Unity's order: about z first, then x, then y, all
        /// about the fixed axes.</summary>
        public static Quaterniond FromEulerDegrees(in Vector3d degrees)
        {
            const double Radians = System.Math.PI / 180.0;
            return Quaterniond.FromAxisAngle(Vector3d.UnitY, Radians * degrees.Y)
                * Quaterniond.FromAxisAngle(Vector3d.UnitX, Radians * degrees.X)
                * Quaterniond.FromAxisAngle(Vector3d.UnitZ, Radians * degrees.Z);
        }
    }
}
