using System;

namespace Guidewire.Core
{
    /// <summary>What is prescribed in time: loads, and the motion of held ends.</summary>
    internal sealed class RodSchedule
    {
        private double _twistOrigin;      // turn of the proximal frame at _twistOriginTime, radians
        private double _twistOriginTime;  // s

        /// <summary>m/s^2.</summary>
        public Vector3d Gravity { get; set; }

        /// <summary>Force on the last node, N, until <see cref="TipForceReleaseTime"/>.</summary>
        public Vector3d TipForce { get; set; }

        /// <summary>Force per length at rest, N/m.</summary>
        public Vector3d DistributedForce { get; set; }

        /// <summary>The wire's length at rest, m.</summary>
        public double WireLength { get; set; }

        /// <summary>Factor on gravity over time, or null.</summary>
        public TimeTable? GravityTable { get; set; }

        /// <summary>Factor on the tip force over time, or null.</summary>
        public TimeTable? TipForceTable { get; set; }

        /// <summary>Factor on the force per length over time, or null.</summary>
        public TimeTable? DistributedForceTable { get; set; }

        /// <summary>Factor on the axial force over time, or null.</summary>
        public TimeTable? AxialForceTable { get; set; }

        /// <summary>The tables of all loads that there are, of those that turn with the tip among them.</summary>
        public TimeTable[] LoadTables { get; set; } = Array.Empty<TimeTable>();

        /// <summary>s; the force acts at times up to and including this one.</summary>
        public double TipForceReleaseTime { get; set; } = double.PositiveInfinity;

        /// <summary>Force on a sliding distal end along the axis of its frame, N; a pull is positive.</summary>
        public double AxialForce { get; set; }

        /// <summary>Force on node 0 where it is free, N.</summary>
        public Vector3d ProximalForce { get; set; }

        /// <summary>Position of node 0 at <see cref="ProximalTime"/>, m.</summary>
        public Vector3d ProximalPosition { get; set; }

        /// <summary>Its velocity, m/s.</summary>
        public Vector3d ProximalVelocity { get; set; }

        /// <summary>The time, s, at which node 0 is at that position.</summary>
        public double ProximalTime { get; set; }

        /// <summary>The proximal clamp's frame at time 0.</summary>
        public Quaterniond ProximalFrame { get; set; } = Quaterniond.Identity;

        /// <summary>Its turning about its own d3, rad/s.</summary>
        public double ProximalTwistRate { get; set; }

        /// <summary>From when on nothing but constant speeds moves the proximal end, s: infinite under a
        /// hand.</summary>
        public double DriveEnd { get; set; } = double.NegativeInfinity;

        /// <summary>Where the proximal frame is held while the hub turns, radians: of a wire in a sheath, whose
        /// sheathed part is a spring between hub and frame. Null: the frame is the hub.</summary>
        public double? HeldFrameTurn { get; set; }

        /// <summary>Position of the last node before its displacement, m.</summary>
        public Vector3d DistalPosition { get; set; }

        /// <summary>The distal clamp's frame before it turns.</summary>
        public Quaterniond DistalFrame { get; set; } = Quaterniond.Identity;

        /// <summary>How far the last node is displaced along the frame's d3 in the end, m.</summary>
        public double DistalDisplacement { get; set; }

        /// <summary>How far the distal frame turns about its own d3 in the end, radians; more than one turn counts.
        /// </summary>
        public double DistalRotation { get; set; }

        /// <summary>Time over which displacement and rotation of the distal end grow evenly, s; 0: at once.</summary>
        public double DistalRampTime { get; set; }

        /// <summary>Acceleration of gravity at this time, m/s^2.</summary>
        public Vector3d GravityAt(double time)
        {
            return Factor(GravityTable, time) * Gravity;
        }

        /// <summary>Force on the last node at this time, N.</summary>
        public Vector3d DistalForceAt(double time)
        {
            Vector3d axial = (Factor(AxialForceTable, time) * AxialForce) * DistalFrame.Director3;
            Vector3d tip = Factor(TipForceTable, time) * TipForce;
            return time <= TipForceReleaseTime ? tip + axial : axial;
        }

        /// <summary>Force per length at this time, N/m.</summary>
        public Vector3d DistributedForceAt(double time)
        {
            return Factor(DistributedForceTable, time) * DistributedForce;
        }

        /// <summary>Sum of the loads' magnitudes at this time, N, on a rod of this mass, kg.</summary>
        public double LoadAt(double time, double mass)
        {
            double tip = time <= TipForceReleaseTime ? TipForce.Length : 0.0;
            return Math.Abs(Factor(GravityTable, time)) * mass * Gravity.Length + ProximalForce.Length
                + Math.Abs(Factor(AxialForceTable, time) * AxialForce) + Math.Abs(Factor(TipForceTable, time)) * tip
                + Math.Abs(Factor(DistributedForceTable, time)) * WireLength * DistributedForce.Length;
        }

        /// <summary>Node 0 at this time, m.</summary>
        public Vector3d ProximalPositionAt(double time)
        {
            return ProximalPosition + (time - ProximalTime) * ProximalVelocity;
        }

        /// <summary>Turn of the proximal frame at this time, radians.</summary>
        public double ProximalTurnAt(double time)
        {
            return _twistOrigin + ProximalTwistRate * (time - _twistOriginTime);
        }

        /// <summary>Turn of the frame to which the first element is clamped at this time, radians.</summary>
        public double FrameTurnAt(double time)
        {
            return HeldFrameTurn ?? ProximalTurnAt(time);
        }

        /// <summary>Its turning, rad/s.</summary>
        public double FrameTwistRate => HeldFrameTurn.HasValue ? 0.0 : ProximalTwistRate;

        /// <summary>How far the hub is ahead of that frame at this time, radians.</summary>
        public double HubAhead(double time)
        {
            return HeldFrameTurn.HasValue ? ProximalTurnAt(time) - HeldFrameTurn.Value : 0.0;
        }

        /// <summary>From this time on, s, the proximal frame turns at this rate, rad/s.</summary>
        public void TurnOn(double time, double rate)
        {
            _twistOrigin = ProximalTurnAt(time);
            _twistOriginTime = time;
            ProximalTwistRate = rate;
        }

        /// <summary>The last node at this time, m.</summary>
        public Vector3d DistalPositionAt(double time)
        {
            return DistalPosition + (Ramp(time) * DistalDisplacement) * DistalFrame.Director3;
        }

        /// <summary>Velocity of the last node's support at this time, m/s.</summary>
        public Vector3d DistalVelocityAt(double time)
        {
            return time < DistalRampTime ? (DistalDisplacement / DistalRampTime) * DistalFrame.Director3
                : Vector3d.Zero;
        }

        /// <summary>The first time after this one, s, at which a load or the velocity of a support jumps: the tip force
        /// is let go, a table of a load has two rows of one time, the distal end comes to rest. Infinite where none
        /// does.</summary>
        public double NextJump(double time)
        {
            double next = double.PositiveInfinity;
            if (TipForceReleaseTime > time && TipForce != Vector3d.Zero)
            {
                next = TipForceReleaseTime;
            }
            foreach (TimeTable table in LoadTables)
            {
                next = Math.Min(next, table.NextJump(time));
            }
            bool ramps = DistalDisplacement != 0.0 || DistalRotation != 0.0;
            return ramps && DistalRampTime > time ? Math.Min(next, DistalRampTime) : next;
        }

        /// <summary>The first time after this one, s, at which something prescribed is not smooth: a jump, or a row of
        /// a load's table. Infinite where there is none.</summary>
        public double NextBreak(double time)
        {
            double next = NextJump(time);
            foreach (TimeTable table in LoadTables)
            {
                next = Math.Min(next, table.NextRow(time));
            }
            return next;
        }

        /// <summary>Turn of the distal frame at this time, radians.</summary>
        public double DistalTurnAt(double time)
        {
            return Ramp(time) * DistalRotation;
        }

        /// <summary>Turning of the distal frame about its own d3 at this time, rad/s.</summary>
        public double DistalTwistRateAt(double time)
        {
            return time < DistalRampTime ? DistalRotation / DistalRampTime : 0.0;
        }

        /// <summary>Whether all that is prescribed stays as it is from this time to an end, s.</summary>
        public bool IsOver(double time, double end)
        {
            bool ramps = time < DistalRampTime && (DistalDisplacement != 0.0 || DistalRotation != 0.0);
            bool isReleased = time <= TipForceReleaseTime && TipForceReleaseTime < end && TipForce != Vector3d.Zero;
            bool changes = Changes(GravityTable, time) || Changes(TipForceTable, time)
                || Changes(DistributedForceTable, time) || Changes(AxialForceTable, time);
            return !ramps && !isReleased && !changes && time >= DriveEnd
                && ProximalVelocity == Vector3d.Zero && ProximalTwistRate == 0.0;
        }

        /// <summary>The largest turn between the two frames from a time to an end, s, over that at the time; 1 where
        /// there is none yet.</summary>
        public double TurnAhead(double time, double end)
        {
            double now = Math.Abs(DistalTurnAt(time) - ProximalTurnAt(time));
            double largest = Math.Max(now, Math.Abs(DistalTurnAt(end) - ProximalTurnAt(end)));
            if (time < DistalRampTime && DistalRampTime < end)
            {
                largest = Math.Max(largest, Math.Abs(DistalRotation - ProximalTurnAt(DistalRampTime)));
            }
            return now > 0.0 ? largest / now : 1.0;
        }

        /// <summary>Sets both frames of a shape, turned by these angles.</summary>
        public void TurnFrames(RodShape shape, double proximal, double distal)
        {
            shape.ProximalFrame = ProximalFrame * Quaterniond.FromAxisAngle(Vector3d.UnitZ, proximal);
            shape.DistalFrame = DistalFrame * Quaterniond.FromAxisAngle(Vector3d.UnitZ, distal);
        }

        /// <summary>The distal frame at this time.</summary>
        public Quaterniond DistalFrameAt(double time)
        {
            return DistalFrame * Quaterniond.FromAxisAngle(Vector3d.UnitZ, DistalTurnAt(time));
        }

        /// <summary>Writes or takes over how the proximal end moves: what a drive prescribes anew before every step.
        /// </summary>
        public void SerializeDrive(Snapshot snapshot)
        {
            ProximalPosition = snapshot.Serialize(ProximalPosition);
            ProximalVelocity = snapshot.Serialize(ProximalVelocity);
            ProximalTime = snapshot.Serialize(ProximalTime);
            ProximalTwistRate = snapshot.Serialize(ProximalTwistRate);
            snapshot.Serialize(ref _twistOrigin);
            snapshot.Serialize(ref _twistOriginTime);
        }

        /// <summary>Writes into a snapshot, or takes over from one, where the prescribed motions began and how far they
        /// have come at this time. Loads, ramps and rates stay this schedule's own: a twist at another rate goes on
        /// from the present turn, and node 0 stays where a drive has brought it until a drive takes it on.</summary>
        public void Serialize(Snapshot snapshot, double time)
        {
            Vector3d proximal = ProximalPosition;
            Vector3d velocity = ProximalVelocity;
            double since = ProximalTime;
            Quaterniond proximalFrame = ProximalFrame;
            double rate = ProximalTwistRate;
            Vector3d distal = DistalPosition;
            Quaterniond distalFrame = DistalFrame;
            snapshot.Serialize(ref proximal);
            snapshot.Serialize(ref velocity);
            snapshot.Serialize(ref since);
            snapshot.Serialize(ref proximalFrame);
            snapshot.Serialize(ref rate);
            snapshot.Serialize(ref _twistOrigin);
            snapshot.Serialize(ref _twistOriginTime);
            snapshot.Serialize(ref distal);
            snapshot.Serialize(ref distalFrame);
            if (snapshot.IsWritten)
            {
                return;
            }
            bool moves = velocity != Vector3d.Zero;
            ProximalPosition = moves ? proximal + (time - since) * velocity : proximal;
            ProximalTime = moves ? time : since;
            ProximalVelocity = Vector3d.Zero;
            ProximalFrame = proximalFrame;
            DistalPosition = distal;
            DistalFrame = distalFrame;
            if (rate != ProximalTwistRate)
            {
                _twistOrigin += rate * (time - _twistOriginTime);
                _twistOriginTime = time;
            }
        }

        private static double Factor(TimeTable? table, double time)
        {
            return table == null ? 1.0 : table.At(time);
        }

        private static bool Changes(TimeTable? table, double time)
        {
            return table != null && table.ChangesFrom(time);
        }

        private double Ramp(double time)
        {
            return DistalRampTime > 0.0 ? Math.Min(1.0, Math.Max(0.0, time / DistalRampTime)) : 1.0;
        }
    }
}
