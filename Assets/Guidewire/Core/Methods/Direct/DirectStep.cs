using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>One step of the direct solver: the drive's motion, then all stages of the scheme, each an exact
    /// minimisation over the whole rod.</summary>
    internal sealed class DirectStep : MaterialStep
    {
        // A step in which a disturbance would grow by much (a thrust beyond buckling) may end in any shape.
        private const string Shorter = "; in a motion a shorter timeStep, or a timeStepError, may help";
        private const string Limit = "; a hubForceLimit lets the hub slip";
        private const string FewIterations = "; maxNewtonIterations is below its default, which may suffice";

        private const int MaxSlips = 60;
        private const double OfElement = 0.01;     // by which a hub may be past its end

        private const double MaxSpinLoss = 0.01;  // of a free wire's angular momentum, before a warning

        private readonly RodDynamics _dynamics;
        private HubRecord? _hub;
        private readonly SpinLoss? _spinLoss;  // of a wire that nothing holds
        private long _startFactorisations;  // of the rest shape
        private readonly StepStart _start;
        private readonly WallMonitor? _monitor;
        private readonly ElementContactForces? _elementForces;
        private readonly JamReport? _jam;
        private readonly RunExtremes _extremes;
        private double _hubWork;            // J
        private readonly Joint[] _joints;
        private readonly double[] _jointLengths;

        /// <summary>A step for this scene.</summary>
        /// <param name="dynamics">The motion, at its start.</param>
        /// <param name="record">Takes the support's force after each step, or null.</param>
        public DirectStep(MaterialScene scene, RodDynamics dynamics, MethodParameters method,
            SolverReport report, ContactRecord? record)
            : base(scene, dynamics.Terms, new FreeInertia(dynamics.Terms.Mass, scene.Supports), dynamics.Velocities,
                dynamics.Spins, method, report)
        {
            _dynamics = dynamics;
            _startFactorisations = report.Factorisations;
            Contacts = record;
            dynamics.Reactions.AreKept = record != null;
            _start = new StepStart(SerializeStep);
            WallTerms? walls = dynamics.Terms.Walls();
            if (walls != null)
            {
                walls.Spring.Position = scene.Schedule.Hub.PositionAt(dynamics.Time);
                _monitor = new WallMonitor(scene.Rod, walls, scene.Metres);
                dynamics.IntervalDone = EndInterval;
                _elementForces = new ElementContactForces(scene.Rod, walls.Barrier);
                _jam = new JamReport(dynamics.Terms, scene.Metres);
                if (record != null)
                {
                    record.WallForces = walls.Barrier.Resultants;
                    record.SetElements(scene.Rod.ElementCount, scene.Walls);
                }
            }
            report.Extremes ??= new RunExtremes();
            _extremes = report.Extremes;
            _joints = scene.Rod.Joints(scene.Supports);
            _jointLengths = scene.Rod.JointLengths(scene.Supports);
            _extremes.TakeShape(dynamics.Terms, _joints, _jointLengths, dynamics.Shape);
            FollowEnds();
            Energy.Start();  // the hub's spring is in place only now
            if (scene.Supports.Proximal == ProximalEnd.Free && scene.Supports.Distal == DistalEnd.Free)
            {
                _spinLoss = new SpinLoss(method.Integrator);
            }
        }

        /// <inheritdoc/>
        protected override double Time => _dynamics.Time;

        /// <inheritdoc/>
        protected override double KineticEnergy => Terms.Mass.KineticEnergy(Velocities, Spins);

        /// <summary>The motion.</summary>
        public RodDynamics Dynamics => _dynamics;

        /// <inheritdoc/>
        public override ContactRecord? Contacts { get; }

        /// <inheritdoc/>
        public override void Advance(RodState state)
        {
            if (Step())
            {
                Write(state);
            }
        }

        /// <summary>One step. Between walls one without a solution leaves everything, hub and wire, as it was before.
        /// </summary>
        /// <returns>False where it has no solution or has lost the wire.</returns>
        public bool Step()
        {
            if (_monitor != null)
            {
                _start.Save();
            }
            _dynamics.Work.BeginStep();
            (double insertion, double turn) = (Drive.Insertion, Drive.Turn);
            Drive.Prepare(Shape, Time);
            bool isDone = Step(TimeStep, insertion, turn);
            if (!isDone && _monitor != null)
            {
                (string? failure, string? divergence) = (Failure, Divergence);
                _start.Restore();
                (Failure, Divergence) = (failure, divergence);
            }
            return isDone;
        }

        /// <summary>A part of a step whose drive has been prepared.</summary>
        /// <param name="length">s.</param>
        /// <returns>False where it has no solution or has lost the wire.</returns>
        /// <param name="insertion">Of the drive when the step began, m.</param>
        /// <param name="turn">The same, radians.</param>
        public bool StepPart(double length, double insertion, double turn)
        {
            return Step(length, insertion, turn);
        }

        // From where the hub was at the step's start, m and radians.
        private bool Step(double length, double insertion, double turn)
        {
            int last = Shape.ElementCount;
            SupportSpring? spring = Terms.Walls()?.Spring;
            if (spring != null && Drive.Axis != Vector3d.Zero)
            {
                spring.Axis = Drive.Axis;
            }
            double exit = Scene.Supports.Winds ? Scene.Supports.Coaxial!.Joints.Sheathed : 0.0;
            _hubWork += 0.5 * SheathWork(exit);
            Vector3d free = Shape.X[last] + length * Velocities[last]
                + (length * length) * Schedule.Loads.Gravity;
            Vector3d held = spring == null ? Vector3d.Zero : spring.HeldPosition(Shape);
            double dissipated = Dissipated;
            long innerSteps = _dynamics.Control.Steps;
            _monitor?.BeginStep(Shape);
            string? failure = _dynamics.Step(length);
            if (failure != null)
            {
                string time = Time.ToString("G6", CultureInfo.InvariantCulture);
                if (_monitor != null)
                {
                    // What Newton's method left is no shape of the wire.
                    _dynamics.GoBack();
                    failure = Terms.Walls()!.Barrier.Nodes.HasBuckled
                        ? "the wire buckles at the exit of its sheath and would come out through a wall" : failure;
                }
                Failure = "the step to t = " + time + " s has no solution: "
                    + (Scene.Joints.FindTurned(Shape, Time) ?? failure)
                    + (_jam == null ? "" : "; " + _jam.Text(Shape)) + FailureAdvice;
                return false;
            }
            Ends.Count(Shape, HubTurn, _dynamics.DistalTurn, length);
            Failure ??= _monitor?.FindTouchFromBeside(Time);
            if (Failure != null || HasBlownUp("; lower timeStep, or take another integrator"))
            {
                return false;
            }
            EndStep(free);
            Failure = Failure == null ? null : Failure + FailureAdvice;
            if (Contacts != null)
            {
                StageForces mean = _dynamics.Reactions.Mean;
                Contacts.Reaction = mean.Proximal;
                Contacts.ReactionAtEnd = _dynamics.Reactions.End.Proximal;
                Contacts.MeanTotal = mean.Walls;
                _hubWork += Vector3d.Dot(mean.Proximal, Terms.HubAxis(Shape))
                    * (Drive.Insertion - insertion) + mean.HubTorque * (Drive.Turn - turn) + 0.5 * SheathWork(exit);
                _monitor?.EndStep(Shape, Contacts);
                if (spring != null && Terms.Walls()!.HoldsStart)
                {
                    SlipHub(spring);
                    CountDrive(length / TimeStep * Drive.CommandedDisplacement, held, spring.HeldPosition(Shape));
                    Failure ??= FindOverdriven() ?? FindDrivenOut();
                }
            }
            TakeExtremes(length, dissipated, innerSteps);
            return true;
        }

        private void EndInterval()
        {
            _monitor!.AddPart(Shape);
            Terms.Walls()!.Barrier.Nodes.HasBuckled = false;
        }

        // The force that drives the wire out of a sheath depends on the hub's position, steeply where the exit passes a
        // node: so the hub slips until its force is within the limit, by half as much once it has slipped too far.
        private void SlipHub(SupportSpring spring)
        {
            if (!spring.HasLimit)
            {
                return;
            }
            Terms.SetTime(Schedule, Time);
            double asked = Drive.Insertion;
            double slip = 0.0;
            bool isTooFar = false;
            for (int left = Terms.Release == null ? 1 : MaxSlips; left > 0; left--)
            {
                spring.ReleaseForce = Terms.Release?.SheathForce(Shape) ?? 0.0;
                double needed = spring.SlipOf(Shape);
                if (needed == 0.0)
                {
                    break;
                }
                isTooFar |= needed * slip < 0.0;
                slip = isTooFar ? Math.Sign(needed) * Math.Abs(0.5 * slip) : needed;
                spring.Position -= slip * spring.Axis;
                Drive.SlipHub(slip);
                Terms.SetTime(Schedule, Time);
            }
            if (Drive.Insertion != asked)
            {
                _hubWork += Terms.HubForce(Shape) * (Drive.Insertion - asked);
            }
        }

        // Of the hub in this step against what drives the wire out of a sheath, by the moments of now, J.
        private double SheathWork(double exit)
        {
            return !Scene.Supports.Winds ? 0.0
                : Terms.Release!.SheathWork(Shape, exit, Scene.Supports.Coaxial!.Hubs!.SheathedAt(Drive.StepEnd));
        }

        private double Dissipated => Terms.Walls()?.Friction?.Anchors.Dissipated ?? 0.0;

        // Since friction had turned so much into heat, J, and so many inner steps were done.
        private void TakeExtremes(double length, double dissipated, long innerSteps)
        {
            _spinLoss?.Take(Terms.Rod, Shape, Spins, length,
                Math.Max(1, _dynamics.Control.Steps - innerSteps));
            _extremes.TakeShape(Terms, _joints, _jointLengths, Shape);
            if (_elementForces == null)
            {
                return;
            }
            _elementForces.Take(Shape, Contacts!, _extremes, Time);
            if (Terms.Walls()!.HoldsStart)
            {
                _extremes.TakeHub(Terms.HubForce(Shape), _dynamics.Reactions.HubTorque, Time);
            }
            if (Terms.Walls()!.Barrier.Lag != null)
            {
                _extremes.WallWork = 0.0 - Terms.Walls()!.Barrier.Lag!.Dissipated;
            }
            if (Terms.Walls()!.Friction != null)
            {
                _extremes.TakeFriction(Dissipated - dissipated, length);
            }
        }

        // A frame in a sheath is held where the wire is; a spring beyond it turns with the hub.
        private double HubTurn => _dynamics.ProximalTurn + Schedule.Hub.AheadAt(Time);

        private string FailureAdvice
        {
            get
            {
                if (_dynamics.MaxIterations < new MethodParameters().MaxNewtonIterations)
                {
                    return FewIterations;
                }
                string? advice = Terms.Walls()?.Advice;
                if (advice != null || _jam == null || !_jam.IsJammed(Shape))
                {
                    return advice == null ? Shorter : "; " + advice;
                }
                return Terms.Walls()!.Spring.HasLimit ? "" : Limit;
            }
        }

        /// <inheritdoc/>
        public override HubRecord? Hub()
        {
            if (Terms.Supports.Proximal == ProximalEnd.Free)
            {
                return null;
            }
            _hub ??= new HubRecord(Scene.Rod, Scene.Supports);
            // A hub that may slip has the force of where it has slipped to, not that of the step.
            Vector3d force = Terms.Walls()?.Spring.HasLimit == true ? Terms.Walls()!.SupportForce(Shape)
                : _dynamics.ReactionAt(0);
            _hub.Take(Terms, Shape, Drive, force, _dynamics.Reactions.HubTorque,
                Schedule.Hub.AheadAt(Time));
            _hub.Work = _monitor == null ? double.NaN : _hubWork;
            return _hub;
        }

        /// <summary>A hub that slips moves less than asked; a free wire that spins fast loses angular
        /// momentum.</summary>
        public override void AddWarnings(List<RunWarning> warnings)
        {
            if (Drive.FallsShort)
            {
                warnings.Add(WarningTable.HubShortfall.With("the hub", Drive.Slip,
                    "it slipped at hubForceLimit, or the wire reached an end of its sheath"));
            }
            if (_dynamics.Newton.BalanceRounding.OfSupports > 0.0)
            {
                warnings.Add(WarningTable.Rounding.With(_dynamics.Newton.BalanceRounding.OfSupports));
            }
            if (_spinLoss != null && _spinLoss.Expected > MaxSpinLoss)
            {
                warnings.Add(WarningTable.SpinLost.With(_spinLoss.LargestTurn, 100.0 * _spinLoss.Expected));
            }
        }

        /// <inheritdoc/>
        public override SolverReport? Report()
        {
            Results.Factorisations = _startFactorisations + _dynamics.Newton.Factorisations;
            Results.KeptSolutions = _dynamics.Newton.KeptSolutions;
            Results.Searches = _dynamics.Newton.Searches;
            if (_dynamics.HasErrorEstimate)
            {
                Results.TimeStepError = _dynamics.Control.LargestError;
                Results.StepsNotConverged = _dynamics.Control.StepsAbove;
            }
            if (_monitor != null)
            {
                Barrier barrier = Terms.Walls()!.Barrier.Barrier;
                Results.WallIterations = _dynamics.Newton.Iterations;
                Results.ContactDistance = barrier.Distance;
                Results.ContactStiffness = barrier.Stiffness;
            }
            Results.HalvedSteps = _dynamics.Clock.Halvings;
            Results.InnerSteps = _dynamics.Control.Steps;
            Results.Energy = _dynamics.Energy;
            Results.ProximalForce = _dynamics.ReactionAt(0);
            Results.DistalForce = Scene.Supports.Distal != DistalEnd.Free ? _dynamics.ReactionAt(Shape.ElementCount)
                : Vector3d.Zero;
            Results.ProximalMoment = _dynamics.Reactions.ProximalCouple;
            Results.DistalMoment = _dynamics.Reactions.DistalCouple;
            return Results;
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            _dynamics.Serialize(snapshot);
            if (!snapshot.IsWritten)
            {
                FollowEnds();
            }
            if (!snapshot.Section(SectionKey, SerializeOwn))
            {
                Energy.Start();
            }
        }

        /// <summary>Writes or restores all that <see cref="Step"/> may touch, for a <see cref="StepStart"/>.
        /// </summary>
        public void SerializeStep(Snapshot snapshot)
        {
            Drive.SerializeStep(snapshot);
            _dynamics.SerializeStep(snapshot);
            Ends.SerializeStep(snapshot);
            Energy.SerializeStep(snapshot);
            Rest.Serialize(snapshot);
            _extremes.Serialize(snapshot);
            _extremes.SerializeDisplacements(snapshot);
            _spinLoss?.Serialize(snapshot);
            _monitor?.Serialize(snapshot);
            snapshot.Serialize(ref _hubWork);
            Contacts?.Serialize(snapshot);
            if (!snapshot.IsWritten)
            {
                (Failure, Divergence) = (null, null);
            }
        }

        /// <summary>Writes or restores what was counted, whatever the number of elements.</summary>
        public void SerializeCounts(Snapshot snapshot)
        {
            snapshot.Serialize(ref _startFactorisations);
            snapshot.Serialize(ref _hubWork);
            _dynamics.Clock.Serialize(snapshot);
            _monitor?.Serialize(snapshot);
            Ends.SerializeWork(snapshot);
            _dynamics.SerializeCounts(snapshot);
        }

        // Between walls more is kept than without.
        private string SectionKey
        {
            get
            {
                WallTerms? walls = Terms.Walls();
                return walls == null ? "direct" : walls.HoldsStart ? "direct, walls" : "direct, walls, free";
            }
        }

        private void SerializeOwn(Snapshot snapshot)
        {
            snapshot.Serialize(ref _startFactorisations);
            snapshot.Serialize(ref _hubWork);
            Results.Serialize(snapshot);
            snapshot.OptionalSection("spin", _spinLoss == null ? (Action<Snapshot>?)null : _spinLoss.Serialize);
            Energy.Serialize(snapshot);
            Drive.Serialize(snapshot);
            _dynamics.Clock.Serialize(snapshot);
            _dynamics.Work.Serialize(snapshot);
            _monitor?.Serialize(snapshot);
            (_monitor == null ? null : Contacts)?.Serialize(snapshot);
            Ends.SerializeWork(snapshot);
            Rest.Serialize(snapshot);
            _dynamics.SerializeHistory(snapshot, TimeStep);
        }

        // What the drive asked in the last step, m, and what of it was not gone.
        private void CountDrive(double asked, in Vector3d before, in Vector3d after)
        {
            Contacts!.DriveAsked += asked / Scene.Metres;
            Contacts.DriveShortfall += (asked - Drive.AxialProgress(before, after)) / Scene.Metres;
        }

        // A hub that misses its position by a tenth of an element pulls at node 0 with EA, the force under which a wire
        // would have no length left: then what the drive asks and what walls allow do not go together.
        private string? FindOverdriven()
        {
            if (_monitor == null || !Terms.Walls()!.HoldsStart || !(Contacts!.DriveAsked > 0.0))
            {
                return null;
            }
            double force = Terms.Walls()!.SupportForce(Shape).Length;
            double most = Scene.Rod.StretchStiffness[0];
            return force <= most ? null : string.Format(CultureInfo.InvariantCulture,
                "the walls keep sphere 0 from the position of the drive at t = {0:G6} s, {1:G3} units away: the "
                + "hub would need {2:G3} N, more than the EA of {5}, {3:G3} N; {4}; a smaller motion "
                + "(displacementPerStep, insertionSpeed, maxSimulationSteps) may help, or a hubForceLimit", Time,
                Contacts.DriveShortfall, force, most, _jam!.Text(Shape),
                Scene.Supports.InnerCount == 0 ? "the wire" : "all instruments at the hub together");
        }

        // The wire has then drawn the hub past the end of its sheath.
        private string? FindDrivenOut()
        {
            return Drive.BeyondLimit <= OfElement * Scene.Rod.Length[0] ? null
                : "the wire drives itself out of its sheath: hubForceLimit is too small to hold it";
        }

        private void FollowEnds()
        {
            Ends.Follow(Shape, HubTurn, _dynamics.DistalTurn);
        }
    }
}
