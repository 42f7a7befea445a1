using System;
using System.Collections.Generic;
using System.Linq;

namespace Guidewire.Core
{
    /// <summary>One step of the direct solver: the hubs' motion, then all stages of the scheme, each an exact
    /// minimisation over the whole rod. One without a solution leaves everything, hubs and instruments, as it was
    /// before. This one is of a wire alone.</summary>
    internal class DirectStep : TimeStepper
    {
        private readonly double _timeStep;      // s
        private readonly StepStart _start;
        private readonly SlippingHubs _slipping;

        /// <summary>A step of a wire alone.</summary>
        /// <param name="timeStep">s.</param>
        public DirectStep(MonitoredRod rod, double timeStep)
            : this(rod, new[] { rod.Drive }, Array.Empty<HubSlip>(), timeStep)
        {
        }

        /// <summary>A step of instruments on these hubs, the outermost one first, the wire last.</summary>
        /// <param name="rod">What is simulated of them.</param>
        /// <param name="slips">What hubs do at a hubForceLimit that only other steps can find.</param>
        /// <param name="timeStep">s.</param>
        protected DirectStep(MonitoredRod rod, MaterialDrive[] drives, HubSlip[] slips, double timeStep)
        {
            Rod = rod;
            Drives = drives;
            Slips = slips;
            _timeStep = timeStep;
            _start = new StepStart(Serialize, Dynamics.Terms.Rod);
            _slipping = new SlippingHubs(this, _start);
        }

        /// <summary>What moves each hub, the outermost one first, the wire's last.</summary>
        public MaterialDrive[] Drives { get; }

        /// <summary>What they do at a hubForceLimit.</summary>
        public HubSlip[] Slips { get; }

        /// <summary>What is simulated at present.</summary>
        public MonitoredRod Rod { get; }

        /// <summary>The motion of that.</summary>
        public RodDynamics Dynamics => Rod.Dynamics;

        /// <inheritdoc/>
        public override WallField? FieldOf(int wall)
        {
            WallField?[]? fields = Dynamics.Terms.Walls()?.Barrier.Fields.Of;
            return wall < fields?.Length ? fields![wall] : null;
        }

        /// <inheritdoc/>
        public override ContactRecord? Contacts => Rod.Contacts;

        /// <summary>Takes the parts between which nodes come and go; again while a hub slips.</summary>
        public override void Advance(RodState state)
        {
            _start.Save();
            Dynamics.Work.BeginStep();
            _slipping.BeginStep();
            bool isDone;
            do
            {
                BeginStep();
                double start = Dynamics.Time;
                isDone = true;
                for (double done = 0.0; isDone && done < _timeStep;)
                {
                    double left = _timeStep - done;
                    double length = BeginPart(left);
                    Rod.BeginStep(length);
                    string? failure = Dynamics.Step(length);
                    isDone = Rod.EndStep(failure, length);
                    done = length == left ? _timeStep : Dynamics.Time - start;
                }
            }
            while (_slipping.NeedAnother(isDone));
            (Failure, Divergence) = (Rod.Failure, Rod.Divergence);
            (SteadyState, PredictionError) = (Rod.SteadyState, Rod.PredictionError);
            if (isDone)
            {
                RecordStep();
                Write(state);
            }
            else
            {
                _start.Restore();
            }
        }

        /// <summary>Writes the wire as it is into a state.</summary>
        public virtual void Write(RodState state) => Rod.Write(state);

        /// <summary>Gives the force of a hub on its instrument, N: of the outermost one first, of the wire
        /// last.</summary>
        public virtual double ForceOf(int hub) => Hub()!.Force;

        /// <inheritdoc/>
        public override void AddWarnings(List<RunWarning> warnings) => Rod.AddWarnings(warnings);

        /// <inheritdoc/>
        public override HubRecord? Hub() => Rod.Hub();

        /// <summary>Strains, forces and couples of the wire, and energies of all.</summary>
        public override StressRecord Stress() => Rod.Stress();

        /// <inheritdoc/>
        public override SolverReport? Report() => Rod.Report();

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot) => Rod.Serialize(snapshot);

        /// <summary>Moves the hubs, as far as they may go.</summary>
        protected virtual void BeginStep() => Drives[0].Prepare(Dynamics.Shape, Dynamics.Time);

        /// <summary>Takes in and leaves out nodes.</summary>
        /// <param name="left">Of the step, s.</param>
        /// <returns>How long no other ones come or go, at most what is left, s.</returns>
        protected virtual double BeginPart(double left) => left;

        /// <summary>Takes what a step has come to.</summary>
        protected virtual void RecordStep()
        {
        }
    }

    /// <summary>Snapshot of everything that a step may change, taken at its start: a step that is repeated begins with
    /// the same bits. Counters of work are not included.</summary>
    /// <remarks>Written into memory that is used anew, so that no step leaves garbage.</remarks>
    internal sealed class StepStart
    {
        private readonly Snapshot _kept = new Snapshot(isStep: true);
        private readonly Action<Snapshot> _exchange;
        private double _growth;    // of what is kept, at most; 0 once there is room for it

        /// <summary>For a step that touches what is exchanged here.</summary>
        /// <param name="rod">Whose elements may become more; null: they do not.</param>
        public StepStart(Action<Snapshot> exchange, MaterialRod? rod = null)
        {
            _exchange = exchange;
            _growth = rod == null ? 0.0 : (rod.Capacity + 1.0) / rod.ElementCount;
        }

        /// <summary>Saves the state at which a step begins.</summary>
        public void Save()
        {
            _kept.RewindForWriting();
            _exchange(_kept);
            if (_growth > 0.0)
            {
                _kept.Reserve(_growth);
                _growth = 0.0;
            }
        }

        /// <summary>Goes back to where it began.</summary>
        public void Restore()
        {
            _kept.RewindForReading();
            _exchange(_kept);
        }
    }

    /// <summary>Builds the parts of the direct solver from a run's parameters.</summary>
    internal static class DirectSetup
    {
        // As many times the iterations of a stage: a wall that is pressed to its limit takes more than a rigid one.
        private const int BetweenSoftWalls = 2;

        /// <summary>Gives the motion of a scene's rod by the direct solver.</summary>
        /// <param name="work">What the run may take; null where all of the run is this motion.</param>
        public static RodDynamics DynamicsOf(SimulationParameters parameters, MaterialScene scene, RodTerms terms,
            WorkLimit? work = null)
        {
            bool isSoft = Array.Exists(scene.Walls, wall => wall.Softness != null);
            int most = (isSoft ? BetweenSoftWalls : 1) * parameters.Method.MaxNewtonIterations;
            var dynamics = new RodDynamics(terms, scene.Schedule, scene.Shape, Scheme(parameters.Method.Integrator),
                parameters.Method.SolverTolerance, most, work)
            {
                Cancellation = parameters.Method.Cancellation,
            };
            dynamics.Control.Tolerance = parameters.Method.TimeStepError;
            dynamics.Begin(scene.Velocities, scene.Spins,
                parameters.Scene.InitialState == InitialState.Equilibrium);
            return dynamics;
        }

        /// <summary>What walls add to a wire's energy.</summary>
        public static WallTerms WallTermsOf(SimulationParameters parameters, MaterialScene scene, Barrier barrier,
            SupportSpring spring)
        {
            double move = parameters.Drive.LargestMove(parameters.Method.TimeStep, scene.Metres);
            var contact = new BarrierEnergy(scene.Rod, scene.Walls, scene.Metres, barrier, scene.Supports.SheathEnd);
            bool hasOwn = scene.Supports.Coaxial != null
                && parameters.Scene.Catheters.Any(catheter => catheter.FrictionCoefficient > 0.0);
            FrictionEnergy? friction = hasOwn
                || Array.Exists(scene.Walls, wall => wall.FrictionCoefficient > 0.0)
                ? new FrictionEnergy(contact, scene.Rod.ElementCount, 0.0, scene.Rod.Capacity) : null;
            SetFriction(parameters, scene, friction);
            // Searched for on demand: the rule measures the narrowest width of the whole vessel.
            ContactParameters given = parameters.Contact;
            Func<string?>? advice = null;
            if (given.ContactDistance != 0.0 || given.ContactStiffness != 0.0)
            {
                advice = () => BarrierDefaults.Advice(barrier, BarrierDefaults.Of(scene.Rod, new ContactParameters(),
                    scene.Walls, scene.Metres, move));
            }
            return new WallTerms(contact, friction, spring, scene.Supports.HasSpring, advice,
                SelfContactOf(parameters, scene, barrier));
        }

        private static (SelfContact Contact, SelfFriction? Friction)? SelfContactOf(SimulationParameters parameters,
            MaterialScene scene, in Barrier barrier)
        {
            ContactParameters given = parameters.Contact;
            if (!given.TouchesItself(scene.Walls.Length))
            {
                return null;
            }
            var contact = new SelfContact(scene.Rod, barrier, scene.Supports.SheathEnd);
            return (contact, given.SelfFriction > 0.0
                ? new SelfFriction(contact, scene.Rod, given.SelfFriction, SlipOf(given, scene.Rod)) : null);
        }

        private static double SlipOf(ContactParameters contact, MaterialRod rod) =>
            contact.ElasticSlip > 0.0 ? contact.ElasticSlip : FrictionEnergy.ElasticSlipOf(rod);

        /// <summary>Sets the coefficients of instruments, and the elastic slip by the rule.</summary>
        /// <param name="friction">Null: there is none.</param>
        public static void SetFriction(SimulationParameters parameters, MaterialScene scene, FrictionEnergy? friction)
        {
            if (friction == null)
            {
                return;
            }
            friction.ElasticSlip = SlipOf(parameters.Contact, scene.Rod);
            CoaxialJoints? coaxial = scene.Supports.Coaxial?.Joints;
            IReadOnlyList<Catheter> catheters = parameters.Scene.Catheters;
            for (int i = 0; coaxial != null && i < catheters.Count; i++)
            {
                friction.SetCoefficient(i == 0 ? 0 : coaxial.TipOf(i - 1), coaxial.TipOf(i),
                    catheters[i].FrictionCoefficient);
            }
        }

        /// <summary>Gives the scheme of an integrator of the direct solver; null for BDF2.</summary>
        public static RungeKuttaScheme? Scheme(Integrator integrator)
        {
            switch (integrator)
            {
                case Integrator.ImplicitEuler:
                    return RungeKuttaScheme.ImplicitEuler();
                case Integrator.Bdf2:
                    return null;
                case Integrator.Trbdf2:
                    return RungeKuttaScheme.TrBdf2();
                case Integrator.Esdirk3:
                    return RungeKuttaScheme.Esdirk3();
                case Integrator.Esdirk4:
                    return RungeKuttaScheme.Esdirk4();
                default:
                    throw new ArgumentException("the direct solver has no integrator " + integrator);
            }
        }
    }
}
