using System;

namespace Guidewire.Core
{
    /// <summary>One stage of an implicit scheme: its positions and orientations minimise inertia plus energies. What
    /// came before stands in the histories of <see cref="Inertia"/>, set by the scheme; what the stage leaves to those
    /// after it, in <see cref="Rates"/>.</summary>
    internal sealed class RodStage
    {
        private const double LargestPredictedTurn = 1.0;  // radians

        private readonly RodSupports _supports;
        private readonly RodTerms _terms;
        private readonly RodSchedule _schedule;
        private readonly RodShape _shape;
        private readonly RodShape _before;        // the last stage's
        private readonly Quaterniond[] _predicted;
        private readonly RodVector[] _loads;
        private readonly double _mass;
        private readonly bool _isLoose;           // held nowhere, and nothing takes its momentum
        private readonly WallStage? _walls;       // solves where there are walls

        /// <summary>For a rod of this shape, which stages move from then on.</summary>
        /// <param name="scheme">A Runge-Kutta scheme, or null for BDF2.</param>
        /// <param name="tolerance">On each stage's error: radians, or displacement over L; and on what a step may leave
        /// of the balance of forces, over the largest force in the rod.</param>
        /// <param name="mostIterations">Newton iterations of a stage.</param>
        public RodStage(RodTerms terms, RodSchedule schedule, RodShape shape, RungeKuttaScheme? scheme,
            double tolerance, int mostIterations)
        {
            int n = shape.ElementCount;
            _supports = terms.Supports;
            _terms = terms;
            _schedule = schedule;
            _shape = shape;
            _before = new RodShape(n);
            _predicted = new Quaterniond[n];
            _loads = new RodVector[n + 2];
            _mass = terms.Mass.Total;
            int stages = scheme == null ? 1 : scheme.StageCount;
            double massDamping = terms.Rod.MassDamping;
            _isLoose = terms.Walls() == null && massDamping == 0.0 && scheme != null && scheme.IsFirstExplicit
                && _supports.Proximal == ProximalEnd.Free && _supports.Distal == DistalEnd.Free;
            VelocityHistory = new Vector3d[n + 1];
            Inertia = new InertiaEnergy(terms.Mass)
            {
                TurnDamping = massDamping,
                RemembersCouples = terms.Walls() != null,
            };
            if (massDamping > 0.0 || terms.Rod.MaterialDamping > 0.0)
            {
                Damping = new RodDamping(terms, stages);
            }
            EnergyTerm[] moving = Damping == null
                ? new EnergyTerm[] { Inertia } : new EnergyTerm[] { Inertia, Damping };
            Solver = new StageSolver(terms, moving)
            {
                Tolerance = tolerance,
                Balance = tolerance / (2.0 * (scheme == null ? 1.0 : scheme.WeightSum)),
                MostIterations = mostIterations,
            };
            if (terms.Walls() != null)
            {
                _walls = new WallStage(terms, Inertia, moving);
                _walls.Newton.Tolerance = tolerance;
                _walls.Newton.Balance = Solver.Balance;
                _walls.Newton.MostIterations = mostIterations;
            }
            Frames = new ClampFrames(schedule, Solver);
            Rates = new StageRates(stages, n);
        }

        /// <summary>What the stages before leave of positions, orientations and spins, and the inertia.</summary>
        public InertiaEnergy Inertia { get; }

        /// <summary>What the stages before leave of the velocities, m/s.</summary>
        public Vector3d[] VelocityHistory { get; }

        /// <summary>What resists velocities and rates of strain, or null.</summary>
        public RodDamping? Damping { get; }

        /// <summary>Solves the stages, and counts what was solved.</summary>
        public StageSolver Solver { get; }

        /// <summary>Solves the stages where there are walls, and counts; null where there are none.</summary>
        public BarrierNewton? WallSolver => _walls?.Newton;

        /// <summary>Frames of the clamps.</summary>
        public ClampFrames Frames { get; }

        /// <summary>Accelerations of the stages.</summary>
        public StageRates Rates { get; }

        /// <summary>Whether <see cref="Forces"/> are kept; they cost a gradient a stage.</summary>
        public bool TracksForces { get; set; }

        /// <summary>The forces from outside in the last stage.</summary>
        public StageForces Forces { get; set; }

        /// <summary>Places the supports, predicts from stages before, solves, and takes the stage's
        /// rates.</summary>
        /// <param name="jump">When a load jumps next: a stage at that time is before the jump.</param>
        /// <param name="stage">Its index among the rates.</param>
        /// <param name="hasPast">Whether stages of the step before are known.</param>
        /// <param name="predictor">Which stages before it is predicted from.</param>
        /// <returns>Null, or why it has no solution; the shape is then not to be used.</returns>
        public string? Solve(double time, double jump, int stage, bool hasPast, in StagePredictor predictor)
        {
            double h = Inertia.StageLength;
            double before = Math.Min(time, jump);
            Inertia.BeginStage();
            _terms.SetTime(_schedule, before);
            string? failure = Frames.Turn(_shape, time, out bool inParts);
            if (failure != null)
            {
                return failure;
            }
            // A prediction knows nothing of turns just wound up, and one of more than a radian leads to another
            // winding.
            Vector3d start = PredictStart(time, h, predictor);
            if (Predict(h, predictor) > LargestPredictedTurn || inParts)
            {
                Array.Copy(_shape.Q, _predicted, _predicted.Length);
            }
            Vector3d end = _schedule.Distal.PositionAt(time);
            double loads = _schedule.Loads.SumAt(before, _mass) + _terms.Followers.Force.Force.Length;
            failure = _walls != null ? _walls.Solve(_shape, _predicted, start, end, h, loads)
                : Solve(h, loads, start, end);
            if (failure != null)
            {
                return failure;
            }
            if (_isLoose)
            {
                Inertia.Balance(_shape, LoadSum());
            }
            Rates.Take(stage, _shape, Inertia, VelocityHistory, hasPast);
            Damping?.EndStage(stage, _shape);
            if (TracksForces)
            {
                RodVector[] gradient = Solver.Reactions(_shape);
                RodVector first = gradient[0];
                RodVector last = gradient[_shape.ElementCount];
                Forces = WithWalls(new StageForces
                {
                    Proximal = new Vector3d(first.X1, first.X2, first.X3),
                    Distal = new Vector3d(last.X1, last.X2, last.X3),
                });
            }
            return null;
        }

        /// <summary>Torque of the hub on the wire about its axis, N m; that on a wire in a sheath is the slope of the
        /// energy in the hub's turn.</summary>
        public double HubTorque()
        {
            if (_terms.Sheath != null)
            {
                return _terms.Bending.TurnCouple(_shape);
            }
            Vector3d couple = _terms.Bending.ProximalCouple(_shape)
                + (Damping == null ? Vector3d.Zero : Damping.ProximalCouple(_shape));
            return Vector3d.Dot(couple, _terms.HubAxis(_shape));
        }

        /// <summary>These forces, what nodes 0 and n need to be where they are, with the loads, and with what walls and
        /// the hub add between walls.</summary>
        public StageForces WithWalls(StageForces forces)
        {
            forces.Load = LoadSum();
            if (_terms.Walls() != null)
            {
                forces.Proximal = _terms.Walls()!.SupportForce(_shape) + forces.Proximal;
                Array.Clear(_loads, 0, _loads.Length);
                _terms.Walls()!.AddWallGradient(_shape, _loads);
                forces.Walls = -Sum(_loads);
                forces.HubTorque = HubTorque();
            }
            return forces;
        }

        /// <summary>Writes or takes over what a solution leaves to the next one, besides what the scheme has.</summary>
        public void SerializeStep(Snapshot snapshot)
        {
            WallSolver?.SerializeShift(snapshot);
        }

        /// <summary>Sum of the forces of all loads, N, whose time has been set.</summary>
        public Vector3d LoadSum()
        {
            Array.Clear(_loads, 0, _loads.Length);
            _terms.AddLoadGradient(_shape, _loads);
            return -Sum(_loads);
        }

        private static Vector3d Sum(RodVector[] gradient)
        {
            Vector3d sum = Vector3d.Zero;
            foreach (RodVector g in gradient)
            {
                sum += new Vector3d(g.X1, g.X2, g.X3);
            }
            return sum;
        }

        /// <summary>By the quick iteration from the prediction, or else by the slower search.</summary>
        private string? Solve(double h, double loads, in Vector3d start, in Vector3d end)
        {
            KeepShape();
            RodStep.PlaceElements(_supports, _shape, _predicted, start, end);
            return Solver.Iterate(_shape, h, loads) ? null : Search(h, loads, start, end);
        }

        /// <summary>The slower search from the stage before, with what the iteration can still add to it.</summary>
        private string? Search(double h, double loads, in Vector3d start, in Vector3d end)
        {
            GoBack();
            RodStep.PlaceElements(_supports, _shape, _shape.Q, start, end);
            string? failure = Solver.Search(_shape);
            if (failure == null)
            {
                KeepShape();
                if (!Solver.Iterate(_shape, h, loads))
                {
                    GoBack();
                }
            }
            return failure;
        }

        private void KeepShape()
        {
            _before.CopyFrom(_shape);
            Inertia.KeepTurns();
        }

        private void GoBack()
        {
            _shape.CopyFrom(_before);
            Inertia.RestoreTurns();
        }

        /// <summary>Orientations by the accelerations of stages before; strains are not predicted but kept, because
        /// EA makes a force of every error that the turns leave in a chord. Returns the largest turn.</summary>
        private double Predict(double h, in StagePredictor predictor)
        {
            double largest = 0.0;
            Vector3d[] first = Rates.SpinRate[predictor.First];
            Vector3d[] second = Rates.SpinRate[predictor.Second];
            double fraction = predictor.Fraction;
            for (int j = 0; j < _predicted.Length; j++)
            {
                Vector3d rate = first[j] + fraction * (second[j] - first[j]);
                Vector3d turn = Inertia.TurnHistory[j] + h * (Inertia.SpinHistory[j] + h * rate);
                _predicted[j] = Inertia.Start[j] * RotationVector.Exp(turn);
                largest = Math.Max(largest, Inertia.SquaredChange(turn, j));
            }
            return Math.Sqrt(largest);
        }

        private Vector3d PredictStart(double time, double h, in StagePredictor predictor)
        {
            return _supports.Proximal == ProximalEnd.Free
                ? Inertia.FreePositions[0] + (h * h) * Rates.Acceleration[predictor.First][0]
                : _schedule.Hub.PositionAt(time);
        }
    }
}
