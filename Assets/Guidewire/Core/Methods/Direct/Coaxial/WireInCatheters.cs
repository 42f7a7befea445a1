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
}
