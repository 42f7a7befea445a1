using System;
using System.Globalization;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
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

        /// <summary>The same of a joint that is turned by more than half a turn: a wire that turned as it should would
        /// have been found before.</summary>
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
