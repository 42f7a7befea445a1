using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>A wire in one or two catheters, with a sheath around them or without.</summary>
    internal sealed class WireInCatheters : CoaxialInstruments
    {
        private readonly SolverReport _report;
        private readonly CatheterRecords _records;
        private readonly InnerInstrument[] _each;      // the outermost one first, the wire last
        private readonly HubRecord _hub;
        private readonly WireStress _stress;
        private readonly HubForceErrors _errors;

        /// <summary>At their start.</summary>
        /// <param name="timeStep">s.</param>
        public WireInCatheters(CoaxialSetup setup, MaterialDrive[] drives, CoaxialChain chain, SolverReport report,
            double timeStep)
            : base(setup, drives, chain, timeStep)
        {
            _report = report;
            _records = new CatheterRecords(setup, drives);
            _each = new InnerInstrument[drives.Length];
            for (int i = 0; i < _each.Length; i++)
            {
                _each[i] = i == _each.Length - 1 ? Wire : new InnerInstrument(setup, Hubs, i);
            }
            _hub = new HubRecord(setup.Wire.Rod.JointLengths(setup.Wire.Supports));
            _stress = new WireStress(setup, Wire);
            _errors = new HubForceErrors(drives.Length);
        }

        /// <inheritdoc/>
        public override double ForceOf(int hub) => Coaxial()!.ForceOf(hub);

        /// <inheritdoc/>
        public override StressRecord Stress()
        {
            double force = Coaxial()!.WireForce;
            RodTerms terms = Dynamics.Terms;
            StressRecord record = _stress.Record(Dynamics, Chain.Rod.Joints, force);
            record.TakeEnergies(Dynamics.KineticEnergy,
                terms.ElasticEnergy(Dynamics.Shape) - Chain.Rod.Axial.PreloadEnergy
                + (terms.Fibres?.LeadEnergy ?? 0.0),
                terms.LoadPotential(Dynamics.Shape));
            record.TakeFibres(terms, Dynamics.Shape, Chain.Rod.Joints.InnerCount);
            return record;
        }

        /// <inheritdoc/>
        public override CoaxialRecord? Coaxial()
        {
            Chain.TakeTime();
            CoaxialRecord outermost = _records.Record(Dynamics, Chain.Rod.Joints, _each);
            for (int i = 0; i < _records.All.Length; i++)
            {
                _records.All[i].SlippedFrom = Slips[i].Record.SlippedFrom;
                _records.All[i].ForceError = _errors.Of(i);
            }
            return outermost;
        }

        /// <inheritdoc/>
        public override void AddWarnings(List<RunWarning> warnings)
        {
            int last = Slips.Length - 1;
            for (int k = last; k >= 0; k--)
            {
                string name = k == last ? "the wire's hub" : last == 1 ? "the catheter's hub"
                    : k == 0 ? "the outer catheter's hub" : "the inner catheter's hub";
                string stops = k == last
                    ? "it met the catheter's hub, or the wire's tip came to the first element of the catheter"
                    : last == 1 ? "it met the wire's hub, or its first element came to the wire's tip"
                    : "it met the next hub, or its first element came to a tip inside";
                stops += k < last && Setup.Sheath != null ? ", or its hub to the exit of the sheath" : "";
                if (Drives[k].FallsShort)
                {
                    warnings.Add(WarningTable.HubShortfall.With(name, Drives[k].Slip,
                        Slips[k].Record.Why is string slipped ? slipped + ", or " + stops : stops));
                }
                if (Slips[k].Record.FindExcess(name) is RunWarning excess)
                {
                    warnings.Add(excess);
                }
                if (_errors.FindWarning(k, name) is RunWarning uncertain)
                {
                    warnings.Add(uncertain);
                }
            }
        }

        /// <summary>Why an instrument cannot be exchanged where it is, in one phrase, or null.</summary>
        /// <param name="instrument">0 the outermost one.</param>
        public string? FindInVessel(int instrument) =>
            CoaxialExchange.FindInVessel(Setup, Hubs, instrument, Dynamics.Time);

        /// <summary>Goes on from where other instruments were: hubs with the insertion that they had, the rest where it
        /// was.</summary>
        /// <param name="isOther">Which instruments were others, the outermost one first.</param>
        /// <exception cref="ArgumentException">One of them is in the vessel, or one does not fit the others;
        /// other walls.</exception>
        public void ResumeFrom(WireInCatheters former, bool[] isOther)
        {
            if (Setup.Wire.Walls.Length != former.Setup.Wire.Walls.Length)
            {
                throw new ArgumentException("walls cannot come or go together with an instrument");
            }
            double time = former.Dynamics.Time;
            Vector3d[] starts = Array.ConvertAll(Drives, drive => drive.Hub.PositionAt(0.0));
            var kept = new Snapshot();
            former.SerializeHubs(kept, time, 0);
            former._report.Serialize(kept);
            Snapshot read = kept.ToRead();
            SerializeHubs(read, time, 0);
            _report.Serialize(read);
            double shift = 0.0;
            string? problem = null;
            for (int i = 0; i < isOther.Length; i++)
            {
                if (isOther[i])
                {
                    Vector3d place = starts[i] + Drives[i].Insertion * Setup.Axis;
                    double move = Vector3d.Dot(place - Drives[i].Hub.PositionAt(time), Setup.Axis);
                    Drives[i].Hub.Shift(move * Setup.Axis);
                    shift -= i == 0 ? move : 0.0;
                    problem ??= former.FindInVessel(i);
                }
            }
            for (int i = 0; i < isOther.Length; i++)
            {
                problem ??= isOther[i] ? CoaxialExchange.FindInVessel(Setup, Hubs, i, time) : null;
            }
            problem ??= CoaxialExchange.FindMisfit(Setup, Hubs, time);
            if (problem != null)
            {
                throw new ArgumentException(problem);
            }
            Chain.ResumeFrom(former.Chain, isOther, shift);
            TakeShapes();
        }

        /// <inheritdoc/>
        protected override HubRecord OwnHub()
        {
            CoaxialRecord record = Coaxial()!;
            Quaterniond[] q = Wire.Shape.Q;
            _hub.ForceError = _errors.Of(Slips.Length - 1);
            _hub.SlippedFrom = Slips[Slips.Length - 1].Record.SlippedFrom;
            _hub.Record(Drives[Drives.Length - 1], record.WireForce, record.WireTorque, q[q.Length - 1].Director3,
                record.WireTwist, record.LargestCurvature);
            return _hub;
        }

        /// <inheritdoc/>
        protected override void BeginStep()
        {
            base.BeginStep();
            _records.BeginStep();
        }

        /// <inheritdoc/>
        protected override void RecordStep()
        {
            base.RecordStep();
            _errors.AddStep(Dynamics, Chain.Rod.Joints, Coaxial()!.Force);
            if (_records.HasFriction)
            {
                Setup.TakeStrains(_records.All, _report, Dynamics.Time);
            }
        }

        /// <inheritdoc/>
        protected override void TakeMoment()
        {
            RodShape shape = Dynamics.Shape;
            Dynamics.Terms.CoaxialBending!.SetIdleTwists(shape);
            _records.TakePlay(Chain.Rod.Joints, shape);
            base.TakeMoment();
        }

        /// <inheritdoc/>
        protected override void TakeShapes()
        {
            base.TakeShapes();
            for (int i = 0; i < _records.All.Length; i++)
            {
                _each[i].UpdateFrom(Dynamics, Chain.Rod.Joints);
                if (Contacts != null)
                {
                    CoaxialRecord own = _records.All[i];
                    TakeWalls(i, own.ContactForces, own.StrandForces, own.WallDisplacements);
                }
            }
        }

        /// <inheritdoc/>
        protected override void SerializeRecords(Snapshot snapshot)
        {
            _records.Serialize(snapshot);
            _errors.Serialize(snapshot);
        }
    }

    /// <summary>Results of the catheters around a wire, the outermost one first, and the forces of all hubs.</summary>
    internal sealed class CatheterRecords
    {
        private readonly CoaxialRecord[] _records;
        private readonly MaterialDrive[] _drives;      // of the outermost catheter first, of the wire last
        private readonly Vector3d _axis;
        private readonly double[] _forces;             // of the hubs without friction, N

        /// <summary>Makes empty records of the catheters of a setup.</summary>
        public CatheterRecords(CoaxialSetup setup, MaterialDrive[] drives)
        {
            _records = setup.Records();
            _drives = drives;
            _axis = setup.Axis;
            _forces = new double[drives.Length];
            HasFriction = Array.Exists(_records, record => record.FrictionCoefficient > 0.0);
        }

        /// <summary>Whether a lumen has friction.</summary>
        public bool HasFriction { get; }

        /// <summary>The records of all catheters.</summary>
        public CoaxialRecord[] All => _records;

        /// <summary>A step begins, for which the hubs' drives have been prepared.</summary>
        public void BeginStep()
        {
            foreach (CoaxialRecord record in _records)
            {
                record.TakeStep(_drives);
            }
        }

        /// <summary>Takes a moment, at the time that was set last.</summary>
        /// <param name="instruments">The outermost one first.</param>
        public CoaxialRecord Record(RodDynamics dynamics, CoaxialJoints joints, InnerInstrument[] instruments)
        {
            RodTerms terms = dynamics.Terms;
            RodShape shape = dynamics.Shape;
            CoaxialBendTwist bending = terms.CoaxialBending!;
            int wire = _records.Length;
            // The outermost hub has the chain's reaction less those of the others.
            _forces[0] = Vector3d.Dot(dynamics.ReactionAt(0), _axis);
            double torque = Vector3d.Dot(bending.ProximalCouple(shape), _axis);
            double wireTorque = bending.InnerTorque(shape, wire);
            double inside = 0.0;
            for (int i = wire; i > 0; i--)
            {
                _forces[i] = terms.Release!.InnerForce(shape, terms, i);
                _forces[0] -= _forces[i];
                double own = bending.InnerTorque(shape, i);
                torque -= own;
                if (i < wire)
                {
                    _records[i].Record(joints, terms, shape, instruments[i].Shape, _drives[i], _drives[wire], own,
                        wireTorque, inside);
                }
                inside += _forces[i];
            }
            _forces[0] += terms.SheathForce(shape);
            _records[0].Record(joints, terms, shape, instruments[0].Shape, _drives[0], _drives[wire], torque,
                wireTorque, inside);
            double around = 0.0;
            double wireForce = _forces[wire] + _records[wire - 1].FrictionForce;
            for (int i = 0; i < wire; i++)
            {
                _records[i].TakeMotion(instruments[i].Velocities, instruments[i].Spins);
                _records[i].TakeForces(_forces[i], around, wireForce);
                around = _records[i].FrictionForce;
            }
            return _records[0];
        }

        /// <summary>Takes what is left between the instruments.</summary>
        public void TakePlay(CoaxialJoints joints, RodShape shape)
        {
            foreach (CoaxialRecord record in _records)
            {
                record.TakePlay(joints, shape);
            }
        }

        /// <summary>Writes or restores all of it.</summary>
        public void Serialize(Snapshot snapshot)
        {
            foreach (CoaxialRecord record in _records)
            {
                record.Serialize(snapshot);
            }
        }
    }

    /// <summary>Strains, forces and couples of a wire among coaxial instruments, at its own joints and
    /// elements.</summary>
    /// <remarks>Its curvature is that of the shared centreline, linear between the joints of the chain, about the
    /// wire's own axes; its twist is its own. Couples follow by its own stiffness. Along the axis it has its own loads,
    /// and of what else is there (walls, inertia) the part of its EA in that of all; of the shear force that of its GA.
    /// In a sheath it is straight, and behind the outermost hub, where it has the force of its hub. That alone has
    /// friction in a lumen, and what bending in one another makes of a force along the axis.</remarks>
    internal sealed class WireStress
    {
        private readonly CoaxialInstrument _own;
        private readonly InnerInstrument _wire;
        private readonly Joint[] _joints;       // as if it were alone
        private readonly double[] _lengths;     // of wire that each stands for, m
        private readonly StressRecord _record;

        /// <summary>Makes one of the innermost instrument.</summary>
        /// <param name="wire">Where it is.</param>
        public WireStress(CoaxialSetup setup, InnerInstrument wire)
        {
            _wire = wire;
            _own = setup.Instruments[setup.Instruments.Length - 1];
            _joints = wire.Joints;
            _lengths = _own.Rod.JointLengths(InnerInstrument.Supports);
            _record = new StressRecord(_lengths);
        }

        /// <summary>The record at the time that was set last; the next call writes it anew.</summary>
        /// <param name="thrust">Of the wire's hub, N.</param>
        public StressRecord Record(RodDynamics dynamics, CoaxialJoints joints, double thrust)
        {
            CoaxialBendTwist bending = dynamics.Terms.CoaxialBending!;
            int wire = joints.InnerCount;
            double lead = joints.LeadOf(wire);
            int n = _own.Rod.ElementCount;
            int j = 0;
            for (int k = 0; k <= n; k++)
            {
                double at = _own.Stations[k] - lead;
                j = CoaxialShape.ElementAt(joints, at, j);
                Vector3d curvature = k == n ? Vector3d.Zero
                    : at < joints.Stations[0] ? CoaxialShape.LeadTwist(dynamics.Shape, bending, wire)
                    : Curvature(dynamics.Shape, bending, j, at);
                curvature = at < joints.Sheathed ? curvature.Z * Vector3d.UnitZ : curvature;
                Joint joint = _joints[k];
                Vector3d couple = _lengths[k] * curvature - joint.Rest;
                couple = new Vector3d(joint.Bend1 * couple.X, joint.Bend2 * couple.Y, joint.Twist * couple.Z)
                    + (_own.Rod.Fibres?.CoupleAt(k, curvature, at < joints.Sheathed) ?? Vector3d.Zero);
                _record.Curvature[k] = curvature;
                _record.Couple[k] = k == n ? Vector3d.Zero : Quaterniond.Rotate(_wire.Shape.Q[k], couple);
                if (k < n)
                {
                    TakeElement(dynamics, joints, k, at + 0.5 * _own.Rod.Length[k], j, thrust);
                }
            }
            return _record;
        }

        // Rad/m, at a place along the chain in element j.
        private static Vector3d Curvature(RodShape shape, CoaxialBendTwist bending, int j, double at)
        {
            CoaxialJoints joints = bending.Joints;
            Vector3d before = CoaxialShape.CurvatureOf(shape, bending, j, joints.InnerCount);
            if (j + 1 >= joints.ElementCount)
            {
                return before;
            }
            double fraction = (at - joints.Stations[j]) / (joints.Stations[j + 1] - joints.Stations[j]);
            return Vector3d.Lerp(before, CoaxialShape.CurvatureOf(shape, bending, j + 1, joints.InnerCount), fraction);
        }

        private void TakeElement(RodDynamics dynamics, CoaxialJoints joints, int element, double at, int j,
            double thrust)
        {
            MaterialRod rod = _own.Rod;
            Vector3d strain = new Vector3d(0.0, 0.0, -thrust / rod.StretchStiffness[element]);
            if (at >= joints.Stations[0])
            {
                RodShape shape = dynamics.Shape;
                j = CoaxialShape.ElementAt(joints, at, j);
                Vector3d force = dynamics.Terms.Stretch.Stress(shape, j, out Vector3d p);
                Quaterniond turn = _wire.Shape.Q[element].Conjugate * shape.Q[j];
                Vector3d shear = Quaterniond.Rotate(turn, new Vector3d(p.X, p.Y, 0.0));
                strain = new Vector3d(shear.X, shear.Y,
                    dynamics.Terms.Supports.Coaxial!.Axial.StrainOf(joints.InnerCount, j, force.Z));
            }
            _record.Strain[element] = strain;
            _record.Force[element] = Quaterniond.Rotate(_wire.Shape.Q[element], new Vector3d(
                rod.ShearStiffness[element] * strain.X, rod.ShearStiffness[element] * strain.Y,
                rod.StretchStiffness[element] * strain.Z));
        }
    }
}
