using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>A tube along a centreline of straight pieces: its lumen is the union of all spheres whose centre runs
    /// along the centreline while their radius changes linearly from knot to knot.</summary>
    /// <remarks>The distance of x is d(x) = max over pieces i and u in [0, 1] of R_i(u) - |x - c_i(u)|, its normal
    /// points from x to the centre c that gives the maximum. d is the exact distance outside a crease, has slope 1
    /// everywhere and is 0 on the wall; where two pieces meet at the inner side of a bend it may be smaller than the
    /// distance to their common edge, never larger. Each piece's term is concave, because its lumen is convex: an
    /// element therefore touches with its ends or where two pieces' terms cross.</remarks>
    public sealed class TubeShape : ContactShape
    {
        private const int MaxCuts = 64;
        private const int MaxAdvances = 16;
        private const double MinAdvance = 0.01;    // of what is proven
        private readonly Vector3d[] _knots;
        private readonly double[] _radii;
        private readonly TubeTree _tree;
        private TubeCreases? _edgeContacts;
        private TubeCcd? _ccd;
        private TubePlanes? _planes;
        private TubeOverlaps? _overlaps;

        /// <summary>The tube through <paramref name="knots"/> (at least 2, units) with a radius at each (positive,
        /// units). It ends in half spheres; an open end continues straight with the radius of its last knot.</summary>
        /// <exception cref="ArgumentException">Fewer than 2 knots, unequal counts, a value that is not finite, a radius
        /// that is not positive, or a piece that lies inside the sphere of one of its ends.</exception>
        public TubeShape(Vector3d[] knots, double[] radii, bool openStart, bool openEnd)
        {
            string? error = Check(knots, radii);
            if (error != null)
            {
                throw new ArgumentException(error);
            }
            int extra = (openStart ? 1 : 0) + (openEnd ? 1 : 0);
            int shift = openStart ? 1 : 0;
            int count = knots.Length;
            _knots = new Vector3d[count + extra];
            _radii = new double[count + extra];
            double length = 0.0;
            double widest = 0.0;
            for (int i = 0; i < count; i++)
            {
                _knots[i + shift] = knots[i];
                _radii[i + shift] = radii[i];
                widest = Math.Max(widest, radii[i]);
                length += i > 0 ? Vector3d.Distance(knots[i - 1], knots[i]) : 0.0;
            }

            // Far enough that no wire reaches the end of the extension, near enough to keep 12 digits of a radius.
            double far = 1000.0 * (length + widest);
            if (openStart)
            {
                _knots[0] = knots[0] + far * Vector3d.Normalize(knots[0] - knots[1]);
                _radii[0] = radii[0];
            }
            if (openEnd)
            {
                _knots[count + shift] = knots[count - 1]
                    + far * Vector3d.Normalize(knots[count - 1] - knots[count - 2]);
                _radii[count + shift] = radii[count - 1];
            }
            _tree = new TubeTree(_knots, _radii, 1e-12 * (length + widest));
            FirstKnot = shift;
            LastKnot = shift + count - 1;
        }

        /// <inheritdoc/>
        public override IEnumerable<Vector3d> SurfacePoints()
        {
            for (int i = FirstKnot; i <= LastKnot; i++)
            {
                for (int side = -1; side <= 1; side += 2)
                {
                    yield return _knots[i] + (side * _radii[i]) * Vector3d.UnitX;
                    yield return _knots[i] + (side * _radii[i]) * Vector3d.UnitY;
                    yield return _knots[i] + (side * _radii[i]) * Vector3d.UnitZ;
                }
            }
        }

        /// <summary>The knots that were given, units.</summary>
        public IReadOnlyList<Vector3d> Centreline =>
            new ArraySegment<Vector3d>(_knots, FirstKnot, LastKnot + 1 - FirstKnot);

        /// <summary>The first knot that was given: 1 behind an open start, else 0.</summary>
        internal int FirstKnot { get; }

        /// <summary>The last knot that was given.</summary>
        internal int LastKnot { get; }

        /// <summary>Knots of the centreline in units; an open end's last knot is far away.</summary>
        internal Vector3d[] Knots => _knots;

        /// <summary>Radius at each knot, units.</summary>
        internal double[] Radii => _radii;

        /// <summary>All radii are larger: every distance is, by as much.</summary>
        private protected override ContactShape? Outward(double distance)
        {
            int count = LastKnot + 1 - FirstKnot;
            var knots = new Vector3d[count];
            Array.Copy(_knots, FirstKnot, knots, 0, count);
            var radii = new double[count];
            for (int i = 0; i < count; i++)
            {
                radii[i] = _radii[FirstKnot + i] + distance;
            }
            return new TubeShape(knots, radii, FirstKnot > 0, LastKnot + 1 < _knots.Length);
        }

        /// <inheritdoc/>
        public override bool Contains(in Vector3d point)
        {
            _tree.Deepest(point, 0, out double distance);
            return distance > 0.0;
        }

        /// <inheritdoc/>
        public override bool IsWithin(in Vector3d point)
        {
            int piece = _tree.Deepest(point, 0, out double distance);
            bool isBefore = piece < FirstKnot;
            bool isBehind = piece >= LastKnot;
            return distance > 0.0 && !isBefore && !isBehind;
        }

        /// <inheritdoc/>
        public override bool Nearest(
            in Vector3d a, in Vector3d b, double range, ref int hint, out SurfaceContact contact)
        {
            int guess = hint >= 0 && hint < _tree.Pieces.Length ? hint : 0;
            ref readonly TubePiece last = ref _tree.Pieces[guess];
            if (last.Distance(a) > range && last.Distance(b) > range)
            {
                // One piece, being convex, holds all of the segment that deep.
                contact = default;
                return false;
            }
            if (range <= double.MaxValue && AreDeeper(a, b, range, ref guess))
            {
                hint = guess;
                contact = default;
                return false;
            }
            int piece = FindLeast(a, b, guess, range, out double s, out _);
            hint = piece;
            Vector3d x = Vector3d.Lerp(a, b, s);
            double distance = _tree.Pieces[piece].Distance(x, out Vector3d centre, out _);
            Vector3d normal = Vector3d.Normalize(centre - x);
            contact = new SurfaceContact(s, x - distance * normal, normal, distance);
            return distance <= range;
        }

        /// <summary>Least distance along segment a b, units.</summary>
        internal double MinDistance(in Vector3d a, in Vector3d b)
        {
            FindLeast(a, b, 0, double.PositiveInfinity, out _, out double distance);
            return distance;
        }

        /// <inheritdoc/>
        internal override bool Holds(in Vector3d a, in Vector3d b, ref int hint)
        {
            hint = hint >= 0 && hint < _tree.Pieces.Length ? hint : 0;
            ref readonly TubePiece piece = ref _tree.Pieces[hint];
            return (piece.Distance(a) > 0.0 && piece.Distance(b) > 0.0) || AreDeeper(a, b, 0.0, ref hint)
                || MinDistance(a, b) > 0.0;
        }

        // Whether each piece from the deepest at one end to the deepest at the other holds the part of the segment
        // between the planes of its knots deeper than this: a piece's term is concave, so checking the ends of a part
        // suffices.
        private bool AreDeeper(in Vector3d a, in Vector3d b, double distance, ref int hint)
        {
            int first = _tree.Deepest(a, hint, out double atA);
            int last = _tree.Deepest(b, first, out double atB);
            hint = first;
            bool isDeeper = atA > distance && atB > distance;
            Vector3d u = first <= last ? b - a : a - b;
            for (int knot = Math.Min(first, last) + 1; knot <= Math.Max(first, last) && isDeeper; knot++)
            {
                Vector3d point = (first <= last ? a : b) + Planes.Cut(knot, first <= last ? a : b, u) * u;
                isDeeper = _tree.Pieces[knot - 1].Distance(point) > distance
                    && _tree.Pieces[knot].Distance(point) > distance;
            }
            return isDeeper;
        }

        /// <summary>Pieces that hold something within the skin of the segment, along the centreline. The distance is
        /// the least at its ends and where it crosses creases.</summary>
        internal override double FindFeatures(in Vector3d a, in Vector3d b, double range, double skin, ref int hint,
            StructList<WallFeature> features)
        {
            int from = features.Count;
            _tree.Collect(a, b, skin, features);
            if (features.Count == from)
            {
                return base.FindFeatures(a, b, range, skin, ref hint, features);
            }
            var found = new FeatureRange(features, from, features.Count, 0.0);
            hint = Deepest(a, found, out double atA);
            Deepest(b, found, out double atB);
            return Overlaps.Has(found) || Overlaps.Hide(found) ? MinDistance(a, b)
                : Math.Min(Math.Min(atA, atB), EdgeContacts.Nearest(a, b, found));
        }

        /// <summary>The contact point of the deepest piece. On a piece's centreline the normal is 0 and no curvature is
        /// stated.</summary>
        internal override double FindContactPoints(in Vector3d x, double range, FeatureRange features,
            StructList<ContactPoint> contactPoints)
        {
            int piece = features.From == features.To ? _tree.Deepest(x, 0, out double distance)
                : Deepest(x, features, out distance);
            if (distance > range)
            {
                return distance;
            }
            _tree.Pieces[piece].Distance(x, out Vector3d centre, out double along);
            double radius = Vector3d.Distance(centre, x);
            Vector3d normal = Vector3d.Normalize(centre - x);
            var contact = new SurfaceContact(0.0, x - distance * normal, normal, distance);
            Vector3d around = Vector3d.Normalize(Vector3d.Cross(_knots[piece + 1] - _knots[piece], normal));
            bool isRound = along <= 0.0 || along >= 1.0;
            contactPoints.Add(isRound ? ContactPoint.Corner(contact, 1, -radius)
                : ContactPoint.Edge(contact, 1, Vector3d.Cross(around, normal), -radius));
            return distance;
        }

        /// <summary>The creases at its knots, see <see cref="TubeCreases"/>; where pieces hold creases of others those
        /// between the pieces that are the deepest one after another along the segment. Where it crosses from one leg
        /// of the tube to another the contact has no weight: the wire stops there without a force.</summary>
        internal override void FindEdgeContacts(in Vector3d a, in Vector3d b, double range, FeatureRange features,
            StructList<EdgeContact> edgeContacts)
        {
            int from = edgeContacts.Count;
            if (Overlaps.Hide(features))
            {
                FindMeetings(a, b, range, features, edgeContacts);
                return;
            }
            if (features.IsKnown)
            {
                EdgeContacts.Find(a, b, range, features, edgeContacts);
            }
            else
            {
                EdgeContacts.Find(a, b, range, edgeContacts);
            }
            if (Overlaps.Has(features))
            {
                FindBetweenLegs(a, b, range, from, edgeContacts);
            }
        }

        private void FindBetweenLegs(in Vector3d a, in Vector3d b, double range, int from,
            StructList<EdgeContact> edgeContacts)
        {
            // A crease in the lumen of another leg is none.
            int left = from;
            for (int k = from; k < edgeContacts.Count; k++)
            {
                EdgeContact crease = edgeContacts[k];
                _tree.Deepest(Vector3d.Lerp(a, b, crease.Position), 0, out double depth);
                if (depth <= crease.Distance + _tree.Resolution)
                {
                    edgeContacts[left++] = crease;
                    range = Math.Min(range, crease.Distance - _tree.Resolution);
                }
            }
            edgeContacts.Truncate(left);
            int piece = FindLeast(a, b, 0, range, out double s, out double distance);
            if (s > 0.0 && s < 1.0 && distance < range)
            {
                Vector3d x = Vector3d.Lerp(a, b, s);
                _tree.Pieces[piece].Distance(x, out Vector3d centre, out _);
                edgeContacts.Add(new EdgeContact(s, distance, Vector3d.Normalize(centre - x), 0.0, Vector3d.Zero,
                    Vector3d.Zero, 1.0, 0.0));
            }
        }

        private void FindMeetings(in Vector3d a, in Vector3d b, double range, FeatureRange features,
            StructList<EdgeContact> edgeContacts)
        {
            int first = Deepest(a, 0, features, out double atA);
            int last = Deepest(b, first, features, out double atB);
            bool isAlong = first <= last;
            var start = new TubePoint(0.0, isAlong ? atA : atB, Math.Min(first, last));
            var end = new TubePoint(1.0, isAlong ? atB : atA, Math.Max(first, last));
            int from = edgeContacts.Count;
            AddMeetings(isAlong ? a : b, isAlong ? b : a, start, end, range, features, 0, edgeContacts);
            for (int k = from; k < edgeContacts.Count && !isAlong; k++)
            {
                edgeContacts[k] = edgeContacts[k].Reversed();
            }
        }

        // In the direction of the tube. With slope at most 1, d is nowhere below (d0 + d1 - length)/2.
        private void AddMeetings(in Vector3d a, in Vector3d b, in TubePoint from, in TubePoint to, double range,
            FeatureRange features, int cuts, StructList<EdgeContact> edgeContacts)
        {
            double length = (to.S - from.S) * Vector3d.Distance(a, b);
            if (from.Piece == to.Piece || 0.5 * (from.Distance + to.Distance - length) > range || cuts == MaxCuts)
            {
                return;
            }
            double middle = _tree.Crossing(a, b, from, to);
            Vector3d x = Vector3d.Lerp(a, b, middle);
            int deepest = Deepest(x, from.Piece, features, out double depth);
            double crossing = Math.Max(_tree.Pieces[from.Piece].Distance(x), _tree.Pieces[to.Piece].Distance(x));
            if (depth > crossing + _tree.Resolution)
            {
                var cut = new TubePoint(middle, depth, deepest);
                AddMeetings(a, b, from, cut, range, features, cuts + 1, edgeContacts);
                AddMeetings(a, b, cut, to, range, features, cuts + 1, edgeContacts);
            }
            else if (EdgeContacts.FindBetween(from.Piece, to.Piece, a, b, (from.S, middle, to.S), range,
                out EdgeContact contact))
            {
                edgeContacts.Add(contact);
            }
        }

        private int Deepest(in Vector3d x, int guess, FeatureRange features, out double distance) =>
            features.IsKnown ? Deepest(x, features, out distance) : _tree.Deepest(x, guess, out distance);

        private int Deepest(in Vector3d x, FeatureRange features, out double distance)
        {
            int piece = features[features.From];
            distance = _tree.Pieces[piece].Distance(x);
            for (int k = features.From + 1; k < features.To; k++)
            {
                double own = _tree.Pieces[features[k]].Distance(x);
                if (own > distance)
                {
                    distance = own;
                    piece = features[k];
                }
            }
            return piece;
        }

        /// <summary>Gives that of the narrowest knot.</summary>
        internal override double NarrowestRadius(double above, double below)
        {
            double narrowest = double.PositiveInfinity;
            foreach (double radius in _radii)
            {
                narrowest = radius > above && radius < below ? Math.Min(narrowest, radius) : narrowest;
            }
            return narrowest;
        }

        private TubeCreases EdgeContacts => _edgeContacts ??= new TubeCreases(this, _tree.Pieces, Planes);

        private TubeCcd Ccd => _ccd ??= new TubeCcd(_tree.Pieces, Planes);

        private TubeOverlaps Overlaps => _overlaps ??= new TubeOverlaps(_knots, _radii, _tree);

        private TubePlanes Planes => _planes ??= new TubePlanes(_knots);

        /// <summary>Gives what <see cref="TubeCcd"/> proves at once.</summary>
        internal override double ConservativeTimeOfImpact(in Vector3d a0, in Vector3d b0, in Vector3d a1,
            in Vector3d b1, double clearance, double resolution, int hint, FeatureRange features, double limit) =>
            Math.Min(limit, Ccd.SafeFraction(a0, b0, a1, b1, clearance, Guess(a0, hint)));

        /// <summary>The part of the motion that <see cref="TubeCcd"/> proves to be free, and again from where it ends:
        /// until the segment is at the wall, or little is gained. Distances have slope 1 or less, so each advance is at
        /// least the distance to be covered over the motion of the ends.</summary>
        private protected override double TimeOfImpact(in Vector3d a0, in Vector3d b0, in Vector3d a1, in Vector3d b1,
            double clearance, double resolution, int hint)
        {
            Vector3d a = a0;
            Vector3d b = b0;
            int piece = Guess(a0, hint);
            double time = 0.0;
            double left = 0.0;    // of the distance, above the clearance
            for (int k = 0; k < MaxAdvances; k++)
            {
                double part = Ccd.SafeFraction(a, b, a1, b1, clearance, piece);
                if (left > 0.0)
                {
                    part = Math.Max(part, left / Math.Max(Vector3d.Distance(a, a1), Vector3d.Distance(b, b1)));
                }
                if (part >= 1.0)
                {
                    return NoImpact;
                }
                time += part * (1.0 - time);
                a = Vector3d.Lerp(a0, a1, time);
                b = Vector3d.Lerp(b0, b1, time);
                left = MinDistance(a, b) - clearance;
                if (left <= resolution || part <= MinAdvance * time)
                {
                    break;
                }
                piece = _tree.Deepest(a, piece, out _);
            }
            return time;
        }

        private int Guess(in Vector3d x, int hint) =>
            hint >= 0 && hint < _tree.Pieces.Length ? hint : _tree.Deepest(x, 0, out _);

        // Where d is least along the segment, and the piece whose term it is. A piece that is deepest at both ends of a
        // part is deepest on all of it, its term being concave, and then an end is the nearest point. So a part is
        // divided where the terms of the pieces at its ends cross; if one of the two is the deepest there too, that
        // point is the nearest in between. With slope at most 1, d is nowhere below (d0 + d1 - length)/2.
        private int FindLeast(
            in Vector3d a, in Vector3d b, int guess, double range, out double s, out double distance)
        {
            int piece = _tree.Deepest(a, guess, out distance);
            s = 0.0;
            if (a == b)
            {
                return piece;
            }
            int last = _tree.Deepest(b, piece, out double db);
            int first = piece;
            double da = distance;
            if (db < distance)
            {
                s = 1.0;
                distance = db;
                piece = last;
            }
            if (first != last)
            {
                double length = Vector3d.Distance(a, b);
                var start = new TubePoint(0.0, da, first);
                var end = new TubePoint(1.0, db, last);
                Between(a, b, length, start, end, range, 0, ref s, ref distance, ref piece);
            }
            return piece;
        }

        private void Between(in Vector3d a, in Vector3d b, double length, in TubePoint from, in TubePoint to,
            double range, int cuts, ref double s, ref double distance, ref int piece)
        {
            double bound = 0.5 * (from.Distance + to.Distance - length * (to.S - from.S));
            if (from.Piece == to.Piece || bound > range || bound >= distance - _tree.Resolution || cuts == MaxCuts)
            {
                return;
            }
            // A piece's term is no less than the line between its values at both ends: so between the ends d is nowhere
            // below the value at which the two pieces' lines cross.
            double fromAtEnd = _tree.Pieces[from.Piece].Distance(Vector3d.Lerp(a, b, to.S));
            double toAtStart = _tree.Pieces[to.Piece].Distance(Vector3d.Lerp(a, b, from.S));
            double falls = from.Distance - toAtStart;
            double rises = to.Distance - fromAtEnd;
            double held = distance - _tree.Resolution;
            if (fromAtEnd >= held || toAtStart >= held
                || (from.Distance * rises + fromAtEnd * falls) / (falls + rises) > Math.Min(range, held))
            {
                return;
            }
            double middle = _tree.Crossing(a, b, from, to);
            int deepest = _tree.Deepest(Vector3d.Lerp(a, b, middle), from.Piece, out double d);
            if (d < distance - _tree.Resolution)
            {
                s = middle;
                distance = d;
                piece = deepest;
            }
            double crossing = Math.Max(
                _tree.Pieces[from.Piece].Distance(Vector3d.Lerp(a, b, middle)),
                _tree.Pieces[to.Piece].Distance(Vector3d.Lerp(a, b, middle)));
            if (d <= crossing + _tree.Resolution)
            {
                return;
            }
            var cut = new TubePoint(middle, d, deepest);
            Between(a, b, length, from, cut, range, cuts + 1, ref s, ref distance, ref piece);
            Between(a, b, length, cut, to, range, cuts + 1, ref s, ref distance, ref piece);
        }

        /// <summary>The term of piece i at x with the centre that gives it, and where along the piece that centre would
        /// lie if the piece had no ends: from 0 to 1 between its knots.</summary>
        internal double PieceDistance(int i, in Vector3d x, out Vector3d centre, out double along) =>
            _tree.Pieces[i].Distance(x, out centre, out along);

        private static string? Check(Vector3d[] knots, double[] radii)
        {
            if (knots.Length < 2 || knots.Length != radii.Length)
            {
                return "a tube needs at least 2 knots and one radius for each";
            }
            for (int i = 0; i < knots.Length; i++)
            {
                if (!knots[i].IsFinite || !(radii[i] > 0.0) || double.IsInfinity(radii[i]))
                {
                    return "knot " + i + " of the tube needs finite coordinates and a positive radius";
                }
                if (i > 0 && !(Vector3d.Distance(knots[i - 1], knots[i]) > Math.Abs(radii[i] - radii[i - 1])))
                {
                    return "knots " + (i - 1) + " and " + i + " of the tube are closer together than their radii "
                        + "differ";
                }
            }
            return null;
        }
    }
}
