using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Steps of a wire in a sheath or in one or two catheters, as one rod (<see cref="CoaxialChain"/>): the
    /// drives of its hubs, what they do at a hubForceLimit, and the results of each instrument.</summary>
    internal sealed class CoaxialStep : TimeStepper
    {
        private readonly SolverReport _report;
        private readonly CoaxialSetup _setup;
        private readonly MaterialDrive[] _drives;      // of the outermost catheter first, of the wire last
        private readonly SlippingHubs _slips;
        private readonly CoaxialHubs _hubs;
        private readonly CatheterRecords _records;
        private readonly bool _isAlone;                // a wire in a sheath
        private readonly InnerInstrument[] _inner;     // the wire last
        private readonly double[] _insertions;         // before a step, m
        private readonly HubRecord _hub;
        private readonly StressRecord _stress;         // of a wire in a sheath
        private readonly WireStress _wireStress;       // of one among others
        private readonly StepStart _start;
        private readonly CoaxialChain _chain;

        /// <summary>A step of the instruments of these parameters, from their start.</summary>
        /// <param name="failure">Why there is no rest shape to start from, or null.</param>
        public CoaxialStep(SimulationParameters parameters, SolverReport report, out string? failure)
        {
            _report = report;
            _setup = new CoaxialSetup(parameters);
            _drives = _setup.Drives();
            int count = _drives.Length;
            _insertions = new double[count];
            _isAlone = count == 1;
            _start = new StepStart(SerializeStep);
            _slips = new SlippingHubs(_drives, _setup.Slips(_drives), _start, _setup.Work, StepAsRequested,
                hub => Coaxial()!.ForceOf(hub));
            _records = new CatheterRecords(_setup, _drives);
            _hubs = new CoaxialHubs(Array.ConvertAll(_drives, drive => drive.Hub), _setup.Axis, _setup.Sheath);
            _inner = new InnerInstrument[Math.Max(count - 1, 1)];
            for (int i = 0; i < _inner.Length; i++)
            {
                _inner[i] = new InnerInstrument(_setup, _hubs, count - _inner.Length + i);
            }
            _hub = new HubRecord(_setup.Wire.Rod, _setup.Wire.Supports);
            _stress = new StressRecord(_setup.Wire.Rod, _setup.Wire.Supports);
            _wireStress = new WireStress(_setup, Wire);
            if (_setup.Wire.Walls.Length > 0)
            {
                string? outside = _setup.FindProblemOfStart();
                if (outside != null)
                {
                    throw new ArgumentException(outside);
                }
                Contacts = new ContactRecord(_setup.Wire.Rod.ElementCount + 1);
                Contacts.SetElements(_isAlone ? _setup.Wire.Rod.ElementCount : 0, _setup.Wire.Walls);
            }
            _chain = new CoaxialChain(parameters, report, _setup, _drives, _hubs, Wire, out failure);
            TakeResults();
        }

        /// <summary>Sums over the run and the walls' forces; on spheres those of the wire, beyond the tips around it.
        /// </summary>
        public override ContactRecord? Contacts { get; }

        /// <summary>Whether the start is a rest shape.</summary>
        public bool IsAtRest => _chain.IsAtRest;

        /// <summary>The motion of what is simulated.</summary>
        public RodDynamics Dynamics => _chain.Dynamics;

        /// <summary>All instruments as one rod.</summary>
        public CoaxialRod Rod => _chain.Rod;

        /// <inheritdoc/>
        public override void AddWarnings(List<RunWarning> warnings)
        {
            if (_isAlone)
            {
                _chain.Whole.AddWarnings(warnings);
                return;
            }
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
            Failure = _chain.Whole.Failure;
            Divergence = _chain.Whole.Divergence;
            SteadyState = _chain.Whole.SteadyState;
            PredictionError = _chain.Whole.PredictionError;
            if (isDone)
            {
                TakeResults();
                if (_records.HasFriction)
                {
                    Coaxial();
                    _setup.TakeStrains(_records.All, _report);
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
            double insertion = _drives[0].Insertion;
            double turn = _drives[0].Turn;
            MoveWindow();
            BeginStep();
            return _chain.Step(insertion, turn);
        }

        /// <summary>See <see cref="CoaxialChain.MoveWindow"/>.</summary>
        public void MoveWindow()
        {
            _chain.MoveWindow();
        }

        // Moves the hubs as far as allowed.
        private void BeginStep()
        {
            _chain.TakeLoads();
            _setup.LimitDrives(_drives, _hubs, Dynamics.Time);
            for (int i = 0; i < _drives.Length; i++)
            {
                _insertions[i] = _drives[i].Insertion;
                _drives[i].Prepare(Dynamics.Shape, Dynamics.Time);
            }
            _records.BeginStep(_insertions);
        }

        /// <summary>Writes the wire as it is into a state.</summary>
        public void WriteWire(RodState state)
        {
            _setup.Wire.Write(state, Wire.Shape, Wire.Velocities, Wire.Spins);
        }

        /// <inheritdoc/>
        public override HubRecord? Hub()
        {
            HubRecord hub = _hub;
            if (Coaxial() is CoaxialRecord record)
            {
                Quaterniond[] q = Wire.Shape.Q;
                hub.Take(_drives[_drives.Length - 1], record.WireForce, record.WireTorque, q[q.Length - 1].Director3,
                    record.WireTwist, record.LargestCurvature);
            }
            else
            {
                hub = _chain.Whole.Hub()!;
            }
            if (_setup.Sheath != null)
            {
                Wire.WriteBody(hub, _setup.Sheath, Rod.Joints.LeadOf(_drives.Length - 1) + Rod.Joints.Sheathed);
            }
            return hub;
        }

        /// <inheritdoc/>
        public override StressRecord? Stress()
        {
            if (Coaxial() is CoaxialRecord record)
            {
                return _wireStress.Take(Dynamics, Rod.Joints, Energies()!.Value, record.WireForce);
            }
            _chain.TakeTime();
            Wire.TakeForces(Dynamics.Terms, Dynamics.Shape);
            _stress.Take(_chain.Whole.Stress()!, _setup.Wire.Rod, Rod.Joints.First, _setup.Axis, Wire.Thrust,
                Wire.Torque);
            return _stress;
        }

        /// <inheritdoc/>
        public override CoaxialRecord? Coaxial()
        {
            if (_isAlone)
            {
                return null;
            }
            _chain.TakeTime();
            return _records.Take(Dynamics, Rod.Joints, _inner);
        }

        /// <inheritdoc/>
        public override Vector3d? Energies()
        {
            if (_isAlone)
            {
                return base.Energies();
            }
            _chain.TakeTime();
            RodTerms terms = Dynamics.Terms;
            return new Vector3d(Dynamics.KineticEnergy,
                terms.ElasticEnergy(Dynamics.Shape) - Rod.Axial.PreloadEnergy, terms.LoadPotential(Dynamics.Shape));
        }

        /// <inheritdoc/>
        public override SolverReport? Report()
        {
            return _chain.Whole.Report();
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            double time = Dynamics.Time;
            int first = Rod.Joints.First;
            _chain.SerializeNodes(snapshot, ref first);
            snapshot.Serialize(ref time);
            for (int i = 1; i < _drives.Length; i++)
            {
                _drives[i].Hub.Serialize(snapshot, time);
                _drives[i].Serialize(snapshot);
            }
            _slips.Serialize(snapshot);
            _records.Serialize(snapshot);
            _chain.Serialize(snapshot, first, time);
            if (!snapshot.IsWritten)
            {
                TakeInner();
                TakeContacts();
            }
        }

        /// <summary>Why an instrument cannot be exchanged where it is, in one phrase, or null.</summary>
        /// <param name="instrument">0 the outermost one.</param>
        public string? FindInVessel(int instrument)
        {
            return CoaxialExchange.FindInVessel(_setup, _hubs, instrument, Dynamics.Time);
        }

        /// <summary>Goes on from where other instruments were: hubs with the insertion that they had, the rest where it
        /// was.</summary>
        /// <param name="isOther">Which instruments were others, the outermost one first.</param>
        /// <exception cref="ArgumentException">One of them is in the vessel, or one does not fit the others.</exception>
        public void GoOnFrom(CoaxialStep former, bool[] isOther)
        {
            double time = former.Dynamics.Time;
            Vector3d[] starts = Array.ConvertAll(_drives, drive => drive.Hub.PositionAt(0.0));
            var kept = new Snapshot();
            former.SerializeHubs(kept, time);
            SerializeHubs(kept.ToRead(), time);
            double shift = 0.0;
            string? problem = null;
            for (int i = 0; i < isOther.Length; i++)
            {
                if (isOther[i])
                {
                    Vector3d place = starts[i] + _drives[i].Insertion * _setup.Axis;
                    double move = Vector3d.Dot(place - _drives[i].Hub.PositionAt(time), _setup.Axis);
                    _drives[i].Hub.Shift(move * _setup.Axis);
                    shift -= i == 0 ? move : 0.0;
                    problem ??= former.FindInVessel(i);
                }
            }
            for (int i = 0; i < isOther.Length; i++)
            {
                problem ??= isOther[i] ? CoaxialExchange.FindInVessel(_setup, _hubs, i, time) : null;
            }
            problem ??= CoaxialExchange.FindMisfit(_setup, _hubs, time);
            if (problem != null)
            {
                throw new ArgumentException(problem);
            }
            _chain.GoOnFrom(former._chain, isOther, shift);
            TakeInner();
            TakeContacts();
        }

        // How far they have come, and what the run has counted.
        private void SerializeHubs(Snapshot snapshot, double time)
        {
            foreach (MaterialDrive drive in _drives)
            {
                drive.Hub.Serialize(snapshot, time);
                drive.Serialize(snapshot);
            }
            _slips.Serialize(snapshot);
            _records.Serialize(snapshot);
            _report.Serialize(snapshot);
        }

        /// <summary>Writes or restores all that a step may touch, for a <see cref="StepStart"/>.</summary>
        public void SerializeStep(Snapshot snapshot)
        {
            for (int i = 1; i < _drives.Length; i++)
            {
                _drives[i].SerializeStep(snapshot);
            }
            _records.Serialize(snapshot);
            _chain.SerializeStep(snapshot);
            if (!snapshot.IsWritten)
            {
                _chain.TakeTime();
            }
        }

        private InnerInstrument Wire => _inner[_inner.Length - 1];

        // Where the instruments are and what touches them.
        private void TakeResults()
        {
            (Dynamics.Terms.Bending as CoaxialBendTwist)?.SetIdleTwists(Dynamics.Shape);
            _records.TakePlay(Rod.Joints, Dynamics.Shape);
            _chain.TakeTime();
            TakeInner();
            TakeContacts();
        }

        private void TakeContacts()
        {
            if (Contacts != null)
            {
                ContactRecord whole = _chain.Whole.Contacts!;
                Contacts.Take(whole, Rod.Joints.First);
                TakeForces(whole, _drives.Length - 1, Contacts.Forces);
                for (int i = 0; i < _records.All.Length; i++)
                {
                    TakeForces(whole, i, _records.All[i].ContactForces);
                }
            }
        }

        // A node of the chain is one of the outermost instrument there; that at a tip is the outer one's.
        private void TakeForces(ContactRecord whole, int instrument, Vector3d[] forces)
        {
            whole.CopyForces(forces, forces.Length - 1 - Rod.Joints.TipOf(instrument),
                instrument == 0 ? 0 : Rod.Joints.TipOf(instrument - 1) + 1);
        }

        private void TakeInner()
        {
            foreach (InnerInstrument inner in _inner)
            {
                inner.Take(Dynamics, Rod.Joints);
            }
        }
    }
}
