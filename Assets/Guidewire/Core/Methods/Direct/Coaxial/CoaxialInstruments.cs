using System;

namespace Guidewire.Core
{
    /// <summary>A step of coaxial instruments as one rod (<see cref="CoaxialChain"/>). This one is of a wire alone in a
    /// sheath, of which only the part near the exit and beyond is simulated.</summary>
    internal class CoaxialInstruments : DirectStep
    {
        private readonly ContactRecord? _contacts;
        private readonly HubOrder _order;
        private StressRecord? _stress;

        /// <summary>The instruments of a setup at their start.</summary>
        /// <param name="timeStep">s.</param>
        protected CoaxialInstruments(CoaxialSetup setup, MaterialDrive[] drives, CoaxialChain chain, double timeStep)
            : base(chain.Whole, drives, setup.Slips(drives), timeStep)
        {
            Setup = setup;
            Chain = chain;
            _order = new HubOrder(setup, drives, chain.Hubs);
            MaterialScene wire = setup.Wire;
            if (Rod.Contacts != null)
            {
                _contacts = new ContactRecord(wire.Rod.ElementCount + 1);
                _contacts.SetElements(wire.Rod.ElementCount, wire.Walls, drives.Length == 1,
                    Rod.Contacts.StrandForces.Length > 0);
            }
        }

        /// <summary>The instruments of these parameters at their start.</summary>
        /// <param name="failure">Why there is no rest shape to start from, or null.</param>
        public static CoaxialInstruments Create(SimulationParameters parameters, SolverReport report,
            out string? failure)
        {
            var setup = new CoaxialSetup(parameters);
            if (setup.Wire.Walls.Length > 0 && setup.FindProblemOfStart() is string outside)
            {
                throw new ArgumentException(outside);
            }
            double timeStep = parameters.Method.TimeStep;
            MaterialDrive[] drives = setup.Drives();
            var chain = new CoaxialChain(parameters, report, setup, drives, out failure);
            CoaxialInstruments all = drives.Length == 1 ? new CoaxialInstruments(setup, drives, chain, timeStep)
                : new WireInCatheters(setup, drives, chain, report, timeStep);
            all.TakeMoment();
            return all;
        }

        /// <summary>What is simulated of them.</summary>
        public CoaxialChain Chain { get; }

        /// <summary>Sums over the run and the walls' forces; on spheres those of the wire, beyond the tips around it.
        /// </summary>
        public override ContactRecord? Contacts => _contacts;

        /// <inheritdoc/>
        public override Vector3d? ExitOfSheath => Setup.Sheath?.Exit;

        /// <summary>What they are built from.</summary>
        protected CoaxialSetup Setup { get; }

        /// <summary>Where their hubs are.</summary>
        protected CoaxialHubs Hubs => Chain.Hubs;

        /// <summary>The wire's own shape.</summary>
        protected InnerInstrument Wire => Chain.Wire;

        /// <inheritdoc/>
        public override void Write(RodState state) => Setup.Wire.Write(state, Wire.Shape, Wire.Velocities, Wire.Spins);

        /// <inheritdoc/>
        public override HubRecord Hub()
        {
            HubRecord hub = OwnHub();
            if (Setup.Sheath != null)
            {
                CoaxialJoints joints = Chain.Rod.Joints;
                Wire.WriteBody(hub, Setup.Sheath, joints.LeadOf(Drives.Length - 1) + joints.Sheathed);
            }
            return hub;
        }

        /// <inheritdoc/>
        public override StressRecord Stress()
        {
            Chain.TakeTime();
            Wire.TakeForces(Dynamics.Terms, Dynamics.Shape);
            _stress ??= new StressRecord(Setup.Wire.Rod.JointLengths(Setup.Wire.Supports));
            _stress.Record(Rod.Stress(), Setup.Wire.Rod, Chain.Rod.Joints.First, Setup.Axis, Wire.Thrust, Wire.Torque);
            _stress.TakeFibres(Dynamics.Terms, Dynamics.Shape, 0);
            return _stress;
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            double time = Dynamics.Time;
            int first = Chain.Rod.Joints.First;
            bool isOther = Chain.SerializeNodes(snapshot, ref first);
            snapshot.Serialize(ref time);
            SerializeHubs(snapshot, time, 1);
            Chain.Serialize(snapshot, isOther ? first : (int?)null, time);
            if (!snapshot.IsWritten && !snapshot.IsStep)
            {
                _order.LimitAlone(Dynamics.Time);
                TakeShapes();
            }
        }

        /// <summary>The wire's hub without what is out of a sheath.</summary>
        protected virtual HubRecord OwnHub() => Rod.Hub()!;

        /// <inheritdoc/>
        protected override void BeginStep()
        {
            _order.Limit(Dynamics.Time);
            Chain.BeginStep();
            Chain.MoveWindow();
            Chain.TakeLoads();
            foreach (MaterialDrive drive in Drives)
            {
                drive.Prepare(Dynamics.Shape, Dynamics.Time);
            }
        }

        /// <inheritdoc/>
        protected override double BeginPart(double left) => Chain.BeginPart(left);

        /// <inheritdoc/>
        protected override void RecordStep()
        {
            TakeMoment();
            Chain.TakeBorne();
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
            Wire.UpdateFrom(Dynamics, Chain.Rod.Joints);
            if (_contacts != null)
            {
                _contacts.CopyFrom(Rod.Contacts!, Chain.Rod.Joints.First);
                TakeWalls(Drives.Length - 1, _contacts.Forces, _contacts.StrandForces,
                    _contacts.Displacements);
            }
        }

        /// <summary>Takes the forces of walls and strands on an instrument, and how far walls give way. A node of
        /// the chain is one of the outermost instrument there; that at a tip is the outer one's.</summary>
        protected void TakeWalls(int instrument, Vector3d[] forces, Vector3d[] strandForces, Vector3d[] displacements)
        {
            CoaxialJoints joints = Chain.Rod.Joints;
            int offset = forces.Length - 1 - joints.TipOf(instrument);
            int first = instrument == 0 ? 0 : joints.TipOf(instrument - 1);
            Rod.Contacts!.CopyTo(forces, strandForces, displacements, offset, instrument == 0 ? 0 : first + 1, first);
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

    /// <summary>How far the hubs of coaxial instruments may go: none passes the next one nor the exit of a sheath, and
    /// the tips inside stay in the outermost catheter by an element at least. A hub that is pressed against another
    /// carries it along. The hub of an instrument alone goes on to the exit of its sheath, and back until the tip is
    /// there.</summary>
    internal sealed class HubOrder
    {
        private const double Nowhere = 1e9;     // m, farther than any drive goes

        private readonly CoaxialInstrument[] _instrument;
        private readonly SheathEnd? _sheath;
        private readonly MaterialDrive[] _drives;
        private readonly CoaxialHubs _hubs;
        private readonly double[] _move;        // of each hub in the next step, m
        private readonly double[] _inside;      // how far each tip may go back, m
        private readonly double[] _gap;         // how far each hub is behind the next one around it, m

        /// <summary>Takes the hubs of a setup, which are at their start.</summary>
        public HubOrder(CoaxialSetup setup, MaterialDrive[] drives, CoaxialHubs hubs)
        {
            _instrument = setup.Instruments;
            _sheath = setup.Sheath;
            _drives = drives;
            _hubs = hubs;
            _move = new double[drives.Length];
            _inside = new double[drives.Length];
            _gap = new double[drives.Length];
            for (int i = 1; i < drives.Length; i++)
            {
                int hub = i;
                drives[i - 1].LetPress(drives[i], time => hubs.LeadAt(hub, time) - hubs.LeadAt(hub - 1, time));
            }
            LimitAlone(0.0);
        }

        /// <summary>Where an instrument alone is at a time says how far its hub may go in all of the run.</summary>
        public void LimitAlone(double time)
        {
            if (_drives.Length == 1)
            {
                double outside = _sheath!.Outside(_hubs.Outer.PositionAt(time));
                _drives[0].Limit(-outside - _instrument[0].Rod.TotalLength, -outside);
            }
        }

        /// <summary>Sets how far several may go in the step that begins at a time.</summary>
        public void Limit(double time)
        {
            int last = _drives.Length - 1;
            if (last == 0)
            {
                return;
            }
            for (int i = 1; i <= last; i++)
            {
                double lead = _hubs.LeadAt(i, time);
                double[] station = _instrument[i].Stations;
                _inside[i] = station[station.Length - 1] - lead - _instrument[0].Rod.Length[0];
                _gap[i] = lead - _hubs.LeadAt(i - 1, time);
            }
            double toExit = _sheath == null ? Nowhere : _hubs.SheathedAt(time);
            _drives[0].Limit(-Nowhere, toExit);
            _move[0] = _drives[0].NextMove(time);
            LimitInner(time, false);
            // What is to rest inside may hold back what is around it.
            for (int i = last - 1; i > 0; i--)
            {
                _drives[i].Limit(Math.Min(0.0, Math.Max(_move[0] - _inside[i], _move[i + 1] - _gap[i + 1])),
                    Math.Max(0.0, _gap[i] + _move[i - 1]));
                _move[i] = _drives[i].NextMove(time);
            }
            double forward = toExit;
            for (int i = 1; i <= last; i++)
            {
                forward = Math.Min(forward, Math.Max(0.0, _inside[i] + _move[i]));
            }
            _drives[0].Limit(Math.Min(0.0, _move[1] - _gap[1]), forward);
            if (last > 1)
            {
                _move[0] = _drives[0].NextMove(time);
                LimitInner(time, true);
            }
        }

        // isLast: what is inside has been limited before, and goes no farther than it was to go then.
        private void LimitInner(double time, bool isLast)
        {
            for (int i = 1; i < _drives.Length; i++)
            {
                double back = _move[0] - _inside[i];
                back = isLast && i + 1 < _drives.Length ? Math.Max(back, _move[i + 1] - _gap[i + 1]) : back;
                _drives[i].Limit(Math.Min(0.0, back), Math.Max(0.0, _gap[i] + _move[i - 1]));
                _move[i] = _drives[i].NextMove(time);
            }
        }
    }
}
