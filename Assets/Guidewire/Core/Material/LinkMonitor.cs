using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Detects a wire between two clamps that has lost whole turns of twist by passing through
    /// itself.</summary>
    /// <remarks>Without selfContact the wire does not meet itself. Wound up beyond the couple at which it stays
    /// straight (2 sqrt(EI T) under a tension T) it bends into a loop. A loop that passes through the wire, or over an
    /// end, takes two turns along (Calugareanu: twist and writhe change by 2 together), and what is left may well be in
    /// balance.
    /// No wire does that. What a wire keeps is its link, twist and writhe, with both ends extended along their
    /// clamps: it changes by the turns of the clamps alone, wherever the twist is from. Seen along one direction v the
    /// link is the sum of the signed crossings and of the turns against the normal v x t of the picture. From tangent
    /// a to tangent b on the great circle that normal turns, against what is carried along without twist, by
    /// atan2(D, 1 - v.a - v.b + a.b) - atan2(D, 1 + v.a + v.b + a.b), D = v . (a x b): half the difference of the
    /// areas to the south pole -v and to the north pole v. Neither depends on v in sum. Where an end moves in six
    /// degrees of freedom, its extension sweeps across the wire, and nothing is said.</remarks>
    internal sealed class LinkMonitor
    {
        private readonly RodSchedule _schedule;
        private readonly bool _isOn;
        private Vector3d _along;             // the picture's axes: v, and two across
        private Vector3d _right;
        private Vector3d _up;
        private readonly Vector3d[] _tangent;    // of the extension, the elements, the other extension
        private readonly Vector3d[] _picture;    // nodes, seen along v
        private double _start;               // link less the turns of the clamps, radians

        /// <summary>A monitor of a wire at its start, whose clamps have not turned yet.</summary>
        public LinkMonitor(RodSupports supports, RodSchedule schedule, RodShape start)
        {
            _schedule = schedule;
            _isOn = !schedule.HasMotions && supports.HasProximalJoint && supports.HasDistalJoint;
            _tangent = new Vector3d[_isOn ? start.X.Length + 1 : 0];
            _picture = new Vector3d[_isOn ? start.X.Length : 0];
            Begin(start, 0.0);
        }

        /// <summary>The wire has all its turns in this shape.</summary>
        /// <param name="turn">Of the distal clamp against the proximal one, radians.</param>
        public void Begin(RodShape shape, double turn)
        {
            if (!_isOn)
            {
                return;
            }
            // Oblique, so that no wire in a plane of the scene is seen edge on.
            Quaterniond frame = shape.ProximalFrame;
            _along = Quaterniond.Rotate(frame, new Vector3d(0.6, 0.8, 0.1));
            _along = (1.0 / _along.Length) * _along;
            Vector3d axis = frame.Director3;
            _right = axis - Vector3d.Dot(axis, _along) * _along;
            _right = (1.0 / _right.Length) * _right;
            _up = Vector3d.Cross(_along, _right);
            _start = Measure(shape) - turn;
        }

        /// <summary>How many turns the wire has lost, and why, in one line; or null.</summary>
        /// <param name="turn">Of the distal clamp against the proximal one, radians.</param>
        public string? FindLost(RodShape shape, double turn)
        {
            double lost = _isOn ? Math.Round((turn + _start - Measure(shape)) / (2.0 * Math.PI)) : 0.0;
            if (!(Math.Abs(lost) >= 1.0))
            {
                return null;
            }
            return string.Format(CultureInfo.InvariantCulture,
                "of {0:G4} turns between its clamps the wire has lost {1}: it has formed loops and passed through "
                + "itself. selfContact keeps strands apart. Fewer turns (distalRotation, twistPerStep, those of a "
                + "start) or a pull (axialForce, distalDisplacement) keep it straight",
                Math.Abs(turn + _start) / (2.0 * Math.PI), Math.Abs(lost));
        }

        /// <summary>The link with both ends extended, times 2 pi.</summary>
        internal double Measure(RodShape shape)
        {
            int n = shape.ElementCount;
            Quaterniond before = shape.ProximalFrame;
            _tangent[0] = before.Director3;
            double link = 0.0;
            for (int j = 0; j <= n; j++)
            {
                Quaterniond frame = shape.DistalFrame;
                _tangent[j + 1] = frame.Director3;
                if (j < n)
                {
                    Vector3d chord = shape.X[j + 1] - shape.X[j];
                    _tangent[j + 1] = (1.0 / chord.Length) * chord;
                    frame = Swing(shape.Q[j].Director3, _tangent[j + 1]) * shape.Q[j];
                }
                Quaterniond turn = before.Conjugate * frame;
                link += Math.IEEERemainder(2.0 * Math.Atan2(turn.Z, turn.W), 2.0 * Math.PI)
                    - NormalTurn(_tangent[j], _tangent[j + 1]);
                before = frame;
            }
            return link + 2.0 * Math.PI * Crossings(shape);
        }

        // The rotation by the shortest way from a unit vector to another.
        private static Quaterniond Swing(in Vector3d from, in Vector3d to)
        {
            Vector3d axis = Vector3d.Cross(from, to);
            double real = 1.0 + Vector3d.Dot(from, to);
            double scale = 1.0 / Math.Sqrt(axis.LengthSquared + real * real);
            return new Quaterniond(scale * axis.X, scale * axis.Y, scale * axis.Z, scale * real);
        }

        private double NormalTurn(in Vector3d a, in Vector3d b)
        {
            double area = Vector3d.Dot(_along, Vector3d.Cross(a, b));
            double sum = Vector3d.Dot(_along, a) + Vector3d.Dot(_along, b);
            double dot = 1.0 + Vector3d.Dot(a, b);
            return Math.Atan2(area, dot - sum) - Math.Atan2(area, dot + sum);
        }

        // Signed, as v sees the wire with its extensions; none where all of it goes to the right.
        private int Crossings(RodShape shape)
        {
            int n = shape.ElementCount;
            bool isForward = true;
            for (int j = 0; j <= n + 1; j++)
            {
                isForward &= Vector3d.Dot(_tangent[j], _right) > 0.0;
            }
            if (isForward)
            {
                return 0;
            }
            double longest = 0.0;
            for (int i = 0; i <= n; i++)
            {
                Vector3d x = shape.X[i];
                _picture[i] = new Vector3d(Vector3d.Dot(x, _right), Vector3d.Dot(x, _up), 0.0);
                longest = i == 0 ? 0.0 : Math.Max(longest, Vector3d.Distance(_picture[i - 1], _picture[i]));
            }
            int sum = Crossing(shape, -1, n);
            for (int i = 0; i < n; i++)
            {
                sum += i > 0 ? Crossing(shape, -1, i) : 0;
                sum += i < n - 1 ? Crossing(shape, i, n) : 0;
                for (int j = Next(n, i, i + 2, longest); j < n; j = Next(n, i, j + 1, longest))
                {
                    sum += Crossing(shape, i, j);
                }
            }
            return sum;
        }

        // The next element, from one on, whose middle in the picture is no farther than the longest element from that
        // of another one; n where there is none. From one element to the next the middle goes no farther than that:
        // what is far away stays so for a number of elements that need not be looked at.
        private int Next(int n, int element, int from, double longest)
        {
            Vector3d middle = 0.5 * (_picture[element] + _picture[element + 1]);
            int j = from;
            while (j < n)
            {
                double apart = Vector3d.Distance(middle, 0.5 * (_picture[j] + _picture[j + 1])) - longest;
                if (apart <= 0.0)
                {
                    return j;
                }
                j += Math.Max(1, (int)Math.Min(n, apart / longest));
            }
            return n;
        }

        // Of two elements, where -1 is the proximal extension and n the distal one.
        private int Crossing(RodShape shape, int i, int j)
        {
            (Vector3d a, Vector3d u, double aEnd) = Line(shape, i);
            (Vector3d b, Vector3d w, double bEnd) = Line(shape, j);
            Vector3d between = b - a;
            double across = Vector3d.Dot(_along, Vector3d.Cross(u, w));
            double s = Vector3d.Dot(_along, Vector3d.Cross(between, w)) / across;
            double t = Vector3d.Dot(_along, Vector3d.Cross(between, u)) / across;
            if (!(s >= 0.0 && s < aEnd && t >= 0.0 && t < bEnd))
            {
                return 0;
            }
            // The proximal extension is followed towards the wire, against its line.
            double above = Vector3d.Dot(_along, a + s * u - b - t * w) * across * (i < 0 ? -1.0 : 1.0);
            return Math.Sign(above);
        }

        private (Vector3d Start, Vector3d Direction, double End) Line(RodShape shape, int j)
        {
            int n = shape.ElementCount;
            return j < 0 ? (shape.X[0], -_tangent[0], double.PositiveInfinity)
                : j == n ? (shape.X[n], _tangent[n + 1], double.PositiveInfinity)
                : (shape.X[j], shape.X[j + 1] - shape.X[j], 1.0);
        }
    }
}
