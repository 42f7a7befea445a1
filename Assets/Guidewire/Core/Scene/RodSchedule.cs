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

    /// <summary>The loads on a wire over time: weight, forces on its ends and force per length. They are functions of
    /// time only, so several motions may share them.</summary>
    internal sealed class PrescribedLoads
    {
        private readonly Vector3d _gravity;           // m/s^2
        private readonly Vector3d _tipForce;          // N
        private readonly Vector3d _distributedForce;  // N/m
        private readonly PointLoad[] _pointLoads;     // at lengths in m
        private readonly double _axialForce;          // N
        private readonly double _releaseTime;         // s
        private readonly double _wireLength;          // m
        private readonly TimeTable? _gravityTable;    // factors over time
        private readonly TimeTable? _tipForceTable;
        private readonly TimeTable? _distributedForceTable;
        private readonly TimeTable? _pointLoadsTable;
        private readonly TimeTable? _axialForceTable;
        private readonly TimeTable[] _tables;         // of all loads, of those that turn with the tip among them

        /// <summary>Makes the loads of a scene.</summary>
        /// <param name="unitLength">Length of one unit, m.</param>
        /// <param name="proximalForce">Force on node 0 where it is free, N.</param>
        public PrescribedLoads(SceneParameters scene, double unitLength, in Vector3d proximalForce)
        {
            _gravity = scene.Gravity;
            _tipForce = scene.TipForce;
            _distributedForce = scene.DistributedForce;
            _pointLoads = Array.ConvertAll(scene.PointLoads,
                load => new PointLoad(unitLength * load.At, load.Force));
            _axialForce = scene.DistalEnd == DistalEnd.Sliding ? scene.AxialForce : 0.0;
            _releaseTime = scene.TipForceReleaseTime;
            _wireLength = unitLength * scene.GuidewireLength;
            _gravityTable = scene.GravityTable;
            _tipForceTable = scene.TipForceTable;
            _distributedForceTable = scene.DistributedForceTable;
            _pointLoadsTable = scene.PointLoadsTable;
            _axialForceTable = scene.AxialForceTable;
            _tables = scene.UsedLoadTables();
            ProximalForce = proximalForce;
        }

        /// <summary>Gravity without its factor, m/s^2.</summary>
        public Vector3d Gravity => _gravity;

        /// <summary>Force on node 0 where it is free, N.</summary>
        public Vector3d ProximalForce { get; }

        /// <summary>Whether there is a force per length.</summary>
        public bool HasDistributedForce => _distributedForce != Vector3d.Zero;

        /// <summary>Gives the acceleration of gravity at this time, m/s^2.</summary>
        public Vector3d GravityAt(double time) => Factor(_gravityTable, time) * _gravity;

        /// <summary>Gives the force on the last node at this time, N.</summary>
        /// <param name="axis">Direction of a pull on a sliding distal end, a unit vector.</param>
        public Vector3d DistalForceAt(double time, in Vector3d axis)
        {
            Vector3d axial = (Factor(_axialForceTable, time) * _axialForce) * axis;
            Vector3d tip = Factor(_tipForceTable, time) * _tipForce;
            return time <= _releaseTime ? tip + axial : axial;
        }

        /// <summary>Gives the force per length at rest at this time, N/m.</summary>
        public Vector3d DistributedForceAt(double time) => Factor(_distributedForceTable, time) * _distributedForce;

        /// <summary>Point loads on the wire, at arc lengths in m, without their factor.</summary>
        public PointLoad[] PointLoads => _pointLoads;

        /// <summary>Gives the factor on them at this time.</summary>
        public double PointLoadsFactor(double time) => Factor(_pointLoadsTable, time);

        /// <summary>Sum of the loads' magnitudes at this time, N, on a rod of this mass, kg.</summary>
        public double SumAt(double time, double mass)
        {
            double tip = time <= _releaseTime ? _tipForce.Length : 0.0;
            double points = 0.0;
            foreach (PointLoad load in _pointLoads)
            {
                points += load.Force.Length;
            }
            points *= Math.Abs(Factor(_pointLoadsTable, time));
            return Math.Abs(Factor(_gravityTable, time)) * mass * _gravity.Length + ProximalForce.Length
                + Math.Abs(Factor(_axialForceTable, time) * _axialForce) + Math.Abs(Factor(_tipForceTable, time)) * tip
                + Math.Abs(Factor(_distributedForceTable, time)) * _wireLength * _distributedForce.Length
                + points;
        }

        /// <summary>The first time after this one, s, at which a load jumps: the tip force is released, or a table has
        /// two rows of one time. Infinite where none does.</summary>
        public double NextJump(double time)
        {
            double next = _releaseTime > time && _tipForce != Vector3d.Zero ? _releaseTime : double.PositiveInfinity;
            foreach (TimeTable table in _tables)
            {
                next = Math.Min(next, table.NextJump(time));
            }
            return next;
        }

        /// <summary>The first time after this one, s, of a row of a table. Infinite where there is none.</summary>
        public double NextRow(double time)
        {
            double next = double.PositiveInfinity;
            foreach (TimeTable table in _tables)
            {
                next = Math.Min(next, table.NextRow(time));
            }
            return next;
        }

        /// <summary>Whether all loads stay as they are from this time to an end, s.</summary>
        public bool AreOver(double time, double end)
        {
            bool isReleased = time <= _releaseTime && _releaseTime < end && _tipForce != Vector3d.Zero;
            return !isReleased && !Changes(_gravityTable, time) && !Changes(_tipForceTable, time)
                && !Changes(_distributedForceTable, time) && !Changes(_pointLoadsTable, time)
                && !Changes(_axialForceTable, time);
        }

        private static double Factor(TimeTable? table, double time) => table == null ? 1.0 : table.At(time);

        private static bool Changes(TimeTable? table, double time) => table != null && table.ChangesFrom(time);
    }
}
