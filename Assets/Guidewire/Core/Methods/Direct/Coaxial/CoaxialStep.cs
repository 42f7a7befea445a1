using System;

namespace Guidewire.Core
{
    /// <summary>Steps of a wire in a catheter: both as one rod, by a <see cref="DirectStep"/> of its own, while wire
    /// nodes beyond the catheter's tip come and go with the hubs.</summary>
    /// <remarks>Before a step a wire node comes in where it is 0.02 of its element's length beyond the tip to the
    /// step's end. It goes where it is 0.01 beyond it, and a step ends a part there: so what takes its place lies where
    /// it was. What is simulated is built anew whenever that happens, and where the wire's tip comes into another of
    /// the catheter's elements.</remarks>
    internal sealed class CoaxialStep : TimeStepper
    {
        private const double Reached = 0.02;    // of an element's length
        private const double Left = 0.01;
        private const double SameTime = 1e-6;   // of a step, or of that length
        private const double OfRadius = 0.01;   // of a radius, by which a hub gives way at first

        private readonly MethodParameters _method;
        private readonly SolverReport _report;
        private readonly CoaxialSetup _setup;
        private readonly MaterialDrive _catheterDrive;
        private readonly MaterialDrive _wireDrive;
        private readonly CoaxialHubs _hubs;
        private readonly CoaxialRecord _record;
        private readonly HubRecord _hub;
        private readonly HubSlip _catheterSlip;
        private readonly HubSlip _wireSlip;
        private readonly StepStart _start;
        private readonly RodShape _wire;          // as the log has it
        private readonly Vector3d[] _velocities;
        private readonly Vector3d[] _spins;
        private CoaxialRod _rod = null!;          // these are set wherever the rod is built
        private RodDynamics _dynamics = null!;
        private DirectStep _inner = null!;
        private int _active;                      // elements with both, when it was built
        private double _lead;                     // between the hubs, when it was built, m
        private (CoaxialRod, RodDynamics, DirectStep, int, double) _kept;   // these when a step began

        /// <summary>A step of the instruments of these parameters, from their start.</summary>
        /// <param name="failure">Why there is no rest shape to start from, or null.</param>
        public CoaxialStep(SimulationParameters parameters, SolverReport report, out string? failure)
        {
            _method = parameters.Method;
            _report = report;
            _setup = new CoaxialSetup(parameters);
            _catheterDrive = _setup.DriveOf(_setup.Catheter);
            _wireDrive = _setup.DriveOf(_setup.Wire);
            _catheterSlip = new HubSlip(_catheterDrive, parameters.Scene.Catheters[0].Drive.HubForceLimit,
                OfRadius * _setup.Catheter.Rod.Radius[0]);
            _wireSlip = new HubSlip(_wireDrive, parameters.Drive.HubForceLimit, OfRadius * _setup.Wire.Rod.Radius[0]);
            _start = new StepStart(SerializeStep);
            _hubs = new CoaxialHubs(_catheterDrive.Hub, _wireDrive.Hub, _setup.Axis, _setup.Sheath);
            int n = _setup.Wire.Rod.ElementCount;
            _wire = new RodShape(n);
            _velocities = new Vector3d[n + 1];
            _spins = new Vector3d[n];
            _hub = new HubRecord(_setup.Wire.Rod, _setup.Wire.Supports);
            _record = new CoaxialRecord(_setup.Catheter.Rod.ElementCount, _setup.Wire.Metres, _setup.LumenRadius,
                new LumenFriction(parameters.Scene.Catheters[0].LumenFriction, parameters.Contact.ElasticSlip > 0.0
                    ? parameters.Contact.ElasticSlip : FrictionEnergy.ElasticSlipOf(_setup.Wire.Rod)));
            if (_setup.Wire.Walls.Length > 0)
            {
                string? outside = _setup.FindProblemOfStart();
                if (outside != null)
                {
                    throw new ArgumentException(outside);
                }
                Contacts = new ContactRecord(n + 1);
            }
            double lead = _hubs.LeadAt(0.0);
            _rod = _setup.Rod(NodesBeyond(0, lead, lead), lead, _hubs.SheathedAt(0.0));
            var shape = new RodShape(_rod.Joints.ElementCount, true);
            shape.SetStraight(_catheterDrive.Hub.PositionAt(0.0), _hubs.Outer.Frame, _rod.Joints.Stations);
            Array.Fill(shape.Twist, _hubs.TwistAt(0.0), 0, _rod.Joints.ActiveCount);
            var scene = new MaterialScene(_setup.Catheter, _rod, shape, _catheterDrive, _hubs.Inner);
            RodTerms terms = _setup.Terms(scene, _hubs);
            failure = scene.Joints.FindTurnedAtRest();
            IsAtRest = parameters.Scene.InitialState == InitialState.Equilibrium && failure == null;
            if (IsAtRest)
            {
                failure = new RestShape(scene, terms, Math.Min(_method.SolverTolerance, 1e-9),
                    RestShape.IterationFactor * _method.MaxNewtonIterations, report).Find(shape);
                IsAtRest = failure == null;
            }
            Start(scene, terms, 0.0, 0.0);
            _record.TakePlay(_rod.Joints, shape);
            TakeWire();
        }

        /// <summary>Sums over the run and the walls' forces; that on each sphere is not told apart.</summary>
        public override ContactRecord? Contacts { get; }

        /// <summary>Whether the start is a rest shape.</summary>
        public bool IsAtRest { get; }

        /// <summary>The motion of what is simulated.</summary>
        public RodDynamics Dynamics => _dynamics;

        /// <summary>Both instruments as one rod.</summary>
        public CoaxialRod Rod => _rod;

        /// <inheritdoc/>
        public override string? AccuracyWarning => HubSlip.WarningOf(_wireSlip, _catheterSlip, _setup.Sheath != null);

        /// <inheritdoc/>
        public override void Advance(RodState state)
        {
            bool isDone = _catheterSlip.IsLimited || _wireSlip.IsLimited ? StepWithSlip() : StepAsAsked();
            Failure = _inner.Failure;
            Divergence = _inner.Divergence;
            SteadyState = _inner.SteadyState;
            PredictionError = _inner.PredictionError;
            if (isDone)
            {
                Bending.SetIdleTwists(_dynamics.Shape);
                _record.TakePlay(_rod.Joints, _dynamics.Shape);
                TakeWire();
                TakeContacts();
                WriteWire(state);
            }
        }

        // Taken again until neither hub has more than its force: the wire's in each trial of the catheter's.
        private bool StepWithSlip()
        {
            _start.Save();
            _catheterSlip.Begin();
            bool isDone;
            double catheter = _catheterDrive.Insertion;
            do
            {
                _catheterDrive.Give(_catheterSlip.Displacement);
                _wireSlip.Begin();
                double wire;
                do
                {
                    if (_wireSlip.Displacement != null || _catheterSlip.Displacement != null)
                    {
                        _start.Restore();
                    }
                    wire = _wireDrive.Insertion;
                    _wireDrive.Give(_wireSlip.Displacement);
                    isDone = StepAsAsked();
                }
                while (_wireSlip.NeedsAnother(_wireDrive.Insertion - wire, isDone ? Coaxial()!.WireForce : double.NaN));
            }
            while (_catheterSlip.NeedsAnother(_catheterDrive.Insertion - catheter,
                isDone ? Coaxial()!.Force : double.NaN));
            _catheterDrive.Give(null);
            _wireDrive.Give(null);
            _catheterSlip.EndStep(isDone ? Coaxial()!.Force : 0.0);
            _wireSlip.EndStep(isDone ? Coaxial()!.WireForce : 0.0);
            return isDone;
        }

        private bool StepAsAsked()
        {
            BeginStep();
            double start = _dynamics.Time;
            bool isDone = true;
            for (double done = 0.0; isDone && done < _method.TimeStep;)
            {
                double length = Math.Min(TimeToNode(), _method.TimeStep - done);
                length = _method.TimeStep - done - length < SameTime * _method.TimeStep
                    ? _method.TimeStep - done : length;
                MoveNodes(length);
                isDone = _inner.StepPart(length);
                done = length == _method.TimeStep - done ? _method.TimeStep : _dynamics.Time - start;
            }
            return isDone;
        }

        // The hubs go as far as they may.
        private void BeginStep()
        {
            _setup.LimitDrives(_catheterDrive, _wireDrive, _hubs, _dynamics.Time);
            double catheter = _catheterDrive.Insertion;
            double wire = _wireDrive.Insertion;
            _catheterDrive.Prepare(_dynamics.Shape, _dynamics.Time);
            _wireDrive.Prepare(_dynamics.Shape, _dynamics.Time);
            _record.TakeStep(_catheterDrive, catheter, _wireDrive, wire);
        }

        // Until the first wire node beyond the tip is as near to it as one may come, s: there it goes, before the
        // element that takes over its length would be another than the two that were. Or until the wire's tip is as far
        // out as it comes in: there it is where the catheter's tip has been, and outside no wall.
        private double TimeToNode()
        {
            int beyond = _rod.Joints.Beyond;
            double time = _dynamics.Time;
            double rate = Vector3d.Dot(_hubs.Outer.Velocity - _hubs.Inner.Velocity, _setup.Axis);
            int n = _wire.ElementCount;
            double tip = _hubs.LeadAt(time) + _setup.Catheter.Rod.TotalLength;
            if (beyond == 0 || !(rate > 0.0))
            {
                double ahead = Reached * _setup.Wire.Rod.Length[n - 1] - (_setup.WireStations[n] - tip);
                return beyond == 0 && rate < 0.0 && ahead > SameTime * _setup.Wire.Rod.Length[n - 1] ? ahead / -rate
                    : double.PositiveInfinity;
            }
            while (beyond > 0 && _setup.WireStations[n + 1 - beyond] - tip
                <= (1.0 + SameTime) * Left * _setup.Wire.Rod.Length[n - beyond])
            {
                beyond--;
            }
            return beyond == 0 ? double.PositiveInfinity : (_setup.WireStations[n + 1 - beyond] - tip
                - Left * _setup.Wire.Rod.Length[n - beyond]) / rate;
        }

        /// <summary>Writes the wire as it is into a state.</summary>
        public void WriteWire(RodState state)
        {
            _setup.Wire.Write(state, _wire, _velocities, _spins);
        }

        /// <inheritdoc/>
        public override HubRecord? Hub()
        {
            CoaxialRecord record = Coaxial()!;
            _hub.Take(_wireDrive, record.WireForce, record.WireTorque,
                _wire.Q[_wire.ElementCount - 1].Director3, record.WireTwist, record.LargestCurvature);
            if (_setup.Sheath != null)
            {
                _hub.TakeBody(_setup.WireStations, _rod.Joints.Lead + _rod.Joints.Sheathed);
            }
            return _hub;
        }

        /// <inheritdoc/>
        public override CoaxialRecord? Coaxial()
        {
            RodTerms terms = _dynamics.Terms;
            terms.SetTime(_inner.Schedule, _dynamics.Time);
            RodShape shape = _dynamics.Shape;
            double force = Bending.InnerForce(shape, terms.Stretch);
            double torque = Bending.InnerTorque(shape);
            _record.Take(_rod.Joints, terms, shape, _catheterDrive, _wireDrive,
                Vector3d.Dot(_dynamics.ReactionAt(0), _setup.Axis) - force
                    + Bending.SheathForce(shape, terms.Stretch),
                Vector3d.Dot(terms.Bending.ProximalCouple(shape), _setup.Axis) - torque, force, torque);
            return _record;
        }

        /// <inheritdoc/>
        public override SolverReport? Report()
        {
            return _inner.Report();
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            int beyond = _rod.Joints.Beyond;
            double lead = _lead;
            double time = _dynamics.Time;
            snapshot.Serialize(ref beyond);
            snapshot.Serialize(ref lead);
            snapshot.Serialize(ref time);
            _wireDrive.Hub.Serialize(snapshot, time);
            _wireDrive.Serialize(snapshot);
            _record.Serialize(snapshot);
            if (!snapshot.IsWritten)
            {
                _rod = _setup.Rod(beyond, lead, _hubs.SheathedAt(time));
                var scene = new MaterialScene(_setup.Catheter, _rod, new RodShape(_rod.Joints.ElementCount, true),
                    _catheterDrive, _hubs.Inner);
                // Placed on the axis until its own state is read.
                scene.Shape.SetStraight(_hubs.Outer.PositionAt(time), _hubs.Outer.Frame, _rod.Joints.Stations);
                Start(scene, _setup.Terms(scene, _hubs), time, 0.0);
            }
            _inner.Serialize(snapshot);
            if (!snapshot.IsWritten)
            {
                TakeWire();
                TakeContacts();
            }
        }

        private CoaxialBendTwist Bending => (CoaxialBendTwist)_dynamics.Terms.Bending;

        /// <summary>Writes or takes over all that a step may touch, for a <see cref="StepStart"/>. What was simulated
        /// when it began is kept: the step may build it anew.</summary>
        public void SerializeStep(Snapshot snapshot)
        {
            if (snapshot.IsWritten)
            {
                _kept = (_rod, _dynamics, _inner, _active, _lead);
            }
            (_rod, _dynamics, _inner, _active, _lead) = _kept;
            _wireDrive.SerializeStep(snapshot);
            _record.Serialize(snapshot);
            _inner.SerializeStep(snapshot);
            if (!snapshot.IsWritten)
            {
                _dynamics.Terms.SetTime(_inner.Schedule, _dynamics.Time);
            }
        }

        // For a part of a step, s.
        private void MoveNodes(double length)
        {
            double time = _dynamics.Time;
            double lead = _hubs.LeadAt(time);
            double next = _hubs.LeadAt(time + length);
            int beyond = NodesBeyond(_rod.Joints.Beyond, lead, next);
            if (beyond == _rod.Joints.Beyond && _rod.Joints.ActiveCount == _active)
            {
                return;
            }
            RodShape old = _dynamics.Shape;
            _rod = _setup.Rod(beyond, lead, _hubs.SheathedAt(time));
            RodShape shape = CoaxialShape.Take(old, _rod.Joints);
            var scene = new MaterialScene(_setup.Catheter, _rod, shape, _catheterDrive, _hubs.Inner);
            TakeMotion(scene, old.ElementCount);
            RodTerms terms = _setup.Terms(scene, _hubs);
            DirectStep before = _inner;
            FrictionEnergy? friction = _dynamics.Terms.Walls()?.Friction;
            double[] rates = _dynamics.TwistRates;
            int active = _active;
            Start(scene, terms, time, _dynamics.ProximalTurn);
            // Where the wire's tip comes in, it turns as it does before.
            for (int j = 0; j < _rod.Joints.ActiveCount; j++)
            {
                _dynamics.TwistRates[j] = rates[Math.Min(j, active - 1)];
            }
            _inner.Contacts?.Take(before.Contacts!, _rod.Rod.ElementCount + 1);
            FrictionAnchors? anchors = terms.Walls()?.Friction?.Anchors;
            anchors?.TakeAround(friction!.Anchors, _rod.Joints.OuterCount);
            var counts = new Snapshot();
            before.SerializeCounts(counts);
            _inner.SerializeCounts(counts.ToRead());
        }

        // How many wire nodes are beyond the catheter's tip for a step in which the lead goes from one to another.
        private int NodesBeyond(int beyond, double lead, double next)
        {
            double tip = Math.Max(lead, next) + _setup.Catheter.Rod.TotalLength;
            int n = _wire.ElementCount;
            double[] station = _setup.WireStations;
            double Distance(int count) => station[n + 1 - count] - tip;
            double Length(int count) => _setup.Wire.Rod.Length[n - count];
            while (beyond > 0 && Distance(beyond) < (1.0 - SameTime) * Left * Length(beyond))
            {
                beyond--;
            }
            while (beyond < n && Distance(beyond + 1) >= Reached * Length(beyond + 1) - SameTime * Length(beyond + 1))
            {
                beyond++;
            }
            return beyond;
        }

        // Velocities of a rod with other wire nodes: what comes in moves with the element that it divides.
        private void TakeMotion(MaterialScene scene, int oldCount)
        {
            int tip = _rod.Joints.OuterCount;
            int more = scene.Rod.ElementCount - oldCount;
            for (int i = 0; i < scene.Velocities.Length; i++)
            {
                int from = i <= tip ? i : Math.Max(i - more, tip);
                scene.Velocities[i] = _dynamics.Velocities[from];
            }
            for (int j = 0; j < scene.Spins.Length; j++)
            {
                int from = CoaxialShape.SourceOf(j, tip, more, oldCount);
                scene.Spins[j] = from >= 0 ? _dynamics.Spins[from] : Vector3d.Zero;
            }
        }

        private void Start(MaterialScene scene, RodTerms terms, double time, double turn)
        {
            _active = _rod.Joints.ActiveCount;
            _lead = _rod.Joints.Lead;
            _dynamics = _setup.Dynamics(scene, terms);
            _dynamics.GoOn(time, turn);
            terms.SetTime(scene.Schedule, time);
            if (terms.Walls() != null)
            {
                terms.Walls()!.Spring.Axis = _setup.Axis;
            }
            _inner = new DirectStep(scene, _dynamics, _method, _report,
                Contacts == null ? null : new ContactRecord(scene.Shape.X.Length));
        }

        private void TakeContacts()
        {
            if (Contacts != null)
            {
                // None of its spheres: they are not the chain's.
                Contacts.Take(_inner.Contacts!, Contacts.Forces.Length + _inner.Contacts!.Forces.Length);
            }
        }

        // The wire as the log has it: in the catheter on the shared centreline, before it on the axis.
        private void TakeWire()
        {
            RodShape shape = _dynamics.Shape;
            double[] chain = _rod.Joints.Stations;
            double lead = _hubs.LeadAt(_dynamics.Time);
            int n = shape.ElementCount;
            int j = 0;
            double slide = Vector3d.Dot(_hubs.Inner.Velocity - _hubs.Outer.Velocity, _setup.Axis);
            for (int i = 0; i <= _wire.ElementCount; i++)
            {
                double at = _setup.WireStations[i] - lead;
                while (j < n - 1 && at > chain[j + 1])
                {
                    j++;
                }
                // Before the hub and beyond the last node by what is too short for an element.
                double fraction = (at - chain[j]) / (chain[j + 1] - chain[j]);
                bool isBefore = at <= 0.0;
                Vector3d direction = isBefore ? _setup.Axis : shape.Q[j].Director3;
                _wire.X[i] = isBefore ? shape.X[0] + at * _setup.Axis
                    : fraction > 1.0 ? shape.X[n] + (at - chain[n]) * direction
                    : Vector3d.Lerp(shape.X[j], shape.X[j + 1], fraction);
                _velocities[i] = (isBefore ? _dynamics.Velocities[0]
                    : Vector3d.Lerp(_dynamics.Velocities[j], _dynamics.Velocities[j + 1], Math.Min(fraction, 1.0)))
                    + (at < chain[_rod.Joints.OuterCount] ? slide : 0.0) * direction;
                if (i < _wire.ElementCount)
                {
                    TakeElement(i, at + 0.5 * _setup.Wire.Rod.Length[i], j);
                }
            }
        }

        private void TakeElement(int element, double at, int j)
        {
            RodShape shape = _dynamics.Shape;
            double[] chain = _rod.Joints.Stations;
            if (at <= 0.0)
            {
                // Between the hubs it twists evenly, on to the middle of the catheter's first element.
                double middle = 0.5 * chain[1];
                double fraction = (_rod.Joints.Lead + at) / (_rod.Joints.Lead + middle);
                double turn = Bending.HubTwist + fraction * (shape.Twist[0] - Bending.HubTwist);
                _wire.Q[element] = shape.ProximalFrame * Quaterniond.FromAxisAngle(Vector3d.UnitZ, turn);
                _spins[element] = Vector3d.Zero;
                return;
            }
            while (j < shape.ElementCount - 1 && at > chain[j + 1])
            {
                j++;
            }
            _wire.Q[element] = j < _rod.Joints.OuterCount ? CoaxialShape.InnerFrame(shape, j) : shape.Q[j];
            _spins[element] = _dynamics.Spins[j];
        }
    }
}
