namespace Guidewire.Core
{
    /// <summary>A vertex of the difference of a segment and a hull: one end of the segment less one vertex of the hull.
    /// The two meet where the difference holds the origin.</summary>
    internal readonly struct MinkowskiVertex
    {
        /// <summary>End less hull vertex.</summary>
        public readonly Vector3d Offset;

        /// <summary>The hull's vertex.</summary>
        public readonly Vector3d HullVertex;

        /// <summary>0 for the segment's first end, 1 for its second.</summary>
        public readonly double End;

        private MinkowskiVertex(in Vector3d offset, in Vector3d hullVertex, double end)
        {
            Offset = offset;
            HullVertex = hullVertex;
            End = end;
        }

        /// <summary>Gives the vertex farthest along <paramref name="direction"/>.</summary>
        public static MinkowskiVertex Support(in Vector3d a, in Vector3d b, Vector3d[] hull, in Vector3d direction)
        {
            int lowest = 0;
            double least = double.PositiveInfinity;
            for (int i = 0; i < hull.Length; i++)
            {
                double value = Vector3d.Dot(hull[i], direction);
                if (value < least)
                {
                    least = value;
                    lowest = i;
                }
            }
            bool second = Vector3d.Dot(b - a, direction) > 0.0;
            Vector3d end = second ? b : a;
            return new MinkowskiVertex(end - hull[lowest], hull[lowest], second ? 1.0 : 0.0);
        }
    }
}
