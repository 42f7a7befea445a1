using System;

namespace Guidewire.Core
{
    /// <summary>A convex body at rest, seen from a segment. Implemented by structs only, so that the swept test
    /// compiles once per kind of body.</summary>
    internal interface IConvexBody
    {
        /// <summary>Closest points of segment a b (parameter s) and the body; the distance is returned, 0 or less
        /// where they overlap.</summary>
        double Closest(in Vector3d a, in Vector3d b, out double s, out Vector3d point);
    }

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

    /// <summary>One edge as a convex body.</summary>
    internal readonly struct EdgeBody : IConvexBody
    {
        private readonly Vector3d _start;
        private readonly Vector3d _end;

        /// <summary>Makes the body of an edge from one point to another.</summary>
        public EdgeBody(in Vector3d start, in Vector3d end)
        {
            _start = start;
            _end = end;
        }

        /// <inheritdoc/>
        public double Closest(in Vector3d a, in Vector3d b, out double s, out Vector3d point)
        {
            double squared = ClosestPoints.SegmentSegment(a, b, _start, _end, out s, out double t);
            point = Vector3d.Lerp(_start, _end, t);
            return Math.Sqrt(squared);
        }
    }

    /// <summary>One triangle as a convex body.</summary>
    internal readonly struct TriangleBody : IConvexBody
    {
        private readonly Vector3d _v0;
        private readonly Vector3d _v1;
        private readonly Vector3d _v2;

        public TriangleBody(in Vector3d v0, in Vector3d v1, in Vector3d v2)
        {
            _v0 = v0;
            _v1 = v1;
            _v2 = v2;
        }

        public double Closest(in Vector3d a, in Vector3d b, out double s, out Vector3d point)
        {
            return Math.Sqrt(ClosestPoints.SegmentTriangle(
                a, b, _v0, _v1, _v2, double.PositiveInfinity, out s, out point, out _));
        }
    }

    /// <summary>Time of impact of a segment whose ends move along straight lines against a convex body at rest, by
    /// conservative advancement in the direction of the closest points (Mirtich 1996).</summary>
    /// <remarks>At a moment with closest points p (segment) and c (body), n = (p - c)/|p - c|, the body lies behind the
    /// plane through c with normal n, because it is convex. The segment cannot meet it before one of its ends does meet
    /// that plane. So time may advance to that moment, whatever the motion along the plane: sliding along a wall costs
    /// one query.</remarks>
    internal static class SweptTest
    {
        private const int MaxAdvances = 20;

        /// <summary>Fraction of the motion during which the clearance is at least <paramref name="clearance"/>, <see
        /// cref="ContactShape.NoImpact"/> for all of it. It must be larger at the start. If the advances run out first,
        /// the time proven safe so far is returned. Approaches below <paramref name="resolution"/> are ignored, and so
        /// is what comes after <paramref name="limit"/>.</summary>
        public static double Impact<TBody>(
            in TBody body, in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1, double clearance,
            double resolution, double limit = 1.0)
            where TBody : struct, IConvexBody
        {
            Vector3d va = a1 - a0;
            Vector3d vb = b1 - b0;
            double time = 0.0;
            double proven = 0.0;    // the last time at which the distance was evaluated
            for (int k = 0; k < MaxAdvances; k++)
            {
                Vector3d a = a0 + time * va;
                Vector3d b = b0 + time * vb;
                double distance = body.Closest(a, b, out double s, out Vector3d c);
                if (!(distance > 0.0))
                {
                    return proven;
                }
                proven = time;
                Vector3d n = (Vector3d.Lerp(a, b, s) - c) / distance;
                double advance = Math.Min(
                    TimeToPlane(a - c, va, n, clearance, time), TimeToPlane(b - c, vb, n, clearance, time));
                if (advance >= limit - time)
                {
                    return ContactShape.NoImpact;
                }

                // Both ends may have the clearance and still be approaching: then the plane has turned only a little
                // and the remaining approach is below the resolution.
                if (advance * Math.Max(va.Length, vb.Length) <= resolution && distance <= 1.01 * clearance)
                {
                    return time;
                }
                time += Math.Max(advance, 0.0);
            }
            return time;
        }

        private static double TimeToPlane(
            in Vector3d offset, in Vector3d velocity, in Vector3d n, double clearance, double time)
        {
            double approach = -Vector3d.Dot(velocity, n);
            if (!(approach > 0.0))
            {
                return 1.0 - time;
            }
            return (Vector3d.Dot(offset, n) - clearance) / approach;
        }
    }

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

        /// <summary>Gives this contact as the segment b a has it.</summary>
        public EdgeContact Reversed()
        {
            return new EdgeContact(1.0 - Position, Distance, Normal, Weight, WeightAlongB, WeightAlongA, Angle,
                Rounding, -SlideAlongB, -SlideAlongA, Curvature);
        }

        /// <summary>Gives this contact with what the second derivative of its distance takes.</summary>
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
