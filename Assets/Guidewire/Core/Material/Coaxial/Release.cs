using System;

namespace Guidewire.Core
{
    /// <summary>The derivative of the energy of coaxial instruments by the position of a hub, with all nodes, frames
    /// and angles held: by that an instrument is driven out of others, or all out of a sheath, without
    /// friction.</summary>
    /// <remarks>Hubs move borders, and nodes of the instrument beyond the tip around it. Every sum of a joint or an
    /// element is linear in the lengths of pieces and in their weights (<see cref="CoaxialPieces"/>). So its derivative
    /// A', F', e', C', S', (1/K)', r', w' is the same sum of their derivatives, and with the joint's moments m and
    /// couples c
    ///   E' = -1/2 sum m_i^2 A_i' - m . (F' + sum R(t) F_i') + e' - C' cos t - S' sin t + dE/dt (z_b - z_a) w'
    ///       - sum (1/2 c^2 (1/K)' + c r').
    /// Of an element of the station's length s, compliances a along and b across its axis, of which c is without what
    /// is before it, force N and shear force V of the chain, f of the loads alone and Q of what a tip bears,
    /// E' = -N (s' - f a' + Q (a' - c')) - 1/2 (N^2 + f^2) a' and what V adds; the part with Q is shared by two
    /// elements. Where borders of two instruments are in one place E has a kink, and E' is that of one side; of two
    /// tips, that beyond the outer one.</remarks>
    internal sealed class Release
    {
        private const int Ramp = 6;               // elements over which nodes come to go with their instrument

        private readonly CoaxialRod _rod;
        private readonly CoaxialJoints _joints;
        private readonly BendTwistTerm _bending;
        private readonly CoaxialBendTwist? _angles;    // of several
        private readonly StretchEnergy _stretch;
        private readonly HubSpeeds _speeds;
        private readonly CoaxialPieces _before;   // derivatives on one side of a joint
        private readonly CoaxialPieces _after;
        private readonly CoaxialPieces _shared;   // what is there
        private readonly double[] _own;           // of the compliance of each from its hub on
        private readonly double[] _station;       // speeds of nodes
        private readonly double[] _force;         // of the hubs inside, N
        private RodVector[] _friction = Array.Empty<RodVector>();
        private double _tipGrows;                 // of the element at the last tip
        private double _borneRate;                // of what Q makes it longer by
        private double _borneLength;              // that, m

        /// <summary>Of these instruments.</summary>
        /// <param name="angles">The bending of several, with their angles; null of one.</param>
        public Release(CoaxialRod rod, BendTwistTerm bending, CoaxialBendTwist? angles, StretchEnergy stretch)
        {
            _rod = rod;
            _joints = rod.Joints;
            _bending = bending;
            _angles = angles;
            _stretch = stretch;
            _speeds = new HubSpeeds(_joints.Count);
            _before = _joints.CreatePieces();
            _after = _joints.CreatePieces();
            _shared = _joints.CreatePieces();
            _own = new double[_joints.Count];
            _force = new double[_joints.Count];
            _station = new double[_joints.Capacity + 1];
        }

        /// <summary>Force of an inner hub on its instrument along the axis, N: dE/dp, loads among it. Negative where
        /// the instrument is driven out.</summary>
        public double InnerForce(RodShape shape, RodTerms terms, int instrument = 1)
        {
            SetSpeeds(instrument, 0.0);
            return OfLead(shape, terms, out double compliance) + RateOf(shape, 0, _joints.ElementCount, compliance)
                + (terms.CoaxialLoads?.EnergyRate(shape, _speeds, _station) ?? 0.0);
        }

        /// <summary>Force of an inner hub along the axis, N, by nodes that go on with their instrument only some
        /// elements beyond the tip. What is between slides past them. In the continuum it is <see cref="InnerForce"/>.
        /// With elements as long as the bend beyond a
        /// tip the two differ by what contacts are worth that are handed from node to node.</summary>
        /// <remarks>A node of speed s is passed by its material at 1 - s, against the friction f of walls on it, which
        /// does the work (1 - s) f . t.</remarks>
        public double SmoothForce(RodShape shape, RodTerms terms, int instrument)
        {
            SetSpeeds(instrument, 0.0);
            int first = _joints.TipOf(instrument - 1);
            int last = _joints.TipOf(instrument);
            int ramp = Math.Min(Ramp, last - first);
            double tip = _joints.Stations[first];
            double length = _joints.Stations[first + ramp] - tip;
            for (int k = 0; k < ramp; k++)
            {
                _station[first + k] = (_joints.Stations[first + k] - tip) / length;
            }
            double force = OfLead(shape, terms, out double compliance)
                + RateOf(shape, 0, _joints.ElementCount, compliance)
                + (terms.CoaxialLoads?.EnergyRate(shape, _speeds, _station) ?? 0.0);
            _friction = _friction.Length > 0 ? _friction : new RodVector[terms.VectorCapacity];
            Array.Clear(_friction, 0, terms.VectorCount);
            terms.Contact?.AddFriction(shape, _friction);
            for (int k = first + 1; k < first + ramp; k++)
            {
                Vector3d along = Vector3d.Normalize(shape.X[k + 1] - shape.X[k - 1]);
                force += (1.0 - _station[k]) * (_friction[k].X1 * along.X + _friction[k].X2 * along.Y
                    + _friction[k].X3 * along.Z);
            }
            return force;
        }

        /// <summary>Takes what the tips bear of the thrust of those that go on.</summary>
        /// <returns>The largest change of an element's length, m.</returns>
        public double TakeBorne(RodShape shape, RodTerms terms)
        {
            double largest = 0.0;
            AxialForces axial = _rod.Axial;
            for (int i = 1; i < _joints.Count; i++)
            {
                _force[i] = InnerForce(shape, terms, i);
            }
            for (int j = 1; j < _joints.ElementCount; j++)
            {
                if (_joints.IsTip(j))
                {
                    double borne = -_stretch.Stress(shape, j, out _).Z;
                    for (int i = _joints.CarrierOf(j); i < _joints.Count; i++)
                    {
                        borne -= axial.GoesOn(i, j) ? _force[i] + axial.LoadBefore(i, j) : 0.0;
                    }
                    largest = Math.Max(largest, Math.Abs(axial.SetBorne(j, borne)));
                }
            }
            return largest;
        }

        /// <summary>What the outer hub has of the force along the axis besides that on its node, N: -dE/dD, D the
        /// length in the sheath. Negative where all are driven out.</summary>
        public double SheathForce(RodShape shape)
        {
            int n = _joints.ElementCount;
            double exit = _joints.Sheathed;
            if (exit == 0.0 || exit >= _joints.Stations[n])
            {
                return 0.0;
            }
            int element = 0;
            while (_joints.Stations[element + 1] <= exit)
            {
                element++;
            }
            SetSpeeds(0, -1.0);
            return RateOf(shape, element, Math.Min(element + 2, n), 0.0);
        }

        /// <summary>That force where the step began, N.</summary>
        public double SheathForceAtStart { get; private set; }

        /// <summary>A step begins.</summary>
        public void BeginStep(RodShape shape) => SheathForceAtStart = SheathForce(shape);

        /// <summary>Work of the outer hub, J, against what drives all out, while the exit goes along the chain from one
        /// position to another, by the moments of a shape.</summary>
        /// <param name="from">m from the hub, as is the other.</param>
        public double SheathWork(RodShape shape, double from, double to)
        {
            _bending.Fibres?.FollowHubs();     // before the exit is moved for the integral
            double now = _joints.Sheathed;
            double end = Math.Max(from, to);
            double work = 0.0;
            for (double at = Math.Min(from, to); at < end;)
            {
                double next = Math.Min(_joints.NextBreak(at), end);
                _joints.Hubs.Sheathed = 0.5 * (at + next);
                work -= (next - at) * SheathForce(shape);
                at = next;
            }
            _joints.Hubs.Sheathed = now;
            return to > from ? work : -work;
        }

        private void SetSpeeds(int instrument, double exit)
        {
            _speeds.Exit = exit;
            Array.Clear(_station, 0, _joints.OuterCount + 1);    // other nodes were there
            for (int i = 1; i < _joints.Count; i++)
            {
                _speeds.Instruments[i] = i == instrument ? 1.0 : 0.0;
                for (int k = _joints.TipOf(i - 1) + 1; k <= _joints.TipOf(i); k++)
                {
                    _station[k] = _speeds.Instruments[i];
                }
            }
        }

        // Of what is before the chain and after the outermost hub, on which the hub's spring pulls.
        private double OfLead(RodShape shape, RodTerms terms, out double compliance)
        {
            compliance = 0.0;
            if (_joints.First == 0)
            {
                return 0.0;
            }
            var none = default(CoaxialJoint);
            _before.Clear();
            _before.AddSideRate(ref none, _joints.Stations[0], 0.0, 0, 0, _joints.Hubs, _speeds, 0.0, 0.0);
            compliance = _before.Axial;
            double push = Vector3d.Dot(terms.Contact!.SupportForce(shape), terms.HubAxis(shape))
                + _rod.Axial.LeadLoad;
            return -0.5 * compliance * push * push;
        }

        // Of the joints at the first end of some elements, and of these.
        // compliance: derivative of that of the chain before the first of them.
        private double RateOf(RodShape shape, int from, int to, double compliance)
        {
            _angles?.SetIdleTwists(shape);
            (_tipGrows, _borneRate, _borneLength) = (0.0, 0.0, 0.0);
            double sum = 0.0;
            for (int i = 0; i < _joints.Count; i++)
            {
                ref readonly CrossSection atHub = ref _joints.PieceAtHub(i);
                double speed = _joints.IsAtStart(i) ? _speeds.Instruments[i] : 0.0;
                _own[i] = -speed / atHub.StretchStiffness;
                sum -= speed * CoaxialPieces.Straightened(atHub);
            }
            for (int k = from; k < to; k++)
            {
                var rate = default(CoaxialJoint);
                _before.Clear();
                _after.Clear();
                _bending.Fibres?.BeginRate();
                bool moves = k > 0 && AddSide(ref rate, k, k - 1, _before);
                moves |= AddSide(ref rate, k, k + 1, _after);
                if (moves || (k == 0 && _speeds.Exit == 0.0))
                {
                    SetTwists(ref rate, k);
                    sum += RateOf(shape, k, rate);
                }
                sum += OfElement(shape, k, ref compliance);
            }
            return sum + (_joints.HasLast ? OfLast(shape, _angles!) : 0.0);
        }

        private bool AddSide(ref CoaxialJoint rate, int k, int other, CoaxialPieces side)
        {
            bool moves = _bending.Fibres?.AddSideRate(k, other, _speeds, _station[k], _station[other]) ?? false;
            return moves | side.AddSideRate(ref rate, _joints.Stations[k], _joints.Stations[other],
                _joints.CarrierOf(Math.Min(k, other)), _joints.FrameOf(k), _joints.Hubs, _speeds, _station[k],
                _station[other]);
        }

        // Derivatives of compliances, turns at rest and weights of the joint at node k.
        private void SetTwists(ref CoaxialJoint rate, int k)
        {
            int frame = _joints.FrameOf(k);
            rate.Twist = _before.Compliance[frame] + _after.Compliance[frame];
            rate.RestTwist = _before.Rest[frame] + _after.Rest[frame];
            ref readonly CoaxialJoint joint = ref _joints[k];
            if (k > 0 && (joint.First.Twist != 0.0 || joint.Second.Twist != 0.0))
            {
                _shared.Clear();
                _joints.AddSides(k, _shared);
            }
            bool isFirst = true;
            for (int i = 0; i < _joints.Count; i++)
            {
                if (i != frame)
                {
                    SetPart(ref (isFirst ? ref rate.First : ref rate.Second), isFirst ? joint.First : joint.Second,
                        k, i);
                    isFirst = false;
                }
            }
        }

        private void SetPart(ref CoaxialPart rate, in CoaxialPart part, int k, int instrument)
        {
            rate.Twist = _before.Compliance[instrument] + _after.Compliance[instrument];
            rate.RestTwist = _before.Rest[instrument] + _after.Rest[instrument];
            if (part.Twist == 0.0)
            {
                return;
            }
            if (k == 0)
            {
                ref readonly CrossSection atHub = ref _joints.PieceAtHub(instrument);
                double own = rate.Twist;
                rate.Twist -= _speeds.Instruments[instrument] / atHub.TwistStiffness;
                rate.RestTwist -= _speeds.Instruments[instrument] * atHub.RestCurvature.Z;
                rate.Weight = -0.5 * part.Twist * (own - 2.0 * (1.0 - part.Weight) * rate.Twist);
                return;
            }
            double shared = _shared.Shared[instrument];
            double after = _after.Shared[instrument];
            rate.Weight = shared > 0.0
                ? (after - part.Weight * (_before.Shared[instrument] + after)) / shared : 0.0;
        }

        private double RateOf(RodShape shape, int k, in CoaxialJoint rate)
        {
            ref readonly CoaxialJoint joint = ref _joints[k];
            _bending.Evaluate(shape, k, out CoaxialJointState s);
            double t = s.First.Mean(joint.First);
            double u = s.Second.Mean(joint.Second);
            var rest = new Vector3d(rate.FixedX, rate.FixedY, 0.0);
            rate.First.AddRest(t, ref rest, out _, out _);
            rate.Second.AddRest(u, ref rest, out _, out _);
            double held = rate.HeldAt(t, u, out _, out _, out _);
            double couple = joint.Twist * (s.Turn.Z - joint.RestTwist);
            double fibres = _bending.Fibres?.RateOf(shape, k, s, rate, rest) ?? 0.0;
            return fibres + rate.BendingRate(s.Joint.Bend1 * (s.Turn.X - s.Joint.Rest.X),
                    s.Joint.Bend2 * (s.Turn.Y - s.Joint.Rest.Y), rest, held)
                - couple * (0.5 * couple * rate.Twist + rate.RestTwist) + OfPart(rate.First, s.First)
                + OfPart(rate.Second, s.Second);
        }

        private static double OfPart(in CoaxialPart rate, in CoaxialPartState s)
        {
            return s.Slope * rate.Weight * (s.After - s.Before)
                - s.Couple * (0.5 * s.Couple * rate.Twist + rate.RestTwist);
        }

        private double OfLast(RodShape shape, CoaxialBendTwist bending)
        {
            int n = _joints.ElementCount;
            var rate = default(CoaxialJoint);
            _before.Clear();
            _bending.Fibres?.BeginRate();
            return AddSide(ref rate, n, n - 1, _before) ? bending.LastAt(shape, rate, out _, out _, out _) : 0.0;
        }

        // Of what a tip that bears thrust makes an element longer by.
        private double BorneRate(int j, double grows, double along)
        {
            AxialForces axial = _rod.Axial;
            if (_joints.IsTip(j))
            {
                _tipGrows = grows;
                _borneRate = (along - _after.Axial) * axial.BorneAt(j);
                _borneLength = axial.BorneLengthAt(j);
                return axial.ShareOf(j, j, grows, out double rate) * _borneRate + rate * _borneLength;
            }
            return _joints.IsTip(j - 1)
                ? axial.ShareOf(j, j - 1, _tipGrows, out double next) * _borneRate + next * _borneLength : 0.0;
        }

        // Of stretch and shear.
        private double OfElement(RodShape shape, int j, ref double before)
        {
            for (int i = 0; i < _own.Length; i++)
            {
                _own[i] += _after.Stretch[i];
            }
            double along = _rod.Axial.ComplianceRateOf(j, _after.Axial, _own, before);
            before += along;
            double grows = _station[j + 1] - _station[j];
            double borne = BorneRate(j, grows, along);
            if (along == 0.0 && grows == 0.0 && _after.Shear == 0.0 && borne == 0.0)
            {
                return 0.0;
            }
            Vector3d n = _stretch.Stress(shape, j, out _);
            double load = _rod.Axial.LoadOn(j);
            double length = grows - along * load + borne;
            double across = _rod.Rod.ShearStiffness[j];
            double acrossRate = (grows - across * _after.Shear) / _joints[j].Shear;
            return -n.Z * length - 0.5 * along * (n.Z * n.Z + load * load)
                + 0.5 * (n.X * n.X + n.Y * n.Y) / across * (acrossRate / across * _rod.Rod.Length[j] - length);
        }
    }
}
