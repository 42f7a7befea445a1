namespace Guidewire.Core
{
    /// <summary>A point of a segment in a tube.</summary>
    internal readonly struct TubePoint
    {
        /// <summary>Where along the segment, 0 at its first end and 1 at its second.</summary>
        public readonly double S;

        /// <summary>The signed distance d there, units.</summary>
        public readonly double Distance;

        /// <summary>The piece that gives it; at a handover, the one that follows.</summary>
        public readonly int Piece;

        /// <summary>Makes a point with these values.</summary>
        public TubePoint(double s, double distance, int piece)
        {
            S = s;
            Distance = distance;
            Piece = piece;
        }
    }
}
