namespace Guidewire.Core
{
    /// <summary>A convex wall as the swept test needs it: by its own signed distance.</summary>
    internal readonly struct ConvexWall : IConvexBody
    {
        private readonly ContactShape _shape;

        public ConvexWall(ContactShape shape)
        {
            _shape = shape;
        }

        /// <inheritdoc/>
        public double Closest(in Vector3d a, in Vector3d b, out double s, out Vector3d point)
        {
            int hint = -1;
            _shape.Nearest(a, b, double.PositiveInfinity, ref hint, out SurfaceContact contact);
            s = contact.Position;
            point = contact.Point;
            return contact.Distance;
        }
    }
}
