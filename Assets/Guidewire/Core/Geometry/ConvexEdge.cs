using System;

namespace Guidewire.Core
{
    /// <summary>A convex edge of a wall, in contact with a segment near it.</summary>
    /// <remarks>Where segment and edge are parallel their closest points jump; so the weight fades as c = sin^2 of the
    /// angle between them goes to 0: t (2 - t) with t = c/0.01. A segment along an edge has its contacts at its
    /// ends.</remarks>
    internal static class ConvexEdge
    {
        private const double FadeOver = 0.01;     // of sin^2
        private const double Sharp = 0.02;        // radians, from which an edge counts as one

        /// <summary>Weight of an edge at which the wall turns by an angle, radians: tanh(angle/0.02).</summary>
        /// <remarks>Proportional to small angles, so that a bend counts the same however finely it is divided; but
        /// large enough for a coarse bend that the one edge met does not hold the wire at a vanishing gap.</remarks>
        public static double Weight(double angle) => Math.Tanh(angle / Sharp);

        /// <summary>Adds the edge contact if the edge is within a range of segment a b.</summary>
        /// <param name="a">First end of the segment.</param>
        /// <param name="b">Second end.</param>
        /// <param name="start">First end of the edge; the second may be the same, which is a corner.</param>
        /// <param name="end">Second end of the edge.</param>
        /// <param name="radius">By which the edge is widened, units.</param>
        /// <param name="weight">Of an edge across the segment.</param>
        /// <param name="angle">By which the wall turns there, radians.</param>
        /// <param name="range">Units.</param>
        /// <param name="contacts">Receives it.</param>
        public static void Add(in Vector3d a, in Vector3d b, in Vector3d start, in Vector3d end, double radius,
            double weight, double angle, double range, StructList<EdgeContact> contacts)
        {
            double squared = ClosestPoints.SegmentSegment(a, b, start, end, out double s, out double t);
            double limit = range + radius;
            if (squared > limit * limit || squared == 0.0)
            {
                return;
            }
            double distance = Math.Sqrt(squared);
            Vector3d normal = (Vector3d.Lerp(a, b, s) - Vector3d.Lerp(start, end, t)) / distance;
            Vector3d u = b - a;
            Vector3d along = Vector3d.Normalize(end - start);
            double perWeight = angle / weight;
            Vector3d slope = Fade(u, along, 0.0, ref weight);
            var contact = new EdgeContact(s, distance - radius, normal, weight, -slope, slope, perWeight, radius);
            contacts.Add(s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0 ? Sliding(contact, u, along, distance) : contact);
        }

        /// <summary>Fades a weight where the segment is almost parallel to an edge: times t (2 - t) up to t = 1,
        /// with t the squared sine of their angle less a least value, over 0.01.</summary>
        /// <param name="u">From the segment's first end to its second.</param>
        /// <param name="along">Unit vector along the edge.</param>
        /// <param name="least">Of the squared sine at which the weight is 0.</param>
        /// <param name="weight">That of an edge across the segment, which is faded.</param>
        /// <returns>Its derivative along u, 1/units.</returns>
        public static Vector3d Fade(in Vector3d u, in Vector3d along, double least, ref double weight)
        {
            double size = u.Length;
            Vector3d direction = u / size;
            double cosine = Vector3d.Dot(direction, along);
            double fraction = Math.Max(0.0, 1.0 - cosine * cosine - least) / FadeOver;
            if (!(fraction < 1.0))
            {
                return Vector3d.Zero;
            }
            double rate = 2.0 * (1.0 - fraction) / FadeOver;
            Vector3d slope = (weight * rate * -2.0 * cosine / size) * (along - cosine * direction);
            weight *= fraction * (2.0 - fraction);
            return slope;
        }

        /// <summary>The contact between the ends of both, where the crossing slides so that the distance along the
        /// segment stays least.</summary>
        /// <param name="contact">Without that.</param>
        /// <param name="u">From the segment's first end to its second.</param>
        /// <param name="along">Unit vector along the edge.</param>
        /// <param name="distance">Of the crossing from the edge, units.</param>
        public static EdgeContact Sliding(in EdgeContact contact, in Vector3d u, in Vector3d along, double distance)
        {
            double s = contact.Position;
            Vector3d n = contact.Normal;
            Vector3d across = Vector3d.Cross(n, along);
            double rate = Vector3d.Dot(across, u) / distance;
            double perSecond = -distance / (Vector3d.Dot(across, u) * Vector3d.Dot(across, u));
            return contact.Sliding(perSecond * ((1.0 - s) * rate * across - n), perSecond * (s * rate * across + n),
                Symmetric3.Outer(1.0 / distance, across));
        }
    }
}
