namespace Guidewire.Core
{
    /// <summary>Where a segment a b crosses a convex edge of a wall: an edge of a mesh, or the crease at the inner side
    /// of a bend, which bulges into the free side.</summary>
    /// <remarks>The crossing's distance d from the edge has the derivative ((1 - s) n, s n) along (a, b). An energy is
    /// W f(d) with a weight W that is continuous while the segment moves: it measures the angle by which the wall turns
    /// at the edge, so that a bend counts the same however finely it is divided, and fades where the crossing is not
    /// defined: along a parallel edge, or at a segment's end, which is a contact point of its own.</remarks>
    internal readonly struct EdgeContact
    {
        /// <summary>Position s of the crossing along the segment.</summary>
        public readonly double Position;

        /// <summary>The signed distance d, units.</summary>
        public readonly double Distance;

        /// <summary>n, from the edge into the free side.</summary>
        public readonly Vector3d Normal;

        /// <summary>W, 0 or more.</summary>
        public readonly double Weight;

        /// <summary>Derivative of W along a, 1/units.</summary>
        public readonly Vector3d WeightAlongA;

        /// <summary>Derivative of W along b, 1/units.</summary>
        public readonly Vector3d WeightAlongB;

        /// <summary>Derivative of s along a, 1/units; 0 where the crossing stays where it is.</summary>
        public readonly Vector3d SlideAlongA;

        /// <summary>Derivative of s along b, 1/units.</summary>
        public readonly Vector3d SlideAlongB;

        /// <summary>H, 1/units: with S the derivative of s and u = b - a, the second derivative of d is
        /// [(1 - s)^2 H, s (1 - s) H; s (1 - s) H, s^2 H] + q S^T + S q^T + (u.H u) S S^T,
        /// q = ((1 - s) H u - n, s H u + n).</summary>
        public readonly Symmetric3 Curvature;

        /// <summary>The angle by which the wall turns at the edge over its weight, radians.</summary>
        public readonly double Angle;

        /// <summary>Radius over which it turns, units; 0 of a sharp edge.</summary>
        public readonly double Rounding;

        /// <summary>Makes a crossing with these values.</summary>
        public EdgeContact(double position, double distance, in Vector3d normal, double weight,
            in Vector3d weightAlongA, in Vector3d weightAlongB, double angle, double rounding)
            : this(position, distance, normal, weight, weightAlongA, weightAlongB, angle, rounding, default, default,
                default)
        {
        }

        private EdgeContact(double position, double distance, in Vector3d normal, double weight,
            in Vector3d weightAlongA, in Vector3d weightAlongB, double angle, double rounding,
            in Vector3d slideAlongA, in Vector3d slideAlongB, in Symmetric3 curvature)
        {
            Angle = angle;
            Rounding = rounding;
            SlideAlongA = slideAlongA;
            SlideAlongB = slideAlongB;
            Curvature = curvature;
            Position = position;
            Distance = distance;
            Normal = normal;
            Weight = weight;
            WeightAlongA = weightAlongA;
            WeightAlongB = weightAlongB;
        }

        /// <summary>Gives the same of the segment b a.</summary>
        public EdgeContact Reversed()
        {
            return new EdgeContact(1.0 - Position, Distance, Normal, Weight, WeightAlongB, WeightAlongA, Angle,
                Rounding, -SlideAlongB, -SlideAlongA, Curvature);
        }

        /// <summary>The same with what its second derivative takes.</summary>
        public EdgeContact Sliding(in Vector3d alongA, in Vector3d alongB, in Symmetric3 curvature)
        {
            return new EdgeContact(Position, Distance, Normal, Weight, WeightAlongA, WeightAlongB, Angle, Rounding,
                alongA, alongB, curvature);
        }

        /// <summary>Gives the angle by which the wall turns under a segment of this length, units, over the weight,
        /// radians.</summary>
        public double TurnUnder(double length) => Angle * Rounding > length ? length / Rounding : Angle;
    }
}
