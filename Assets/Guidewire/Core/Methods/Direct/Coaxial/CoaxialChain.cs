using System;
using System.Linq;

namespace Guidewire.Core
{
    /// <summary>What is simulated of coaxial instruments: one <see cref="MonitoredRod"/>, with room for the elements of
    /// all of them. Nodes come and go in place.</summary>
    /// <remarks>Which nodes are there <see cref="CoaxialNodes"/> finds. The rod is as one that is made anew, too, where
    /// a tip inside comes into another element. What is deep in a sheath is left out: it is straight, without mass and
    /// loads, and each instrument is evenly stretched and twisted. What comes in has the strain and the twists of
    /// that.</remarks>
    internal sealed class CoaxialChain
    {
        private const double LeftOfGap = 0.5;     // of the least one, where a node goes

        private readonly MethodParameters _method;
        private readonly CoaxialSetup _setup;
        private readonly MaterialDrive[] _drives;
        private readonly CoaxialHubs _hubs;
        private readonly CoaxialNodes _nodes;
        private readonly bool _hasWindow;         // in a sheath
        private readonly double[] _torques;       // of each instrument on its part before the chain, N m
        private readonly int[] _active;           // elements with each angle, when nodes came or went last
        private readonly double[] _leads;         // between the hubs, at that time, m
        private readonly MaterialScene _scene;
        private readonly CoaxialChange _change;
        private readonly CoaxialJoints _oldJoints;     // of the elements that were
        private readonly RodMotion _oldMotion;
        private double _sheathed;                 // length in the sheath, at that time, m
        private double _frameTurn;                // where the frame before the chain is held in a sheath, radians

        /// <summary>Lays the chain at the start of all instruments.</summary>
        /// <param name="drives">Of the hubs.</param>
        /// <param name="failure">Why there is no rest shape to start from, or null.</param>
        public CoaxialChain(SimulationParameters parameters, SolverReport report, CoaxialSetup setup,
            MaterialDrive[] drives, out string? failure)
        {
            _method = parameters.Method;
            _setup = setup;
            _drives = drives;
            var hubs = new CoaxialHubs(Array.ConvertAll(drives, drive => drive.Hub), setup.Axis, setup.Sheath);
            _hubs = hubs;
            Wire = new InnerInstrument(setup, hubs, drives.Length - 1);
            _nodes = new CoaxialNodes(setup.Instruments, hubs, setup.Wire.Walls
                .Where(wall => wall.Softness != null).Select(wall => wall.Softness!).ToArray());
            _hasWindow = setup.Sheath != null;
            _torques = new double[drives.Length];
            _active = new int[drives.Length];
            _leads = new double[drives.Length];
            _nodes.Find(0.0, 0.0);
            int first = !_hasWindow ? 0
                : _nodes.FirstOf(setup.Catheter.Shape, 0, setup.Sheath!, hubs.SheathedAt(0.0), 0.0);
            _hubs.SetLeads(_leads, 0.0);
            _sheathed = hubs.SheathedAt(0.0);
            Rod = setup.Rod(_nodes.Beyond, _leads, first, hubs, _sheathed);
            CoaxialJoints joints = Rod.Joints;
            RodShape shape = CreateShape();
            shape.SetStraight(hubs.Outer.PositionAt(0.0), hubs.Outer.Frame, joints.Stations);
            CoaxialShape.SetTwists(shape, joints, hubs);
            _scene = new MaterialScene(setup.Catheter, Rod, shape, drives[0], hubs.Inner, setup.Wire.Schedule.Loads);
            double turn = hubs.Outer.TurnAt(0.0);
            if (_hasWindow)
            {
                turn = _frameTurn = setup.HasStart ? hubs.TurnAt(setup.Catheter.Shape, first) : 0.0;
                HoldFrame(shape);
            }
            setup.CopyStart(_scene, first, hubs);
            RodTerms terms = setup.Terms(_scene);
            failure = _scene.Joints.FindTurnedAtRest();
            IsAtRest = parameters.Scene.InitialState == InitialState.Equilibrium && failure == null;
            if (IsAtRest)
            {
                failure = setup.FindRestShape(_scene, terms, report);
                IsAtRest = failure == null;
            }
            RodDynamics dynamics = setup.Dynamics(_scene, terms);
            dynamics.ResumeAt(0.0, turn);
            terms.SetTime(_scene.Schedule, 0.0);
            Whole = new MonitoredRod(_scene, dynamics, _method, report,
                terms.Walls() == null ? null : new ContactRecord(shape.X.Length));
            SetActive();
            _change = new CoaxialChange(joints);
            _oldJoints = new CoaxialJoints(setup.Instruments, _nodes.Beyond, _leads, _sheathed, first);
            _oldMotion = new RodMotion(CreateShape());
            if (setup.HasStart)
            {
                TakeLoads();
                TakeBorne();
            }
        }

        /// <summary>Whether all that is in a sheath comes in with the next step, and stays: to compare with.</summary>
        public bool IsWhole { get; set; }

        /// <summary>Whether the start is a rest shape.</summary>
        public bool IsAtRest { get; }

        /// <summary>Where the hubs are.</summary>
        public CoaxialHubs Hubs => _hubs;

        /// <summary>The wire's own shape.</summary>
        public InnerInstrument Wire { get; }

        /// <summary>All instruments as one rod.</summary>
        public CoaxialRod Rod { get; }

        /// <summary>The motion of the chain.</summary>
        public RodDynamics Dynamics => Whole.Dynamics;

        /// <summary>The same with its monitors.</summary>
        public MonitoredRod Whole { get; }

        /// <summary>Sets what is prescribed at the present time.</summary>
        public void TakeTime()
        {
            Dynamics.Terms.SetTime(Whole.Schedule, Dynamics.Time);
            CoaxialSetup.SetLead(_scene, Dynamics.Terms);
        }

        /// <summary>The same, with the directions of loads along the instruments.</summary>
        public void TakeLoads()
        {
            TakeTime();
            if (Dynamics.Terms.CoaxialLoads != null)
            {
                CoaxialSetup.TakeLoads(_scene, Dynamics.Terms);
            }
        }

        /// <summary>A step has ended: takes what tips bear, for the next one.</summary>
        public void TakeBorne()
        {
            if (Rod.Joints.InnerCount > 0)
            {
                TakeTime();
                Dynamics.Terms.Release!.TakeBorne(Dynamics.Shape, Dynamics.Terms);
            }
        }

        /// <summary>A step begins: what tips bear counts.</summary>
        public void BeginStep()
        {
            Rod.Axial.BeginStep();
            Rod.SetLengths();
        }

        /// <summary>Begins a part of a step: nodes that come or go within it do so now.</summary>
        /// <param name="left">Of the step, s.</param>
        /// <returns>How long no other ones come or go, at most what is left, s.</returns>
        public double BeginPart(double left)
        {
            double length = Math.Min(_nodes.TimeToNode(Dynamics.Time), left);
            length = left - length < CoaxialNodes.SameTime * _method.TimeStep ? left : length;
            _nodes.Find(Dynamics.Time, length);
            if (HasOthers())
            {
                Remesh(this, Rod.Joints.First);
            }
            return length;
        }

        /// <summary>Begins a step in a sheath: elements that will reach its exit come in, others go. A second call
        /// changes nothing.</summary>
        public void MoveWindow()
        {
            if (_hasWindow)
            {
                double time = Dynamics.Time;
                int first = IsWhole ? 0 : _nodes.FirstOf(Dynamics.Shape, Rod.Joints.First, _setup.Sheath!,
                    _hubs.SheathedAt(time), Math.Max(0.0, _drives[0].NextMove(time)));
                if (first != Rod.Joints.First)
                {
                    Remesh(this, first);
                }
            }
        }

        /// <summary>Goes on from where another chain is, in which other instruments were: what lies along them lies
        /// where they were. All of that chain comes in.</summary>
        /// <param name="isOther">Which instruments are not those of that chain.</param>
        /// <param name="shift">How far the outermost hub is behind that of that chain, m.</param>
        public void ResumeFrom(CoaxialChain former, bool[] isOther, double shift)
        {
            if (former.Rod.Joints.First > 0)
            {
                former.Remesh(former, 0);
            }
            for (int i = 1; i < isOther.Length; i++)
            {
                _nodes.Beyond[i] = isOther[i] ? 0 : former._nodes.Beyond[i];
            }
            _nodes.Find(former.Dynamics.Time, 0.0);
            Dynamics.Terms.Fibres?.TakeOver(former.Dynamics.Terms.Fibres, isOther);
            Remesh(former, 0, isOther, shift);
            var counts = new Snapshot();
            former.Whole.SerializeCounts(counts);
            Whole.SerializeCounts(counts.ToRead());
            Whole.Contacts?.CopyFrom(former.Whole.Contacts!, Rod.Rod.ElementCount + 1);
        }

        /// <summary>Writes or restores which elements there are.</summary>
        /// <param name="first">The first of them, as it was written.</param>
        /// <returns>Whether those that there are have to be laid anew.</returns>
        public bool SerializeNodes(Snapshot snapshot, ref int first)
        {
            if (_hasWindow)
            {
                snapshot.Serialize(ref first);
                snapshot.Serialize(ref _frameTurn);
            }
            bool isOther = !snapshot.IsStep || first != Rod.Joints.First;
            for (int i = 1; i < _drives.Length; i++)
            {
                double lead = _leads[i];
                snapshot.Serialize(ref _nodes.Beyond[i]);
                snapshot.Serialize(ref _leads[i]);
                isOther |= lead != _leads[i] || _nodes.Beyond[i] != Rod.Joints.BeyondOf(i);
            }
            return isOther && !snapshot.IsWritten;
        }

        /// <summary>Writes or restores its motion.</summary>
        /// <param name="laidFrom">Its first element, where they have to be laid anew.</param>
        /// <param name="time">As it was written, s.</param>
        public void Serialize(Snapshot snapshot, int? laidFrom, double time)
        {
            if (snapshot.IsStep)
            {
                snapshot.Serialize(ref _sheathed);
            }
            else if (!snapshot.IsWritten)
            {
                _sheathed = _hubs.SheathedAt(time);
            }
            if (laidFrom is int first)
            {
                Lay(first, time);
            }
            HoldFrame(Dynamics.Shape);
            Rod.Axial.Serialize(snapshot);
            if (!snapshot.IsWritten)
            {
                Rod.SetLengths();
            }
            Whole.Serialize(snapshot);
            if (!snapshot.IsWritten)
            {
                TakeTime();
            }
        }

        private RodShape CreateShape() =>
            new RodShape(Rod.Joints.ElementCount, Rod.Joints.InnerCount, Rod.Joints.Capacity);

        // In a sheath the chain winds up against its frame, which does not turn with the hub.
        private void HoldFrame(RodShape shape)
        {
            if (_hasWindow)
            {
                _hubs.Outer.HoldFrame(_frameTurn);
                shape.ProximalFrame = _hubs.Outer.FrameTurned(_frameTurn);
            }
        }

        private void SetActive()
        {
            for (int i = 1; i < _active.Length; i++)
            {
                _active[i] = Rod.Joints.ActiveCountOf(i);
            }
        }

        // Whether other elements are to be there than are.
        private bool HasOthers()
        {
            bool hasOthers = false;
            for (int i = 1; i < _active.Length; i++)
            {
                hasOthers |= _nodes.Beyond[i] != Rod.Joints.BeyondOf(i) || Rod.Joints.ActiveCountOf(i) != _active[i];
            }
            return hasOthers;
        }

        // Whether nodes that are there are not to be.
        private bool HasFewer()
        {
            bool hasFewer = false;
            for (int i = 1; i < _active.Length; i++)
            {
                hasFewer |= _nodes.Beyond[i] < Rod.Joints.BeyondOf(i);
            }
            return hasFewer;
        }

        // From where a chain is, this one or that of other instruments.
        private void Remesh(CoaxialChain from, int first, bool[]? isOther = null, double shift = 0.0)
        {
            RodDynamics was = from.Dynamics;
            RodTerms former = was.Terms;
            double time = was.Time;
            double turn = was.ProximalTurn;
            double thrust = 0.0;
            double gap = from == this && HasFewer() ? was.Terms.Walls()?.Barrier.LeastGap(was.Shape) ?? 0.0 : 0.0;
            Vector3d held = default;
            if (_hasWindow)
            {
                SupportSpring spring = former.Walls()!.Spring;
                thrust = Vector3d.Dot(spring.Force(was.Shape), _setup.Axis);
                held = spring.HeldPosition(was.Shape);
                turn += former.Bending.TurnOf(was.Shape, 0).Z;
                for (int i = 0; i < _torques.Length; i++)
                {
                    _torques[i] = -former.Bending.TurnCouple(was.Shape, i);
                }
            }
            CoaxialJoints joints = from.Rod.Joints;
            bool movesWindow = from == this && first != joints.First;
            double carried = movesWindow ? Whole.Carried : 0.0;
            RodMotion motion = was.Motion;
            if (from == this)
            {
                _oldJoints.CopyFrom(joints);
                _oldMotion.CopyFrom(motion);
                (joints, motion) = (_oldJoints, _oldMotion);
            }
            _hubs.SetLeads(_leads, time);
            _sheathed = _hubs.SheathedAt(time);
            Rod.Axial.TakeBorne(from.Rod.Axial);
            Rod.Remesh(_nodes.Beyond, _leads, _sheathed, first);
            _change.Begin(joints, isOther, shift);
            _change.Convert(motion, Dynamics.Motion);
            if (_hasWindow)
            {
                // With the lengths that loads give them.
                Dynamics.Terms.CoaxialLoads?.Place(Dynamics.Terms.Loads.Force);
                Rod.TakeLoads(Dynamics.Shape);
                _frameTurn = _change.Enter(motion.Shape, Rod.Rod, Dynamics.Motion, _setup.Axis, turn, thrust,
                    _torques);
                turn = _frameTurn;
                Rod.Axial.Remesh();
                Rod.SetLengths();
            }
            Begin(time, turn, former.Walls(), movesWindow ? _change.Entered : (int?)null);
            if (gap > 0.0)
            {
                Dynamics.Terms.Walls()!.Barrier.Open(Dynamics.Shape, LeftOfGap * gap);
            }
            if (_hasWindow)
            {
                // An element that leaves may have another force than the springs that take its place.
                Whole.Contacts!.DriveShortfall -= _drives[0].AxialProgress(held,
                    Dynamics.Terms.Walls()!.Spring.HeldPosition(Dynamics.Shape)) / _setup.Wire.Metres;
            }
            Rod.Axial.BeginStep();
            TakeLoads();
            if (movesWindow)
            {
                Whole.Leave(carried - Whole.Carried);
            }
        }

        // With the nodes that were set, on the axis until their own state is read.
        private void Lay(int first, double time)
        {
            Rod.Remesh(_nodes.Beyond, _leads, _sheathed, first);
            Dynamics.Shape.ElementCount = Rod.Joints.ElementCount;
            Dynamics.Shape.SetStraight(_hubs.Outer.PositionAt(time), _hubs.Outer.Frame, Rod.Joints.Stations);
            _change.Forget();
            Begin(time, _frameTurn, Dynamics.Terms.Walls(), null);
        }

        private void Begin(double time, double turn, WallTerms? former, int? entered)
        {
            SetActive();
            HoldFrame(Dynamics.Shape);
            RodTerms terms = Dynamics.Terms;
            _setup.Remesh(_scene, terms);
            if (former != null)
            {
                terms.Walls()!.Barrier.FollowElements(entered);
                terms.Walls()!.CarryOver(former, _change.Node, Rod.Joints.ElementCount);
            }
            Dynamics.Remesh();
            Dynamics.ResumeAt(time, turn);
            terms.SetTime(Whole.Schedule, time);
            Whole.Remesh();
        }
    }
}
