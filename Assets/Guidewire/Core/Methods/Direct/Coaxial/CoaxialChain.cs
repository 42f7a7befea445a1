using System;

namespace Guidewire.Core
{
    /// <summary>What is simulated of coaxial instruments: one <see cref="MonitoredRod"/>, built anew wherever nodes
    /// come or go.</summary>
    /// <remarks>Which nodes are there <see cref="CoaxialNodes"/> finds. It is also built anew where a tip inside comes
    /// into another element. Of an instrument alone the part in its sheath is left out: it is straight, massless, and
    /// evenly stretched and twisted. What comes in has the strain and the twist of that.</remarks>
    internal sealed class CoaxialChain
    {
        private readonly MethodParameters _method;
        private readonly SolverReport _report;
        private readonly CoaxialSetup _setup;
        private readonly MaterialDrive[] _drives;
        private readonly CoaxialHubs _hubs;
        private readonly CoaxialNodes _nodes;
        private readonly InnerInstrument _wire;
        private readonly bool _isAlone;           // in a sheath
        private readonly int[] _active;           // elements with each angle, when the rod was built
        private double[] _leads = null!;          // between the hubs, when it was built, m
        private double _frameTurn;                // where the frame of an instrument alone is held, radians
        private CoaxialRod _rod;
        private MonitoredRod _whole = null!;

        /// <summary>Lays the chain at the start of all instruments.</summary>
        /// <param name="drives">Of the hubs.</param>
        /// <param name="wire">Takes the wire's shape.</param>
        /// <param name="failure">Why there is no rest shape to start from, or null.</param>
        public CoaxialChain(SimulationParameters parameters, SolverReport report, CoaxialSetup setup,
            MaterialDrive[] drives, CoaxialHubs hubs, InnerInstrument wire, out string? failure)
        {
            _method = parameters.Method;
            _report = report;
            _setup = setup;
            _drives = drives;
            _hubs = hubs;
            _wire = wire;
            _nodes = new CoaxialNodes(setup.Instruments, hubs);
            _isAlone = drives.Length == 1;
            _active = new int[drives.Length];
            _nodes.Find(0.0, 0.0);
            int first = !_isAlone ? 0
                : _nodes.FirstOf(setup.Wire.Shape, 0, setup.Sheath!, hubs.SheathedAt(0.0), 0.0);
            _rod = RodAt(0.0, first);
            var shape = new RodShape(Rod.Joints.ElementCount, Rod.Joints.InnerCount);
            shape.SetStraight(hubs.Outer.PositionAt(0.0), hubs.Outer.Frame, Rod.Joints.Stations);
            CoaxialShape.SetTwists(shape, Rod.Joints, hubs);
            MaterialScene scene = SceneOf(shape);
            double turn = hubs.Outer.TurnAt(0.0);
            if (_isAlone)
            {
                setup.CopyStart(scene, first);
                turn = _frameTurn = setup.HasStart ? wire.TurnAt(setup.Wire.Shape, first) : 0.0;
                HoldFrame(shape);
            }
            else if (setup.HasStart)
            {
                setup.CopyStart(scene, hubs);
            }
            RodTerms terms = setup.Terms(scene);
            failure = scene.Joints.FindTurnedAtRest();
            IsAtRest = parameters.Scene.InitialState == InitialState.Equilibrium && failure == null;
            if (IsAtRest)
            {
                failure = setup.FindRestShape(scene, terms, report);
                IsAtRest = failure == null;
            }
            Start(scene, terms, 0.0, turn);
            if (setup.HasStart)
            {
                TakeLoads();
            }
        }

        /// <summary>Whether the start is a rest shape.</summary>
        public bool IsAtRest { get; }

        /// <summary>All instruments as one rod.</summary>
        public CoaxialRod Rod => _rod;

        /// <summary>The motion of the chain.</summary>
        public RodDynamics Dynamics => Whole.Dynamics;

        /// <summary>The same with its monitors.</summary>
        public MonitoredRod Whole => _whole;

        /// <summary>Sets what is prescribed at the present time.</summary>
        public void TakeTime()
        {
            Dynamics.Terms.SetTime(Whole.Schedule, Dynamics.Time);
        }

        /// <summary>The same, with the directions of loads along the instruments.</summary>
        public void TakeLoads()
        {
            TakeTime();
            if (Dynamics.Terms.CoaxialLoads != null)
            {
                Rod.TakeLoads(Dynamics.Shape);
            }
        }

        /// <summary>Begins a part of a step: nodes that come or go within it do so now.</summary>
        /// <param name="left">Of the step, s.</param>
        /// <returns>How long no other ones come or go, at most what is left, s.</returns>
        public double BeginPart(double left)
        {
            double length = Math.Min(_nodes.TimeToNode(Dynamics.Time), left);
            length = left - length < CoaxialNodes.SameTime * _method.TimeStep ? left : length;
            _nodes.Find(Dynamics.Time, length);
            if (!IsAsBuilt())
            {
                Rebuild(this, 0);
            }
            return length;
        }

        /// <summary>Begins a step of an instrument alone: elements that will reach the exit of its sheath come in,
        /// others go. A second call changes nothing.</summary>
        public void MoveWindow()
        {
            if (_isAlone)
            {
                double time = Dynamics.Time;
                int first = _nodes.FirstOf(Dynamics.Shape, Rod.Joints.First, _setup.Sheath!, _hubs.SheathedAt(time),
                    Math.Max(0.0, _drives[0].NextMove(time)));
                if (first != Rod.Joints.First)
                {
                    Rebuild(this, first);
                }
            }
        }

        /// <summary>Goes on from where another chain is, in which other instruments were: what lies along them lies
        /// where they were.</summary>
        /// <param name="isOther">Which instruments are not those of that chain.</param>
        /// <param name="shift">How far the outermost hub is behind that of that chain, m.</param>
        public void ResumeFrom(CoaxialChain former, bool[] isOther, double shift)
        {
            for (int i = 1; i < isOther.Length; i++)
            {
                _nodes.Beyond[i] = isOther[i] ? 0 : former._nodes.Beyond[i];
            }
            _nodes.Find(former.Dynamics.Time, 0.0);
            Rebuild(former, 0, isOther, shift);
        }

        /// <summary>Writes or restores what says which rod there is.</summary>
        public void SerializeNodes(Snapshot snapshot, ref int first)
        {
            if (_isAlone)
            {
                snapshot.Serialize(ref first);
                snapshot.Serialize(ref _frameTurn);
            }
            for (int i = 1; i < _drives.Length; i++)
            {
                snapshot.Serialize(ref _nodes.Beyond[i]);
                snapshot.Serialize(ref _leads[i]);
            }
        }

        /// <summary>Writes or restores its motion.</summary>
        /// <param name="first">As it was written.</param>
        /// <param name="time">The same, s.</param>
        public void Serialize(Snapshot snapshot, int first, double time)
        {
            if (!snapshot.IsWritten)
            {
                _rod = _setup.Rod(_nodes.Beyond, _leads, first, _hubs, time);
                MaterialScene scene = SceneOf(new RodShape(Rod.Joints.ElementCount, Rod.Joints.InnerCount));
                // Placed on the axis until its own state is read.
                scene.Shape.SetStraight(_hubs.Outer.PositionAt(time), _hubs.Outer.Frame, Rod.Joints.Stations);
                HoldFrame(scene.Shape);
                Start(scene, _setup.Terms(scene), time, _frameTurn);
            }
            Whole.Serialize(snapshot);
            Rod.Axial.Serialize(snapshot);
            if (!snapshot.IsWritten)
            {
                Rod.SetLengths();
                TakeTime();
            }
        }

        /// <summary>Keeps what was simulated when a step began, or goes back to it: the step may build it
        /// anew.</summary>
        public void SerializeStep(Snapshot snapshot)
        {
            snapshot.Keep(ref _rod);
            snapshot.Keep(ref _whole);
            snapshot.Keep(ref _leads);
            for (int i = 0; i < _active.Length; i++)
            {
                snapshot.Serialize(ref _active[i]);
                snapshot.Serialize(ref _nodes.Beyond[i]);
            }
            snapshot.Serialize(ref _frameTurn);
            HoldFrame(Dynamics.Shape);
            Whole.SerializeStep(snapshot);
        }

        private CoaxialRod RodAt(double time, int first)
        {
            _leads = _hubs.LeadsAt(time);
            return _setup.Rod(_nodes.Beyond, _leads, first, _hubs, time);
        }

        private MaterialScene SceneOf(RodShape shape)
        {
            return new MaterialScene(_setup.Catheter, Rod, shape, _drives[0], _hubs.Inner, _setup.Wire.Schedule.Loads);
        }

        // An instrument alone winds up against its frame, which does not turn with the hub.
        private void HoldFrame(RodShape shape)
        {
            if (_isAlone)
            {
                _hubs.Outer.HoldFrame(_frameTurn);
                shape.ProximalFrame = _hubs.Outer.FrameTurned(_frameTurn);
            }
        }

        private bool IsAsBuilt()
        {
            for (int i = 1; i < _active.Length; i++)
            {
                if (_nodes.Beyond[i] != Rod.Joints.BeyondOf(i) || Rod.Joints.ActiveCountOf(i) != _active[i])
                {
                    return false;
                }
            }
            return true;
        }

        // From where a chain is, this one or that of other instruments.
        private void Rebuild(CoaxialChain from, int first, bool[]? isOther = null, double shift = 0.0)
        {
            RodDynamics was = from.Dynamics;
            double time = was.Time;
            RodShape oldShape = was.Shape;
            RodTerms former = was.Terms;
            CoaxialRod old = from.Rod;
            MonitoredRod before = from.Whole;
            _rod = RodAt(time, first);
            var change = new CoaxialChange(old.Joints, Rod.Joints, isOther, shift);
            MaterialScene scene = SceneOf(change.Take(oldShape));
            double[] rates = was.TwistRates;
            change.TakeMotion(oldShape, was.Velocities, was.Spins, rates, scene);
            double turn = was.ProximalTurn;
            if (_isAlone)
            {
                _wire.TakeForces(former, oldShape);
                turn = change.Enter(oldShape, scene, _setup.Axis, turn + former.Bending.TurnOf(oldShape, 0).Z,
                    _wire.Thrust, _wire.Torque);
                _frameTurn = turn;
                HoldFrame(scene.Shape);
            }
            RodTerms terms = _setup.Terms(scene);
            Start(scene, terms, time, turn);
            for (int i = 1; i < _drives.Length; i++)
            {
                for (int j = 0; j < Rod.Joints.ActiveCountOf(i); j++)
                {
                    Dynamics.TwistRates[(i - 1) * Rod.Joints.ElementCount + j] = change.RateOf(oldShape, rates, j, i);
                }
            }
            Whole.Contacts?.Take(before.Contacts!, Rod.Rod.ElementCount + 1);
            if (former.Walls()?.Friction != null)
            {
                terms.Walls()!.Friction?.Anchors.Take(former.Walls()!.Friction!.Anchors, change.Node);
            }
            if (former.Walls()?.Barrier.Lag != null)
            {
                terms.Walls()!.Barrier.Lag?.Take(former.Walls()!.Barrier.Lag!, change.Node);
            }
            if (_isAlone)
            {
                TakeHub(former, oldShape, change.Entered);
            }
            TakeLoads();
            var counts = new Snapshot();
            before.SerializeCounts(counts);
            Whole.SerializeCounts(counts.ToRead());
        }

        // What the hub and the walls were before elements came in or went.
        private void TakeHub(RodTerms former, RodShape oldShape, int entered)
        {
            WallTerms before = former.Walls()!;
            WallTerms walls = Dynamics.Terms.Walls()!;
            walls.Spring.ReleaseForce = before.Spring.ReleaseForce;   // the hub's force stays within its limit
            walls.Barrier.TakeNeighbours(before.Barrier, entered);
            // An element that leaves may have another force than the springs that take its place.
            Whole.Contacts!.DriveShortfall -= _drives[0].AxialProgress(before.Spring.HeldPosition(oldShape),
                walls.Spring.HeldPosition(Dynamics.Shape)) / _setup.Wire.Metres;
        }

        private void Start(MaterialScene scene, RodTerms terms, double time, double turn)
        {
            for (int i = 1; i < _active.Length; i++)
            {
                _active[i] = Rod.Joints.ActiveCountOf(i);
            }
            RodDynamics dynamics = _setup.Dynamics(scene, terms);
            dynamics.ResumeAt(time, turn);
            terms.SetTime(scene.Schedule, time);
            if (terms.Walls() != null)
            {
                terms.Walls()!.Spring.Axis = _setup.Axis;
            }
            _whole = new MonitoredRod(scene, dynamics, _method, _report,
                terms.Walls() == null ? null : new ContactRecord(scene.Shape.X.Length));
        }
    }
}
