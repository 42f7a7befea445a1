using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>One step of the direct solver: the drive's motion, then all stages of the scheme, each an exact
    /// minimisation over the whole rod.</summary>
    internal sealed class DirectStep : TimeStepper
    {
        // A step in which a disturbance would grow by much (a thrust beyond buckling) may end in any shape.
        private const string Shorter = "; in a motion a shorter timeStep, or a timeStepError, may do";
        private const string Limit = "; a hubForceLimit lets the hub give way";
        private const string Iterations = "; maxNewtonIterations is below its default, which may do";

        private const int MostSlips = 60;
        private const double OfElement = 0.01;     // by which a hub may be past its end

        private const double MostSpinLoss = 0.01;  // of a free wire's angular momentum, before a warning

        private readonly MaterialScene _scene;
        private readonly RodDynamics _dynamics;
        private readonly MaterialDrive _drive;
        private readonly double _timeStep;
        private readonly SolverReport _report;
        private StressRecord? _stress;
        private HubRecord? _hub;
        private readonly SpinLoss? _spinLoss;  // of a wire that nothing holds
        private long _startFactorisations;  // of the rest shape
        private readonly HeldEnds _ends;
        private readonly EnergyMonitor _energy;
        private readonly RestMonitor _rest;
        private readonly HalvedSteps _halved;
        private readonly WallSteps? _walls;
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
        public DirectStep(MaterialScene scene, RodDynamics dynamics, MaterialDrive drive, MethodParameters method,
            SolverReport report, ContactRecord? record)
        {
            _scene = scene;
            _dynamics = dynamics;
            _drive = drive;
            _timeStep = method.TimeStep;
            _report = report;
            _startFactorisations = report.Factorisations;
            Contacts = record;
            dynamics.TracksReactions = record != null;
            _halved = new HalvedSteps(dynamics);
            WallTerms? walls = dynamics.Terms.Walls();
            if (walls != null)
            {
                walls.Spring.Position = scene.Schedule.ProximalPositionAt(dynamics.Time);
                _monitor = new WallMonitor(scene.Rod, walls, scene.Metres);
                _walls = new WallSteps(dynamics, _halved, scene.Schedule, _monitor);
                _elementForces = new ElementContactForces(scene.Rod, walls.Barrier);
                _jam = new JamReport(dynamics.Terms, scene.Metres);
                if (record != null)
                {
                    record.WallForces = walls.Barrier.Resultants;
                    record.ElementForces = new Vector3d[scene.Rod.ElementCount];
                }
            }
            report.Extremes ??= new RunExtremes();
            _extremes = report.Extremes;
            _joints = scene.Rod.Joints(scene.Supports);
            _jointLengths = scene.Rod.JointLengths(scene.Supports);
            _extremes.TakeShape(dynamics.Terms, _joints, _jointLengths, dynamics.Shape);
            _ends = new HeldEnds(dynamics.Terms, scene.Schedule);
            FollowEnds();
            if (scene.Supports.Proximal == ProximalEnd.Free && scene.Supports.Distal == DistalEnd.Free)
            {
                _spinLoss = new SpinLoss(method.Integrator);
            }
            _energy = new EnergyMonitor(dynamics.Terms, new FreeInertia(dynamics.Terms.Mass, scene.Supports),
                dynamics.Shape, dynamics.Velocities, dynamics.Spins, _ends);
            _rest = new RestMonitor(scene, dynamics.Terms, dynamics.Velocities, dynamics.Spins, method);
        }

        /// <inheritdoc/>
        public override ContactRecord? Contacts { get; }

        /// <inheritdoc/>
        public override void Advance(RodState state)
        {
            if (Step())
            {
                _scene.Write(state, _dynamics.Shape, _dynamics.Velocities, _dynamics.Spins);
            }
        }

        /// <summary>One step.</summary>
        /// <returns>False where it has no solution or has lost the wire.</returns>
        public bool Step()
        {
            int last = _dynamics.Shape.ElementCount;
            (double insertion, double turn) = (_drive.Insertion, _drive.Turn);
            _drive.Prepare(_dynamics.Shape, _dynamics.Time);
            SupportSpring? spring = _dynamics.Terms.Walls()?.Spring;
            if (spring != null && _drive.Axis != Vector3d.Zero)
            {
                spring.Axis = _drive.Axis;
            }
            double exit = _dynamics.Terms.Sheath == null ? 0.0 : _dynamics.Terms.Sheath.Exit;
            _hubWork += 0.5 * SheathWork(exit);
            Vector3d free = _dynamics.Shape.X[last] + _timeStep * _dynamics.Velocities[last]
                + (_timeStep * _timeStep) * _scene.Schedule.Gravity;
            Vector3d held = spring == null ? Vector3d.Zero : spring.HeldPosition(_dynamics.Shape);
            double dissipated = Dissipated;
            long innerSteps = _dynamics.Control.Steps;
            string? failure = _walls == null ? _halved.Step(_timeStep) : _walls.Step(_timeStep);
            if (failure != null)
            {
                string time = _dynamics.Time.ToString("G6", CultureInfo.InvariantCulture);
                if (_walls != null)
                {
                    // What Newton's method left is no shape of the wire.
                    _halved.Restore();
                }
                Failure = "the step to t = " + time + " s has no solution: "
                    + (_scene.Joints.FindTurned(_dynamics.Shape, _dynamics.Time) ?? failure)
                    + (_jam == null ? "" : "; " + _jam.Text(_dynamics.Shape)) + Remedy;
                return false;
            }
            _ends.Count(_dynamics.Shape, HubTurn, _dynamics.DistalTurn, _timeStep);
            Divergence = _energy.Blowup();
            if (Divergence != null)
            {
                Divergence += "; lower timeStep, or take another integrator";
                return false;
            }
            string? lost = _scene.Joints.FindLost(_dynamics.Shape, _dynamics.Time);
            Failure = lost == null ? null : lost + Remedy;
            SteadyState = _rest.FindRest(_dynamics.Time);
            PredictionError = Vector3d.Distance(free, _dynamics.Shape.X[last]) / _scene.Metres;
            if (Contacts != null)
            {
                StageForces mean = _walls == null ? _halved.MeanForces : _walls.MeanForces;
                Contacts.Reaction = mean.Proximal;
                Contacts.ReactionAtEnd = _dynamics.EndForces.Proximal;
                Contacts.MeanTotal = mean.Walls;
                _hubWork += Vector3d.Dot(mean.Proximal, _dynamics.Terms.HubAxis(_dynamics.Shape))
                    * (_drive.Insertion - insertion) + mean.HubTorque * (_drive.Turn - turn) + 0.5 * SheathWork(exit);
                _monitor?.EndStep(_dynamics.Shape, Contacts);
                if (spring != null && _dynamics.Terms.Walls()!.HoldsStart)
                {
                    SlipHub(spring);
                    CountDrive(held, spring.HeldPosition(_dynamics.Shape));
                    Failure ??= FindOverdriven() ?? FindDrivenOut();
                }
            }
            TakeExtremes(dissipated, innerSteps);
            return true;
        }

        // The force that drives the wire out of a sheath depends on the hub's position, steeply where the exit passes a
        // node: so the hub slips until its force is within the limit, by half as much once it has slipped too far.
        private void SlipHub(SupportSpring spring)
        {
            if (!spring.HasLimit)
            {
                return;
            }
            RodTerms terms = _dynamics.Terms;
            terms.SetTime(_scene.Schedule, _dynamics.Time);
            double asked = _drive.Insertion;
            double slip = 0.0;
            bool isTooFar = false;
            for (int left = terms.Sheath == null ? 1 : MostSlips; left > 0; left--)
            {
                spring.Besides = terms.Sheath == null ? 0.0 : terms.Sheath.HubForce(_dynamics.Shape);
                double needed = spring.SlipOf(_dynamics.Shape);
                if (needed == 0.0)
                {
                    break;
                }
                isTooFar |= needed * slip < 0.0;
                slip = isTooFar ? Math.Sign(needed) * Math.Abs(0.5 * slip) : needed;
                spring.Position -= slip * spring.Axis;
                _drive.SlipHub(slip);
                terms.SetTime(_scene.Schedule, _dynamics.Time);
            }
            if (_drive.Insertion != asked)
            {
                _hubWork += terms.HubForce(_dynamics.Shape) * (_drive.Insertion - asked);
            }
        }

        // Of the hub in this step against what drives the wire out of a sheath, by the moments of now, J.
        private double SheathWork(double exit)
        {
            SheathEnergy? sheath = _dynamics.Terms.Sheath;
            return sheath == null ? 0.0
                : sheath.WorkTo(_dynamics.Shape, _scene.Schedule.ProximalPositionAt(_drive.StepEnd), exit);
        }

        private double Dissipated => _dynamics.Terms.Walls()?.Friction?.Anchors.Dissipated ?? 0.0;

        // Since friction had turned so much into heat, J, and so many inner steps were done.
        private void TakeExtremes(double dissipated, long innerSteps)
        {
            RodTerms terms = _dynamics.Terms;
            RodShape shape = _dynamics.Shape;
            _spinLoss?.Take(terms.Rod, shape, _dynamics.Spins, _timeStep,
                Math.Max(1, _dynamics.Control.Steps - innerSteps));
            _extremes.TakeShape(terms, _joints, _jointLengths, shape);
            if (_elementForces == null)
            {
                return;
            }
            _elementForces.Take(shape, Contacts!.ElementForces);
            Contacts.Pressure = _elementForces.LargestPressure;
            _extremes.TakeWalls(_elementForces.LargestForce, _elementForces.LargestPressure);
            if (terms.Walls()!.HoldsStart)
            {
                _extremes.TakeHub(terms.HubForce(shape), _dynamics.HubTorque);
            }
            if (terms.Walls()!.Friction != null)
            {
                _extremes.TakeFriction(Dissipated - dissipated, _timeStep);
            }
        }

        // A frame in a sheath is held where the wire is; a spring beyond it turns with the hub.
        private double HubTurn => _dynamics.ProximalTurn + _scene.Schedule.HubAhead(_dynamics.Time);

        private string Remedy
        {
            get
            {
                if (_dynamics.Solver.MostIterations < new MethodParameters().MaxNewtonIterations)
                {
                    return Iterations;
                }
                string? advice = _dynamics.Terms.Walls()?.Advice;
                if (advice != null || _jam == null || !_jam.IsJammed(_dynamics.Shape))
                {
                    return advice == null ? Shorter : "; " + advice;
                }
                return _dynamics.Terms.Walls()!.Spring.HasLimit ? "" : Limit;
            }
        }

        /// <inheritdoc/>
        public override StressRecord? Stress()
        {
            _stress ??= new StressRecord(_scene.Rod, _scene.Supports);
            RodTerms terms = _dynamics.Terms;
            terms.SetTime(_scene.Schedule, _dynamics.Time);
            _stress.Take(terms, _dynamics.Shape, terms.Mass.KineticEnergy(_dynamics.Velocities, _dynamics.Spins));
            return _stress;
        }

        /// <inheritdoc/>
        public override HubRecord? Hub()
        {
            RodTerms terms = _dynamics.Terms;
            if (terms.Supports.Proximal == ProximalEnd.Free)
            {
                return null;
            }
            _hub ??= new HubRecord(_scene.Rod, _scene.Supports);
            // A hub that may slip has the force of where it has slipped to, not that of the step.
            Vector3d force = terms.Walls()?.Spring.HasLimit == true ? terms.Walls()!.SupportForce(_dynamics.Shape)
                : _dynamics.ReactionAt(0);
            _hub.Take(terms, _dynamics.Shape, _drive, force, _dynamics.HubTorque,
                _scene.Schedule.HubAhead(_dynamics.Time));
            _hub.Work = _walls == null ? double.NaN : _hubWork;
            return _hub;
        }

        /// <summary>A hub that slips moves less than asked; a free wire that spins fast loses angular
        /// momentum.</summary>
        public override string? AccuracyWarning => _drive.Slip != 0.0 ? string.Format(
            CultureInfo.InvariantCulture,
            "the hub lost {0:G3} m of its way: it gave way at hubForceLimit, or the wire in its sheath came to"
            + " an end", _drive.Slip)
            : _spinLoss == null || _spinLoss.Expected <= MostSpinLoss ? null : string.Format(
            CultureInfo.InvariantCulture, "the free wire turned by up to {0:G2} rad a step, which changes its"
            + " angular momentum by some {1:G2} % (docs/verification.md); a shorter timeStep keeps it, or another"
            + " integrator", _spinLoss.LargestTurn, 100.0 * _spinLoss.Expected);

        /// <inheritdoc/>
        public override SolverReport? Report()
        {
            _report.Factorisations = _startFactorisations + _dynamics.Solver.Factorisations
                + (_dynamics.WallSolver?.Factorisations ?? 0);
            _report.KeptSolutions = _dynamics.Solver.KeptSolutions;
            _report.Searches = _dynamics.Solver.Searches;
            if (_dynamics.HasErrorEstimate)
            {
                _report.TimeStepError = _dynamics.Control.LargestError;
                _report.StepsNotConverged = _dynamics.Control.StepsAbove;
            }
            if (_walls != null)
            {
                Barrier barrier = _dynamics.Terms.Walls()!.Barrier.Barrier;
                _report.WallIterations = _dynamics.WallSolver!.Iterations;
                _report.ContactDistance = barrier.Distance;
                _report.ContactStiffness = barrier.Stiffness;
            }
            _report.HalvedSteps = _halved.Halvings;
            _report.InnerSteps = _dynamics.Control.Steps;
            _report.Energy = _dynamics.Energy;
            RodShape shape = _dynamics.Shape;
            _report.ProximalForce = _dynamics.ReactionAt(0);
            _report.DistalForce = _scene.Supports.HasDistalJoint ? _dynamics.ReactionAt(shape.ElementCount)
                : Vector3d.Zero;
            _report.ProximalMoment = _dynamics.ProximalCouple;
            _report.DistalMoment = _dynamics.DistalCouple;
            return _report;
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
                _energy.Start();
            }
        }

        /// <summary>Writes or takes over all that <see cref="Step"/> may touch, for a <see cref="StepStart"/>.
        /// </summary>
        public void SerializeStep(Snapshot snapshot)
        {
            _drive.SerializeStep(snapshot);
            _dynamics.SerializeStep(snapshot);
            _ends.SerializeStep(snapshot);
            _energy.SerializeStep(snapshot);
            _rest.Serialize(snapshot);
            _extremes.Serialize(snapshot);
            _spinLoss?.Serialize(snapshot);
            _monitor?.Serialize(snapshot);
            snapshot.Serialize(ref _hubWork);
            Contacts?.Serialize(snapshot);
        }

        /// <summary>Writes or takes over what was counted, whatever the number of elements.</summary>
        public void SerializeCounts(Snapshot snapshot)
        {
            snapshot.Serialize(ref _startFactorisations);
            snapshot.Serialize(ref _hubWork);
            _halved.Serialize(snapshot);
            _monitor?.Serialize(snapshot);
            _ends.SerializeWork(snapshot);
            _dynamics.SerializeCounts(snapshot);
        }

        // Between walls more is kept than without.
        private string SectionKey
        {
            get
            {
                WallTerms? walls = _dynamics.Terms.Walls();
                return walls == null ? "direct" : walls.HoldsStart ? "direct, walls" : "direct, walls, free";
            }
        }

        private void SerializeOwn(Snapshot snapshot)
        {
            snapshot.Serialize(ref _startFactorisations);
            snapshot.Serialize(ref _hubWork);
            _report.Serialize(snapshot);
            snapshot.OptionalSection("spin", _spinLoss == null ? (Action<Snapshot>?)null : _spinLoss.Serialize);
            _energy.Serialize(snapshot);
            _drive.Serialize(snapshot);
            _halved.Serialize(snapshot);
            _monitor?.Serialize(snapshot);
            SerializeRecord(snapshot);
            _ends.SerializeWork(snapshot);
            _rest.Serialize(snapshot);
            _dynamics.SerializeHistory(snapshot, _timeStep);
        }

        private void SerializeRecord(Snapshot snapshot)
        {
            if (_walls != null)
            {
                Contacts!.Serialize(snapshot);
            }
        }

        // What the drive asked in the last step, and what of it was not gone, units.
        private void CountDrive(in Vector3d before, in Vector3d after)
        {
            Contacts!.DriveAsked += _drive.Asked / _scene.Metres;
            Contacts.DriveShortfall += (_drive.Asked - _drive.Gone(before, after)) / _scene.Metres;
        }

        // A hub that misses its position by a tenth of an element pulls at node 0 with EA, the force under which a wire
        // would have no length left: then what the drive asks and what walls allow do not go together.
        private string? FindOverdriven()
        {
            if (_walls == null || !_dynamics.Terms.Walls()!.HoldsStart || !(Contacts!.DriveAsked > 0.0))
            {
                return null;
            }
            double force = _dynamics.Terms.Walls()!.SupportForce(_dynamics.Shape).Length;
            double most = _scene.Rod.StretchStiffness[0];
            return force <= most ? null : string.Format(CultureInfo.InvariantCulture,
                "the walls do not let sphere 0 to where the drive has it at t = {0:G6} s, {1:G3} units on: the hub"
                + " would need {2:G3} N, more than the wire's EA, {3:G3} N; {4}; a smaller motion (displacementPerStep,"
                + " insertionSpeed, maxSimulationSteps) may do, or a hubForceLimit", _dynamics.Time,
                Contacts.DriveShortfall, force, most, _jam!.Text(_dynamics.Shape));
        }

        // The wire has then drawn the hub past the end of its sheath.
        private string? FindDrivenOut()
        {
            double past = _drive.Insertion - _drive.MostInsertion;
            return _dynamics.Terms.Sheath == null || past <= OfElement * _scene.Rod.Length[0] ? null
                : "the wire drives itself out of its sheath: hubForceLimit is too small to hold it";
        }

        private void FollowEnds()
        {
            _ends.Follow(_dynamics.Shape, HubTurn, _dynamics.DistalTurn);
        }
    }
}
