using System;

namespace Guidewire.Core
{
    /// <summary>A wire in a sheath or in one or two catheters, as one rod (<see cref="CoaxialChain"/>).</summary>
    internal abstract class CoaxialInstruments : InstrumentSet
    {
        private readonly ContactRecord? _contacts;

        /// <summary>The instruments of a setup at their start.</summary>
        /// <param name="failure">Why there is no rest shape to start from, or null.</param>
        protected CoaxialInstruments(SimulationParameters parameters, SolverReport report, CoaxialSetup setup,
            MaterialDrive[] drives, out string? failure)
            : base(drives, setup.Slips(drives), setup.Work)
        {
            Setup = setup;
            Hubs = new CoaxialHubs(Array.ConvertAll(drives, drive => drive.Hub), setup.Axis, setup.Sheath);
            Wire = new InnerInstrument(setup, Hubs, drives.Length - 1);
            MaterialScene wire = setup.Wire;
            if (wire.Walls.Length > 0)
            {
                string? outside = setup.FindProblemOfStart();
                if (outside != null)
                {
                    throw new ArgumentException(outside);
                }
                _contacts = new ContactRecord(wire.Rod.ElementCount + 1);
                _contacts.SetElements(wire.Rod.ElementCount, wire.Walls, drives.Length == 1);
            }
            Chain = new CoaxialChain(parameters, report, setup, drives, Hubs, Wire, out failure);
        }

        /// <summary>The instruments of these parameters at their start.</summary>
        /// <param name="failure">Why there is no rest shape to start from, or null.</param>
        public static CoaxialInstruments Create(SimulationParameters parameters, SolverReport report,
            out string? failure)
        {
            var setup = new CoaxialSetup(parameters);
            MaterialDrive[] drives = setup.Drives();
            CoaxialInstruments all = drives.Length == 1
                ? new SheathedWire(parameters, report, setup, drives, out failure)
                : (CoaxialInstruments)new WireInCatheters(parameters, report, setup, drives, out failure);
            all.TakeMoment();
            return all;
        }

        /// <summary>What is simulated of them.</summary>
        public CoaxialChain Chain { get; }

        /// <inheritdoc/>
        public override MonitoredRod Rod => Chain.Whole;

        /// <summary>Sums over the run and the walls' forces; on spheres those of the wire, beyond the tips around it.
        /// </summary>
        public override ContactRecord? Contacts => _contacts;

        /// <summary>What they are built from.</summary>
        protected CoaxialSetup Setup { get; }

        /// <summary>Where their hubs are.</summary>
        protected CoaxialHubs Hubs { get; }

        /// <summary>The wire's own shape.</summary>
        protected InnerInstrument Wire { get; }

        /// <inheritdoc/>
        public override double BeginPart(double left)
        {
            return Chain.BeginPart(left);
        }

        /// <inheritdoc/>
        public override void Take()
        {
            TakeMoment();
        }

        /// <inheritdoc/>
        public override void Write(RodState state)
        {
            Setup.Wire.Write(state, Wire.Shape, Wire.Velocities, Wire.Spins);
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            double time = Rod.Dynamics.Time;
            int first = Chain.Rod.Joints.First;
            Chain.SerializeNodes(snapshot, ref first);
            snapshot.Serialize(ref time);
            SerializeHubs(snapshot, time, 1);
            Chain.Serialize(snapshot, first, time);
            if (!snapshot.IsWritten)
            {
                Setup.LimitAlone(Drives, Rod.Dynamics.Time);
                TakeShapes();
            }
        }

        /// <inheritdoc/>
        public override void SerializeStep(Snapshot snapshot)
        {
            for (int i = 1; i < Drives.Length; i++)
            {
                Drives[i].SerializeStep(snapshot);
            }
            SerializeRecords(snapshot);
            Chain.SerializeStep(snapshot);
            if (!snapshot.IsWritten)
            {
                Chain.TakeTime();
            }
        }

        /// <summary>Takes where the instruments are and what touches them.</summary>
        protected virtual void TakeMoment()
        {
            Chain.TakeTime();
            TakeShapes();
        }

        /// <summary>Takes the shape of each and the forces of walls on it.</summary>
        protected virtual void TakeShapes()
        {
            Wire.Take(Rod.Dynamics, Chain.Rod.Joints);
            if (_contacts != null)
            {
                _contacts.Take(Rod.Contacts!, Chain.Rod.Joints.First);
                TakeWalls(Drives.Length - 1, _contacts.Forces, _contacts.Displacements);
            }
        }

        /// <summary>Takes the forces of walls on an instrument, and how far they give way. A node of the chain is one
        /// of the outermost instrument there; that at a tip is the outer one's.</summary>
        protected void TakeWalls(int instrument, Vector3d[] forces, Vector3d[] displacements)
        {
            CoaxialJoints joints = Chain.Rod.Joints;
            int offset = forces.Length - 1 - joints.TipOf(instrument);
            int first = instrument == 0 ? 0 : joints.TipOf(instrument - 1);
            Rod.Contacts!.CopyTo(forces, displacements, offset, instrument == 0 ? 0 : first + 1, first);
        }

        /// <summary>Writes or restores how far hubs have come, and what the run has counted of instruments.</summary>
        /// <param name="time">s.</param>
        /// <param name="first">The first of the hubs.</param>
        protected void SerializeHubs(Snapshot snapshot, double time, int first)
        {
            for (int i = first; i < Drives.Length; i++)
            {
                Drives[i].Hub.Serialize(snapshot, time);
                Drives[i].Serialize(snapshot);
            }
            foreach (HubSlip slip in Slips)
            {
                slip.Serialize(snapshot);
            }
            SerializeRecords(snapshot);
        }

        /// <summary>Writes or restores what the results of instruments need of former steps.</summary>
        protected virtual void SerializeRecords(Snapshot snapshot)
        {
        }
    }
}
