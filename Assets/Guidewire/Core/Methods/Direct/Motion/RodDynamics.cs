using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>The motion of a material rod by implicit schemes: each stage's positions and orientations minimise
    /// inertia plus energies, by Newton's method in O(n).</summary>
    /// <remarks>Positions and velocities obey x' = v, M v' = f; orientations are q = q_start exp(phi) within a step,
    /// with phi' = J(phi)^-1 w and I w' = couple - w x I w along the element's axes. A Runge-Kutta scheme acts on x,
    /// v, phi and w alike, so its order holds for large turns too. BDF2 begins with a step of implicit Euler.</remarks>
    internal sealed class RodDynamics
    {
        private const double LargestFrameTurn = 0.5;  // radians a stage; more is taken in parts
        private const double LargestPredictedTurn = 1.0;

        private readonly RodSupports _supports;
        private readonly RodTerms _terms;
        private readonly RodSchedule _schedule;
        private readonly InertiaEnergy _inertia;
        private readonly StageSolver _solver;
        private readonly RungeKuttaScheme? _scheme;  // null: BDF2
        private readonly Vector3d[] _startPositions;
        private readonly Vector3d[] _velocityHistory;
        private readonly Vector3d[][] _velocity;      // by stage: x'
        private readonly Vector3d[][] _acceleration;  // v'
        private readonly Vector3d[][] _turnRate;      // phi'
        private readonly Vector3d[][] _spinRate;      // w', two or more
        private readonly Bdf2History _history;
        private readonly RodShape _before;            // the last stage's
        private readonly Quaterniond[] _predicted;
        private readonly int _last;                   // index of the stage that ends a step
        private readonly double _mass;
        private Vector3d _oldMomentum;
        private bool _hasStepped;
        private double _proximalTurn;
        private double _distalTurn;

        /// <summary>A rod at rest in this shape.</summary>
        /// <param name="terms">The rod's energies and loads.</param>
        /// <param name="shape">Where it starts; the rod moves it from then on.</param>
        /// <param name="scheme">A Runge-Kutta scheme, or null for BDF2.</param>
        /// <param name="tolerance">On each stage's error: radians, or displacement over L; and on what a step may leave
        /// of the balance of forces, over the largest force in the rod.</param>
        /// <param name="mostIterations">Newton iterations of a stage.</param>
        public RodDynamics(RodTerms terms, RodSchedule schedule, RodShape shape, RungeKuttaScheme? scheme,
            double tolerance, int mostIterations)
        {
            int n = shape.ElementCount;
            _supports = terms.Supports;
            _terms = terms;
            _schedule = schedule;
            _scheme = scheme;
            Shape = shape;
            Velocities = new Vector3d[n + 1];
            Spins = new Vector3d[n];
            _inertia = new InertiaEnergy(terms.Mass);
            _solver = new StageSolver(terms, _inertia)
            {
                Tolerance = tolerance,
                Balance = tolerance / (2.0 * (scheme == null ? 1.0 : scheme.WeightSum)),
                MostIterations = mostIterations,
            };
            _before = new RodShape(n);
            _predicted = new Quaterniond[n];
            _mass = terms.Mass.Total;
            _startPositions = new Vector3d[n + 1];
            _velocityHistory = new Vector3d[n + 1];
            int stages = scheme == null ? 1 : scheme.StageCount;
            _last = stages - 1;
            _velocity = Arrays(stages, n + 1);
            _acceleration = Arrays(stages, n + 1);
            _turnRate = Arrays(stages, n);
            _spinRate = Arrays(Math.Max(stages, 2), n);
            _history = new Bdf2History(scheme == null ? n : 0);
        }

        /// <summary>Takes over the velocities of the start.</summary>
        /// <param name="isTurned">Whether the clamps' frames have already made their turn of time 0.</param>
        public void Begin(Vector3d[] velocities, Vector3d[] spins, bool isTurned)
        {
            Array.Copy(velocities, Velocities, Velocities.Length);
            Array.Copy(spins, Spins, Spins.Length);
            _distalTurn = isTurned ? _schedule.DistalTurnAt(0.0) : 0.0;
        }

        /// <summary>The rod's energies and loads.</summary>
        public RodTerms Terms => _terms;

        /// <summary>Positions and orientations.</summary>
        public RodShape Shape { get; }

        /// <summary>v of the nodes, m/s.</summary>
        public Vector3d[] Velocities { get; }

        /// <summary>w of the elements along their own axes, rad/s.</summary>
        public Vector3d[] Spins { get; }

        /// <summary>s.</summary>
        public double Time { get; private set; }

        /// <summary>Turn that the proximal frame has made, radians.</summary>
        public double ProximalTurn => _proximalTurn;

        /// <summary>Turn that the distal frame has made, radians.</summary>
        public double DistalTurn => _distalTurn;

        /// <summary>Counts of what was solved.</summary>
        public StageSolver Solver => _solver;

        /// <summary>Whether <see cref="MomentumRate"/> and the forces beside it are kept; they cost a gradient a
        /// stage.</summary>
        public bool TracksReactions { get; set; }

        /// <summary>Change of the momentum in the last step, N, as the scheme writes it: (P_new - P)/dt with stages,
        /// (3 P_new - 4 P + P_old)/(2 dt) for BDF2 after its first step. With the same scheme's weights it equals the
        /// forces: <see cref="MeanReaction"/> + <see cref="MeanDistalReaction"/> + <see cref="MeanLoad"/>.</summary>
        public Vector3d MomentumRate { get; private set; }

        /// <summary>Force that the supports exert on node 0, N, the mean over the last step by the scheme's weights
        /// (BDF2: at the step's end): the first element's stress, less the node's own share of weight and
        /// inertia.</summary>
        public Vector3d MeanReaction { get; private set; }

        /// <summary>Force that the supports exert on the last node, N, the mean over the last step.</summary>
        public Vector3d MeanDistalReaction { get; private set; }

        /// <summary>Sum of the dead loads, N, the mean over the last step.</summary>
        public Vector3d MeanLoad { get; private set; }

        /// <summary>Linear momentum, kg m/s.</summary>
        public Vector3d Momentum => _terms.Mass.Momentum(Velocities);

        /// <summary>Elastic plus kinetic energy less the work of the loads, J.</summary>
        public double Energy => _terms.Mass.KineticEnergy(Velocities, Spins) + _terms.Potential(Shape);

        /// <summary>Force of the supports on a node as the rod is now, N.</summary>
        public Vector3d ReactionAt(int node)
        {
            _terms.SetTime(_schedule, Time);
            RodVector g = _hasStepped ? _solver.Reactions(Shape)[node] : _solver.StaticReactions(Shape)[node];
            return new Vector3d(g.X1, g.X2, g.X3);
        }

        /// <summary>One step.</summary>
        /// <param name="dt">s.</param>
        /// <returns>Null, or why a stage has no solution; the shape is then not to be used.</returns>
        public string? Step(double dt)
        {
            Array.Copy(Shape.X, _startPositions, _startPositions.Length);
            _inertia.BeginStep(Shape, dt);
            foreach (EnergyTerm term in _terms.All)
            {
                term.BeginStep(Shape, dt);
            }
            MeanReaction = Vector3d.Zero;
            MeanDistalReaction = Vector3d.Zero;
            MeanLoad = Vector3d.Zero;
            Vector3d momentum = TracksReactions ? Momentum : Vector3d.Zero;
            bool isTwoStep = _scheme == null && _history.IsComplete;
            string? failure = _scheme == null ? StepByBdf2(dt) : StepByRungeKutta(_scheme, dt);
            Time += dt;
            _hasStepped = true;
            if (TracksReactions)
            {
                Vector3d change = Momentum - momentum;
                MomentumRate = (isTwoStep ? 1.5 * change - 0.5 * (momentum - _oldMomentum) : change) / dt;
                _oldMomentum = momentum;
            }
            return failure;
        }

        /// <summary>Writes or takes over where the rod is and how it moves: what a motion by any scheme goes on
        /// from.</summary>
        public void Exchange(Snapshot snapshot)
        {
            double time = Time;
            MaterialSnapshot.Exchange(snapshot, _schedule, Shape, Velocities, Spins, ref time);
            Time = time;
            snapshot.Exchange(ref _proximalTurn);
            snapshot.Exchange(ref _distalTurn);
        }

        /// <summary>Writes or takes over what went before, as far as it means something to a motion by this scheme
        /// and steps of dt (s).</summary>
        public void ExchangeHistory(Snapshot snapshot, double dt)
        {
            _terms.Exchange(snapshot);
            _solver.ExchangeCounts(snapshot);
            string scheme = _scheme == null ? "BDF2" : _scheme.StageCount + " stages " + Text(_scheme.Diagonal);
            snapshot.Section(scheme + " " + Text(dt), ExchangeStages);
        }

        private void ExchangeStages(Snapshot snapshot)
        {
            snapshot.Exchange(ref _hasStepped);
            snapshot.Exchange(ref _oldMomentum);
            snapshot.Exchange(_acceleration);
            snapshot.Exchange(_spinRate);
            _history.Exchange(snapshot);
            _inertia.Exchange(snapshot);
            _solver.ExchangeTrust(snapshot);
        }

        private static string Text(double value)
        {
            return value.ToString("R", CultureInfo.InvariantCulture);
        }

        private string? StepByRungeKutta(RungeKuttaScheme scheme, double dt)
        {
            double h = scheme.Diagonal * dt;
            _inertia.StageLength = h;
            double[] final = scheme.Rows[_last];
            for (int s = 0; s <= _last; s++)
            {
                double[] row = scheme.Rows[s];
                for (int i = 0; i < _startPositions.Length; i++)
                {
                    Vector3d x = _startPositions[i];
                    Vector3d v = Velocities[i];
                    for (int k = 0; k < s; k++)
                    {
                        double weight = dt * row[k];
                        x += weight * _velocity[k][i];
                        v += weight * _acceleration[k][i];
                    }
                    _velocityHistory[i] = v;
                    _inertia.FreePositions[i] = x + h * v;
                }
                for (int j = 0; j < Spins.Length; j++)
                {
                    Vector3d turn = Vector3d.Zero;
                    Vector3d spin = Spins[j];
                    for (int k = 0; k < s; k++)
                    {
                        double weight = dt * row[k];
                        turn += weight * _turnRate[k][j];
                        spin += weight * _spinRate[k][j];
                    }
                    _inertia.TurnHistory[j] = turn;
                    _inertia.SpinHistory[j] = spin;
                }
                string? failure = SolveStage(Time + scheme.Times[s] * dt, h, s, scheme.Predictors[s], final[s]);
                if (failure != null)
                {
                    return failure;
                }
            }
            Accept(h);
            return null;
        }

        private string? StepByBdf2(double dt)
        {
            double h = _history.Prepare(_inertia, _startPositions, Velocities, Spins, _velocityHistory, dt);
            string? failure = SolveStage(Time + dt, h, 0, StagePredictor.OneStage, 1.0);
            if (failure == null)
            {
                Accept(h);
                _history.Complete();
            }
            return failure;
        }

        /// <summary>Places the supports, predicts from stages before, solves, and takes the stage's
        /// derivatives.</summary>
        private string? SolveStage(double time, double h, int stage, in StagePredictor predictor, double weight)
        {
            _terms.SetTime(_schedule, time);
            string? failure = TurnFrames(time, out bool inParts);
            if (failure != null)
            {
                return failure;
            }
            // A prediction knows nothing of turns just wound up, and one of more than a radian leads to another
            // winding.
            Vector3d start = PredictStart(time, h, predictor);
            if (Predict(h, predictor) > LargestPredictedTurn || inParts)
            {
                Array.Copy(Shape.Q, _predicted, _predicted.Length);
            }
            Vector3d end = _schedule.DistalPositionAt(time);
            _before.CopyFrom(Shape);
            RodStep.PlaceElements(_supports, Shape, _predicted, start, end);
            double loads = _schedule.LoadAt(time, _mass);
            if (!_solver.Iterate(Shape, h, loads))
            {
                failure = Search(h, loads, start, end);
                if (failure != null)
                {
                    return failure;
                }
            }
            if (_last == 0)
            {
                Array.Copy(_spinRate[0], _spinRate[1], Spins.Length);
            }
            double perStage = 1.0 / h;
            for (int i = 0; i < _startPositions.Length; i++)
            {
                Vector3d a = (perStage * perStage) * (Shape.X[i] - _inertia.FreePositions[i]);
                _acceleration[stage][i] = a;
                _velocity[stage][i] = _velocityHistory[i] + h * a;
            }
            _inertia.SetRates(Shape, _turnRate[stage], _spinRate[stage]);
            if (_last == 0 && !_hasStepped)
            {
                // The first step stands for the one before it too.
                Array.Copy(_spinRate[0], _spinRate[1], Spins.Length);
            }
            if (TracksReactions)
            {
                Track(weight);
            }
            return null;
        }

        /// <summary>The slower search from the stage before, with what the iteration can still add to it.</summary>
        private string? Search(double h, double loads, in Vector3d start, in Vector3d end)
        {
            Shape.CopyFrom(_before);
            RodStep.PlaceElements(_supports, Shape, Shape.Q, start, end);
            string? failure = _solver.Search(Shape);
            if (failure == null)
            {
                _before.CopyFrom(Shape);
                if (!_solver.Iterate(Shape, h, loads))
                {
                    Shape.CopyFrom(_before);
                }
            }
            return failure;
        }

        /// <summary>Orientations by the accelerations of stages before; strains are not predicted but kept, because
        /// EA makes a force of every error that the turns leave in a chord. Returns the largest turn.</summary>
        private double Predict(double h, in StagePredictor predictor)
        {
            double largest = 0.0;
            Vector3d[] first = _spinRate[predictor.First];
            Vector3d[] second = _spinRate[predictor.Second];
            double share = _hasStepped ? predictor.Share : 0.0;
            for (int j = 0; j < _predicted.Length; j++)
            {
                Vector3d rate = first[j] + share * (second[j] - first[j]);
                Vector3d turn = _inertia.TurnHistory[j] + h * (_inertia.SpinHistory[j] + h * rate);
                _predicted[j] = _inertia.Start[j] * RotationVector.Exp(turn);
                largest = Math.Max(largest, _inertia.SquaredChange(turn, j));
            }
            return Math.Sqrt(largest);
        }

        private Vector3d PredictStart(double time, double h, in StagePredictor predictor)
        {
            return _supports.Proximal == ProximalEnd.Free
                ? _inertia.FreePositions[0] + (h * h) * _acceleration[predictor.First][0]
                : _schedule.ProximalPositionAt(time);
        }

        /// <summary>Turns the clamps' frames; a large turn in parts, each solved on its own, so that the rod winds up
        /// as it would under a fast turn and not by the shorter way.</summary>
        private string? TurnFrames(double time, out bool inParts)
        {
            inParts = false;
            double proximal = _schedule.ProximalTurnAt(time) - _proximalTurn;
            double distal = _schedule.DistalTurnAt(time) - _distalTurn;
            if (proximal == 0.0 && distal == 0.0)
            {
                return null;
            }
            int parts = 1 + (int)(Math.Max(Math.Abs(proximal), Math.Abs(distal)) / LargestFrameTurn);
            inParts = parts > 1;
            for (int k = 1; k <= parts; k++)
            {
                double share = (double)k / parts;
                _schedule.TurnFrames(Shape, _proximalTurn + share * proximal, _distalTurn + share * distal);
                if (k < parts)
                {
                    string? failure = _solver.Search(Shape);
                    if (failure != null)
                    {
                        return failure;
                    }
                }
            }
            _proximalTurn += proximal;
            _distalTurn += distal;
            return null;
        }

        private void Accept(double h)
        {
            Array.Copy(_velocity[_last], Velocities, Velocities.Length);
            for (int j = 0; j < Spins.Length; j++)
            {
                Spins[j] = _inertia.SpinHistory[j] + h * _spinRate[_last][j];
            }
        }

        private void Track(double weight)
        {
            RodVector[] gradient = _solver.Reactions(Shape);
            int last = _startPositions.Length - 1;
            MeanReaction += weight * new Vector3d(gradient[0].X1, gradient[0].X2, gradient[0].X3);
            MeanDistalReaction += weight * new Vector3d(gradient[last].X1, gradient[last].X2, gradient[last].X3);
            foreach (Vector3d force in _terms.Loads.Force)
            {
                MeanLoad += weight * force;
            }
        }

        private static Vector3d[][] Arrays(int count, int length)
        {
            var arrays = new Vector3d[count][];
            for (int s = 0; s < count; s++)
            {
                arrays[s] = new Vector3d[length];
            }
            return arrays;
        }
    }
}
