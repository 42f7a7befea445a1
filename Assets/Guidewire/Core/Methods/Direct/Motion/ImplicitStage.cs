using System;

namespace Guidewire.Core
{
    /// <summary>One stage of an implicit scheme: its positions and orientations minimise inertia plus energies. It owns
    /// the history that stages and steps pass on to later ones.</summary>
    /// <remarks>A step is <see cref="BeginStep"/>, then for each stage <see cref="BeginStage(double[], double)"/> and
    /// <see cref="Solve(double, double, int, in StagePredictor)"/>, then <see cref="Accept"/> and, where the step
    /// counts, <see cref="EndStep"/>.</remarks>
    internal sealed class ImplicitStage
    {
        /// <summary>Fraction of a step within which two times are the same.</summary>
        public const double SameTime = 1e-9;

        private const double LargestPredictedTurn = 1.0;  // radians
        private const double FirstAccuracy = 1e-4;        // of a solution that only gives normal forces
        private const double FirstTolerances = 100.0;     // that it may leave at most

        private readonly RodSupports _supports;
        private readonly RodTerms _terms;
        private readonly RodSchedule _schedule;
        private readonly RodMotion _motion;
        private readonly RodShape _shape;
        private readonly RodShape _before;        // the last stage's
        private readonly InertiaEnergy _inertia;
        private readonly Vector3d[] _startPositions;   // of the step, m
        private readonly Vector3d[] _velocityHistory;  // what the stages before leave of the velocities, m/s
        private readonly Quaterniond[] _predicted;
        private readonly bool _isLoose;           // held nowhere, and nothing takes its momentum
        private readonly ViscousRelaxation? _creep;   // where a couple at the tip has no potential
        private readonly WallStage? _walls;       // solves where there are walls
        private double _loads;                    // sum of their magnitudes in the stage, N
        private readonly Vector3d[] _vesselBegan;      // displacements of a vessel's splines, m
        private double _began;                    // s
        private double _length;                   // s
        private bool _hasPast;
        private bool _isEuler;                    // the stage is a step of implicit Euler

        /// <summary>For a rod, which stages move from then on.</summary>
        /// <param name="stageCount">Of the scheme, an explicit one counted.</param>
        /// <param name="isFirstExplicit">Whether its first stage is explicit.</param>
        public ImplicitStage(RodTerms terms, RodSchedule schedule, RodMotion motion, int stageCount,
            bool isFirstExplicit)
        {
            _supports = terms.Supports;
            _terms = terms;
            _schedule = schedule;
            _motion = motion;
            _shape = motion.Shape;
            _before = new RodShape(_shape.ElementCount, _shape.InnerCount, terms.Rod.Capacity);
            _startPositions = new Vector3d[_shape.X.Length];
            _vesselBegan = new Vector3d[_shape.Vessel.Length];
            _velocityHistory = new Vector3d[_shape.X.Length];
            _predicted = new Quaterniond[_shape.Q.Length];
            double massDamping = terms.Rod.MassDamping;
            _isLoose = terms.Walls() == null && massDamping == 0.0 && isFirstExplicit
                && _supports.Proximal == ProximalEnd.Free && _supports.Distal == DistalEnd.Free;
            _inertia = new InertiaEnergy(terms.Mass)
            {
                TurnDamping = massDamping,
                RemembersCouples = terms.Walls() != null,
            };
            if (massDamping > 0.0 || terms.Rod.MaterialDamping > 0.0)
            {
                Damping = new RodDamping(terms, stageCount);
            }
            EnergyTerm[] moving = Damping == null
                ? new EnergyTerm[] { _inertia } : new EnergyTerm[] { _inertia, Damping };
            Inner = new InnerSpin(_supports.Coaxial, _inertia, motion, stageCount);
            if (_supports.InnerCount > 0)
            {
                Array.Resize(ref moving, moving.Length + 1);
                moving[moving.Length - 1] = Inner;
            }
            EnergyTerm[] all = terms.With(moving);
            Newton = new Newton(terms, all);
            _creep = terms.HavePotential ? null : new ViscousRelaxation(terms.Rod, _supports, all, terms.Followers);
            _walls = terms.Walls() == null ? null : new WallStage(terms, _inertia, all);
            Frames = new ClampFrames(schedule, Search);
            Rates = new StageRates(stageCount, _shape);
            Reactions = new RodReactions(terms, schedule, motion, all, Newton.BalanceRounding, Damping);
        }

        /// <summary>Velocities of the blood at the nodes in the last stage, m/s; null: it is at rest.</summary>
        public Vector3d[]? Surrounding { get; private set; }

        /// <summary>What resists velocities and rates of strain, or null.</summary>
        public RodDamping? Damping { get; }

        /// <summary>The spin of instruments inside.</summary>
        public InnerSpin Inner { get; }

        /// <summary>Solves the stages, and counts.</summary>
        public Newton Newton { get; }

        /// <summary>Frames of the clamps.</summary>
        public ClampFrames Frames { get; }

        /// <summary>Accelerations of the stages.</summary>
        public StageRates Rates { get; }

        /// <summary>The forces from outside.</summary>
        public RodReactions Reactions { get; }

        /// <summary>Whether stages of the step before are known, to predict from.</summary>
        public bool HasPast
        {
            get => _hasPast;
            set => _hasPast = value;
        }

        /// <summary>The rod has other elements and no past.</summary>
        public void Remesh()
        {
            _inertia.Remesh();
            Damping?.Remesh();
            Inner.Remesh();
            Newton.Remesh();
            _creep?.Remesh();
            _walls?.Remesh();
            Rates.Clear();
            Reactions.Remesh();
            _hasPast = false;
        }

        /// <summary>A step of dt, s, begins.</summary>
        public void BeginStep(double time, double dt)
        {
            Array.Copy(_shape.X, _startPositions, _shape.ElementCount + 1);
            _shape.Vessel.CopyTo(_vesselBegan, 0);
            (_began, _length) = (time, dt);
            _inertia.BeginStep(_shape, dt);
            BeginDamping(time + SameTime * dt);
            _terms.Bending.BeginSlide(time);
            _terms.Release?.BeginStep(_shape);
            foreach (EnergyTerm term in _terms.All)
            {
                term.BeginStep(_shape, dt);
            }
            Inner.BeginStep(_shape, dt);
        }

        /// <summary>A stage of a Runge-Kutta scheme begins.</summary>
        /// <param name="row">a_ik; its length is the stage's index plus 1.</param>
        /// <param name="dt">The step, s.</param>
        public void BeginStage(double[] row, double dt)
        {
            _inertia.StageLength = row[row.Length - 1] * dt;
            _isEuler = row.Length == 1;
            Rates.Prepare(_inertia, row, dt, _startPositions, _motion.Velocities, _motion.Spins, _velocityHistory);
            Damping?.BeginStage(row, dt);
            Inner.BeginStage(row, dt);
        }

        /// <summary>The one stage of a step by BDF2 begins.</summary>
        public void BeginStage(Bdf2History history, double dt)
        {
            double h = history.Prepare(_inertia, _startPositions, _motion.Velocities, _motion.Spins, _velocityHistory,
                dt);
            Damping?.BeginStage(history.IsComplete, h);
            _isEuler = !history.IsComplete;
            Inner.BeginStage(history.IsComplete);
        }

        /// <summary>Rates from the forces of this time are asked for, at the start of a step of length h, s.</summary>
        public void BeginRates(double time, double h)
        {
            _walls?.TakePlaces(_shape);
            _terms.SetTime(_schedule, time);
            BeginDamping(time);
            Damping?.TakeMoment(h);
            Vector3d[]? around = _walls?.Around();
            _terms.Walls()?.Barrier.BeginStage(_shape.X, _motion.Velocities, h, around);
            Damping?.SetSurrounding(around);
        }

        /// <summary>The velocities in the last stage are those at the step's end.</summary>
        public void Accept()
        {
            Rates.Accept(_inertia, _motion.Velocities, _motion.Spins);
            Inner.Accept();
        }

        /// <summary>The step is kept.</summary>
        public void EndStep()
        {
            foreach (EnergyTerm term in _terms.All)
            {
                term.EndStep(_shape);
            }
            for (int j = 0; j < _vesselBegan.Length; j++)
            {
                _shape.VesselRates[j] = (1.0 / _length) * (_shape.Vessel[j] - _vesselBegan[j]);
            }
            _shape.VesselInterval = _length;
        }

        /// <summary>Forgets the stages before.</summary>
        public void Forget()
        {
            _hasPast = false;
            Rates.Clear();
            Inner.Clear();
        }

        /// <summary>Places the supports, predicts from stages before, solves, and takes the stage's rates. Without
        /// walls by full steps from the prediction, or else by a search from the stage before.</summary>
        /// <param name="jump">When a load jumps next: a stage at that time is before the jump.</param>
        /// <param name="stage">Its index among the rates.</param>
        /// <param name="predictor">Which stages before it is predicted from.</param>
        /// <returns>Null, or why it has no solution; the shape is then not to be used.</returns>
        public string? Solve(double time, double jump, int stage, in StagePredictor predictor)
        {
            double h = _inertia.StageLength;
            double before = Math.Min(time, jump);
            _inertia.BeginStage();
            _walls?.TakePlaces(_shape);
            _terms.SetTime(_schedule, before);
            Surrounding = _walls?.Carry(_shape, _isEuler ? h : 0.0, _vesselBegan, time - _began);
            _terms.Walls()?.Barrier.BeginStage(_inertia.FreePositions, _velocityHistory, h, Surrounding);
            Damping?.SetSurrounding(Surrounding);
            _loads = _schedule.Loads.SumAt(before, _terms.Mass.Total) + _terms.Followers.Force.Force.Length;
            string? failure = Frames.Turn(_shape, time, out bool inParts);
            if (failure != null)
            {
                return failure;
            }
            // A prediction knows nothing of turns just wound up, and one of more than a radian leads to another
            // winding.
            Vector3d start = PredictStart(time, h, predictor);
            if (Predict(predictor) > LargestPredictedTurn || inParts)
            {
                Array.Copy(_shape.Q, _predicted, _shape.ElementCount);
            }
            Vector3d end = _schedule.Distal.PositionAt(time);
            if (_walls == null)
            {
                KeepShape();
                RodStep.PlaceElements(_supports, _shape, _predicted, start, end);
            }
            else
            {
                failure = _walls.Begin(_shape, _predicted, start, end);
            }
            // Friction has the normal forces of a first solution.
            WallTerms? contact = _terms.Walls();
            for (int left = contact?.HasFriction == true ? 1 : 0; left >= 0 && failure == null; left--)
            {
                double first = Math.Min(FirstTolerances, Math.Max(1.0, FirstAccuracy / Newton.Tolerance));
                failure = Newton.Minimise(_shape, h, _loads, isSearched: _walls != null, left > 0 ? first : 1.0);
                if (left > 0 && failure == null)
                {
                    contact!.Lag(_shape);
                }
            }
            if (failure != null && _walls == null)
            {
                GoBack();
                RodStep.PlaceElements(_supports, _shape, _shape.Q, start, end);
                failure = Search();
            }
            if (failure != null)
            {
                return failure;
            }
            if (_isLoose)
            {
                _inertia.Balance(_shape, Reactions.LoadSum());
            }
            Rates.Record(stage, _shape, _inertia, _velocityHistory, _hasPast);
            Damping?.EndStage(stage, _shape);
            Inner.EndStage(stage, _shape);
            Reactions.TakeStage();
            return null;
        }

        /// <summary>Writes or restores what stages leave to the next step; for a step also the motion and the terms,
        /// which a run lists before.</summary>
        public void Serialize(Snapshot snapshot)
        {
            if (snapshot.IsStep)
            {
                _motion.Serialize(snapshot);
                Frames.Serialize(snapshot);
                _terms.Serialize(snapshot);
            }
            Rates.Serialize(snapshot);
            _inertia.Serialize(snapshot);
            Inner.Serialize(snapshot);
            Newton.Serialize(snapshot);
            snapshot.Serialize(ref _hasPast);
            Reactions.Serialize(snapshot);
            if (snapshot.IsStep)
            {
                Damping?.Serialize(snapshot);
            }
            else
            {
                snapshot.OptionalSection("damping", Damping == null ? null : Damping.Serialize);
            }
        }

        private void BeginDamping(double time)
        {
            Damping?.Begin(_shape, _motion.Velocities, _motion.Spins,
                _schedule.ProximalSpinAt(time), _schedule.DistalSpinAt(time));
        }

        private string? Search()
        {
            if (_creep == null)
            {
                return Newton.Minimise(_shape, _inertia.StageLength, _loads, isSearched: true);
            }
            EquilibriumResult result = _creep.Settle(_shape, Newton.Tolerance, Newton.MaxIterations);
            if (!result.Converged)
            {
                return result.Reason;
            }
            KeepShape();
            if (Newton.Minimise(_shape, _inertia.StageLength, _loads, isSearched: false) != null)
            {
                GoBack();
            }
            return null;
        }

        private void KeepShape()
        {
            _before.CopyFrom(_shape);
            _inertia.KeepTurns();
        }

        private void GoBack()
        {
            _shape.CopyFrom(_before);
            _inertia.RestoreTurns();
        }

        /// <summary>Orientations by the accelerations of stages before; strains are not predicted but kept, because
        /// EA makes a force of every error that the turns leave in a chord. Returns the largest turn.</summary>
        private double Predict(in StagePredictor predictor)
        {
            return _inertia.Predict(Rates.SpinRate[predictor.First], Rates.SpinRate[predictor.Second],
                predictor.Fraction, _predicted);
        }

        private Vector3d PredictStart(double time, double h, in StagePredictor predictor)
        {
            return _supports.Proximal == ProximalEnd.Free
                ? _inertia.FreePositions[0] + (h * h) * Rates.Acceleration[predictor.First][0]
                : _schedule.Hub.PositionAt(time);
        }
    }

    /// <summary>A scheme in time that takes a rod through a step by implicit stages.</summary>
    internal abstract class ImplicitStepper
    {
        /// <summary>Steps by these stages.</summary>
        /// <param name="control">Counts the intervals, and divides them where the scheme tells their errors.</param>
        protected ImplicitStepper(ImplicitStage stage, StepControl control)
        {
            Stage = stage;
            Control = control;
        }

        /// <summary>Solves the stages.</summary>
        public ImplicitStage Stage { get; }

        /// <summary>How intervals follow from error estimates.</summary>
        public StepControl Control { get; }

        /// <summary>Whether no interval goes beyond a jump of a load.</summary>
        public virtual bool StopsAtJumps => false;

        /// <summary>By the scheme's estimate, of the last interval: radians, or displacement over L; 0 where it has
        /// none.</summary>
        public double Error { get; protected set; }

        /// <summary>Whether the last interval may be tried by the scheme's start, which it has not used.</summary>
        public bool MayRestart { get; protected set; }

        /// <summary>Whether the scheme estimates the errors of its steps.</summary>
        public virtual bool HasErrorEstimate => false;

        /// <summary>Sum of the magnitudes of the weights: the factor by which stage errors enter a step.</summary>
        public virtual double WeightSum => 1.0;

        /// <summary>Names the scheme: another's history means nothing to it.</summary>
        public abstract string Key { get; }

        /// <summary>The rod begins to move from where it is, as it does.</summary>
        public abstract void Begin();

        /// <summary>The rod has other elements and no past.</summary>
        public virtual void Remesh()
        {
            Stage.Remesh();
            Control.Forget();
            (Error, MayRestart) = (0.0, false);
        }

        /// <summary>Takes the rod through an interval.</summary>
        /// <returns>Null, or why a stage has no solution; the shape is then not to be used.</returns>
        public abstract string? Step(in Interval interval);

        /// <summary>Writes or restores what went before the next step.</summary>
        public virtual void Serialize(Snapshot snapshot) => Stage.Serialize(snapshot);
    }

    /// <summary>How the accelerations of a stage are predicted: a_First + Fraction (a_Second - a_First).</summary>
    internal struct StagePredictor
    {
        public int First;
        public int Second;
        public double Fraction;

        /// <summary>Gives that of one stage alone.</summary>
        public static StagePredictor Of(int stage) => new StagePredictor { First = stage, Second = stage };

        /// <summary>2 a - a_old, for a scheme of one stage that stores the step before as second.</summary>
        public static StagePredictor OneStage => new StagePredictor { First = 0, Second = 1, Fraction = -1.0 };
    }

    /// <summary>Shape, velocities and spins of a rod: the state that its steppers advance in time.</summary>
    internal sealed class RodMotion
    {
        /// <summary>A rod at rest in this shape, which moves from then on.</summary>
        public RodMotion(RodShape shape)
        {
            Shape = shape;
            Velocities = new Vector3d[shape.X.Length];
            Spins = new Vector3d[shape.Q.Length];
            TwistRates = new double[shape.Twist.Length];
        }

        /// <summary>Positions and orientations.</summary>
        public RodShape Shape { get; }

        /// <summary>v of the nodes, m/s.</summary>
        public Vector3d[] Velocities { get; }

        /// <summary>w of the elements along their own axes, rad/s.</summary>
        public Vector3d[] Spins { get; }

        /// <summary>z' of the angles to an instrument inside, rad/s; none where there is one alone.</summary>
        public double[] TwistRates { get; }

        /// <summary>Takes over another motion.</summary>
        public void CopyFrom(RodMotion other)
        {
            Shape.CopyFrom(other.Shape);
            Begin(other.Velocities, other.Spins);
            Array.Copy(other.TwistRates, TwistRates, Shape.TwistCount);
        }

        /// <summary>Takes over velocities.</summary>
        public void Begin(Vector3d[] velocities, Vector3d[] spins)
        {
            Array.Copy(velocities, Velocities, Shape.ElementCount + 1);
            Array.Copy(spins, Spins, Shape.ElementCount);
        }

        /// <summary>Writes or restores the motion.</summary>
        public void Serialize(Snapshot snapshot)
        {
            Shape.Serialize(snapshot);
            Shape.SerializeVessel(snapshot);
            snapshot.Serialize(Velocities, Shape.ElementCount + 1);
            snapshot.Serialize(Spins, Shape.ElementCount);
            snapshot.Serialize(TwistRates, Shape.TwistCount);
        }
    }
}
