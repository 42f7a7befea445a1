using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>A vessel that gives way as a whole: its centreline is a beam on an elastic foundation, displaced by
    /// w(s) = sum N_j(s) q_j with uniform cubic B-splines N_j.</summary>
    /// <remarks>Sections stay plane and round, and turn with the centreline by the rotation vector
    /// a = c' x w'/|c'|^2, with c(s) the centreline at rest. They do not turn about it. The energy is that of small
    /// strains, 1/2 int (EI |a'|^2 across c' + EA (c'.w')^2/|c'|^4 + k w^2) ds, a square form of q.</remarks>
    public sealed class WallBeam
    {
        /// <summary>Splines that are not 0 at a station.</summary>
        internal const int Order = 4;

        /// <summary>Pieces of the centreline from spline to spline.</summary>
        internal const int PiecesPerSpline = 4;

        private const int MostSplines = 200;
        private const double Hold = 1e6;             // times the foundation of one spline: what holds an end
        private const int GaussPoints = 4;           // of a piece

        private readonly Vector3d[] _points;         // of the centreline, a piece apart, units
        private readonly Vector3d[] _second;         // its second derivatives there
        private readonly double _piece;              // units
        private readonly double[] _stiffness;        // N/m, Count x Count: the lower triangle counts, of all components

        /// <summary>Makes the beam of a vessel.</summary>
        /// <param name="centreline">Of the vessel at rest, units, from its start to its end.</param>
        /// <param name="bending">EI, N m^2.</param>
        /// <param name="stretching">EA, N.</param>
        /// <param name="foundation">Force by length and displacement in every direction, Pa.</param>
        /// <param name="spacing">Of the splines, units; rounded so that a whole number fits.</param>
        /// <param name="metres">Of a unit.</param>
        /// <param name="holds">Whether place and direction of the start, and of the end, are held.</param>
        /// <exception cref="ArgumentException">A centreline without length, or too many splines.</exception>
        public WallBeam(IReadOnlyList<Vector3d> centreline, double bending, double stretching, double foundation,
            double spacing, double metres, (bool Start, bool End) holds)
        {
            double length = 0.0;
            for (int k = 1; k < centreline.Count; k++)
            {
                length += Vector3d.Distance(centreline[k - 1], centreline[k]);
            }
            double pieces = Math.Max(1.0, Math.Round(length / spacing));
            if (!(length > 0.0) || !(pieces <= MostSplines))
            {
                throw new ArgumentException(length > 0.0 ? "its centreline has more than " + MostSplines
                    + " splines: a larger spacing is needed" : "its centreline has no length");
            }
            Length = length;
            Spacing = length / pieces;
            _piece = Spacing / PiecesPerSpline;
            Count = (int)pieces + Order - 1;
            _points = Resample(centreline, (int)pieces * PiecesPerSpline);
            _second = SecondDerivatives();
            _stiffness = new double[9 * Count * Count];
            AddBending(bending / (metres * metres * metres), stretching / metres, foundation * metres);
            AddHolds(holds, Hold * foundation * metres * Spacing);
        }

        /// <summary>The length of the centreline, units.</summary>
        public double Length { get; }

        /// <summary>The spacing of the splines, units.</summary>
        public double Spacing { get; }

        /// <summary>The number of splines.</summary>
        public int Count { get; }

        /// <summary>The number of points of the centreline that are looked at.</summary>
        internal int PointCount => _points.Length;

        /// <summary>Point k of the centreline, units.</summary>
        internal Vector3d Point(int k) => _points[k];

        /// <summary>Where point k is along it, units.</summary>
        internal double StationOf(int k) => k * _piece;

        /// <summary>Entry of the stiffness against displacements, N/m.</summary>
        /// <param name="row">Three times the spline, plus the component.</param>
        /// <param name="column">The same.</param>
        internal double Stiffness(int row, int column) => _stiffness[3 * Count * row + column];

        /// <summary>Finds the force that it needs to be displaced so.</summary>
        /// <param name="q">m by spline.</param>
        /// <param name="force">Receives it, N by spline.</param>
        internal void FindForce(Vector3d[] q, Vector3d[] force)
        {
            for (int j = 0; j < Count; j++)
            {
                double x = 0.0;
                double y = 0.0;
                double z = 0.0;
                for (int i = Math.Max(0, j - Order + 1); i < Math.Min(Count, j + Order); i++)
                {
                    int at = 3 * Count * 3 * j + 3 * i;
                    x += Product(at, q[i]);
                    y += Product(at + 3 * Count, q[i]);
                    z += Product(at + 6 * Count, q[i]);
                }
                force[j] = new Vector3d(x, y, z);
            }
        }

        private double Product(int at, in Vector3d q) =>
            _stiffness[at] * q.X + _stiffness[at + 1] * q.Y + _stiffness[at + 2] * q.Z;

        /// <summary>The centreline at a station, with its derivatives.</summary>
        internal void Evaluate(double station, out Vector3d c, out Vector3d first, out Vector3d second)
        {
            int k = Math.Min((int)(station / _piece), _points.Length - 2);
            double b = station / _piece - k;
            double a = 1.0 - b;
            double size = _piece * _piece / 6.0;
            (Vector3d one, Vector3d two) = (_second[k], _second[k + 1]);
            c = a * _points[k] + b * _points[k + 1] + (size * a * (a * a - 1.0)) * one
                + (size * b * (b * b - 1.0)) * two;
            first = (1.0 / _piece) * (_points[k + 1] - _points[k]) + (_piece / 6.0 * (1.0 - 3.0 * a * a)) * one
                + (_piece / 6.0 * (3.0 * b * b - 1.0)) * two;
            second = a * one + b * two;
        }

        /// <summary>The splines at a station, with their derivatives.</summary>
        internal Splines SplinesAt(double station)
        {
            int k = Math.Min((int)(station / Spacing), Count - Order);
            double b = station / Spacing - k;
            double a = 1.0 - b;
            double per = 1.0 / Spacing;
            return new Splines(k,
                (a * a * a / 6.0, (3.0 * b * b * b - 6.0 * b * b + 4.0) / 6.0,
                    (3.0 * a * a * a - 6.0 * a * a + 4.0) / 6.0, b * b * b / 6.0),
                (-0.5 * a * a * per, (1.5 * b * b - 2.0 * b) * per, (2.0 * a - 1.5 * a * a) * per, 0.5 * b * b * per),
                (a * per * per, (3.0 * b - 2.0) * per * per, (3.0 * a - 2.0) * per * per, b * per * per));
        }

        /// <summary>Why no wire can be simulated in it, in one phrase, or null: somewhere the wall at rest is no nearer
        /// to the centreline than the centre of its curvature, where sections meet.</summary>
        public string? FindFold(ContactShape wall)
        {
            for (int k = 0; k < _points.Length; k++)
            {
                Evaluate(Math.Min(StationOf(k), Length), out Vector3d c, out Vector3d first, out Vector3d second);
                double radius = Math.Pow(first.Length, 3.0) / Vector3d.Cross(first, second).Length;
                int hint = -1;
                if (radius < Length && !wall.Nearest(c, c, radius, ref hint, out _))
                {
                    return "its centreline bends more tightly than the vessel is wide at " + c
                        + "; if that is a corner, a larger spacing rounds it";
                }
            }
            return null;
        }

        private static Vector3d[] Resample(IReadOnlyList<Vector3d> from, int pieces)
        {
            var along = new double[from.Count];
            for (int k = 1; k < along.Length; k++)
            {
                along[k] = along[k - 1] + Vector3d.Distance(from[k - 1], from[k]);
            }
            var points = new Vector3d[pieces + 1];
            int piece = 1;
            for (int k = 0; k <= pieces; k++)
            {
                double at = along[along.Length - 1] * k / pieces;
                while (piece < along.Length - 1 && along[piece] < at)
                {
                    piece++;
                }
                double span = along[piece] - along[piece - 1];
                points[k] = Vector3d.Lerp(from[piece - 1], from[piece],
                    span > 0.0 ? Math.Min(1.0, (at - along[piece - 1]) / span) : 1.0);
            }
            return points;
        }

        private Vector3d[] SecondDerivatives()
        {
            var rows = Array.ConvertAll(_points, point => new[] { point.X, point.Y, point.Z });
            var at = new double[rows.Length];
            for (int k = 0; k < at.Length; k++)
            {
                at[k] = StationOf(k);
            }
            return Array.ConvertAll(new CubicSpline(at, rows).SecondDerivatives,
                row => new Vector3d(row[0], row[1], row[2]));
        }

        // With EI, EA and k such that lengths count in units.
        private void AddBending(double bending, double stretching, double foundation)
        {
            var points = new (double Point, double Weight)[GaussPoints];
            for (int g = 0; g < GaussPoints; g++)
            {
                points[g] = GaussLegendre.At(GaussPoints, g);
            }
            for (int piece = 0; piece < _points.Length - 1; piece++)
            {
                foreach ((double point, double part) in points)
                {
                    double weight = 0.5 * part * _piece;
                    double station = (piece + 0.5 * (1.0 + point)) * _piece;
                    Evaluate(station, out _, out Vector3d first, out Vector3d second);
                    Splines splines = SplinesAt(station);
                    double square = first.LengthSquared;
                    double speed = Math.Sqrt(square);
                    double slowing = 2.0 * Vector3d.Dot(first, second) / square;
                    // a' and c'.w'/|c'|^2 by the components of the splines.
                    var turn = new Vector3d[3 * Order];
                    var strain = new double[3 * Order];
                    for (int m = 0; m < 3 * Order; m++)
                    {
                        Vector3d e = m % 3 == 0 ? Vector3d.UnitX : m % 3 == 1 ? Vector3d.UnitY : Vector3d.UnitZ;
                        double slope = splines.Slope(m / 3);
                        Vector3d change = (slope / square) * Vector3d.Cross(second - slowing * first, e)
                            + (splines.Bend(m / 3) / square) * Vector3d.Cross(first, e);
                        turn[m] = change - (Vector3d.Dot(change, first) / square) * first;
                        strain[m] = slope / square * Vector3d.Dot(first, e);
                    }
                    for (int m = 0; m < 3 * Order; m++)
                    {
                        for (int l = 0; l < 3 * Order; l++)
                        {
                            Add(3 * splines.First + m, 3 * splines.First + l, weight * (bending / speed
                                * Vector3d.Dot(turn[m], turn[l]) + stretching * speed * strain[m] * strain[l]
                                + (m % 3 == l % 3 ? foundation * speed * splines.Value(m / 3) * splines.Value(l / 3)
                                : 0.0)));
                        }
                    }
                }
            }
        }

        private void AddHolds((bool Start, bool End) holds, double stiffness)
        {
            for (int end = 0; end < 2; end++)
            {
                Splines splines = SplinesAt(end * Length);
                for (int m = 0; m < Order && (end == 0 ? holds.Start : holds.End); m++)
                {
                    for (int l = 0; l < Order; l++)
                    {
                        double both = stiffness * (splines.Value(m) * splines.Value(l)
                            + Spacing * Spacing * splines.Slope(m) * splines.Slope(l));
                        for (int c = 0; c < 3; c++)
                        {
                            Add(3 * (splines.First + m) + c, 3 * (splines.First + l) + c, both);
                        }
                    }
                }
            }
        }

        private void Add(int row, int column, double value) => _stiffness[3 * Count * row + column] += value;

        /// <summary>The splines that are not 0 at a station: values, and derivatives by it.</summary>
        internal readonly struct Splines
        {
            private readonly (double, double, double, double) _value;
            private readonly (double, double, double, double) _slope;
            private readonly (double, double, double, double) _bend;

            public Splines(int first, in (double, double, double, double) value,
                in (double, double, double, double) slope, in (double, double, double, double) bend)
            {
                (First, _value, _slope, _bend) = (first, value, slope, bend);
            }

            /// <summary>The first of them.</summary>
            public int First { get; }

            public double Value(int j) => Of(_value, j);

            public double Slope(int j) => Of(_slope, j);

            public double Bend(int j) => Of(_bend, j);

            public Vector3d SumOf(Vector3d[] q) => Sum(_value, q);

            public Vector3d SlopeOf(Vector3d[] q) => Sum(_slope, q);

            public Vector3d BendOf(Vector3d[] q) => Sum(_bend, q);

            private Vector3d Sum(in (double A, double B, double C, double D) w, Vector3d[] q) =>
                w.A * q[First] + w.B * q[First + 1] + w.C * q[First + 2] + w.D * q[First + 3];

            private static double Of(in (double A, double B, double C, double D) w, int j) =>
                j == 0 ? w.A : j == 1 ? w.B : j == 2 ? w.C : w.D;
        }
    }

    /// <summary>How a point of the wall moves with the displacements of the splines: dx = sum (N_j A + N_j' B) dq_j.
    /// </summary>
    internal readonly struct BeamWeight
    {
        /// <summary>N_j and N_j'.</summary>
        public readonly WallBeam.Splines Splines;

        /// <summary>T: the section turns by T sum N_j' dq_j; 0 where a motion comes after it.</summary>
        public readonly Matrix3 Turn;

        /// <summary>v, from the centreline to the point.</summary>
        public readonly Vector3d Arm;

        private readonly Matrix3 _a;
        private readonly Matrix3 _b;

        public BeamWeight(in WallBeam.Splines splines, in Matrix3 a, in Matrix3 b, in Matrix3 turn = default,
            in Vector3d arm = default) => (Splines, _a, _b, Turn, Arm) = (splines, a, b, turn, arm);

        /// <summary>The derivative by spline First + j.</summary>
        public Matrix3 Of(int j) => Splines.Value(j) * _a + Splines.Slope(j) * _b;

        /// <summary>How far the point goes with these displacements of splines less others.</summary>
        public Vector3d Move(Vector3d[] q, Vector3d[] less)
        {
            Vector3d sum = Vector3d.Zero;
            for (int j = 0; j < WallBeam.Order; j++)
            {
                sum += Of(j) * (q[Splines.First + j] - less[Splines.First + j]);
            }
            return sum;
        }

        /// <summary>Gives the weight of a point that goes on by another motion of the wall.</summary>
        public BeamWeight After(in Matrix3 map) => new BeamWeight(Splines, map.Times(_a), map.Times(_b));
    }

    /// <summary>Where a <see cref="WallBeam"/> is: with w and a of its centreline at s, the point X = c + v of the
    /// section at s, c'.v = 0, is at x = c + w + R(a) v.</summary>
    /// <remarks>Both ways lead over the station s: c'.(X - c) = 0, or (R c').(x - c - w) = 0, by Newton's method from
    /// the nearest point. Beyond the ends all goes with the end's section. With m = |c'|^2 - c''.v and
    /// u = (c + w)' - R c' + (J(a) a') x R v, dx/dX = R + u c'^T/m.</remarks>
    internal sealed class BeamField
    {
        private const int Stride = WallBeam.PiecesPerSpline / 2;
        private const int MaxSteps = 60;
        private const double Rounding = 1e-15;       // of the centreline's length

        private readonly WallBeam _beam;
        private readonly Vector3d[] _q;              // units
        private readonly Vector3d[] _moved;          // points of the centreline

        public BeamField(WallBeam beam)
        {
            _beam = beam;
            _q = new Vector3d[beam.Count];
            _moved = new Vector3d[beam.PointCount];
            SetMoved();
        }

        /// <summary>The largest turn of a section, radians.</summary>
        public double LargestTurn
        {
            get
            {
                double largest = 0.0;
                for (int k = 0; k < _moved.Length; k++)
                {
                    largest = Math.Max(largest, SectionAt(_beam.StationOf(k)).TurnVector.Length);
                }
                return largest;
            }
        }

        /// <summary>Points of the centreline at rest, two from spline to spline, each with its displacement behind it,
        /// units.</summary>
        public Vector3d[] Centreline()
        {
            var points = new Vector3d[2 * ((_moved.Length - 1) / Stride + 1)];
            for (int k = 0; k < points.Length; k += 2)
            {
                int at = Stride * k / 2;
                (points[k], points[k + 1]) = (_beam.Point(at), _moved[at] - _beam.Point(at));
            }
            return points;
        }

        /// <summary>Takes displacements of the splines.</summary>
        /// <param name="units">Of one of these lengths.</param>
        /// <returns>Whether they are others.</returns>
        public bool Set(Vector3d[] q, double units)
        {
            bool isOther = false;
            for (int j = 0; j < _q.Length; j++)
            {
                Vector3d own = units * q[j];
                isOther |= own != _q[j];
                _q[j] = own;
            }
            if (isOther)
            {
                SetMoved();
            }
            return isOther;
        }

        /// <summary>Takes the displacements of another field's splines.</summary>
        public void Follow(BeamField other) => Set(other._q, 1.0);

        /// <summary>The place of the wall at rest that is at x, units, with its derivative, which is 0 where the wall
        /// is folded.</summary>
        public Vector3d AtRest(in Vector3d x, out Matrix3 gradient)
        {
            Section section = SectionAt(FindStation(x, true, out bool isBeyond));
            Vector3d v = x - section.Centre;
            Quaterniond inverse = section.Turn.Conjugate;
            Vector3d back = Quaterniond.Rotate(inverse, v);
            gradient = new Matrix3(Quaterniond.Rotate(inverse, Vector3d.UnitX),
                Quaterniond.Rotate(inverse, Vector3d.UnitY), Quaterniond.Rotate(inverse, Vector3d.UnitZ));
            if (!isBeyond)
            {
                Vector3d slide = gradient * section.SlideOf(v);
                double m = section.First.LengthSquared - Vector3d.Dot(section.Second, back);
                double slope = m + Vector3d.Dot(section.First, slide);
                gradient = m > 0.0 && slope > 0.0 ? gradient + Matrix3.Outer((-1.0 / slope) * slide,
                    Quaterniond.Rotate(section.Turn, section.First)) : default;
            }
            return section.Rest + back;
        }

        /// <summary>Where the place X of the wall at rest is, units.</summary>
        public Vector3d Moved(in Vector3d rest)
        {
            Section section = SectionAt(FindStation(rest, false, out _));
            return section.Centre + Quaterniond.Rotate(section.Turn, rest - section.Rest);
        }

        /// <summary>How what is at the place X of the wall at rest moves with the splines.</summary>
        public BeamWeight WeightAt(in Vector3d rest)
        {
            double station = FindStation(rest, false, out _);
            Section section = SectionAt(station);
            Vector3d arm = Quaterniond.Rotate(section.Turn, rest - section.Rest);
            var turn = new Matrix3(section.TurnBy(Vector3d.UnitX), section.TurnBy(Vector3d.UnitY),
                section.TurnBy(Vector3d.UnitZ));
            return new BeamWeight(_beam.SplinesAt(station), Matrix3.Identity, new Matrix3(
                Vector3d.Cross(turn.C1, arm), Vector3d.Cross(turn.C2, arm), Vector3d.Cross(turn.C3, arm)), turn, arm);
        }

        /// <summary>The turn of the section at x from rest.</summary>
        public Quaterniond TurnAt(in Vector3d x) => SectionAt(FindStation(x, true, out _)).Turn;

        private void SetMoved()
        {
            for (int k = 0; k < _moved.Length; k++)
            {
                _moved[k] = _beam.Point(k) + _beam.SplinesAt(_beam.StationOf(k)).SumOf(_q);
            }
        }

        // By Newton's method in a bracket that begins with the pieces beside the nearest point.
        private double FindStation(in Vector3d x, bool isMoved, out bool isBeyond)
        {
            int near = 0;
            double least = double.PositiveInfinity;
            int last = _moved.Length - 1;
            for (int k = 0; k <= last; k++)
            {
                double square = (x - (isMoved ? _moved[k] : _beam.Point(k))).LengthSquared;
                (near, least) = square < least ? (k, square) : (near, least);
            }
            int before = Math.Max(near - 1, 0);
            int behind = Math.Min(near + 1, last);
            while (Ahead(_beam.StationOf(before), x, isMoved, out _) <= 0.0 && before > 0)
            {
                before--;
            }
            while (Ahead(_beam.StationOf(behind), x, isMoved, out _) >= 0.0 && behind < last)
            {
                behind++;
            }
            double low = _beam.StationOf(before);
            double high = _beam.StationOf(behind);
            isBeyond = true;
            if (before == 0 && Ahead(low, x, isMoved, out _) <= 0.0)
            {
                return low;
            }
            if (behind == last && Ahead(high, x, isMoved, out _) >= 0.0)
            {
                return high;
            }
            isBeyond = false;
            double station = Math.Min(Math.Max(_beam.StationOf(near), low), high);
            double moved = double.PositiveInfinity;
            for (int step = 0; step < MaxSteps; step++)
            {
                double ahead = Ahead(station, x, isMoved, out double slope);
                (low, high) = ahead > 0.0 ? (station, high) : (low, station);
                double next = station - ahead / slope;
                next = next >= low && next <= high ? next : 0.5 * (low + high);
                double move = Math.Abs(next - station);
                station = next;
                if (move <= Rounding * _beam.Length || (move >= moved && move <= 1e3 * Rounding * _beam.Length))
                {
                    break;
                }
                moved = move;
            }
            return station;
        }

        // How far x is ahead of the section at a station, times |c'|, and the derivative by the station.
        private double Ahead(double station, in Vector3d x, bool isMoved, out double slope)
        {
            if (!isMoved)
            {
                _beam.Evaluate(station, out Vector3d c, out Vector3d first, out Vector3d second);
                slope = Vector3d.Dot(second, x - c) - first.LengthSquared;
                return Vector3d.Dot(first, x - c);
            }
            Section section = SectionAt(station);
            Vector3d v = x - section.Centre;
            Vector3d normal = Quaterniond.Rotate(section.Turn, section.First);
            slope = Vector3d.Dot(Quaterniond.Rotate(section.Turn, section.Second)
                + Vector3d.Cross(section.TurnRate, normal), v) - Vector3d.Dot(normal, section.Slope);
            return Vector3d.Dot(normal, v);
        }

        private Section SectionAt(double station)
        {
            _beam.Evaluate(station, out Vector3d c, out Vector3d first, out Vector3d second);
            WallBeam.Splines splines = _beam.SplinesAt(station);
            Vector3d slope = splines.SlopeOf(_q);
            double square = first.LengthSquared;
            Vector3d angles = (1.0 / square) * Vector3d.Cross(first, slope);
            Vector3d rate = (1.0 / square) * (Vector3d.Cross(second, slope)
                + Vector3d.Cross(first, splines.BendOf(_q))) - (2.0 * Vector3d.Dot(first, second) / square) * angles;
            return new Section
            {
                Rest = c, First = first, Second = second, Centre = c + splines.SumOf(_q), Slope = first + slope,
                TurnVector = angles, Turn = RotationVector.Exp(angles),
                TurnRate = RotationVector.TangentMap(-angles, rate),
            };
        }

        private struct Section
        {
            public Vector3d Rest;        // c
            public Vector3d First;       // c'
            public Vector3d Second;      // c''
            public Vector3d Centre;      // c + w
            public Vector3d Slope;       // (c + w)'
            public Vector3d TurnVector;      // a
            public Quaterniond Turn;     // R
            public Vector3d TurnRate;    // J a'

            // u at x = c + w + v.
            public readonly Vector3d SlideOf(in Vector3d v) =>
                Slope - Quaterniond.Rotate(Turn, First) + Vector3d.Cross(TurnRate, v);

            // How it turns with w'.
            public readonly Vector3d TurnBy(in Vector3d slope) =>
                RotationVector.TangentMap(-TurnVector, (1.0 / First.LengthSquared) * Vector3d.Cross(First, slope));
        }
    }
}
