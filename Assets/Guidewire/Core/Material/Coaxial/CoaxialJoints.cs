using System;

namespace Guidewire.Core
{
    /// <summary>The joints of an instrument with one or two others inside it, on one shared centreline: nodes of the
    /// outermost one up to its tip, then those of the next one beyond it, and so on. They change with the insertion of
    /// those inside.</summary>
    /// <remarks>Instruments are counted from the outermost one, 0. Positions along the chain are counted from its hub.
    /// The hub of instrument i is the lead d_i behind that: between the hubs it is straight. Beyond the tip of those
    /// around it, it is the outermost one, and the element between that tip and its first node there has the length l
    /// that follows from d_i, not from the nodes' positions: so the matrix stays block-tridiagonal. That element is
    /// stretched as all of its instrument from its hub is. A tip inside another instrument is only a border of pieces.
    ///
    /// In a sheath the chain is straight, up to a length from the outer hub that follows from that hub: as an outermost
    /// instrument without bend that turns with what is inside. Its exit is a border of pieces, too.</remarks>
    internal sealed class CoaxialJoints
    {
        /// <summary>Fraction of a joint outside a sheath below which it counts as straight.</summary>
        public const double MinFraction = 1e-3;

        private readonly CoaxialInstrument[] _instrument;
        private readonly int[] _beyond;            // nodes of each instrument in the chain, from its tip on
        private readonly int[] _tip;               // node of each where the next one goes on
        private readonly int[] _carrier;           // of each element: the outermost instrument there
        private readonly int[] _active;            // elements of each whose angle is unknown
        private readonly double[] _stretch;        // of each instrument, then by element, m/N
        private readonly double[] _leadStretch;    // of each before the outermost hub, m/N
        private readonly double[] _station;        // of the chain's nodes
        private readonly CoaxialJoint[] _joint;
        private readonly CoaxialPieces _before;    // on one side of a joint
        private readonly CoaxialPieces _after;
        private readonly double[] _compliance;     // in twist of each before the chain, rad/(N m)
        private readonly double[] _rest;           // and its turn at rest
        private CoaxialJoint _last;                // of the last half element: only what it holds counts

        /// <summary>Joints of these instruments.</summary>
        /// <param name="instruments">The outermost one first, up to three.</param>
        /// <param name="beyond">How many nodes of each, from its tip on, are nodes of the chain; of the first those
        /// from its first element here on.</param>
        /// <param name="leads">d of each, m; 0 for the first.</param>
        /// <param name="sheathed">Length in a sheath, m from the outer hub.</param>
        /// <param name="first">Elements of the outermost instrument before the chain.</param>
        public CoaxialJoints(CoaxialInstrument[] instruments, int[] beyond, double[] leads, double sheathed, int first)
        {
            int count = instruments.Length;
            _instrument = instruments;
            foreach (CoaxialInstrument instrument in instruments)
            {
                Capacity += instrument.Rod.ElementCount;
            }
            _beyond = new int[count];
            _tip = new int[count];
            Hubs = new HubPlaces(count);
            _active = new int[count];
            _station = new double[Capacity + 1];
            _carrier = new int[Capacity];
            _joint = new CoaxialJoint[Capacity + 1];
            _stretch = new double[count * Capacity];
            _leadStretch = new double[count];
            _before = CreatePieces();
            _after = CreatePieces();
            _compliance = new double[count];
            _rest = new double[count];
            Remesh(beyond, leads, sheathed, first);
        }

        /// <summary>The chain has other elements.</summary>
        public void Remesh(int[] beyond, double[] leads, double sheathed, int first)
        {
            First = first;
            Array.Copy(beyond, _beyond, Count);
            _tip[0] = _instrument[0].Rod.ElementCount - first;
            for (int i = 1; i < Count; i++)
            {
                _tip[i] = _tip[i - 1] + beyond[i];
            }
            for (int j = 0; j < ElementCount; j++)
            {
                _carrier[j] = j < _tip[0] ? 0 : j < _tip[1] ? 1 : 2;
            }
            Array.Copy(_instrument[0].Stations, first, _station, 0, _tip[0] + 1);
            Hubs.Sheathed = double.NaN;
            SetHubs(leads, sheathed);
        }

        /// <summary>Takes over which elements there are and where, but no joint.</summary>
        public void CopyFrom(CoaxialJoints other)
        {
            First = other.First;
            Array.Copy(other._beyond, _beyond, Count);
            Array.Copy(other._tip, _tip, Count);
            Array.Copy(other._active, _active, Count);
            Array.Copy(other._carrier, _carrier, ElementCount);
            Array.Copy(other._station, _station, ElementCount + 1);
        }

        /// <summary>Elements of the outermost instrument before the chain, which are straight.</summary>
        public int First { get; private set; }

        /// <summary>Grows with every change of the joints.</summary>
        public int Version { get; private set; }

        /// <summary>The most elements that the chain can have.</summary>
        public int Capacity { get; }

        /// <summary>How many instruments there are.</summary>
        public int Count => _instrument.Length;

        /// <summary>How many are inside the outermost one.</summary>
        public int InnerCount => _instrument.Length - 1;

        /// <summary>Elements of the chain.</summary>
        public int ElementCount => _tip[_tip.Length - 1];

        /// <summary>Elements of the outermost instrument.</summary>
        public int OuterCount => _tip[0];

        /// <summary>Where the instruments are along the chain.</summary>
        public HubPlaces Hubs { get; }

        /// <summary>Length in a sheath, m from the outer hub; 0 without one.</summary>
        public double Sheathed => Hubs.Sheathed;

        /// <summary>Elements, from the first on, with a twist angle that is unknown.</summary>
        public int ActiveCount { get; private set; }

        /// <summary>Positions of the chain's nodes along it, m.</summary>
        public double[] Stations => _station;

        /// <summary>Energy of all instruments before the chain, where they are kept straight, J.</summary>
        public double HeldInLead { get; private set; }

        /// <summary>The last half element of a chain that ends where several instruments are.</summary>
        public ref readonly CoaxialJoint Last => ref _last;

        /// <summary>The joint at node k, 0 at the hub.</summary>
        public ref readonly CoaxialJoint this[int k] => ref _joint[k];

        /// <summary>Gives the outermost instrument on an element.</summary>
        public int CarrierOf(int element) => _carrier[element];

        /// <summary>Gives the outermost instrument at a node, one of whose own nodes it is.</summary>
        public int CarrierAt(int node) => node <= OuterCount ? 0 : _carrier[node - 1];

        /// <summary>The instrument on whose frame the joint at node k stands.</summary>
        public int FrameOf(int k) => _carrier[Math.Min(k, ElementCount - 1)];

        /// <summary>Sums over pieces of these instruments.</summary>
        public CoaxialPieces CreatePieces() =>
            new CoaxialPieces(Array.ConvertAll(_instrument, instrument => instrument.Profile));

        /// <summary>Adds what is on both sides of the joint at node k, no end of the chain.</summary>
        public void AddSides(int k, CoaxialPieces sides)
        {
            var joint = default(CoaxialJoint);
            AddSide(ref joint, k, k - 1, FrameOf(k), sides);
            AddSide(ref joint, k, k + 1, FrameOf(k), sides);
        }

        /// <summary>Gives the nodes of an instrument in the chain, from its tip on.</summary>
        public int BeyondOf(int instrument) => _beyond[instrument];

        /// <summary>The last node of an instrument in the chain, or that where its tip is inside.</summary>
        public int TipOf(int instrument) => _tip[instrument];

        /// <summary>Gives the distance of an instrument's hub behind the outermost one's, m.</summary>
        public double LeadOf(int instrument) => Hubs.Leads[instrument];

        /// <summary>Where a node of an inner instrument is, m along the chain.</summary>
        /// <param name="fromTip">0 at its tip.</param>
        public double StationOf(int instrument, int fromTip)
        {
            double[] station = _instrument[instrument].Stations;
            return station[station.Length - 1 - fromTip] - Hubs.Leads[instrument];
        }

        /// <summary>Gives the distance of an instrument's tip beyond that of another, m; negative inside.</summary>
        public double ExtensionOf(int instrument, int outer) =>
            _instrument[instrument].Profile.Length - Hubs.Leads[instrument] - Hubs.Ends[outer];

        /// <summary>Elements, from the first on, where the twist angle of an inner instrument is unknown.</summary>
        public int ActiveCountOf(int instrument) => _active[instrument];

        /// <summary>Compliance along the axis of an instrument in an element, m/N, as far as it is in it.</summary>
        public double StretchOf(int instrument, int element) => _stretch[instrument * ElementCount + element];

        /// <summary>The same of all before the chain and after the outermost hub, held together, m/N.</summary>
        public double LeadAxial { get; private set; }

        /// <summary>The same between two places there, m from that hub.</summary>
        /// <param name="own">Of one instrument alone.</param>
        public double AxialBetween(double from, double to, int instrument, out double own)
        {
            var none = default(CoaxialJoint);
            _before.Clear();
            _before.AddSide(ref none, to, from, 0, 0, Hubs);
            own = _before.Stretch[instrument];
            return _before.Axial;
        }

        /// <summary>Gives the same of its length before the chain.</summary>
        public double LeadStretchOf(int instrument) => _leadStretch[instrument];

        /// <summary>Whether node k is the tip of an instrument with another one going on beyond it.</summary>
        public bool IsTip(int k) => k > 0 && k < ElementCount && _carrier[k] != _carrier[k - 1];

        /// <summary>Whether several instruments are in the last half element.</summary>
        public bool HasLast => _carrier[ElementCount - 1] < InnerCount && ActiveCount == ElementCount;

        /// <summary>The length of the chain that the joint at node k stands for, m.</summary>
        public double LengthOf(int k) => 0.5 * (_station[Math.Min(k + 1, ElementCount)] - _station[Math.Max(k - 1, 0)]);

        /// <summary>The fraction of that, weighted by the joint's hat function, that is not in a sheath.</summary>
        public double FractionOutside(int k) => Hubs.FractionOutside(k, _station, ElementCount);

        /// <summary>The next position along the chain after one, m, up to which forces at a border are linear: a node
        /// or a border of an instrument.</summary>
        public double NextBreak(double position)
        {
            double next = double.PositiveInfinity;
            for (int k = 0; k <= ElementCount; k++)
            {
                next = _station[k] > position ? Math.Min(next, _station[k]) : next;
            }
            for (int i = 0; i < Count; i++)
            {
                next = Math.Min(next, _instrument[i].Profile.NextBorder(position, Hubs.Leads[i]));
            }
            return next;
        }

        /// <summary>What an instrument is made of at node k.</summary>
        public ref readonly CrossSection PieceAt(int k, int instrument)
        {
            InstrumentProfile profile = _instrument[instrument].Profile;
            return ref profile.Pieces[profile.PieceAt(_station[k] + Hubs.Leads[instrument])];
        }

        /// <summary>Whether an instrument is where the chain begins: its tip is not before that.</summary>
        public bool IsAtStart(int instrument) => Hubs.Ends[instrument] > _station[0];

        /// <summary>What an instrument is made of where the chain begins; where a border is there, what is before
        /// it.</summary>
        public ref readonly CrossSection PieceAtHub(int instrument) =>
            ref _instrument[instrument].Profile.PieceUpTo(_station[0], Hubs.Leads[instrument]);

        /// <summary>The inner hubs are this far behind the outermost one, and that one this far in a sheath.</summary>
        /// <param name="leads">m, of all instruments; 0 for the outermost one.</param>
        /// <param name="sheathed">m.</param>
        /// <returns>How many joints, from the first on, are others now.</returns>
        public int SetHubs(double[] leads, double sheathed)
        {
            double most = Math.Max(Hubs.Sheathed, sheathed);   // no number at first
            bool slides = double.IsNaN(most);
            Hubs.Sheathed = sheathed;
            Version++;
            ActiveCount = 0;
            HeldInLead = 0.0;
            for (int i = 0; i < Count; i++)
            {
                slides |= leads[i] != Hubs.Leads[i];
                Hubs.Leads[i] = leads[i];
                Hubs.SetEnd(i, _instrument[i].Profile.Length - leads[i], i > 0 ? StationOf(i - 1, 0) : 0.0);
                if (i > 0)
                {
                    SetStations(i);
                    SetActive(i);
                }
            }
            int end = 0;
            for (; end <= ElementCount && (slides || end == 0 || _station[end - 1] < most); end++)
            {
                SetJoint(end);
            }
            _last = default;
            if (_carrier[ElementCount - 1] < InnerCount)
            {
                int n = ElementCount;
                AddSide(ref _last, n, n - 1, _carrier[n - 1], _before);
            }
            return end;
        }

        private void SetStations(int instrument)
        {
            double[] station = _instrument[instrument].Stations;
            int first = station.Length - 1 - _beyond[instrument];
            for (int k = 1; k <= _beyond[instrument]; k++)
            {
                _station[_tip[instrument - 1] + k] = station[first + k] - Hubs.Leads[instrument];
            }
        }

        private void SetActive(int instrument)
        {
            int most = _tip[instrument - 1];
            double end = Math.Min(Hubs.Ends[instrument], _station[most]);
            int active = 0;
            while (active < most && _station[active] < end)
            {
                active++;
            }
            _active[instrument] = active;
            ActiveCount = Math.Max(ActiveCount, active);
        }

        private void SetJoint(int k)
        {
            ref CoaxialJoint joint = ref _joint[k];
            joint = default;
            int frame = FrameOf(k);
            _before.Clear();
            _after.Clear();
            if (k > 0)
            {
                AddSide(ref joint, k, k - 1, frame, _before);
            }
            if (k < ElementCount)
            {
                AddSide(ref joint, k, k + 1, frame, _after);
                SetElement(ref joint, k);
            }
            if (k == 0)
            {
                SetLeads();
                _after.Compliance[frame] += _compliance[frame];
                _after.Rest[frame] += _rest[frame];
            }
            joint.Twist = 1.0 / (_before.Compliance[frame] + _after.Compliance[frame]);
            joint.RestTwist = _before.Rest[frame] + _after.Rest[frame];
            bool isFirst = true;
            for (int i = 0; i < Count; i++)
            {
                if (i != frame)
                {
                    SetPart(ref (isFirst ? ref joint.First : ref joint.Second), k, i, i > frame);
                    isFirst = false;
                }
            }
        }

        private void SetElement(ref CoaxialJoint joint, int j)
        {
            joint.Axial = _after.Axial;
            joint.Shear = _after.Shear;
            for (int i = 0; i < Count; i++)
            {
                _stretch[i * ElementCount + j] = _after.Stretch[i];
            }
        }

        private void SetPart(ref CoaxialPart part, int k, int instrument, bool isInside)
        {
            double shared = _before.Shared[instrument] + _after.Shared[instrument];
            double compliance = _before.Compliance[instrument] + _after.Compliance[instrument];
            double rest = _before.Rest[instrument] + _after.Rest[instrument];
            part.Weight = shared > 0.0 ? _after.Shared[instrument] / shared : 0.0;
            if (k == 0)
            {
                double own = compliance;
                compliance += _compliance[instrument];
                rest += _rest[instrument];
                part.Weight = 1.0 - 0.5 * own / compliance;
            }
            part.RestTwist = rest;
            if (isInside && k < _active[instrument])
            {
                part.Twist = 1.0 / compliance;
            }
            else
            {
                part.Weight = 0.0;
            }
        }

        private void AddSide(ref CoaxialJoint joint, int k, int other, int frame, CoaxialPieces side) =>
            side.AddSide(ref joint, _station[k], _station[other], _carrier[Math.Min(k, other)], frame, Hubs);

        // Of all instruments before the chain.
        private void SetLeads()
        {
            LeadAxial = AxialBetween(0.0, _station[0], 0, out _);
            _before.Clear();
            for (int i = 0; i < Count; i++)
            {
                InstrumentProfile profile = _instrument[i].Profile;
                _leadStretch[i] = 0.0;
                _compliance[i] = 0.0;
                _rest[i] = 0.0;
                for (int p = 0; p < profile.Pieces.Length; p++)
                {
                    double end = Math.Min(Hubs.Leads[i] + _station[0], profile.Borders[p + 1]);
                    double length = end - profile.Borders[p];
                    if (length > 0.0)
                    {
                        ref CrossSection piece = ref profile.Pieces[p];
                        _compliance[i] += length / piece.TwistStiffness;
                        _leadStretch[i] += length / piece.StretchStiffness;
                        _rest[i] += length * piece.RestCurvature.Z;
                        HeldInLead += length * CoaxialPieces.Straightened(piece);
                    }
                }
            }
        }
    }
}
