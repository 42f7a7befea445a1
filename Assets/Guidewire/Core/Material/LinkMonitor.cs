using System;
using System.Globalization;
using System.Runtime.CompilerServices;

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

    /// <summary>Detects a joint that is rotated so far that the wire is about to lose a turn, or has lost
    /// one.</summary>
    /// <remarks>A joint's couple follows from its orientation alone, which is the same after a turn by a as after one
    /// by a - 2 pi: beyond half a turn it pulls in the opposite sense, and 2 pi of twist are lost. Already before, at
    /// an angle a, a joint has (a/2) cot(a/2) of its stiffness left against turns about its other axes; at 0.98 pi,
    /// the limit here, that is 5 %.
    ///
    /// No turn is missed, however far a step goes: elements turn by q := q exp(turn), which follows the double cover of
    /// the rotations, so that Re(q_a* q_b) = cos(a/2) is below 0 beyond half a turn and stays so when the joint has
    /// unwound in the other direction. One check a step suffices. The joint between what is in a sheath and its hub
    /// counts whole turns (<see cref="JointWinding"/>) and has no such limit.</remarks>
    internal sealed class JointMonitor
    {
        private const double Limit = 0.98 * Math.PI;
        private const double Even = 1e-9;   // by which elements of one length may differ
        private const double FractionOfLimit = 0.9;   // of the limit, for the number of elements that is proposed

        private readonly Joint[] _joints;
        private readonly RodSupports _supports;
        private readonly RodSchedule _schedule;
        private readonly MaterialRod _rod;
        private readonly LinkMonitor _link;
        private readonly double _end;       // of the run, s
        private readonly double _least = Math.Cos(0.5 * Limit);

        /// <summary>Makes a monitor of the joints of this scene's rod.</summary>
        /// <param name="end">When the run ends at the latest, s: up to then turns go on that are prescribed.</param>
        public JointMonitor(MaterialScene scene, double end)
        {
            _joints = scene.Rod.Joints(scene.Supports);
            _rod = scene.Rod;
            _supports = scene.Supports;
            _schedule = scene.Schedule;
            _link = new LinkMonitor(scene.Supports, scene.Schedule, scene.Shape);
            _end = end;
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh() => _rod.SetJoints(_supports, _joints);

        /// <summary>The wire has all its turns in this shape at this time, s.</summary>
        public void Begin(RodShape shape, double time) => _link.Begin(shape, TurnAt(time));

        /// <summary>What the wire has lost of its twist in this shape, or is about to, in one line; or null.</summary>
        /// <param name="time">s; the clamps have turned as they should by then.</param>
        /// <param name="done">How much of what the ends are asked to do at this time they have done, above 0 to
        /// 1.</param>
        public string? FindLost(RodShape shape, double time, double done = 1.0)
        {
            return FindTurned(shape, time, done)
                ?? _link.FindLost(shape, done * TurnAt(time));
        }

        private double TurnAt(double time) => _schedule.Distal.TurnAt(time) - _schedule.Hub.TurnAt(time);

        /// <summary>The joint that is turned too far in this shape, its angle and what would help, in one line; or
        /// null.</summary>
        /// <param name="time">s.</param>
        /// <param name="done">How much of what the ends are asked to do at this time they have done, above 0 to
        /// 1.</param>
        public string? FindTurned(RodShape shape, double time, double done = 1.0) =>
            FindTurned(shape, time, done, _least);

        /// <summary>The joint that is turned by more than half a turn, its angle and what would help, in one line; or
        /// null. A wire that turned as it should would have been found before.</summary>
        public string? FindPassed(RodShape shape, double time) => FindTurned(shape, time, 1.0, 0.0);

        // That whose cos(a/2) is the least, below a limit.
        private string? FindTurned(RodShape shape, double time, double done, double limit)
        {
            Quaterniond[] q = shape.Q;
            int n = shape.ElementCount;
            double least = 1.0;
            int worst = 0;
            for (int k = 1; k < n; k++)
            {
                double cosine = Cosine(Before(shape, k), q[k]);
                if (cosine < least)
                {
                    least = cosine;
                    worst = k;
                }
            }
            double clamp = _supports.HasProximalJoint && !_supports.Winds && _supports.SheathEnd == null
                ? Cosine(shape.ProximalFrame, q[0]) : 1.0;
            if (clamp < least)
            {
                least = clamp;
                worst = 0;
            }
            clamp = _supports.HasDistalJoint ? Cosine(q[n - 1], shape.DistalFrame) : 1.0;
            if (clamp < least)
            {
                least = clamp;
                worst = n;
            }
            if (!(least < limit))
            {
                return null;
            }
            double angle = 2.0 * Math.Acos(Math.Max(-1.0, least));
            double ahead = _supports.HasProximalJoint && _supports.HasDistalJoint
                ? _schedule.TurnAhead(time, _end) / done : 1.0;
            return string.Format(CultureInfo.InvariantCulture,
                "joint {0} is turned by {1:G4} rad{2}; beyond {3:G3} rad the sense of its rotation is ambiguous, and "
                    + "the wire would lose a turn; {4}", worst, angle, PositionOf(worst), Limit,
                IsAlone(shape, worst, angle) ? "the neighbouring joints are turned by less than half of that: "
                    + "shorter elements distribute the rotation only if they are shorter than what bends there, such "
                    + "as a soft section, which may have a numberRodElements of its own"
                : Advice(Math.Max(1.0, ahead) * angle));
        }

        /// <summary>The joint whose rest curvature turns it too far, and what would help, in one line; or
        /// null.</summary>
        public string? FindTurnedAtRest()
        {
            double most = 0.0;
            int worst = 0;
            int n = _rod.ElementCount;
            for (int k = 0; k <= n; k++)
            {
                bool counts = k == 0 ? _supports.HasProximalJoint
                    : k < n || _supports.HasDistalJoint;
                if (counts && _joints[k].Rest.Length > most)
                {
                    most = _joints[k].Rest.Length;
                    worst = k;
                }
            }
            // K sin(angle) measures a turn by 2 sin(angle/2).
            double limit = _supports.Bend == BendLaw.Darboux ? 2.0 * Math.Sin(0.5 * Limit) : Limit;
            if (most <= limit)
            {
                return null;
            }
            return string.Format(CultureInfo.InvariantCulture,
                "restCurvature turns joint {0} by {1:G4} rad at rest, with elements of l = {2:G4} m; beyond {3:G3} "
                    + "rad the sense of its rotation is ambiguous; {4}", worst, most,
                _rod.Length[Math.Min(worst, _rod.ElementCount - 1)], limit, Advice(most));
        }

        // A joint's turn goes with the length of its elements, as long as its neighbours turn like it; a section with a
        // number of elements of its own does not follow that of the wire.
        private string Advice(double angle)
        {
            double shortest = double.PositiveInfinity;
            double longest = 0.0;
            for (int j = 0; j < _rod.ElementCount; j++)
            {
                shortest = Math.Min(shortest, _rod.Length[j]);
                longest = Math.Max(longest, _rod.Length[j]);
            }
            return string.Format(CultureInfo.InvariantCulture, longest > (1.0 + Even) * shortest
                ? "elements there of {1:G3} of their length would suffice (numberRodElements, or that of the "
                    + "section)"
                : "numberRodElements = {0} would do",
                Math.Ceiling(_rod.ElementCount * angle / (FractionOfLimit * Limit)), FractionOfLimit * Limit / angle);
        }

        // Whether a joint's neighbours, if it has any, are turned by less than half of its angle: then what bends is no
        // longer than an element, and its turn does not go with the elements' length.
        private static bool IsAlone(RodShape shape, int joint, double angle)
        {
            double most = -1.0;
            for (int k = Math.Max(1, joint - 1); k <= Math.Min(shape.ElementCount - 1, joint + 1); k++)
            {
                double cosine = k == joint ? 1.0 : Cosine(shape.Q[k - 1], shape.Q[k]);
                most = k == joint ? most : Math.Max(most, 2.0 * Math.Acos(Math.Max(-1.0, Math.Min(1.0, cosine))));
            }
            return most >= 0.0 && most < 0.5 * angle;
        }

        private string PositionOf(int joint)
        {
            return joint == 0 ? " against the proximal clamp"
                : joint == _rod.ElementCount ? " against the distal clamp" : "";
        }

        // The frame from which joint k turns: at the tip of an outer instrument that of the one that goes on.
        private Quaterniond Before(RodShape shape, int k)
        {
            return _supports.Coaxial != null && _supports.Coaxial.Joints.IsTip(k)
                ? CoaxialShape.FrameOf(shape, _supports.Coaxial.Joints, k - 1, _supports.Coaxial.Joints.CarrierOf(k))
                : shape.Q[k - 1];
        }

        // cos(a/2) of the turn from a to b.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static double Cosine(in Quaterniond a, in Quaterniond b) =>
            a.X * b.X + a.Y * b.Y + a.Z * b.Z + a.W * b.W;
    }
}
