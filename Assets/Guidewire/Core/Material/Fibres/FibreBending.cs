using System;

namespace Guidewire.Core
{
    /// <summary>What the fibres of a wire that yields, or gives way on a plateau, add to the linear energy of bending
    /// (<see cref="FibreSection"/>).</summary>
    /// <remarks>A joint is of pieces in series, each with a length lambda by the joint's hat function, a stiffness B of
    /// all that is there, and as linear joint the curvature kappa = K (theta - F)/B + kappa_0. The correction is sum
    /// lambda w(kappa - kappa_i) over its pieces and their instruments, the curvature turned into the instrument's own
    /// frame. As w'' is at least -B, the joint stays stable: K - K^2 sum lambda/B = 0. With the weights of a clamp's
    /// rule K sum lambda/B is 1, too.
    ///
    /// Of several instruments kappa depends on their angles t, and <see cref="CoaxialBendTwist"/> takes the correction
    /// into its joints. Lengths are linear in the places of hubs, so the force that drives instruments out has it
    /// exactly (<see cref="Release"/>). The memory moves at a step's end only.</remarks>
    internal sealed class FibreBending : EnergyTerm
    {
        private const int Neighbours = 3;   // joints beside one in which a node of an instrument inside may be, too

        private readonly BendTwistTerm _bending;
        private readonly RodSupports _supports;
        private readonly MaterialRod _rod;
        private readonly CoaxialJoints? _joints;       // null of a wire alone
        private readonly HubPlaces _places;
        private readonly CoaxialPieces _sides;
        private readonly int[][] _nodeOf;              // of pieces cut at the middles of elements, by instrument
        private readonly int[][] _pieceOf;             // and which piece of the material they are
        private readonly StructList<FibrePiece>[] _pieces;   // of each joint
        private readonly StructList<FibrePiece> _rates = new StructList<FibrePiece>(4);
        private readonly double[] _jointLengths;
        private readonly double[] _mixed;              // e_n where material passes the exit
        private readonly bool _isAlone;
        private StructList<FibrePiece> _list;          // that takes pieces
        private int _joint;
        private int _other;
        private double _weight = 1.0;
        private int _version = -1;
        private bool _dropsGeometricStiffness;
        private RodBlock _clampBlock;
        private RodVector _clampVector;

        private FibreBending(MaterialRod rod, RodSupports supports, BendTwistTerm bending, FibreMemory?[] memory)
        {
            _rod = rod;
            _supports = supports;
            _bending = bending;
            Memory = memory;
            _joints = supports.Coaxial?.Joints;
            _isAlone = supports.InnerCount == 0;
            int count = memory.Length;
            _nodeOf = new int[count][];
            _pieceOf = new int[count][];
            var profiles = new InstrumentProfile[count];
            int most = 1;
            for (int i = 0; i < count; i++)
            {
                InstrumentProfile profile = supports.Coaxial?.ProfileOf(i) ?? memory[i]!.Profile;
                profiles[i] = Cut(profile, _isAlone ? null : memory[i], out _nodeOf[i], out _pieceOf[i]);
                foreach (FibreSection? section in memory[i]?.Sections ?? Array.Empty<FibreSection?>())
                {
                    most = Math.Max(most, section?.StateCount ?? 0);
                }
            }
            _mixed = new double[most];
            _sides = new CoaxialPieces(profiles) { Added = AddPiece };
            _places = _joints?.Hubs ?? new HubPlaces(1) { Sheathed = -1.0 };
            _places.Ends[0] = _joints == null ? profiles[0].Length : _places.Ends[0];
            _pieces = new StructList<FibrePiece>[rod.Capacity + 1];
            for (int k = 0; k < _pieces.Length; k++)
            {
                _pieces[k] = new StructList<FibrePiece>(2);
            }
            _list = _rates;
            _jointLengths = new double[rod.Capacity + 1];
            Remesh();
        }

        /// <summary>The term of a rod; null where all of it is linear.</summary>
        public static FibreBending? Create(MaterialRod rod, RodSupports supports, BendTwistTerm bending)
        {
            FibreMemory?[] memory = supports.Coaxial?.Memory ?? new[] { rod.Fibres };
            return Array.Exists(memory, one => one != null) ? new FibreBending(rod, supports, bending, memory) : null;
        }

        /// <summary>What the fibres of each instrument remember; null of a linear one.</summary>
        public FibreMemory?[] Memory { get; }

        /// <summary>Energy that the material has turned into heat, J.</summary>
        public double Loss { get; private set; }

        /// <summary>What bends that cores keep store where the wire is held straight before the rod, in a sheath or in
        /// another instrument, J.</summary>
        public double LeadEnergy
        {
            get
            {
                Update();
                var sum = default(FibreCurve);
                foreach (FibreMemory? memory in Memory)
                {
                    for (int slot = 0; memory != null && slot < memory.Remembers.Length; slot++)
                    {
                        if (memory.Remembers[slot] && memory.Outside[slot] + memory.Inside[slot] == 0.0)
                        {
                            Vector3d rest = memory.Profile.Pieces[memory.PieceOf(slot)].RestCurvature;
                            memory.Sections[slot]!.Add(-rest.X, -rest.Y, memory.Straight, memory.StartOf(slot),
                                memory.LengthOf(slot), ref sum);
                        }
                    }
                }
                return sum.Energy;
            }
        }

        /// <summary>How many fibre states there are.</summary>
        public int StateCount
        {
            get
            {
                int count = 0;
                foreach (FibreMemory? memory in Memory)
                {
                    count += memory?.Bent.Length ?? 0;
                }
                return count;
            }
        }

        /// <inheritdoc/>
        public override void Remesh()
        {
            _version = -1;
            Update();
            foreach (FibreMemory? memory in Memory)
            {
                for (int slot = 0; memory != null && slot < memory.Remembers.Length; slot++)
                {
                    memory.KeepLengths(slot, isNew: true);
                }
            }
        }

        /// <inheritdoc/>
        public override void DropGeometricStiffness(bool isOn) => _dropsGeometricStiffness = isOn;

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            for (int k = 0; _isAlone && k <= LastJoint(shape); k++)
            {
                sum += At(shape, k, out FibreJoint joint) ? joint.Curve.Energy : 0.0;
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            int n = shape.ElementCount;
            for (int k = from == 0 ? 0 : from + 1; _isAlone && k <= Math.Min(to, LastJoint(shape)); k++)
            {
                if (At(shape, k, out FibreJoint joint))
                {
                    RotationVectorLaw.AddGradient(joint.Turn, joint.Moment,
                        ref k == 0 ? ref _clampVector : ref gradient[k - 1],
                        ref k == n ? ref _clampVector : ref gradient[k]);
                }
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            int n = shape.ElementCount;
            for (int k = from == 0 ? 0 : from + 1; _isAlone && k <= Math.Min(to, LastJoint(shape)); k++)
            {
                if (At(shape, k, out FibreJoint joint))
                {
                    _clampBlock = default;
                    joint.AddBlocks(_dropsGeometricStiffness, ref k == 0 ? ref _clampVector : ref gradient[k - 1],
                        ref k == n ? ref _clampVector : ref gradient[k],
                        ref k == 0 ? ref _clampBlock : ref blocks[k - 1],
                        ref k == n ? ref _clampBlock : ref blocks[k]);
                }
            }
        }

        /// <summary>Adds the couple of joint k on the element after it, N m, along that element's axes.</summary>
        public void AddCouple(RodShape shape, int k, ref RodVector before, ref RodVector after)
        {
            if (At(shape, k, out FibreJoint joint))
            {
                RotationVectorLaw.AddGradient(joint.Turn, joint.Moment, ref before, ref after);
            }
        }

        /// <summary>Adds the correction to a joint of several instruments.</summary>
        public void AddTo(int k, ref CoaxialJointState s)
        {
            if (!At(k, s, out FibreJoint joint))
            {
                return;
            }
            s.Fibres = joint;
            s.Held += joint.Curve.Energy;
            s.First.Slope += joint.First;
            s.First.Second += joint.FirstFirst;
            s.First.Mixed += joint.FirstMixed;
            s.Second.Slope += joint.Second;
            s.Second.Second += joint.SecondSecond;
            s.Second.Mixed += joint.SecondMixed;
            s.MixedSecond += joint.FirstSecond;
        }

        /// <summary>Whether any fibre has left its line in a shape.</summary>
        public bool GivesWay(RodShape shape)
        {
            bool givesWay = false;
            for (int k = 0; k <= LastJoint(shape); k++)
            {
                givesWay |= At(shape, k, out _);
            }
            return givesWay;
        }

        /// <summary>The step that began last is accepted: the fibres remember.</summary>
        public override void EndStep(RodShape shape)
        {
            Update();
            double before = TakeStates(shape);
            foreach (FibreMemory? memory in Memory)
            {
                for (int slot = 0; memory != null && slot < memory.Remembers.Length; slot++)
                {
                    Remember(memory, slot);
                }
            }
            Loss += before == 0.0 ? 0.0 : before - All(shape);
        }

        /// <summary>Goes on where another chain of instruments was: the same ones remember what they did.</summary>
        public void TakeOver(FibreBending? former, bool[] isOther)
        {
            Loss = former?.Loss ?? 0.0;
            for (int i = 0; i < Memory.Length && former != null; i++)
            {
                if (!isOther[i] && former.Memory[i] is FibreMemory was)
                {
                    Memory[i]?.CopyFrom(was);
                }
            }
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            Loss = snapshot.Serialize(Loss);
            foreach (FibreMemory? memory in Memory)
            {
                memory?.Serialize(snapshot, _joints != null);
            }
        }

        /// <summary>Its pieces are those of the hubs as they are now.</summary>
        public void FollowHubs() => Update();

        /// <summary>Begins the derivative of a joint by the place of a hub.</summary>
        public void BeginRate()
        {
            Update();
            _rates.Clear();
        }

        /// <summary>Adds the derivatives of lengths on one side of the joint at node k.</summary>
        /// <returns>Whether any is not 0.</returns>
        public bool AddSideRate(int k, int other, HubSpeeds speeds, double nodeSpeed, double farSpeed)
        {
            Begin(_rates, k, other);
            var none = default(CoaxialJoint);
            _sides.AddSideRate(ref none, _joints!.Stations[k], _joints.Stations[other],
                _joints.CarrierOf(Math.Min(k, other)), _joints.FrameOf(k), _joints.Hubs, speeds, nodeSpeed, farSpeed);
            return _rates.Count > 0;
        }

        /// <summary>The derivative of the correction by the place of a hub.</summary>
        /// <param name="rate">Derivatives of the joint's sums.</param>
        /// <param name="rest">Derivative of its turn at rest.</param>
        public double RateOf(RodShape shape, int k, in CoaxialJointState s, in CoaxialJoint rate, in Vector3d rest)
        {
            Angles angles = AnglesOf(k, s);
            double sum = 0.0;
            for (int p = 0; p < _rates.Count; p++)
            {
                ref FibrePiece piece = ref _rates[p];
                FibreMemory memory = Memory[piece.Instrument]!;
                Vector3d curvature = piece.Curvature(angles, out _);
                double[] states = StatesOf(memory, piece, out int from);
                FibreSection section = memory.Sections[piece.Slot]!;
                var curve = default(FibreCurve);
                section.Add(curvature.X, curvature.Y, states, from, 1.0, ref curve);
                sum += piece.Length * (curve.Energy + Passing(shape, k, piece));
            }
            if (At(k, s, out FibreJoint joint))
            {
                double moment1 = s.Joint.Bend1 * (s.Turn.X - s.Joint.Rest.X);
                double moment2 = s.Joint.Bend2 * (s.Turn.Y - s.Joint.Rest.Y);
                sum -= joint.Curve.Moment1 * (rate.Compliance1 * moment1 + rest.X)
                    + joint.Curve.Moment2 * (rate.Compliance2 * moment2 + rest.Y);
            }
            return sum;
        }

        // The change of w by the states that pass the exit while a piece grows, J/m. Of a length L that has grown by g
        // e_n is e + g/L (e' - e), the other side's e'; where it has shrunk the straight side has that, of its length.
        private double Passing(RodShape shape, int k, in FibrePiece piece)
        {
            FibreMemory memory = Memory[piece.Instrument]!;
            double growth = memory.Remembers[piece.Slot] ? memory.Growth(piece.Slot) : 0.0;
            if (growth >= 0.0)
            {
                return growth == 0.0 || piece.IsInside ? 0.0
                    : memory.OwnShare(piece.Slot, false) * Passing(shape, k, piece, false);
            }
            return (piece.IsInside ? memory.OwnShare(piece.Slot, true) - 1.0 : -1.0) * Passing(shape, k, piece, true);
        }

        // By the state of the other side in place of a side's own, of a unit of its length, in all joints of a slot.
        private double Passing(RodShape shape, int k, in FibrePiece passing, bool isInside)
        {
            FibreMemory memory = Memory[passing.Instrument]!;
            double[] own = isInside ? memory.Straight : memory.Bent;
            double[] others = isInside ? memory.Bent : memory.Straight;
            double sum = 0.0;
            double length = 0.0;
            for (int j = Math.Max(0, k - Neighbours); j <= Math.Min(k + Neighbours, LastJoint(shape)); j++)
            {
                _bending.Evaluate(shape, j, out CoaxialJointState s);
                Angles angles = AnglesOf(j, s);
                for (int p = 0; p < _pieces[j].Count; p++)
                {
                    ref FibrePiece piece = ref _pieces[j][p];
                    if (piece.Instrument == passing.Instrument && piece.Slot == passing.Slot
                        && piece.IsInside == isInside)
                    {
                        Vector3d curvature = piece.Curvature(angles, out _);
                        double[] states = StatesOf(memory, piece, out int from);
                        sum += piece.Length * memory.Sections[piece.Slot]!.Towards(curvature.X, curvature.Y, states,
                            from, own, others, memory.StartOf(piece.Slot));
                        length += piece.Length;
                    }
                }
            }
            return length > 0.0 ? sum / length : 0.0;
        }

        /// <summary>Finds the largest strain of the fibres, and the share of the section there whose fibres have left
        /// their line.</summary>
        /// <param name="take">Takes instrument, node, strain of the outermost fibre, share and section.</param>
        public void Visit(RodShape shape, Action<int, int, double, double, FibreSection> take)
        {
            Update();
            for (int k = 0; k <= LastJoint(shape); k++)
            {
                StructList<FibrePiece> pieces = _pieces[k];
                if (pieces.Count == 0)
                {
                    continue;
                }
                _bending.Evaluate(shape, k, out CoaxialJointState s);
                Angles angles = AnglesOf(k, s);
                for (int p = 0; p < pieces.Count; p++)
                {
                    FibreMemory memory = Memory[pieces[p].Instrument]!;
                    Vector3d curvature = pieces[p].Curvature(angles, out _);
                    FibreSection section = memory.Sections[pieces[p].Slot]!;
                    double share = pieces[p].IsInside ? 0.0
                        : section.ShareBeyond(memory.Bent, memory.StartOf(pieces[p].Slot));
                    take(pieces[p].Instrument, memory.NodeOf(pieces[p].Slot),
                        section.Radius * Math.Sqrt(curvature.X * curvature.X + curvature.Y * curvature.Y), share,
                        section);
                }
            }
        }

        /// <summary>The largest curvature that cores which yield keep without a couple, rad/m, and where, m from the
        /// hub.</summary>
        public (double Curvature, double Place) LargestKept()
        {
            (double Curvature, double Place) largest = (0.0, double.NaN);
            foreach (FibreMemory? memory in Memory)
            {
                for (int slot = 0; memory != null && slot < memory.Remembers.Length; slot++)
                {
                    if (memory.Remembers[slot])
                    {
                        int node = memory.NodeOf(slot);
                        FibreSection section = memory.Sections[slot]!;
                        double stiffness = memory.Profile.Pieces[memory.PieceOf(slot)].BendStiffness1;
                        double kept = Math.Max(section.Kept(memory.Bent, memory.StartOf(slot), stiffness),
                            section.Kept(memory.Straight, memory.StartOf(slot), stiffness));
                        largest = kept > largest.Curvature ? (kept, memory.Stations[node]) : largest;
                    }
                }
            }
            return largest;
        }

        private int LastJoint(RodShape shape) =>
            _joints == null && _supports.HasDistalJoint ? shape.ElementCount : shape.ElementCount - 1;

        // A joint of a wire alone in a shape; false where it is linear.
        private bool At(RodShape shape, int k, out FibreJoint joint)
        {
            Update();
            joint = default;
            if (_pieces[k].Count == 0 || (k == 0 && !_supports.HasProximalJoint))
            {
                return false;
            }
            _bending.Evaluate(shape, k, out CoaxialJointState s);
            return At(k, s, out joint);
        }

        private bool At(int k, in CoaxialJointState s, out FibreJoint joint)
        {
            Update();
            joint = default;
            StructList<FibrePiece> pieces = _pieces[k];
            bool isActive = false;
            Angles angles = AnglesOf(k, s);
            for (int p = 0; p < pieces.Count; p++)
            {
                ref FibrePiece piece = ref pieces[p];
                if (!IsActive(piece, angles, out Vector3d curvature, out Vector3d turned))
                {
                    continue;
                }
                isActive = true;
                FibreMemory memory = Memory[piece.Instrument]!;
                double[] states = StatesOf(memory, piece, out int from);
                var curve = default(FibreCurve);
                memory.Sections[piece.Slot]!.Add(curvature.X, curvature.Y, states, from, piece.Length, ref curve);
                joint.Curve.Energy += curve.Energy;
                if (!piece.IsInside)
                {
                    joint.Add(piece, angles, curve, turned);
                }
            }
            joint.Turn = s.Turn;
            return isActive;
        }

        private bool IsActive(in FibrePiece piece, in Angles angles, out Vector3d curvature, out Vector3d turned)
        {
            FibreMemory memory = Memory[piece.Instrument]!;
            curvature = piece.Curvature(angles, out turned);
            return memory.Remembers[piece.Slot]
                || !memory.Sections[piece.Slot]!.IsElastic(curvature.X, curvature.Y);
        }

        private Angles AnglesOf(int k, in CoaxialJointState s)
        {
            var angles = new Angles
            {
                Moment = new Vector3d(s.Joint.Bend1 * (s.Turn.X - s.Joint.Rest.X),
                    s.Joint.Bend2 * (s.Turn.Y - s.Joint.Rest.Y), 0.0),
                Bend1 = s.Joint.Bend1,
                Bend2 = s.Joint.Bend2,
            };
            if (!_isAlone)
            {
                ref readonly CoaxialJoint joint = ref _joints![k];
                angles.First = s.First.Mean(joint.First);
                angles.Second = s.Second.Mean(joint.Second);
                angles.FirstRest = new Vector3d(joint.First.RestX, joint.First.RestY, 0.0);
                angles.SecondRest = new Vector3d(joint.Second.RestX, joint.Second.RestY, 0.0);
            }
            return angles;
        }

        // e_n of the fibres of a piece.
        private double[] StatesOf(FibreMemory memory, in FibrePiece piece, out int from)
        {
            from = memory.StartOf(piece.Slot);
            double[] own = piece.IsInside ? memory.Straight : memory.Bent;
            double share = memory.OwnShare(piece.Slot, piece.IsInside);
            if (share == 1.0 || !memory.Remembers[piece.Slot])
            {
                return own;
            }
            double[] other = piece.IsInside ? memory.Bent : memory.Straight;
            int count = memory.Sections[piece.Slot]!.StateCount;
            for (int i = 0; i < count; i++)
            {
                _mixed[i] = share * own[from + i] + (1.0 - share) * other[from + i];
            }
            from = 0;
            return _mixed;
        }

        private double All(RodShape shape)
        {
            double sum = 0.0;
            for (int k = 0; k <= LastJoint(shape); k++)
            {
                sum += At(shape, k, out FibreJoint joint) ? joint.Curve.Energy : 0.0;
            }
            return sum;
        }

        // Sums e over the pieces of each slot; the energy before the memory moves, J.
        private double TakeStates(RodShape shape)
        {
            double energy = 0.0;
            for (int k = 0; k <= LastJoint(shape); k++)
            {
                if (!At(shape, k, out FibreJoint joint))
                {
                    continue;
                }
                energy += joint.Curve.Energy;
                _bending.Evaluate(shape, k, out CoaxialJointState s);
                Angles angles = AnglesOf(k, s);
                for (int p = 0; p < _pieces[k].Count; p++)
                {
                    ref FibrePiece piece = ref _pieces[k][p];
                    if (IsActive(piece, angles, out Vector3d curvature, out _))
                    {
                        FibreMemory memory = Memory[piece.Instrument]!;
                        double[] states = StatesOf(memory, piece, out int from);
                        memory.Sections[piece.Slot]!.AddOwn(curvature.X, curvature.Y, states, from, piece.Length,
                            piece.IsInside ? memory.StraightSums : memory.Sums, memory.StartOf(piece.Slot));
                        memory.IsTouched[piece.Slot] = true;
                    }
                }
            }
            return energy;
        }

        private static void Remember(FibreMemory memory, int slot)
        {
            memory.KeepLengths(slot, isNew: false);
            if (!memory.IsTouched[slot])
            {
                return;
            }
            memory.IsTouched[slot] = false;
            bool remembers = false;
            int from = memory.StartOf(slot);
            for (int i = from; i < from + memory.Sections[slot]!.StateCount; i++)
            {
                memory.Bent[i] = memory.Outside[slot] > 0.0 ? memory.Sums[i] / memory.Outside[slot] : 0.0;
                memory.Straight[i] = memory.Inside[slot] > 0.0 ? memory.StraightSums[i] / memory.Inside[slot] : 0.0;
                remembers |= memory.Bent[i] != 0.0 || memory.Straight[i] != 0.0;
                memory.Sums[i] = 0.0;
                memory.StraightSums[i] = 0.0;
            }
            memory.Remembers[slot] = remembers;
        }

        // Pieces of all joints, after a change of the hubs or of elements.
        private void Update()
        {
            int version = _joints?.Version ?? 0;
            if (version == _version)
            {
                return;
            }
            _version = version;
            int n = _rod.ElementCount;
            if (_joints == null)
            {
                _rod.SetJointLengths(_supports, _jointLengths);
            }
            foreach (FibreMemory? memory in Memory)
            {
                memory?.ClearLengths();
            }
            for (int k = 0; k <= n; k++)
            {
                _pieces[k].Clear();
                _weight = 1.0;
                if (_joints == null)
                {
                    _weight = _jointLengths[k]
                        / (0.5 * (_rod.Length[Math.Max(k - 1, 0)] + _rod.Length[Math.Min(k, n - 1)]));
                    // At an end there is half a joint on one side, and as much on the other.
                    _weight *= k == 0 || k == n ? 2.0 : 1.0;
                }
                AddSide(k, k - 1, n);
                AddSide(k, k + 1, n);
                _weight = 1.0;
            }
        }

        private void AddSide(int k, int other, int last)
        {
            if (other < 0 || other > last || (_joints != null && k == last))
            {
                return;
            }
            Begin(_pieces[k], k, other);
            double[] stations = _joints?.Stations ?? Memory[0]!.Stations;
            int element = Math.Min(k, other);
            var none = default(CoaxialJoint);
            _sides.AddSide(ref none, stations[k], stations[other], _joints?.CarrierOf(element) ?? 0,
                _joints?.FrameOf(k) ?? 0, _places);
        }

        private void Begin(StructList<FibrePiece> list, int k, int other) => (_list, _joint, _other) = (list, k, other);

        // Called for each piece of a side.
        private void AddPiece(double lambda, bool isInside)
        {
            double all = 0.0;
            int frame = _joints?.FrameOf(_joint) ?? 0;
            for (int i = 0; i < Memory.Length; i++)
            {
                all += _sides.IsPresent(i) ? _sides.PieceOf(i).BendStiffness1 : 0.0;
            }
            for (int i = 0; i < Memory.Length; i++)
            {
                FibreMemory? memory = Memory[i];
                if (memory == null || !_sides.IsPresent(i))
                {
                    continue;
                }
                int cut = _sides.IndexOf(i);
                int slot = memory.SlotOf(OwnNode(i) ?? _nodeOf[i][cut], _pieceOf[i][cut]);
                if (memory.Sections[slot] == null)
                {
                    continue;
                }
                var piece = new FibrePiece
                {
                    Instrument = i,
                    Slot = slot,
                    Angle = AngleOf(i, frame),
                    Length = _weight * lambda,
                    PerStiffness = 1.0 / all,
                    IsInside = isInside,
                    Own = _sides.PieceOf(i).RestCurvature,
                };
                for (int j = 0; j < Memory.Length && !isInside; j++)
                {
                    if (_sides.IsPresent(j))
                    {
                        CrossSection part = _sides.PieceOf(j);
                        piece.AddMean(AngleOf(j, frame), part.BendStiffness1 / all * part.RestCurvature);
                    }
                }
                piece.Settle();
                if (_list != _rates)
                {
                    memory.AddLength(slot, piece.Length, isInside);
                }
                _list.Add(piece);
            }
        }

        // 0: the joint's own frame; 1 and 2: the first and the second of the other instruments.
        private static int AngleOf(int instrument, int frame) =>
            instrument == frame ? 0 : instrument == 0 || (instrument == 1 && frame == 0) ? 1 : 2;

        // Of the outermost instrument on a side, where the joint is at one of its own nodes.
        private int? OwnNode(int instrument)
        {
            if (_joints == null)
            {
                return _joint;
            }
            if (instrument != _joints.CarrierOf(Math.Min(_joint, _other)))
            {
                return null;
            }
            if (instrument == 0)
            {
                return _joints.First + _joint;
            }
            return _joint > _joints.TipOf(instrument - 1)
                ? Memory[instrument]!.Stations.Length - 1 - (_joints.TipOf(instrument) - _joint) : (int?)null;
        }

        // The pieces of a material, cut at the middles of elements: each stands for the node next to it.
        private static InstrumentProfile Cut(InstrumentProfile profile, FibreMemory? memory, out int[] nodes,
            out int[] pieces)
        {
            var borders = new System.Collections.Generic.List<double>(profile.Borders);
            double[] stations = memory?.Stations ?? Array.Empty<double>();
            for (int k = 1; k < stations.Length; k++)
            {
                double middle = 0.5 * (stations[k - 1] + stations[k]);
                if (!borders.Contains(middle) && middle < profile.Length)
                {
                    borders.Add(middle);
                }
            }
            borders.Sort();
            nodes = new int[borders.Count - 1];
            pieces = new int[borders.Count - 1];
            var sections = new CrossSection[borders.Count - 1];
            int node = 0;
            for (int p = 0; p < sections.Length; p++)
            {
                double middle = 0.5 * (borders[p] + borders[p + 1]);
                while (node + 1 < stations.Length && 0.5 * (stations[node] + stations[node + 1]) <= middle)
                {
                    node++;
                }
                nodes[p] = node;
                pieces[p] = profile.PieceAt(middle);
                sections[p] = profile.Pieces[pieces[p]];
            }
            return new InstrumentProfile(borders.ToArray(), sections);
        }
    }

    /// <summary>A piece of a joint whose section has a law.</summary>
    internal struct FibrePiece
    {
        public int Instrument;
        public int Slot;
        public int Angle;             // by which the instrument is turned: none, first or second
        public double Length;         // lambda, m
        public double PerStiffness;   // 1/B, 1/(N m^2)
        public bool IsInside;         // a sheath
        public Vector3d Own;          // curvature at rest in its own frame, rad/m; 0 where it has no angle
        public Vector3d Mean;         // kappa_0 of what has no angle, less that
        public Vector3d First;        // and of the two others, each in its own frame
        public Vector3d Second;

        /// <summary>Adds the share of an instrument in kappa_0.</summary>
        public void AddMean(int angle, in Vector3d share)
        {
            Vector3d flat = new Vector3d(share.X, share.Y, 0.0);
            Mean += angle == 0 ? flat : Vector3d.Zero;
            First += angle == 1 ? flat : Vector3d.Zero;
            Second += angle == 2 ? flat : Vector3d.Zero;
        }

        /// <summary>All shares are known.</summary>
        public void Settle()
        {
            Own = new Vector3d(Own.X, Own.Y, 0.0);
            if (Angle == 0 && !IsInside)
            {
                Mean -= Own;
                Own = Vector3d.Zero;
            }
        }

        /// <summary>Curvature less that at rest, in the instrument's own frame.</summary>
        /// <param name="turned">The curvature itself in that frame.</param>
        public readonly Vector3d Curvature(in Angles angles, out Vector3d turned)
        {
            turned = Vector3d.Zero;
            if (!IsInside)
            {
                turned = PerStiffness * angles.Moment + Mean;
                if (First != Vector3d.Zero)
                {
                    turned += Angles.Turn(First, angles.First);
                }
                if (Second != Vector3d.Zero)
                {
                    turned += Angles.Turn(Second, angles.Second);
                }
                turned = Angle == 0 ? turned : Angles.Turn(turned, -angles.Of(Angle));
            }
            return turned - Own;
        }
    }

    /// <summary>What the curvature of a joint's pieces depends on.</summary>
    internal struct Angles
    {
        public Vector3d Moment;       // K (theta - F) about d1 and d2, N m
        public double Bend1, Bend2;   // K
        public double First, Second;  // radians
        public Vector3d FirstRest, SecondRest;   // F', rad

        /// <summary>The angle of that number.</summary>
        public readonly double Of(int angle) => angle == 1 ? First : Second;

        /// <summary>A vector turned about d3.</summary>
        public static Vector3d Turn(in Vector3d v, double angle)
        {
            double c = Math.Cos(angle);
            double s = Math.Sin(angle);
            return new Vector3d(c * v.X - s * v.Y, s * v.X + c * v.Y, 0.0);
        }
    }

    /// <summary>The correction of a joint with its derivatives by the turn about d1 and d2 and by two angles.</summary>
    internal struct FibreJoint
    {
        public FibreCurve Curve;      // by the turn
        public Vector3d Turn;         // rad
        public double First, Second;  // by the angles
        public double FirstFirst, SecondSecond, FirstSecond;
        public Vector3d FirstMixed, SecondMixed;   // by an angle and the turn

        /// <summary>The couple, N m.</summary>
        public readonly Vector3d Moment => new Vector3d(Curve.Moment1, Curve.Moment2, 0.0);

        /// <summary>Adds a piece.</summary>
        /// <param name="curve">Its energy by its curvature.</param>
        /// <param name="turned">The curvature in the instrument's frame.</param>
        public void Add(in FibrePiece piece, in Angles angles, in FibreCurve curve, in Vector3d turned)
        {
            double k1 = angles.Bend1 * piece.PerStiffness;
            double k2 = angles.Bend2 * piece.PerStiffness;
            bool hasAngles = piece.Angle > 0 || piece.First != Vector3d.Zero || piece.Second != Vector3d.Zero
                || angles.FirstRest != Vector3d.Zero || angles.SecondRest != Vector3d.Zero;
            if (!hasAngles)
            {
                Curve.Moment1 += k1 * curve.Moment1;
                Curve.Moment2 += k2 * curve.Moment2;
                Curve.Slope11 += k1 * k1 * curve.Slope11;
                Curve.Slope12 += k1 * k2 * curve.Slope12;
                Curve.Slope22 += k2 * k2 * curve.Slope22;
                return;
            }
            // Derivatives of the curvature by turn, turn, first and second angle.
            double back = piece.Angle == 0 ? 0.0 : -angles.Of(piece.Angle);
            Span<Vector3d> d = stackalloc Vector3d[4];
            d[0] = Angles.Turn(new Vector3d(k1, 0.0, 0.0), back);
            d[1] = Angles.Turn(new Vector3d(0.0, k2, 0.0), back);
            d[2] = Angles.Turn(ByAngle(piece.First, angles.FirstRest, k1, k2, angles.First, out Vector3d first), back);
            d[3] = Angles.Turn(ByAngle(piece.Second, angles.SecondRest, k1, k2, angles.Second, out Vector3d second),
                back);
            var m = new Vector3d(curve.Moment1, curve.Moment2, 0.0);
            double ff = Vector3d.Dot(m, Angles.Turn(first, back));
            double ss = Vector3d.Dot(m, Angles.Turn(second, back));
            if (piece.Angle > 0)
            {
                int z = 1 + piece.Angle;
                double own = -2.0 * Vector3d.Dot(m, Across(d[z])) - Vector3d.Dot(m, turned);
                ff += z == 2 ? own : 0.0;
                ss += z == 3 ? own : 0.0;
                FirstSecond -= Vector3d.Dot(m, Across(d[5 - z]));
                Vector3d mixed = new Vector3d(-Vector3d.Dot(m, Across(d[0])), -Vector3d.Dot(m, Across(d[1])), 0.0);
                FirstMixed += z == 2 ? mixed : Vector3d.Zero;
                SecondMixed += z == 3 ? mixed : Vector3d.Zero;
                d[z] -= Across(turned);
            }
            Curve.Moment1 += Vector3d.Dot(m, d[0]);
            Curve.Moment2 += Vector3d.Dot(m, d[1]);
            First += Vector3d.Dot(m, d[2]);
            Second += Vector3d.Dot(m, d[3]);
            Curve.Slope11 += Twice(curve, d[0], d[0]);
            Curve.Slope12 += Twice(curve, d[0], d[1]);
            Curve.Slope22 += Twice(curve, d[1], d[1]);
            FirstMixed += new Vector3d(Twice(curve, d[0], d[2]), Twice(curve, d[1], d[2]), 0.0);
            SecondMixed += new Vector3d(Twice(curve, d[0], d[3]), Twice(curve, d[1], d[3]), 0.0);
            FirstFirst += ff + Twice(curve, d[2], d[2]);
            SecondSecond += ss + Twice(curve, d[3], d[3]);
            FirstSecond += Twice(curve, d[2], d[3]);
        }

        /// <summary>Adds gradient and second derivatives of the joint by its two frames.</summary>
        public readonly void AddBlocks(bool dropsGeometricStiffness, ref RodVector a, ref RodVector b,
            ref RodBlock blockA, ref RodBlock blockB)
        {
            RotationVectorLaw.AddGradient(Turn, Moment, ref a, ref b);
            RotationVectorLaw.AddBlocks(Turn, dropsGeometricStiffness ? Vector3d.Zero : Moment, Curve.Slope11,
                Curve.Slope12, Curve.Slope22, ref blockA, ref blockB);
        }

        // Derivatives of R(t) kappa - K R(t) F'/B by t.
        private static Vector3d ByAngle(in Vector3d mean, in Vector3d rest, double k1, double k2, double angle,
            out Vector3d second)
        {
            Vector3d turned = Angles.Turn(mean, angle);
            Vector3d turnedRest = Angles.Turn(rest, angle);
            second = new Vector3d(k1 * turnedRest.X - turned.X, k2 * turnedRest.Y - turned.Y, 0.0);
            return new Vector3d(k1 * turnedRest.Y - turned.Y, turned.X - k2 * turnedRest.X, 0.0);
        }

        private static Vector3d Across(in Vector3d v) => new Vector3d(-v.Y, v.X, 0.0);

        private static double Twice(in FibreCurve curve, in Vector3d a, in Vector3d b) =>
            curve.Slope11 * a.X * b.X + curve.Slope12 * (a.X * b.Y + a.Y * b.X) + curve.Slope22 * a.Y * b.Y;
    }
}
