using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Steps of a wire in one or two catheters: all are one rod with a <see cref="DirectStep"/> of its own,
    /// while nodes of those inside come and go with the hubs beyond the tips around them.</summary>
    /// <remarks>Which nodes are there <see cref="CoaxialNodes"/> finds. What is simulated is rebuilt whenever that
    /// changes, and where a tip inside comes into another element.</remarks>
    internal sealed class CoaxialStep : TimeStepper
    {
        private readonly MethodParameters _method;
        private readonly SolverReport _report;
        private readonly CoaxialSetup _setup;
        private readonly MaterialDrive[] _drives;      // of the outermost catheter first, of the wire last
        private readonly SlippingHubs _slips;
        private readonly CoaxialHubs _hubs;
        private readonly CoaxialNodes _nodes;
        private readonly CoaxialRecord[] _records;     // of the catheters
        private readonly bool _hasFriction;            // in a lumen
        private readonly InnerInstrument[] _inner;     // the wire last
        private readonly double[] _insertions;         // before a step, m
        private readonly double[] _forces;             // of the hubs without friction, N
        private readonly HubRecord _hub;
        private readonly StepStart _start;
        private readonly int[] _active;           // elements with each angle, when the rod was built
        private CoaxialRod _rod = null!;          // these are set wherever the rod is built
        private RodDynamics _dynamics = null!;
        private DirectStep _whole = null!;
        private double[] _leads = null!;          // between the hubs, when it was built, m
        private (CoaxialRod, RodDynamics, DirectStep, double[]) _kept;   // these when a step began
        private readonly int[] _keptActive;
        private readonly int[] _keptBeyond;

        /// <summary>A step of the instruments of these parameters, from their start.</summary>
        /// <param name="failure">Why there is no rest shape to start from, or null.</param>
        public CoaxialStep(SimulationParameters parameters, SolverReport report, out string? failure)
        {
            _method = parameters.Method;
            _report = report;
            _setup = new CoaxialSetup(parameters);
            _drives = _setup.Drives();
            int count = _drives.Length;
            _insertions = new double[count];
            _forces = new double[count];
            _start = new StepStart(SerializeStep);
            _slips = new SlippingHubs(_drives, _setup.Slips(_drives), _start, _setup.Work, StepAsRequested,
                hub => Coaxial()!.ForceOf(hub));
            _hubs = new CoaxialHubs(Array.ConvertAll(_drives, drive => drive.Hub), _setup.Axis, _setup.Sheath);
            _nodes = new CoaxialNodes(_setup.Instruments, _hubs);
            _active = new int[count];
            _keptActive = new int[count];
            _keptBeyond = new int[count];
            _inner = new InnerInstrument[count - 1];
            for (int i = 1; i < count; i++)
            {
                _inner[i - 1] = new InnerInstrument(_setup, _hubs, i);
            }
            _hub = new HubRecord(_setup.Wire.Rod, _setup.Wire.Supports);
            _records = _setup.Records();
            _hasFriction = Array.Exists(_records, record => record.FrictionCoefficient > 0.0);
            if (_setup.Wire.Walls.Length > 0)
            {
                string? outside = _setup.FindProblemOfStart();
                if (outside != null)
                {
                    throw new ArgumentException(outside);
                }
                Contacts = new ContactRecord(_setup.Wire.Rod.ElementCount + 1);
            }
            _nodes.Find(0.0, 0.0);
            _rod = RodAt(0.0);
            var shape = new RodShape(_rod.Joints.ElementCount, _rod.Joints.InnerCount);
            shape.SetStraight(_drives[0].Hub.PositionAt(0.0), _hubs.Outer.Frame, _rod.Joints.Stations);
            CoaxialShape.SetTwists(shape, _rod.Joints, _hubs);
            MaterialScene scene = SceneOf(shape);
            RodTerms terms = _setup.Terms(scene, _hubs);
            failure = scene.Joints.FindTurnedAtRest();
            IsAtRest = parameters.Scene.InitialState == InitialState.Equilibrium && failure == null;
            if (IsAtRest)
            {
                failure = _setup.FindRestShape(scene, terms, report);
                IsAtRest = failure == null;
            }
            Start(scene, terms, 0.0, 0.0);
            TakePlay();
            TakeInner();
        }

        /// <summary>Sums over the run and the walls' forces; on spheres those of the wire, beyond the tips around it.
        /// </summary>
        public override ContactRecord? Contacts { get; }

        /// <summary>Whether the start is a rest shape.</summary>
        public bool IsAtRest { get; }

        /// <summary>The motion of what is simulated.</summary>
        public RodDynamics Dynamics => _dynamics;

        /// <summary>All instruments as one rod.</summary>
        public CoaxialRod Rod => _rod;

        /// <inheritdoc/>
        public override void AddWarnings(List<RunWarning> warnings)
        {
            _slips.AddWarnings(_setup.Sheath != null, warnings);
        }

        /// <inheritdoc/>
        public override void Advance(RodState state)
        {
            if (!_slips.AreLimited)
            {
                _start.Save();
            }
            bool isDone = Step();
            Failure = _whole.Failure;
            Divergence = _whole.Divergence;
            SteadyState = _whole.SteadyState;
            PredictionError = _whole.PredictionError;
            if (isDone)
            {
                Bending.SetIdleTwists(_dynamics.Shape);
                TakePlay();
                TakeInner();
                TakeContacts();
                if (_hasFriction)
                {
                    Coaxial();
                    _setup.TakeStrains(_records, _report);
                }
                WriteWire(state);
            }
            else
            {
                // Hubs and instruments as in the state, that of the step before.
                _start.Restore();
            }
        }

        /// <summary>One step of all instruments; with limited hubs its start is saved first.</summary>
        /// <returns>False where it has no solution or has lost an instrument.</returns>
        public bool Step()
        {
            _setup.Work.BeginStep();
            return _slips.AreLimited ? _slips.Step() : StepAsRequested();
        }

        private bool StepAsRequested()
        {
            BeginStep();
            double start = _dynamics.Time;
            bool isDone = true;
            for (double done = 0.0; isDone && done < _method.TimeStep;)
            {
                double length = Math.Min(_nodes.TimeToNode(_dynamics.Time), _method.TimeStep - done);
                length = _method.TimeStep - done - length < CoaxialNodes.SameTime * _method.TimeStep
                    ? _method.TimeStep - done : length;
                MoveNodes(length);
                isDone = _whole.StepPart(length);
                done = length == _method.TimeStep - done ? _method.TimeStep : _dynamics.Time - start;
            }
            return isDone;
        }

        // Moves the hubs as far as allowed.
        private void BeginStep()
        {
            TakeLoads();
            _setup.LimitDrives(_drives, _hubs, _dynamics.Time);
            for (int i = 0; i < _drives.Length; i++)
            {
                _insertions[i] = _drives[i].Insertion;
                _drives[i].Prepare(_dynamics.Shape, _dynamics.Time);
            }
            foreach (CoaxialRecord record in _records)
            {
                record.TakeStep(_drives, _insertions);
            }
        }

        /// <summary>Writes the wire as it is into a state.</summary>
        public void WriteWire(RodState state)
        {
            _setup.Wire.Write(state, Wire.Shape, Wire.Velocities, Wire.Spins);
        }

        /// <inheritdoc/>
        public override HubRecord? Hub()
        {
            CoaxialRecord record = Coaxial()!;
            Quaterniond[] q = Wire.Shape.Q;
            _hub.Take(_drives[_drives.Length - 1], record.WireForce, record.WireTorque, q[q.Length - 1].Director3,
                record.WireTwist, record.LargestCurvature);
            if (_setup.Sheath != null)
            {
                _hub.TakeBody(_setup.Instruments[_drives.Length - 1].Stations,
                    _rod.Joints.LeadOf(_drives.Length - 1) + _rod.Joints.Sheathed);
            }
            return _hub;
        }

        /// <inheritdoc/>
        public override CoaxialRecord? Coaxial()
        {
            RodTerms terms = _dynamics.Terms;
            terms.SetTime(_whole.Schedule, _dynamics.Time);
            RodShape shape = _dynamics.Shape;
            int wire = _drives.Length - 1;
            // The outermost hub has the chain's reaction less those of the others.
            _forces[0] = Vector3d.Dot(_dynamics.ReactionAt(0), _setup.Axis);
            double torque = Vector3d.Dot(terms.Bending.ProximalCouple(shape), _setup.Axis);
            double wireTorque = Bending.InnerTorque(shape, wire);
            double inside = 0.0;
            for (int i = wire; i > 0; i--)
            {
                _forces[i] = terms.Release!.InnerForce(shape, terms, i);
                _forces[0] -= _forces[i];
                double own = Bending.InnerTorque(shape, i);
                torque -= own;
                if (i < wire)
                {
                    _records[i].Take(_rod.Joints, terms, shape, _inner[i - 1].Shape, _drives[i], _drives[wire], own,
                        wireTorque, inside);
                }
                inside += _forces[i];
            }
            _forces[0] += terms.Release!.SheathForce(shape);
            _records[0].Take(_rod.Joints, terms, shape, shape, _drives[0], _drives[wire], torque, wireTorque, inside);
            double around = 0.0;
            double wireForce = _forces[wire] + _records[wire - 1].FrictionForce;
            for (int i = 0; i < wire; i++)
            {
                _records[i].TakeForces(_forces[i], around, wireForce);
                around = _records[i].FrictionForce;
            }
            return _records[0];
        }

        /// <inheritdoc/>
        public override Vector3d? Energies()
        {
            RodTerms terms = _dynamics.Terms;
            terms.SetTime(_whole.Schedule, _dynamics.Time);
            return new Vector3d(_dynamics.KineticEnergy,
                terms.ElasticEnergy(_dynamics.Shape) - _rod.Axial.PreloadEnergy, terms.LoadPotential(_dynamics.Shape));
        }

        /// <inheritdoc/>
        public override SolverReport? Report()
        {
            return _whole.Report();
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            double time = _dynamics.Time;
            for (int i = 1; i < _drives.Length; i++)
            {
                snapshot.Serialize(ref _nodes.Beyond[i]);
                snapshot.Serialize(ref _leads[i]);
            }
            snapshot.Serialize(ref time);
            for (int i = 1; i < _drives.Length; i++)
            {
                _drives[i].Hub.Serialize(snapshot, time);
                _drives[i].Serialize(snapshot);
            }
            _slips.Serialize(snapshot);
            foreach (CoaxialRecord record in _records)
            {
                record.Serialize(snapshot);
            }
            if (!snapshot.IsWritten)
            {
                double[] leads = _leads;
                _rod = _setup.Rod(_nodes.Beyond, leads, _hubs.SheathedAt(time));
                MaterialScene scene = SceneOf(new RodShape(_rod.Joints.ElementCount, _rod.Joints.InnerCount));
                // Placed on the axis until its own state is read.
                scene.Shape.SetStraight(_hubs.Outer.PositionAt(time), _hubs.Outer.Frame, _rod.Joints.Stations);
                Start(scene, _setup.Terms(scene, _hubs), time, 0.0);
            }
            _whole.Serialize(snapshot);
            _rod.Axial.Serialize(snapshot);
            if (!snapshot.IsWritten)
            {
                _rod.SetLengths();
                TakeInner();
                TakeContacts();
            }
        }

        /// <summary>Writes or restores all that a step may touch, for a <see cref="StepStart"/>. What was simulated
        /// when it began is kept: the step may build it anew.</summary>
        public void SerializeStep(Snapshot snapshot)
        {
            if (snapshot.IsWritten)
            {
                _kept = (_rod, _dynamics, _whole, _leads);
                _active.CopyTo(_keptActive, 0);
                _nodes.Beyond.CopyTo(_keptBeyond, 0);
            }
            (_rod, _dynamics, _whole, _leads) = _kept;
            _keptActive.CopyTo(_active, 0);
            _keptBeyond.CopyTo(_nodes.Beyond, 0);
            for (int i = 1; i < _drives.Length; i++)
            {
                _drives[i].SerializeStep(snapshot);
            }
            foreach (CoaxialRecord record in _records)
            {
                record.Serialize(snapshot);
            }
            _whole.SerializeStep(snapshot);
            if (!snapshot.IsWritten)
            {
                _dynamics.Terms.SetTime(_whole.Schedule, _dynamics.Time);
            }
        }

        private CoaxialBendTwist Bending => (CoaxialBendTwist)_dynamics.Terms.Bending;

        private InnerInstrument Wire => _inner[_inner.Length - 1];

        private CoaxialRod RodAt(double time)
        {
            _leads = _hubs.LeadsAt(time);
            return _setup.Rod(_nodes.Beyond, _leads, _hubs.SheathedAt(time));
        }

        private MaterialScene SceneOf(RodShape shape)
        {
            return new MaterialScene(_setup.Catheter, _rod, shape, _drives[0], _hubs.Inner, _setup.Wire.Schedule.Loads);
        }

        // For a part of a step, s.
        private void MoveNodes(double length)
        {
            double time = _dynamics.Time;
            _nodes.Find(time, length);
            if (IsAsBuilt())
            {
                return;
            }
            CoaxialRod old = _rod;
            RodShape oldShape = _dynamics.Shape;
            _rod = RodAt(time);
            var change = new CoaxialChange(old.Joints, _rod.Joints);
            MaterialScene scene = SceneOf(change.Take(oldShape));
            double[] rates = _dynamics.TwistRates;
            change.TakeMotion(oldShape, _dynamics.Velocities, _dynamics.Spins, rates, scene);
            RodTerms terms = _setup.Terms(scene, _hubs);
            DirectStep before = _whole;
            FrictionEnergy? friction = _dynamics.Terms.Walls()?.Friction;
            Start(scene, terms, time, _dynamics.ProximalTurn);
            for (int i = 1; i < _drives.Length; i++)
            {
                for (int j = 0; j < _rod.Joints.ActiveCountOf(i); j++)
                {
                    _dynamics.TwistRates[(i - 1) * _rod.Joints.ElementCount + j] = change.RateOf(oldShape, rates, j, i);
                }
            }
            _whole.Contacts?.Take(before.Contacts!, _rod.Rod.ElementCount + 1);
            terms.Walls()?.Friction?.Anchors.Take(friction!.Anchors, change.Node);
            TakeLoads();
            var counts = new Snapshot();
            before.SerializeCounts(counts);
            _whole.SerializeCounts(counts.ToRead());
        }

        private bool IsAsBuilt()
        {
            for (int i = 1; i < _active.Length; i++)
            {
                if (_nodes.Beyond[i] != _rod.Joints.BeyondOf(i) || _rod.Joints.ActiveCountOf(i) != _active[i])
                {
                    return false;
                }
            }
            return true;
        }

        private void Start(MaterialScene scene, RodTerms terms, double time, double turn)
        {
            for (int i = 1; i < _active.Length; i++)
            {
                _active[i] = _rod.Joints.ActiveCountOf(i);
            }
            _dynamics = _setup.Dynamics(scene, terms);
            _dynamics.GoOn(time, turn);
            terms.SetTime(scene.Schedule, time);
            if (terms.Walls() != null)
            {
                terms.Walls()!.Spring.Axis = _setup.Axis;
            }
            _whole = new DirectStep(scene, _dynamics, _method, _report,
                Contacts == null ? null : new ContactRecord(scene.Shape.X.Length));
        }

        private void TakeLoads()
        {
            _dynamics.Terms.SetTime(_whole.Schedule, _dynamics.Time);
            _rod.TakeLoads(_dynamics.Shape);
        }

        private void TakeContacts()
        {
            if (Contacts != null)
            {
                ContactRecord whole = _whole.Contacts!;
                Contacts.Take(whole, 0);
                TakeForces(whole, _drives.Length - 1, Contacts.Forces);
                for (int i = 0; i < _records.Length; i++)
                {
                    TakeForces(whole, i, _records[i].ContactForces);
                }
            }
        }

        // A node of the chain is one of the outermost instrument there; that at a tip is the outer one's.
        private void TakeForces(ContactRecord whole, int instrument, Vector3d[] forces)
        {
            whole.CopyForces(forces, forces.Length - 1 - _rod.Joints.TipOf(instrument),
                instrument == 0 ? 0 : _rod.Joints.TipOf(instrument - 1) + 1);
        }

        private void TakePlay()
        {
            foreach (CoaxialRecord record in _records)
            {
                record.TakePlay(_rod.Joints, _dynamics.Shape);
            }
        }

        private void TakeInner()
        {
            foreach (InnerInstrument inner in _inner)
            {
                inner.Take(_dynamics, _rod.Joints);
            }
        }
    }
}
