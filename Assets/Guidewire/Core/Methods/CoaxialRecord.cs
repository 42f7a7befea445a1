using System;

namespace Guidewire.Core
{
    /// <summary>What is read off of a wire in a catheter at one moment: of the catheter all, of the wire what its hub
    /// feels; and what the model of one shared centreline leaves out.</summary>
    /// <remarks>Force and torque are those of a hub on its instrument: a thrust and a turn to the right, as seen from
    /// the hub, are positive. The wire's are derivatives of the energy in its hub's position and turn, the catheter's
    /// the chain's reaction less those.
    ///
    /// With the radial play delta and a difference dk of the two rest curvatures the instruments lie on one another but
    /// for a length a = sqrt(12 delta/dk) from each end of the overlap, and leave it at an angle of sqrt(3 delta dk);
    /// 0.66 a of coupled length is lost at a free tip.</remarks>
    public sealed class CoaxialRecord
    {
        /// <summary>Play angle in degrees from which on a warning is due.</summary>
        public const double LargePlay = 15.0;

        /// <summary>The same of a over the overlap.</summary>
        public const double LargeLength = 0.1;

        private const double LostAtTip = 0.66;

        private readonly double _units;
        private readonly double _lumen;   // radius, m
        private readonly LumenFriction _friction;
        private double _play;             // where the play angle has been the largest, m
        private double _mismatch;         // 1/m
        private double _reduced;          // B_r, N m^2
        private double _asked;            // of the catheter's hub, m
        private double _gone;
        private double _wireAsked;
        private double _wireGone;

        /// <param name="elements">n of the catheter.</param>
        /// <param name="metres">A unit of length.</param>
        /// <param name="lumenRadius">Of the catheter, m.</param>
        /// <param name="friction">Between the two.</param>
        internal CoaxialRecord(int elements, double metres, double lumenRadius, LumenFriction friction)
        {
            _friction = friction;
            _units = 1.0 / metres;
            Positions = new Vector3d[elements + 1];
            Orientations = new Quaterniond[elements];
            _lumen = lumenRadius;
        }

        /// <summary>The catheter's n + 1 nodes, units.</summary>
        public Vector3d[] Positions { get; }

        /// <summary>Its n elements.</summary>
        public Quaterniond[] Orientations { get; }

        /// <summary>How far the catheter's hub has gone along its axis since the start, m.</summary>
        public double Insertion { get; private set; }

        /// <summary>How far it has turned since the start, rad.</summary>
        public double Turn { get; private set; }

        /// <summary>Force of the catheter's hub, N.</summary>
        public double Force { get; private set; }

        /// <summary>Torque of the catheter's hub, N m.</summary>
        public double Torque { get; private set; }

        /// <summary>Displacement that the catheter's hub was asked, there and back both counted, m.</summary>
        public double Asked => _asked;

        /// <summary>What it went of that, m.</summary>
        public double Gone => _gone;

        /// <summary>Displacement that the catheter's hub has lost, m.</summary>
        public double Shortfall { get; private set; }

        /// <summary>Displacement that the wire's hub was asked, there and back both counted, m.</summary>
        public double WireAsked => _wireAsked;

        /// <summary>What it went of that, m.</summary>
        public double WireGone => _wireGone;

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

        /// <summary>How far the wire's tip is beyond the catheter's, m; negative inside.</summary>
        public double Extension { get; private set; }

        /// <summary>Length over which the wire is in the catheter, m.</summary>
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

        /// <summary>What of the force of the wire's hub is friction in the lumen, N; negative where the wire is drawn
        /// back.</summary>
        public double FrictionForce { get; private set; }

        /// <summary>Angle by which the centreline turns along the overlap, rad.</summary>
        public double OverlapAngle { get; private set; }

        /// <summary>What is not to be trusted for the play that is left out, in one line; or null.</summary>
        public string? PlayWarning
        {
            get
            {
                bool isSharp = PlayAngle > LargePlay;
                bool isLong = PlayLength > LargeLength * Overlap;
                return isSharp || isLong ? string.Format(System.Globalization.CultureInfo.InvariantCulture,
                    "the wire has {0:G3} mm of play in the catheter, which is not simulated: it may leave it at up to"
                    + " {1:G3} degrees from its axis, and {2:G3} mm of {3:G3} mm of overlap are not coupled",
                    1e3 * _play, PlayAngle, 1e3 * LengthLost, 1e3 * Overlap) : null;
            }
        }

        /// <summary>Takes the largest play angle of a shape.</summary>
        internal void TakePlay(CoaxialJoints joints, RodShape shape)
        {
            for (int k = 1; k < joints.ActiveCount; k++)
            {
                PlayAt(k, joints, shape, out double play, out double mismatch, out double reduced);
                if (play * mismatch > _play * _mismatch)
                {
                    _play = play;
                    _mismatch = mismatch;
                    _reduced = reduced;
                }
            }
        }

        // Of node k: play, m; difference of the two rest curvatures, 1/m; B_r, N m^2.
        private void PlayAt(int k, CoaxialJoints joints, RodShape shape, out double play, out double mismatch,
            out double reduced)
        {
            joints.PiecesAt(k, out CrossSection outer, out CrossSection inner);
            double angle = 0.5 * (shape.Twist[k - 1] + shape.Twist[k]);
            double c = Math.Cos(angle);
            double s = Math.Sin(angle);
            Vector3d a = outer.RestCurvature;
            Vector3d b = inner.RestCurvature;
            double x = a.X - c * b.X + s * b.Y;
            double y = a.Y - s * b.X - c * b.Y;
            play = _lumen - inner.Radius;
            mismatch = Math.Sqrt(x * x + y * y);
            reduced = outer.BendStiffness1 * inner.BendStiffness1 / (outer.BendStiffness1 + inner.BendStiffness1);
        }

        // 2 B_r dk/a with a = sqrt(12 play/dk), N.
        private static double EndForce(double play, double mismatch, double reduced)
        {
            return mismatch > 0.0 ? 2.0 * reduced * mismatch / Math.Sqrt(12.0 * play / mismatch) : 0.0;
        }

        // The largest force by which an end of the overlap lies against the lumen in a shape, N.
        private double LargestEndForce(CoaxialJoints joints, RodShape shape)
        {
            double largest = 0.0;
            for (int k = 1; k < joints.ActiveCount; k++)
            {
                PlayAt(k, joints, shape, out double play, out double mismatch, out double reduced);
                largest = Math.Max(largest, EndForce(play, mismatch, reduced));
            }
            return largest;
        }

        /// <summary>Counts a step that both drives have prepared.</summary>
        /// <param name="from">Insertion of the catheter's hub before it, m.</param>
        /// <param name="wireFrom">The same of the wire's.</param>
        internal void TakeStep(MaterialDrive drive, double from, MaterialDrive wireDrive, double wireFrom)
        {
            _asked += drive.Asked;
            _gone += drive.GoneSince(from);
            _wireAsked += wireDrive.Asked;
            _wireGone += wireDrive.GoneSince(wireFrom);
            _friction.Slide(wireDrive.Insertion - wireFrom - (drive.Insertion - from));
        }

        internal void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _play);
            snapshot.Serialize(ref _mismatch);
            snapshot.Serialize(ref _reduced);
            snapshot.Serialize(ref _asked);
            snapshot.Serialize(ref _gone);
            snapshot.Serialize(ref _wireAsked);
            snapshot.Serialize(ref _wireGone);
            _friction.Serialize(snapshot);
        }

        internal void Take(CoaxialJoints joints, RodTerms terms, RodShape shape, MaterialDrive drive,
            MaterialDrive wireDrive, double force, double torque, double wireForce, double wireTorque)
        {
            int tip = joints.OuterCount;
            for (int i = 0; i <= tip; i++)
            {
                Positions[i] = _units * shape.X[i];
            }
            Array.Copy(shape.Q, Orientations, tip);
            Insertion = drive.Insertion;
            Turn = drive.Turn;
            Shortfall = drive.Slip;
            WireShortfall = wireDrive.Slip;
            Torque = torque;
            WireTorque = wireTorque;
            Extension = joints.Extension;
            Overlap = joints.Stations[tip] + Math.Min(0.0, Extension);
            var bending = (CoaxialBendTwist)terms.Bending;
            double[] station = joints.Stations;
            int last = Math.Max(joints.ActiveCount - 1, 0);
            WireTwist = shape.Twist[last] - bending.HubTwist;
            LargestCurvature = 0.0;
            OverlapAngle = 0.0;
            double to = 0.0;
            for (int k = 0; k < joints.ElementCount; k++)
            {
                Vector3d turn = bending.TurnOf(shape, k);
                double curvature = Math.Sqrt(turn.X * turn.X + turn.Y * turn.Y) / joints.LengthOf(k);
                double outside = joints.FractionOutside(k);
                LargestCurvature = outside <= CoaxialJoints.LeastFraction ? LargestCurvature
                    : Math.Max(LargestCurvature, curvature / outside);
                // A joint has the curvature between the middles of its elements, the last one on to the end.
                double from = to;
                to = k + 1 < joints.ElementCount ? 0.5 * (joints.Stations[k] + joints.Stations[k + 1]) : Overlap;
                OverlapAngle += curvature * Math.Max(0.0, Math.Min(to, Overlap) - from);
                // The carrier's own twist is the wire's too, but for the hub's frame.
                WireTwist += turn.Z;
            }
            FrictionForce = _friction.Force(wireForce, OverlapAngle,
                _friction.Coefficient > 0.0 ? LargestEndForce(joints, shape) : 0.0);
            WireForce = wireForce + FrictionForce;
            Force = force - FrictionForce;
        }
    }
}
