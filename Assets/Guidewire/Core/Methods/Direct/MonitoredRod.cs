using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>A rod that the direct solver moves, with the monitors of its steps and what is read off it. One of
    /// several instruments, or in a sheath, is built anew where nodes come or go.</summary>
    internal sealed class MonitoredRod
    {
        private const int MaxSlips = 60;
        private const double Rounding = 1e-9;     // of a step
        private const double MaxEnergyLoss = 0.1;  // of what was put in, by the scheme, before a warning
        private const double LargestVesselTurn = 0.3;    // radians
        private const double MaxSpinLoss = 0.01;  // of a free wire's angular momentum, before a warning

        private readonly RodDynamics _dynamics;
        private HubRecord? _hub;
        private readonly SpinLoss? _spinLoss;  // of a wire that nothing holds
        private long _startFactorisations;  // of the rest shape
        private readonly MaterialScene _scene;
        private readonly SolverReport _results;
        private readonly double _timeStep;  // s
        private readonly HeldEnds _ends;
        private readonly SlipRecord? _slips;
        private readonly double _mostSlip;  // of the hub in a step, m
        private readonly EnergyMonitor _energy;
        private readonly RestMonitor _rest;
        private StressRecord? _stress;
        private readonly WallMonitor? _monitor;
        private readonly ElementContactForces? _elementForces;
        private readonly StepFailure _texts;
        private readonly RunExtremes _extremes;
        private double _hubWork;            // J
        private double _vesselTurn;         // largest of the vessel's sections, radians
        private double _outside;            // energy of what is in a sheath before the rod, J
        private Vector3d _free;             // where the last node would be without forces at the step's end, m
        private Vector3d _heldFrom;         // of the spring, when the step began, m
        private double _exit;               // length in a sheath, the same, m
        private bool _hasSlipped;           // in the last step
        private double _dissipated;         // by friction until then, J
        private long _innerSteps;           // until then
        private readonly Joint[] _joints;
        private readonly double[] _jointLengths;

        /// <summary>Makes the rod of a scene.</summary>
        /// <param name="dynamics">Its motion, at its start.</param>
        /// <param name="record">Takes the support's force after each step, or null.</param>
        public MonitoredRod(MaterialScene scene, RodDynamics dynamics, MethodParameters method,
            SolverReport report, ContactRecord? record)
        {
            _dynamics = dynamics;
            _scene = scene;
            _results = report;
            _timeStep = method.TimeStep;
            _ends = new HeldEnds(Terms, scene.Schedule);
            _energy = new EnergyMonitor(Terms, new FreeInertia(Terms.Mass, scene.Supports), scene.Shape,
                dynamics.Velocities, dynamics.Spins, _ends);
            _rest = new RestMonitor(scene, Terms, dynamics.Velocities, dynamics.Spins, method);
            _startFactorisations = report.Factorisations;
            Contacts = record;
            dynamics.Reactions.AreKept = record != null;
            _texts = new StepFailure(scene, dynamics);
            WallTerms? walls = dynamics.Terms.Walls();
            if (walls != null)
            {
                if (walls.Spring.Limit.IsLimited)
                {
                    _slips = new SlipRecord(walls.Spring.Limit);
                    _mostSlip = scene.Drive.LargestSlip;
                }
                walls.Spring.Position = scene.Schedule.Hub.PositionAt(dynamics.Time);
                _monitor = new WallMonitor(scene.Rod, walls, scene.Metres);
                dynamics.IntervalDone = EndInterval;
                dynamics.FindLost = () => scene.Joints.FindPassed(Shape, Time);
                _elementForces = new ElementContactForces(scene.Rod, walls.Barrier);
                if (record != null)
                {
                    record.WallForces = walls.Barrier.Resultants;
                    record.SetElements(scene.Rod.Capacity, scene.Walls, true, walls.Self != null);
                    record.Remesh(scene.Rod.ElementCount + 1);
                }
            }
            report.Extremes ??= new RunExtremes();
            _extremes = report.Extremes;
            _joints = scene.Rod.Joints(scene.Supports);
            _jointLengths = scene.Rod.JointLengths(scene.Supports);
            _extremes.FirstStep = (1.0 + Rounding) * method.TimeStep;
            _extremes.TakeShape(dynamics.Terms, _joints, _jointLengths, dynamics.Shape, Time);
            _extremes.TakeFibres(dynamics.Terms, dynamics.Shape, dynamics.Time);
            FollowEnds();
            _energy.Start();  // the hub's spring is in place only now
            if (scene.Supports.Proximal == ProximalEnd.Free && scene.Supports.Distal == DistalEnd.Free)
            {
                _spinLoss = new SpinLoss(method.Integrator);
            }
        }

        /// <summary>The rod has other elements, and moves on from where they are.</summary>
        public void Remesh()
        {
            MaterialRod rod = _scene.Rod;
            (Failure, Divergence, SteadyState, PredictionError) = (null, null, null, 0.0);
            _scene.Joints.Remesh();
            _ends.Remesh();
            _rest.Remesh();
            if (_monitor != null)
            {
                Terms.Walls()!.Spring.Position = Schedule.Hub.PositionAt(Time);
                _monitor.Remesh();
                _elementForces!.Remesh();
            }
            Contacts?.Remesh(rod.ElementCount + 1);
            rod.SetJoints(_scene.Supports, _joints);
            rod.SetJointLengths(_scene.Supports, _jointLengths);
            _extremes.TakeShape(Terms, _joints, _jointLengths, Shape, Time);
            FollowEnds();
            _energy.Remesh();
        }

        /// <summary>The motion.</summary>
        public RodDynamics Dynamics => _dynamics;

        /// <summary>What moves it.</summary>
        public MaterialDrive Drive => _scene.Drive;

        /// <summary>What is prescribed of it.</summary>
        public RodSchedule Schedule => _scene.Schedule;

        /// <summary>The forces that act on it from outside; null where nobody asked for them.</summary>
        public ContactRecord? Contacts { get; }

        /// <summary>Why the last step has no solution, in one line, or null.</summary>
        public string? Failure { get; private set; }

        /// <summary>How the last step lost the wire, in one line, or null.</summary>
        public string? Divergence { get; private set; }

        /// <summary>Why it is in a steady state, in one line, or null.</summary>
        public string? SteadyState { get; private set; }

        /// <summary>Distance of the last node from where it would be without forces, units.</summary>
        public double PredictionError { get; private set; }

        /// <summary>A step, or a part of one, begins, whose drives have been prepared.</summary>
        /// <param name="length">s.</param>
        public void BeginStep(double length)
        {
            int last = Shape.ElementCount;
            SupportSpring? spring = Terms.Walls()?.Spring;
            if (spring != null && Drive.Axis != Vector3d.Zero)
            {
                spring.Axis = Drive.Axis;
            }
            if (_slips != null)
            {
                _hasSlipped = false;
                double part = length / _timeStep;
                spring!.MostBack = Math.Max(0.0, part * (Drive.Moved + _mostSlip));
                spring.MostForward = Math.Max(0.0, part * (_mostSlip - Drive.Moved));
            }
            _exit = _scene.Supports.Winds ? _scene.Supports.Coaxial!.Joints.Sheathed : 0.0;
            _hubWork += 0.5 * SheathWork(_exit);
            _free = Shape.X[last] + length * Velocities[last]
                + (length * length) * Schedule.Loads.Gravity;
            _heldFrom = spring == null ? Vector3d.Zero : spring.HeldPosition(Shape);
            _dissipated = Dissipated;
            _innerSteps = _dynamics.Control.Steps;
            _monitor?.BeginStep(Shape);
        }

        /// <summary>It ends.</summary>
        /// <param name="failure">Why it has no solution, or null.</param>
        /// <param name="length">s.</param>
        /// <returns>False where it has no solution or has lost the wire.</returns>
        public bool EndStep(string? failure, double length)
        {
            if (failure != null)
            {
                double end = Time;
                if (_monitor != null)
                {
                    _dynamics.GoBack();    // what Newton's method left is no shape of the wire
                }
                Failure = _texts.NoSolution(failure, end);
                return false;
            }
            _ends.Count(Shape, HubTurn, _dynamics.DistalTurn, length);
            Failure ??= _monitor?.FindTouchFromBeside(Time);
            if (Failure != null || HasBlownUp())
            {
                return false;
            }
            Failure = _scene.Joints.FindLost(Shape, Time);
            SteadyState = Terms.Walls()?.Barrier.Fields.Carrier >= 0 ? null : _rest.FindRest(Time);
            PredictionError = Vector3d.Distance(_free, Shape.X[Shape.ElementCount]) / _scene.Metres;
            Failure = Failure == null ? null : Failure + _texts.Advice;
            if (Contacts != null)
            {
                StageForces mean = _dynamics.Reactions.Mean;
                Contacts.Reaction = mean.Proximal;
                Contacts.ReactionAtEnd = _dynamics.Reactions.End.Proximal;
                Contacts.MeanTotal = mean.Walls;
                _hubWork += Vector3d.Dot(mean.Proximal, Terms.HubAxis(Shape))
                    * Drive.Moved + mean.HubTorque * Drive.Turned + 0.5 * SheathWork(_exit);
                _monitor?.EndStep(Shape, Contacts);
                if (Terms.Walls()?.HoldsStart == true)
                {
                    SupportSpring spring = Terms.Walls()!.Spring;
                    SlipHub(spring);
                    // What the drive asked, and what of it was not gone.
                    double asked = length / _timeStep * Drive.CommandedDisplacement;
                    double gone = Drive.AxialProgress(_heldFrom, spring.HeldPosition(Shape))
                        - length / _timeStep * Drive.CarriedBy;
                    Contacts.DriveAsked += asked / _scene.Metres;
                    Contacts.DriveShortfall += (asked - gone) / _scene.Metres;
                    Failure ??= _texts.FindOverdriven(Contacts) ?? _texts.FindDrivenOut()
                        ?? _texts.FindCarriedOff(Time);
                }
            }
            TakeExtremes(length);
            return true;
        }

        private bool HasBlownUp()
        {
            _energy.WallWork = _monitor?.MaxPutIn ?? 0.0;
            string? divergence = _energy.Blowup();
            Divergence = divergence == null ? null : divergence + "; lower timeStep, or take another integrator";
            return Divergence != null;
        }

        private void EndInterval()
        {
            _monitor!.AddPart(Shape, _dynamics.DragPower);
            Terms.Walls()!.Barrier.Nodes.HasBuckled = false;
        }

        // The force that drives the wire out of a sheath depends on the hub's position, steeply where the exit passes a
        // node: so the hub slips until its force is within the limit, by half as much once it has slipped too far.
        private void SlipHub(SupportSpring spring)
        {
            if (_slips == null)
            {
                return;
            }
            Terms.SetTime(Schedule, Time);
            double asked = Drive.Insertion;
            double slip = 0.0;
            bool isTooFar = false;
            for (int left = Terms.Release == null ? 1 : MaxSlips; left > 0; left--)
            {
                spring.ReleaseForce = Terms.SheathForce(Shape);
                double needed = spring.SlipOf(Shape);
                if (needed == 0.0)
                {
                    break;
                }
                isTooFar |= needed * slip < 0.0;
                slip = isTooFar ? Math.Sign(needed) * Math.Abs(0.5 * slip) : needed;
                spring.Position -= slip * spring.Axis;
                spring.MostBack = Math.Max(0.0, spring.MostBack - slip);
                spring.MostForward = Math.Max(0.0, spring.MostForward + slip);
                Drive.SlipHub(slip);
                Terms.SetTime(Schedule, Time);
            }
            if (Drive.Insertion != asked)
            {
                _hubWork += Terms.HubForce(Shape) * (Drive.Insertion - asked);
                _hasSlipped = true;
            }
            _slips.Record(_hasSlipped, Terms.HubForce(Shape), Time);
        }

        // Of the hub in this step against what drives the wire out of a sheath, by the moments of now, J.
        private double SheathWork(double exit)
        {
            return !_scene.Supports.Winds ? 0.0
                : Terms.Release!.SheathWork(Shape, exit, _scene.Supports.Coaxial!.Hubs!.SheathedAt(Drive.StepEnd));
        }

        private RodTerms Terms => _dynamics.Terms;

        private RodShape Shape => _dynamics.Shape;

        private Vector3d[] Velocities => _dynamics.Velocities;

        private Vector3d[] Spins => _dynamics.Spins;

        private double Time => _dynamics.Time;

        private double Dissipated => Terms.Walls()?.Dissipated ?? 0.0;

        private void TakeExtremes(double length)
        {
            _spinLoss?.AddSteps(Terms.Rod, Shape, Spins, length,
                Math.Max(1, _dynamics.Control.Steps - _innerSteps));
            if (_scene.Supports.Coaxial != null)
            {
                _scene.Rod.SetJoints(_scene.Supports, _joints);    // tips that move change the lengths of elements
            }
            _extremes.TakeShape(Terms, _joints, _jointLengths, Shape, Time);
            _extremes.TakeFibres(Terms, Shape, Time);
            if (_elementForces == null)
            {
                return;
            }
            _elementForces.Record(Shape, Contacts!, _extremes, Time);
            _extremes.TakeStrands(Terms.Walls()!.Self?.LargestForce(Shape) ?? double.NaN, Time);
            if (Terms.Walls()!.HoldsStart)
            {
                _extremes.TakeHub(Terms.HubForce(Shape), _dynamics.Reactions.HubTorque, Time, Drag);
            }
            BarrierEnergy barrier = Terms.Walls()!.Barrier;
            _vesselTurn = barrier.Fields.Beam == null ? 0.0
                : Math.Max(_vesselTurn, barrier.Fields.Of[barrier.Fields.Carrier]!.LargestTurn);
            if (barrier.Lag != null || barrier.Fields.IsTimed)
            {
                _extremes.WallWork = _monitor!.Work - (barrier.Lag?.Dissipated ?? 0.0);
            }
            if (Terms.Walls()!.HasFriction)
            {
                _extremes.TakeFriction(Dissipated - _dissipated, length);
            }
        }

        // Of massDamping along the hub's axis, N.
        private double Drag
        {
            get
            {
                Vector3d momentum = Vector3d.Zero;
                for (int i = 0; i <= Shape.ElementCount; i++)
                {
                    momentum += Terms.Mass.Nodal[i] * Velocities[i];
                }
                return Terms.Rod.MassDamping * Vector3d.Dot(momentum, Terms.HubAxis(Shape));
            }
        }

        // A frame in a sheath is held where the wire is; a spring beyond it turns with the hub.
        private double HubTurn => _dynamics.ProximalTurn + Schedule.Hub.AheadAt(Time);

        /// <summary>What is read off at the hub and the tip; null without a hub.</summary>
        public HubRecord? Hub()
        {
            if (Terms.Supports.Proximal == ProximalEnd.Free)
            {
                return null;
            }
            _hub ??= new HubRecord(_jointLengths);
            // A hub that may slip has the force of where it has slipped to, not that of the step.
            Vector3d force = _slips != null && (_hasSlipped || !Terms.Walls()!.Spring.Limit.IsOfHand)
                ? Terms.Walls()!.SupportForce(Shape)
                : _dynamics.ReactionAt(0);
            _hub.Record(Terms, Shape, Drive, force, _dynamics.Reactions.HubTorque,
                Schedule.Hub.AheadAt(Time));
            _hub.SlippedFrom = _slips?.SlippedFrom ?? double.NaN;
            _hub.Work = _monitor == null ? double.NaN : _hubWork;
            _hub.Drag = Drag;
            return _hub;
        }

        /// <summary>A hub that slips moves less than asked; a free wire that spins fast loses angular
        /// momentum.</summary>
        public void AddWarnings(List<RunWarning> warnings)
        {
            if (Drive.FallsShort)
            {
                warnings.Add(WarningTable.HubShortfall.With("the hub", Drive.Slip,
                    _slips?.Why ?? "the wire reached an end of its sheath"));
            }
            if (_slips?.FindExcess("the hub") is RunWarning excess)
            {
                warnings.Add(excess);
            }
            if (_dynamics.Newton.BalanceRounding.OfSupports > 0.0)
            {
                warnings.Add(WarningTable.Rounding.With(_dynamics.Newton.BalanceRounding.OfSupports));
            }
            if (_vesselTurn > LargestVesselTurn)
            {
                warnings.Add(WarningTable.VesselTurn.With(_vesselTurn));
            }
            if (_rest.IsUnstable(Time))
            {
                warnings.Add(WarningTable.Unstable.With());
            }
            if (_dynamics.HasErrorEstimate && Terms.Rod.MassDamping == 0.0 && Terms.Rod.MaterialDamping == 0.0
                && Terms.Contact == null && Terms.Supports.Coaxial == null && _ends.Work == 0.0
                && _energy.FractionLost > MaxEnergyLoss)
            {
                warnings.Add(WarningTable.EnergyLost.With(100.0 * _energy.FractionLost,
                    _dynamics.Control.LargestError));
            }
            if (_spinLoss != null && _spinLoss.Expected > MaxSpinLoss)
            {
                warnings.Add(WarningTable.SpinLost.With(_spinLoss.LargestTurn, 100.0 * _spinLoss.Expected));
            }
        }

        /// <summary>Strains, forces, couples and energies as it is.</summary>
        public StressRecord Stress()
        {
            _stress ??= new StressRecord(_jointLengths);
            Terms.SetTime(Schedule, Time);
            _stress.Record(Terms, Shape, Terms.Mass.KineticEnergy(Velocities, Spins));
            _stress.TakeEnergies(_stress.KineticEnergy, _stress.ElasticEnergy + (Terms.Fibres?.LeadEnergy ?? 0.0),
                _stress.PotentialEnergy + _outside);
            return _stress;
        }

        /// <summary>Weight and motion of the rod, J. What comes in from a sheath has had neither, and what goes there
        /// keeps none: the account takes note of both.</summary>
        public double Carried
        {
            get
            {
                Terms.SetTime(Schedule, Time);
                return Terms.Loads.Value(Shape) + Terms.Mass.KineticEnergy(Velocities, Spins);
            }
        }

        /// <summary>Of what came in or went the account keeps this, J, as the energy of what is in the
        /// sheath.</summary>
        public void Leave(double carried) => _outside += carried;

        /// <summary>Gives the solver's report on its own work.</summary>
        public SolverReport Report()
        {
            _results.Factorisations = _startFactorisations + _dynamics.Newton.Factorisations;
            _results.KeptSolutions = _dynamics.Newton.KeptSolutions;
            _results.Searches = _dynamics.Newton.Searches;
            if (_dynamics.HasErrorEstimate)
            {
                _results.TimeStepError = _dynamics.Control.LargestError;
                _results.StepsNotConverged = _dynamics.Control.StepsAbove;
            }
            if (_monitor != null)
            {
                Barrier barrier = Terms.Walls()!.Barrier.Barrier;
                _results.WallIterations = _dynamics.Newton.Iterations;
                _results.ContactDistance = barrier.Distance;
                _results.ContactStiffness = barrier.Stiffness;
            }
            _results.HalvedSteps = _dynamics.Clock.Halvings;
            _results.InnerSteps = _dynamics.Control.Steps;
            Terms.SetTime(Schedule, Time);
            _results.Energy = _dynamics.Energy;
            _results.ProximalForce = _dynamics.ReactionAt(0);
            _results.DistalForce = _scene.Supports.Distal != DistalEnd.Free ? _dynamics.ReactionAt(Shape.ElementCount)
                : Vector3d.Zero;
            _results.ProximalMoment = _dynamics.Reactions.ProximalCouple;
            _results.DistalMoment = _dynamics.Reactions.DistalCouple;
            return _results;
        }

        /// <summary>Writes it as it is into a state.</summary>
        public void Write(RodState state) => _scene.Write(state, Shape, Velocities, Spins);

        /// <summary>Writes or restores all that the next step depends on.</summary>
        public void Serialize(Snapshot snapshot)
        {
            _dynamics.Serialize(snapshot);
            if (snapshot.IsStep)
            {
                SerializeRecords(snapshot);
                return;
            }
            if (!snapshot.IsWritten)
            {
                Terms.Walls()?.Barrier.SetTime(Time);
                FollowEnds();
            }
            if (!snapshot.Section(SectionKey, SerializeHistory))
            {
                _energy.Start();
            }
            if (!snapshot.IsWritten)
            {
                _scene.Joints.Begin(Shape, Time);
            }
        }

        /// <summary>Writes or restores what was counted, whatever the number of elements.</summary>
        public void SerializeCounts(Snapshot snapshot)
        {
            snapshot.Serialize(ref _startFactorisations);
            snapshot.Serialize(ref _hubWork);
            snapshot.Serialize(ref _outside);
            _dynamics.Clock.Serialize(snapshot);
            _monitor?.Serialize(snapshot);
            _ends.SerializeWork(snapshot);
            _dynamics.SerializeCounts(snapshot);
        }

        // Between walls more is kept than without.
        private string SectionKey => Terms.Walls() == null ? "direct"
            : (Terms.Walls()!.HoldsStart ? "direct, walls" : "direct, walls, free")
            + Terms.Walls()!.Barrier.Fields.Key;

        // For a step.
        private void SerializeRecords(Snapshot snapshot)
        {
            Drive.Serialize(snapshot);
            Drive.Hub.Serialize(snapshot, Time);
            _ends.Serialize(snapshot);
            _energy.Serialize(snapshot);
            _rest.Serialize(snapshot);
            _extremes.Serialize(snapshot);
            _spinLoss?.Serialize(snapshot);
            _monitor?.Serialize(snapshot);
            _slips?.Serialize(snapshot);
            snapshot.Serialize(ref _hasSlipped);
            snapshot.Serialize(ref _hubWork);
            snapshot.Serialize(ref _outside);
            SerializeVessel(snapshot);
            Contacts?.Serialize(snapshot);
            if (!snapshot.IsWritten)
            {
                (Failure, Divergence) = (null, null);
            }
        }

        // For a run.
        private void SerializeHistory(Snapshot snapshot)
        {
            BarrierEnergy? barrier = Terms.Walls()?.Barrier;
            if (barrier?.Fields.Carrier >= 0)
            {
                barrier.Fields.Serialize(snapshot, Time);
                SerializeVessel(snapshot);
                barrier.WallsMoved();
                _monitor!.SerializeWork(snapshot);
            }
            snapshot.Serialize(ref _startFactorisations);
            snapshot.Serialize(ref _hubWork);
            snapshot.Serialize(ref _outside);
            _results.Serialize(snapshot);
            snapshot.OptionalSection("spin", _spinLoss == null ? (Action<Snapshot>?)null : _spinLoss.Serialize);
            snapshot.OptionalSection("slips", _slips == null ? (Action<Snapshot>?)null : kept =>
            {
                _slips.Serialize(kept);
                kept.Serialize(ref _hasSlipped);
            });
            _energy.Serialize(snapshot);
            Drive.Serialize(snapshot);
            _dynamics.Clock.Serialize(snapshot);
            _dynamics.Work.Serialize(snapshot);
            _monitor?.Serialize(snapshot);
            (_monitor == null ? null : Contacts)?.Serialize(snapshot);
            _ends.SerializeWork(snapshot);
            _rest.Serialize(snapshot);
            _dynamics.SerializeHistory(snapshot, _timeStep);
        }

        private void SerializeVessel(Snapshot snapshot)
        {
            if (Shape.Vessel.Length > 0)
            {
                Shape.SerializeVessel(snapshot);
                snapshot.Serialize(ref _vesselTurn);
            }
        }

        private void FollowEnds() => _ends.Follow(Shape, HubTurn, _dynamics.DistalTurn);
    }
}
