using System;

namespace Guidewire.Core
{
    /// <summary>Results of a catheter over a wire at one time: those of the catheter, the force at the wire's hub, and
    /// the play neglected by the shared centreline between the catheter and the next instrument inside it.</summary>
    /// <remarks>Force and torque are those of a hub on its instrument: a thrust and a turn to the right, as seen from
    /// the hub, are positive. Those of inner instruments are derivatives of the energy in their hubs' positions and
    /// turns, the outermost one's the chain's reaction less those.
    ///
    /// With the radial play delta and a difference dk of the two rest curvatures the instruments lie on one another but
    /// for a length a = sqrt(12 delta/dk) from each end of the overlap, and leave it at an angle of sqrt(3 delta dk);
    /// 0.66 a of coupled length is lost at a free tip.</remarks>
    public sealed class CoaxialRecord
    {
        /// <summary>Play angle in degrees from which on a warning is due.</summary>
        public const double LargePlay = 15.0;

        /// <summary>The same for a over the overlap, from <see cref="SmallPlay"/> on.</summary>
        public const double LargeLength = 0.1;

        /// <summary>Play angle in degrees up to which the axes are one, however long a is: two rest curvatures that
        /// hardly differ have a small angle and a long a.</summary>
        public const double SmallPlay = 5.0;

        private const double LostAtTip = 0.66;

        private readonly double _units;
        private readonly double _lumen;   // radius, m
        private readonly LumenFriction _friction;
        private readonly int _instrument; // 0 the outermost one
        private double _play;             // where the play angle has been the largest, m
        private double _mismatch;         // 1/m
        private double _reduced;          // B_r, N m^2
        private double _displacement;     // of the catheter's hub, m
        private double _wireDisplacement;

        /// <param name="elements">n of the catheter.</param>
        /// <param name="metres">A unit of length.</param>
        /// <param name="lumenRadius">Of the catheter, m.</param>
        /// <param name="friction">Between the catheter and the instrument inside.</param>
        /// <param name="instrument">0 the outermost one, 1 that in it.</param>
        /// <param name="hasSoftWalls">Whether any wall gives way.</param>
        /// <param name="touchesItself">Whether instruments touch themselves.</param>
        internal CoaxialRecord(int elements, double metres, double lumenRadius, LumenFriction friction,
            int instrument = 0, bool hasSoftWalls = false, bool touchesItself = false)
        {
            _instrument = instrument;
            _friction = friction;
            _units = 1.0 / metres;
            Positions = new Vector3d[elements + 1];
            Orientations = new Quaterniond[elements];
            Velocities = new Vector3d[elements + 1];
            AngularVelocities = new Vector3d[elements];
            ContactForces = new Vector3d[elements + 1];
            WallDisplacements = new Vector3d[hasSoftWalls ? elements : 0];
            StrandForces = new Vector3d[touchesItself ? elements + 1 : 0];
            _lumen = lumenRadius;
        }

        /// <summary>Results of the catheter inside this one; null if the wire is next.</summary>
        public CoaxialRecord? Inside { get; internal set; }

        /// <summary>The catheter's n + 1 nodes, units.</summary>
        public Vector3d[] Positions { get; }

        /// <summary>The orientations of the catheter's n elements.</summary>
        public Quaterniond[] Orientations { get; }

        /// <summary>Velocities of the nodes, units/s.</summary>
        public Vector3d[] Velocities { get; }

        /// <summary>Angular velocities of the elements, rad/s, own axes; where it is inside another instrument those of
        /// that one.</summary>
        public Vector3d[] AngularVelocities { get; }

        /// <summary>Force of the walls on each node in the last step, N, where it is the outermost instrument.
        /// </summary>
        public Vector3d[] ContactForces { get; }

        /// <summary>Force of its other strands on each node in the last step, N, where it is the outermost instrument;
        /// as <see cref="ContactRecord.StrandForces"/>.</summary>
        public Vector3d[] StrandForces { get; }

        /// <summary>Displacement of soft walls at each element, where it is the outermost instrument, m; as
        /// <see cref="ContactRecord.Displacements"/>.</summary>
        public Vector3d[] WallDisplacements { get; }

        /// <summary>Insertion of the catheter's hub since the start, m.</summary>
        public double Insertion { get; private set; }

        /// <summary>Rotation of the catheter's hub since the start, rad.</summary>
        public double Turn { get; private set; }

        /// <summary>Force of the catheter's hub, N.</summary>
        public double Force { get; private set; }

        /// <summary>Torque of the catheter's hub, N m.</summary>
        public double Torque { get; private set; }

        /// <summary>The end of the first step in which the catheter's hub slipped at its force limit, s; NaN where it
        /// has not.</summary>
        public double SlippedFrom { get; internal set; } = double.NaN;

        /// <summary>By how much that force is uncertain, N: root mean square over the run.</summary>
        public double ForceError { get; internal set; }

        /// <summary>Displacement that the catheter's hub was asked, there and back both counted, m.</summary>
        public double CommandedDisplacement { get; private set; }

        /// <summary>What it went of that, m.</summary>
        public double Displacement => _displacement;

        /// <summary>Displacement that the catheter's hub has lost, m.</summary>
        public double Shortfall { get; private set; }

        /// <summary>Displacement that the wire's hub was asked, there and back both counted, m.</summary>
        public double WireCommandedDisplacement { get; private set; }

        /// <summary>What it went of that, m.</summary>
        public double WireDisplacement => _wireDisplacement;

        /// <summary>Displacement that the wire's hub has lost, m.</summary>
        public double WireShortfall { get; private set; }

        /// <summary>Force of the wire's hub, N.</summary>
        public double WireForce { get; private set; }

        /// <summary>Torque of the wire's hub, N m.</summary>
        public double WireTorque { get; private set; }

        /// <summary>Twist of the wire from its hub to its tip, rad.</summary>
        public double WireTwist { get; private set; }

        /// <summary>Largest curvature of any joint of both, 1/m.</summary>
        public double LargestCurvature { get; private set; }

        /// <summary>Distance of the tip of the next instrument inside beyond the catheter's tip, m; negative
        /// inside.</summary>
        public double Extension { get; private set; }

        /// <summary>Length over which that instrument is in the catheter, m.</summary>
        public double Overlap { get; private set; }

        /// <summary>The largest play angle of the run at any node of the overlap, degrees.</summary>
        public double PlayAngle => 180.0 / Math.PI * Math.Sqrt(3.0 * _play * _mismatch);

        /// <summary>a there, m; 0 where the two have had one rest curvature all along.</summary>
        public double PlayLength => _mismatch > 0.0 ? Math.Sqrt(12.0 * _play / _mismatch) : 0.0;

        /// <summary>Coupled length that is lost at the tip, m, at most all of the overlap.</summary>
        public double LengthLost => Math.Min(LostAtTip * PlayLength, Overlap);

        /// <summary>The axial force, N, that friction of the lumen would have been able to hold per unit of its
        /// coefficient: by both ends of the overlap, 2 B_r dk/a each, where the play angle has been the
        /// largest.</summary>
        public double FrictionHeld => 2.0 * EndForce(_play, _mismatch, _reduced);

        /// <summary>Coefficient of friction between the two.</summary>
        public double FrictionCoefficient => _friction.Coefficient;

        /// <summary>What of the force of the hub of the next instrument inside is friction in the lumen, N; negative
        /// where that is drawn back.</summary>
        public double FrictionForce { get; private set; }

        /// <summary>Angle by which the centreline turns along the overlap, rad.</summary>
        public double OverlapAngle { get; private set; }

        /// <summary>That the play left out is not small, or null.</summary>
        internal RunWarning? PlayWarning => PlayAngle <= LargePlay
            && (PlayAngle <= SmallPlay || PlayLength <= LargeLength * Overlap)
            ? (RunWarning?)null : WarningTable.Play.With(Inside == null ? "wire" : "inner catheter or wire",
                1e3 * _play, Inside != null ? "outer catheter" : _instrument > 0 ? "inner catheter" : "catheter",
                PlayAngle, 1e3 * LengthLost, 1e3 * Overlap);

        /// <summary>Takes the largest play angle of a shape.</summary>
        internal void TakePlay(CoaxialJoints joints, RodShape shape)
        {
            for (int k = 1; k < joints.ElementCount; k++)
            {
                int inside = InsideAt(k, joints);
                if (inside == 0)
                {
                    continue;
                }
                PlayAt(k, inside, inside, joints, shape, out double play, out double mismatch, out double reduced);
                if (play * mismatch > _play * _mismatch)
                {
                    _play = play;
                    _mismatch = mismatch;
                    _reduced = reduced;
                }
            }
        }

        // The next instrument inside the catheter at node k; 0 where there is none, or no catheter, or in a sheath,
        // which keeps both straight.
        private int InsideAt(int k, CoaxialJoints joints)
        {
            int carrier = joints.CarrierOf(k);
            if (joints.Stations[k] < joints.Sheathed || carrier > _instrument
                || (carrier < _instrument && k >= joints.ActiveCountOf(_instrument)))
            {
                return 0;
            }
            int inside = _instrument + 1;
            while (inside < joints.Count && k >= joints.ActiveCountOf(inside))
            {
                inside++;
            }
            return inside < joints.Count ? inside : 0;
        }

        // Of node k: play, m; difference of the rest curvatures of the catheter and of all from 'inside' to 'last' in
        // it, 1/m; B_r, N m^2.
        private void PlayAt(int k, int inside, int last, CoaxialJoints joints, RodShape shape, out double play,
            out double mismatch, out double reduced)
        {
            ref readonly CrossSection outer = ref joints.PieceAt(k, _instrument);
            double bend = 0.0;
            double x = 0.0;
            double y = 0.0;
            for (int i = inside; i <= last; i++)
            {
                if (k >= joints.ActiveCountOf(i))
                {
                    continue;
                }
                ref readonly CrossSection inner = ref joints.PieceAt(k, i);
                double angle = 0.5 * (CoaxialShape.Angle(shape, shape.Twist, joints, k - 1, i, _instrument)
                    + CoaxialShape.Angle(shape, shape.Twist, joints, k, i, _instrument));
                double c = Math.Cos(angle);
                double s = Math.Sin(angle);
                Vector3d b = inner.BendStiffness1 * inner.RestCurvature;
                bend += inner.BendStiffness1;
                x += c * b.X - s * b.Y;
                y += s * b.X + c * b.Y;
            }
            Vector3d a = outer.RestCurvature;
            x = a.X - x / bend;
            y = a.Y - y / bend;
            play = _lumen - joints.PieceAt(k, inside).Radius;
            mismatch = Math.Sqrt(x * x + y * y);
            reduced = outer.BendStiffness1 * bend / (outer.BendStiffness1 + bend);
        }

        // 2 B_r dk/a with a = sqrt(12 play/dk), N.
        private static double EndForce(double play, double mismatch, double reduced) =>
            mismatch > 0.0 ? 2.0 * reduced * mismatch / Math.Sqrt(12.0 * play / mismatch) : 0.0;

        // The largest force by which an end of the overlap lies against the lumen in a shape, N.
        private double LargestEndForce(CoaxialJoints joints, RodShape shape)
        {
            double largest = 0.0;
            for (int k = 1; k < joints.ActiveCount; k++)
            {
                int inside = InsideAt(k, joints);
                if (inside == 0)
                {
                    continue;
                }
                PlayAt(k, inside, joints.InnerCount, joints, shape, out double play, out double mismatch,
                    out double reduced);
                largest = Math.Max(largest, EndForce(play, mismatch, reduced));
            }
            return largest;
        }

        /// <summary>Counts a step that all drives have prepared.</summary>
        /// <param name="drives">The outermost one first, the wire's last.</param>
        internal void TakeStep(MaterialDrive[] drives)
        {
            _displacement += drives[_instrument].Progress;
            _wireDisplacement += drives[drives.Length - 1].Progress;
            _friction.Slide(drives[_instrument + 1].Moved - drives[_instrument].Moved);
        }

        internal void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _play);
            snapshot.Serialize(ref _mismatch);
            snapshot.Serialize(ref _reduced);
            snapshot.Serialize(ref _displacement);
            snapshot.Serialize(ref _wireDisplacement);
            _friction.Serialize(snapshot);
        }

        /// <summary>Takes velocities, m/s and rad/s.</summary>
        internal void TakeMotion(Vector3d[] velocities, Vector3d[] spins)
        {
            for (int i = 0; i < Velocities.Length; i++)
            {
                Velocities[i] = _units * velocities[i];
            }
            Array.Copy(spins, AngularVelocities, AngularVelocities.Length);
        }

        /// <summary>Takes the state of a moment.</summary>
        /// <param name="own">Where the catheter is: its own nodes and elements.</param>
        /// <param name="inside">Sum of the forces of the hubs of all instruments inside, without friction, N.</param>
        internal void Record(CoaxialJoints joints, RodTerms terms, RodShape shape, RodShape own, MaterialDrive drive,
            MaterialDrive wireDrive, double torque, double wireTorque, double inside)
        {
            for (int i = 0; i < Positions.Length; i++)
            {
                Positions[i] = _units * own.X[i];
            }
            Array.Copy(own.Q, Orientations, Orientations.Length);
            Insertion = drive.Insertion;
            Turn = drive.Turn;
            CommandedDisplacement = drive.TotalCommandedDisplacement;
            WireCommandedDisplacement = wireDrive.TotalCommandedDisplacement;
            Shortfall = drive.Slip;
            WireShortfall = wireDrive.Slip;
            Torque = torque;
            WireTorque = wireTorque;
            Extension = joints.ExtensionOf(_instrument + 1, _instrument);
            Overlap = Math.Min(0.0, Extension)
                + (_instrument == 0 ? joints.Stations[joints.OuterCount] : joints.Hubs.Ends[1] + joints.LeadOf(1));
            double overlapEnd = _instrument > 0 ? Math.Min(joints.Hubs.Ends[1], joints.Hubs.Ends[2])
                : joints.InnerCount == 1 ? Overlap
                : Math.Max(Overlap, Math.Min(joints.Hubs.Ends[2], joints.Stations[joints.OuterCount]));
            CoaxialBendTwist bending = terms.CoaxialBending!;
            WireTwist = CoaxialShape.InnermostTwist(shape, bending);
            int wire = joints.InnerCount;
            int reach = joints.ActiveCountOf(wire) < joints.TipOf(wire - 1) ? Math.Max(1, joints.ActiveCountOf(wire))
                : joints.ElementCount;
            LargestCurvature = 0.0;
            OverlapAngle = 0.0;
            double to = joints.Stations[0];
            for (int k = 0; k < joints.ElementCount; k++)
            {
                Vector3d turn = bending.TurnOf(shape, k);
                double curvature = Math.Sqrt(turn.X * turn.X + turn.Y * turn.Y) / joints.LengthOf(k);
                double outside = joints.FractionOutside(k);
                LargestCurvature = outside <= CoaxialJoints.MinFraction ? LargestCurvature
                    : Math.Max(LargestCurvature, curvature / outside);
                // A joint has the curvature between the middles of its elements, the last one on to the end.
                double from = to;
                to = k + 1 < joints.ElementCount ? 0.5 * (joints.Stations[k] + joints.Stations[k + 1]) : overlapEnd;
                OverlapAngle += curvature * Math.Max(0.0, Math.Min(to, overlapEnd) - from);
                // The carrier's own twist is the wire's too, as far as it reaches.
                WireTwist += k < reach ? turn.Z : 0.0;
            }
            FrictionForce = _friction.Force(inside, OverlapAngle,
                _friction.Coefficient > 0.0 ? LargestEndForce(joints, shape) : 0.0);
        }

        /// <summary>Gives the force of a hub, N: of the outermost instrument first, of the wire last.</summary>
        internal double ForceOf(int hub) =>
            hub == _instrument ? Force : Inside == null ? WireForce : Inside.ForceOf(hub);

        /// <summary>Takes the forces of hubs, N.</summary>
        /// <param name="force">Of the catheter's, without friction.</param>
        /// <param name="around">What of it is friction in the lumen around it.</param>
        /// <param name="wireForce">Of the wire's.</param>
        internal void TakeForces(double force, double around, double wireForce)
        {
            Force = force + around - FrictionForce;
            WireForce = wireForce;
        }
    }
}
