using System;

namespace Guidewire.Core
{
    /// <summary>What is prescribed over time for one wire: its loads, the motion of its hub and that of a held distal
    /// end.</summary>
    internal sealed class RodSchedule
    {
        private readonly HubMotion[] _inner;

        /// <summary>Makes a schedule of these.</summary>
        /// <param name="inner">The hubs of instruments inside; null without one.</param>
        public RodSchedule(PrescribedLoads loads, HubMotion hub, DistalMotion distal, HubMotion[]? inner = null)
        {
            _inner = inner ?? Array.Empty<HubMotion>();
            Loads = loads;
            Hub = hub;
            Distal = distal;
        }

        /// <summary>The prescribed loads.</summary>
        public PrescribedLoads Loads { get; }

        /// <summary>The motion of the proximal end.</summary>
        public HubMotion Hub { get; }

        /// <summary>The motion of the distal end, where it is held.</summary>
        public DistalMotion Distal { get; }

        /// <summary>Gives the force on the last node at this time, N.</summary>
        public Vector3d DistalForceAt(double time) => Loads.DistalForceAt(time, Distal.Frame.Director3);

        /// <summary>The first time after this one, s, at which a load or the velocity of a support jumps: the tip force
        /// is released, a table of a load has two rows of one time, the distal end comes to rest. Infinite where none
        /// does.</summary>
        public double NextJump(double time)
        {
            double next = Math.Min(Loads.NextJump(time), Distal.NextJump(time));
            return Hub.Motion == null ? next : Math.Min(next, Hub.Motion.NextRow(time));
        }

        /// <summary>The first time after this one, s, at which something prescribed is not smooth: a jump, or a row of
        /// a load's table. Infinite where there is none.</summary>
        public double NextBreak(double time) => Math.Min(NextJump(time), Loads.NextRow(time));

        /// <summary>How far the hubs of instruments inside move at most in a time, s, in m; 0 without one.</summary>
        public double InnerMove(double duration)
        {
            double largest = 0.0;
            foreach (HubMotion inner in _inner)
            {
                largest = Math.Max(largest, duration * inner.Velocity.Length);
            }
            return largest;
        }

        /// <summary>Whether all that is prescribed stays as it is from this time to an end, s.</summary>
        public bool IsOver(double time, double end)
        {
            return Distal.IsOver(time) && Loads.AreOver(time, end) && Hub.IsOver(time)
                && IsInnerOver(time);
        }

        private bool IsInnerOver(double time)
        {
            foreach (HubMotion inner in _inner)
            {
                if (!inner.IsOver(time))
                {
                    return false;
                }
            }
            return true;
        }

        /// <summary>The largest rotation between the two frames in the interval from a time to an end, s, relative to
        /// that at its start; 1 if that is zero.</summary>
        public double TurnAhead(double time, double end)
        {
            double now = Math.Abs(Distal.TurnAt(time) - Hub.TurnAt(time));
            double largest = Math.Max(now, Math.Abs(Distal.TurnAt(end) - Hub.TurnAt(end)));
            double rest = Distal.RampTime;
            if (time < rest && rest < end)
            {
                largest = Math.Max(largest, Math.Abs(Distal.TurnAt(rest) - Hub.TurnAt(rest)));
            }
            return now > 0.0 ? largest / now : 1.0;
        }

        /// <summary>Whether an end moves in six degrees of freedom.</summary>
        public bool HasMotions => Hub.Motion != null || Distal.Motion != null;

        /// <summary>The larger angle between a frame at one time and at another by the motions of the ends,
        /// radians.</summary>
        public double AngleBetween(double from, double to)
        {
            return Math.Max(Hub.Motion == null ? 0.0 : Hub.Motion.AngleBetween(from, to),
                Distal.Motion == null ? 0.0 : Distal.Motion.AngleBetween(from, to));
        }

        /// <summary>Sets both frames of a shape, turned by these angles about their own axes and by the motions of the
        /// ends up to a time, s.</summary>
        public void TurnFrames(RodShape shape, double proximal, double distal, double time)
        {
            shape.ProximalFrame = Moved(Hub.FrameTurned(proximal), Hub.Motion, time);
            shape.DistalFrame = Moved(Distal.FrameTurned(distal), Distal.Motion, time);
        }

        /// <summary>Spin of the proximal frame along its own axes at this time, rad/s.</summary>
        public Vector3d ProximalSpinAt(double time) =>
            SpinOf(Hub.Motion, Hub.FrameTurned(Hub.FrameTurnAt(time)), Hub.FrameTwistRate, time);

        /// <summary>Gives the same for the distal frame.</summary>
        public Vector3d DistalSpinAt(double time) =>
            SpinOf(Distal.Motion, Distal.FrameAt(time), Distal.TwistRateAt(time), time);

        private static Quaterniond Moved(in Quaterniond frame, EndMotion? motion, double time) =>
            motion == null ? frame : motion.RotationAt(time) * frame;

        private static Vector3d SpinOf(EndMotion? motion, in Quaterniond frame, double twistRate, double time)
        {
            var spin = new Vector3d(0.0, 0.0, twistRate);
            return motion == null ? spin : spin + Quaterniond.Rotate(Moved(frame, motion, time).Conjugate,
                motion.AngularVelocityAt(time));
        }

        /// <summary>Writes into a snapshot, or restores from one, where the prescribed motions began and how far they
        /// have come at this time. Loads, ramps and rates stay this schedule's own.</summary>
        public void Serialize(Snapshot snapshot, double time)
        {
            Hub.Serialize(snapshot, time);
            Distal.Serialize(snapshot);
        }
    }
}
