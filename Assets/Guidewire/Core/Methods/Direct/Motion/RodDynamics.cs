using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>The motion of a material rod by implicit schemes: each stage's positions and orientations minimise
    /// inertia plus energies, by Newton's method in O(n).</summary>
    /// <remarks>Positions and velocities obey x' = v, M v' = f; orientations are q = q_start exp(phi) within a step,
    /// with phi' = J(phi)^-1 w and I w' = couple - w x I w along the element's axes. A Runge-Kutta scheme acts on x,
    /// v, phi and w alike, so its order holds for large turns too. BDF2 begins with a step of implicit Euler.
    ///
    /// An explicit first stage has the rates of the last one before; at the start and after a jump of a load or of a
    /// support those of <see cref="ConsistentStart"/>. Where these are more than a step can resolve (a support that was
    /// displaced at once, a wire far from its rest shape) the motion begins with a step of
    /// <see cref="RungeKuttaScheme.Start"/>, which brings what is stiff to rest; so does a step of which a stage has no
    /// solution. Steps of Runge-Kutta schemes end at jumps that are known in time, and at each row of a load's
    /// table.</remarks>
    internal sealed class RodDynamics
    {
        private const double LargestStart = 0.5;  // radians, or L, by which rates at the start may move the rod
        private const double SameTime = 1e-9;     // of a step
        private const double SamePosition = 1e-9;    // radians, or of L

        private readonly RodTerms _terms;
        private readonly RodSchedule _schedule;
        private readonly RodStage _stage;
        private readonly InertiaEnergy _inertia;
        private readonly RodDamping? _damping;
        private readonly ClampFrames _frames;
        private readonly RungeKuttaScheme? _scheme;  // null: BDF2
        private readonly RungeKuttaScheme _starter = RungeKuttaScheme.Start();
        private readonly bool _startsExplicitly;
        private readonly ConsistentStart _start;
        private readonly StageRates _rates;
        private readonly Bdf2History _history;
        private readonly StepStart _innerStart;   // of the step of the scheme within a logged one
        private readonly Vector3d[] _startPositions;
        private readonly int _last;                   // index of the stage that ends a step
        private readonly double _length;
        private Vector3d _oldMomentum;
        private double _lastStep;             // s
        private bool _hasStepped;
        private bool _hasRates;               // the last stage has the rates of the next step's start
        private bool _hasPast;                // stages of the step before are known, to predict from
        private Vector3d _proximalVelocity;   // of the supports in the last step, m/s
        private Vector3d _distalVelocity;
        private StageForces _meanForces;

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
            _terms = terms;
            _schedule = schedule;
            _scheme = scheme;
            _startsExplicitly = scheme != null && scheme.IsFirstExplicit;
            Shape = shape;
            Velocities = new Vector3d[n + 1];
            Spins = new Vector3d[n];
            _stage = new RodStage(terms, schedule, shape, scheme, tolerance, mostIterations);
            _inertia = _stage.Inertia;
            _damping = _stage.Damping;
            _frames = _stage.Frames;
            _rates = _stage.Rates;
            _length = terms.Rod.TotalLength;
            _startPositions = new Vector3d[n + 1];
            _last = scheme == null ? 0 : scheme.StageCount - 1;
            _start = new ConsistentStart(terms, _damping);
            _innerStart = new StepStart(SerializeMotion);
            _history = new Bdf2History(scheme == null ? n : 0);
            Control = new StepControl(scheme == null ? 1 : scheme.EmbeddedOrder);
        }

        /// <summary>Takes over the velocities of the start.</summary>
        /// <param name="isTurned">Whether the clamps' frames have already made their turn of time 0.</param>
        public void Begin(Vector3d[] velocities, Vector3d[] spins, bool isTurned)
        {
            Array.Copy(velocities, Velocities, Velocities.Length);
            Array.Copy(spins, Spins, Spins.Length);
            TakeSupportVelocities();
            if (isTurned)
            {
                _frames.Begin();
            }
        }

        /// <summary>Goes on from this time, s, at which the proximal frame has made a turn, radians.</summary>
        public void GoOn(double time, double proximalTurn)
        {
            Time = time;
            _frames.Made = (proximalTurn, _frames.Made.Distal);
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
        public double ProximalTurn => _frames.Made.Proximal;

        /// <summary>Turn that the distal frame has made, radians.</summary>
        public double DistalTurn => _frames.Made.Distal;

        /// <summary>Counts of what was solved.</summary>
        public StageSolver Solver => _stage.Solver;

        /// <summary>Solves where there are walls, and counts; null where there are none.</summary>
        public BarrierNewton? WallSolver => _stage.WallSolver;

        /// <summary>How steps are cut, and what their errors were.</summary>
        public StepControl Control { get; }

        /// <summary>Whether the scheme tells its steps' errors.</summary>
        public bool HasErrorEstimate => _scheme?.ErrorWeights != null;

        /// <summary>Whether <see cref="MomentumRate"/> and the forces beside it are kept; they cost a gradient a
        /// stage.</summary>
        public bool TracksReactions
        {
            get => _stage.TracksForces;
            set => _stage.TracksForces = value;
        }

        /// <summary>Change of the momentum in the last step, N, as the scheme writes it: (P_new - P)/dt with stages,
        /// (3 P_new - 4 P + P_old)/(2 dt) for BDF2 after its first step. With the same scheme's weights it equals the
        /// forces: <see cref="MeanReaction"/> + <see cref="MeanDistalReaction"/> + <see cref="MeanLoad"/>, and what
        /// mass-proportional damping takes.</summary>
        public Vector3d MomentumRate { get; private set; }

        /// <summary>Force that the supports exert on node 0, N, the mean over the last step by the scheme's weights
        /// (BDF2: at the step's end): the first element's stress, less the node's own fraction of weight and
        /// inertia.</summary>
        public Vector3d MeanReaction => _meanForces.Proximal;

        /// <summary>The forces from outside, the means over the last step by the scheme's weights.</summary>
        public StageForces MeanForces => _meanForces;

        /// <summary>The same at its end.</summary>
        public StageForces EndForces => _stage.Forces;

        /// <summary>Force that the supports exert on the last node, N, the mean over the last step.</summary>
        public Vector3d MeanDistalReaction => _meanForces.Distal;

        /// <summary>Sum of the dead loads, N, the mean over the last step.</summary>
        public Vector3d MeanLoad => _meanForces.Load;

        /// <summary>Linear momentum, kg m/s.</summary>
        public Vector3d Momentum => _terms.Mass.Momentum(Velocities);

        /// <summary>Elastic plus kinetic energy less the work of the loads, J.</summary>
        public double Energy => _terms.Mass.KineticEnergy(Velocities, Spins) + _terms.Potential(Shape);

        /// <summary>Force of the supports on a node as the rod is now, N.</summary>
        public Vector3d ReactionAt(int node)
        {
            _terms.SetTime(_schedule, Time);
            RodVector g = _hasStepped ? Solver.Reactions(Shape)[node] : Solver.StaticReactions(Shape)[node];
            Vector3d held = node == 0 && _terms.Walls() != null ? _terms.Walls()!.SupportForce(Shape) : Vector3d.Zero;
            return held + new Vector3d(g.X1, g.X2, g.X3);
        }

        /// <summary>Couple of the proximal clamp on the rod as it is now, N m, along the world's axes; with that of the
        /// damping by the rates of the last stage.</summary>
        public Vector3d ProximalCouple => _terms.Bending.ProximalCouple(Shape)
            + (_damping == null ? Vector3d.Zero : _damping.ProximalCouple(Shape));

        /// <summary>Torque of the hub on the wire about its axis, N m; that on a wire in a sheath is the slope of the
        /// energy in the hub's turn.</summary>
        public double HubTorque => _stage.HubTorque();

        /// <summary>The same of the distal clamp.</summary>
        public Vector3d DistalCouple => _terms.Bending.DistalCouple(Shape)
            + (_damping == null ? Vector3d.Zero : _damping.DistalCouple(Shape));

        /// <summary>One step.</summary>
        /// <param name="dt">s.</param>
        /// <returns>Null, or why a stage has no solution; the shape is then not to be used.</returns>
        public string? Step(double dt)
        {
            _meanForces = default;
            if (dt != _lastStep)
            {
                _history.Forget();
                _lastStep = dt;
            }
            Vector3d momentum = TracksReactions ? Momentum : Vector3d.Zero;
            bool isTwoStep = _scheme == null && _history.IsComplete;
            string? failure = _scheme == null ? StepByBdf2(dt) : StepBetweenJumps(_scheme, dt);
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
        public void Serialize(Snapshot snapshot)
        {
            double time = Time;
            MaterialSnapshot.Serialize(snapshot, _schedule, Shape, Velocities, Spins, ref time);
            Time = time;
            _frames.Serialize(snapshot);
            if (!snapshot.IsWritten)
            {
                TakeSupportVelocities();
            }
        }

        /// <summary>Writes or takes over what went before, as far as it means something to a motion by this scheme
        /// and steps of dt (s).</summary>
        public void SerializeHistory(Snapshot snapshot, double dt)
        {
            _terms.Serialize(snapshot);
            SerializeCounts(snapshot);
            string scheme = _scheme == null ? "BDF2" : _scheme.StageCount + " stages " + Text(_scheme.Diagonal);
            if (snapshot.Section(scheme + " " + Text(dt), SerializeStages))
            {
                _lastStep = dt;
            }
        }

        /// <summary>Writes or takes over all that <see cref="Step"/> may touch, for a <see cref="StepStart"/>.
        /// </summary>
        public void SerializeStep(Snapshot snapshot)
        {
            Time = snapshot.Serialize(Time);
            MomentumRate = snapshot.Serialize(MomentumRate);
            snapshot.Serialize(ref _lastStep);
            Control.SerializeCounts(snapshot);
            Control.SerializeLength(snapshot);
            SerializeMotion(snapshot);
        }

        /// <summary>Writes or takes over what was counted.</summary>
        public void SerializeCounts(Snapshot snapshot)
        {
            Solver.SerializeCounts(snapshot);
            WallSolver?.Serialize(snapshot);
            Control.SerializeCounts(snapshot);
        }

        // What a step of the scheme may touch; how long the next one is follows from how this one went.
        private void SerializeMotion(Snapshot snapshot)
        {
            Shape.Serialize(snapshot);
            snapshot.Serialize(Velocities);
            snapshot.Serialize(Spins);
            _frames.Serialize(snapshot);
            foreach (EnergyTerm term in _terms.All)
            {
                term.Serialize(snapshot);
            }
            _terms.Walls()?.Friction?.Anchors.Serialize(snapshot);
            SerializePast(snapshot);
            _damping?.Serialize(snapshot);
            _meanForces.Serialize(snapshot);
            snapshot.Serialize(ref _hasRates);
            _stage.SerializeStep(snapshot);
        }

        private void SerializePast(Snapshot snapshot)
        {
            snapshot.Serialize(ref _hasStepped);
            snapshot.Serialize(ref _oldMomentum);
            _rates.Serialize(snapshot);
            _history.Serialize(snapshot);
            _inertia.Serialize(snapshot);
            Solver.SerializeTrust(snapshot);
            snapshot.Serialize(ref _hasPast);
            snapshot.Serialize(ref _proximalVelocity);
            snapshot.Serialize(ref _distalVelocity);
            StageForces forces = _stage.Forces;
            forces.Serialize(snapshot);
            _stage.Forces = forces;
        }

        private void SerializeStages(Snapshot snapshot)
        {
            SerializePast(snapshot);
            snapshot.OptionalSection("damping", _damping == null ? null : _damping.Serialize);
            Control.SerializeLength(snapshot);
            // Rates are those of this rod under these loads; a reader on which other forces act begins anew.
            _terms.SetTime(_schedule, Time);
            double own = _start.CheckSum(Shape);
            double sum = own;
            snapshot.Serialize(ref sum);
            snapshot.Serialize(ref _hasRates);
            _hasRates &= sum == own;
        }

        private static string Text(double value)
        {
            return value.ToString("R", CultureInfo.InvariantCulture);
        }

        private string? StepBetweenJumps(RungeKuttaScheme scheme, double dt)
        {
            double nearly = SameTime * dt;
            double done = 0.0;
            while (done < dt)
            {
                double jump = _schedule.NextBreak(Time + done + nearly);
                double until = jump - Time < dt - nearly ? jump - Time : dt;
                while (done < until)
                {
                    string? failure = StepTowards(scheme, until, jump, dt, ref done);
                    if (failure != null)
                    {
                        return failure;
                    }
                }
            }
            return null;
        }

        /// <summary>One step of the scheme within a logged one.</summary>
        /// <param name="until">Where it may end at the latest, s after the logged step's start.</param>
        /// <param name="jump">The next jump of a load, s.</param>
        /// <param name="dt">The logged step, s.</param>
        /// <param name="done">Where it begins, and then where it ended.</param>
        private string? StepTowards(RungeKuttaScheme scheme, double until, double jump, double dt, ref double done)
        {
            double time = Time + done;
            double left = until - done;
            double h = Control.Propose(left);
            bool isStart = _startsExplicitly && !TakeFirstRates(time, h, dt);
            RungeKuttaScheme used = isStart ? _starter : scheme;
            if (_startsExplicitly)
            {
                _innerStart.Save();
            }
            while (true)
            {
                string? failure = StepByRungeKutta(used, time, h, jump, h / dt);
                double error = failure != null || used.ErrorWeights == null ? 0.0
                    : _rates.Error(used.ErrorWeights, h, _length);
                bool isKept = Control.Accepts(error, h, dt, failure == null);
                bool startsAnew = isKept && failure != null && _startsExplicitly && !isStart;
                if (isKept && !startsAnew)
                {
                    done = h == left ? until : done + h;
                    _hasRates = true;
                    _hasPast = !isStart;
                    if (failure == null)
                    {
                        EndStep();
                    }
                    return failure;
                }
                _innerStart.Restore();
                if (startsAnew)
                {
                    isStart = true;
                    used = _starter;
                    _hasPast = false;
                    _rates.Clear();
                }
                else
                {
                    h = Control.Propose(left);
                }
            }
        }

        /// <summary>Sets the rates of an explicit first stage.</summary>
        /// <returns>False where they are more than a step of length h can resolve.</returns>
        private bool TakeFirstRates(double time, double h, double dt)
        {
            double after = time + SameTime * dt;
            Vector3d proximal = _schedule.Hub.Velocity;
            Vector3d distal = _schedule.Distal.VelocityAt(after);
            bool isInPlace = _start.IsHeldAt(Shape, _schedule, time, SamePosition * _length)
                && _frames.AreInPlace(time, SamePosition);
            bool jumps = proximal != _proximalVelocity || distal != _distalVelocity;
            if (_hasRates && isInPlace && !jumps && _schedule.NextJump(time - SameTime * dt) > after)
            {
                _rates.SetFirst(Velocities, Spins, true);
                return true;
            }
            if (jumps || !_hasRates)
            {
                _start.Jump(Velocities, proximal, distal);
                _meanForces.Add(1.0 / dt, _start.Forces);
            }
            _proximalVelocity = proximal;
            _distalVelocity = distal;
            _hasPast = false;
            _terms.SetTime(_schedule, after);
            if (_damping != null)
            {
                BeginDamping(_damping, after);
                _damping.TakeMoment(h);
            }
            double move = _start.SetRates(Shape, Spins, _rates.Acceleration[0], _rates.SpinRate[0]);
            if (!isInPlace || !(h * h * move <= LargestStart))
            {
                _rates.Clear();
                return false;
            }
            _rates.SetFirst(Velocities, Spins, false);
            _stage.Forces = _stage.WithWalls(_start.Forces);
            return true;
        }

        private string? StepByRungeKutta(RungeKuttaScheme scheme, double time, double dt, double jump, double fraction)
        {
            BeginStep(time, dt);
            _inertia.StageLength = scheme.Diagonal * dt;
            double[] final = scheme.Rows[scheme.StageCount - 1];
            int first = scheme.IsFirstExplicit ? 1 : 0;
            if (first > 0 && TracksReactions)
            {
                _meanForces.Add(fraction * final[0], _stage.Forces);
            }
            for (int s = first; s < scheme.StageCount; s++)
            {
                _rates.Prepare(_inertia, scheme.Rows[s], dt, _startPositions, Velocities, Spins,
                    _stage.VelocityHistory);
                _damping?.BeginStage(scheme.Rows[s], dt);
                StagePredictor predictor = _hasPast ? scheme.Predictors[s] : StagePredictor.Of(Math.Max(s - 1, 0));
                int stage = s == scheme.StageCount - 1 ? _last : s;
                string? failure = _stage.Solve(time + scheme.Times[s] * dt, jump, stage, _hasPast, predictor);
                if (failure != null)
                {
                    return failure;
                }
                TakeForces(fraction * final[s]);
            }
            _rates.Accept(_inertia, Velocities, Spins);
            return null;
        }

        private string? StepByBdf2(double dt)
        {
            BeginStep(Time, dt);
            double h = _history.Prepare(_inertia, _startPositions, Velocities, Spins, _stage.VelocityHistory, dt);
            _damping?.BeginStage(_history.IsComplete, h);
            string? failure = _stage.Solve(Time + dt, double.PositiveInfinity, 0, _hasPast,
                _hasPast ? StagePredictor.OneStage : StagePredictor.Of(0));
            if (failure == null)
            {
                TakeForces(1.0);
                _rates.Accept(_inertia, Velocities, Spins);
                _history.Complete();
                _hasPast = true;
                Control.Accepts(0.0, dt, dt, true);
                EndStep();
            }
            return failure;
        }

        private void BeginStep(double time, double dt)
        {
            Array.Copy(Shape.X, _startPositions, _startPositions.Length);
            _inertia.BeginStep(Shape, dt);
            if (_damping != null)
            {
                BeginDamping(_damping, time + SameTime * dt);
            }
            foreach (EnergyTerm term in _terms.All)
            {
                term.BeginStep(Shape, dt);
            }
        }

        private void EndStep()
        {
            foreach (EnergyTerm term in _terms.All)
            {
                term.EndStep(Shape);
            }
        }

        private void BeginDamping(RodDamping damping, double time)
        {
            damping.Begin(Shape, Velocities, Spins, new Vector3d(0.0, 0.0, _schedule.Hub.FrameTwistRate),
                new Vector3d(0.0, 0.0, _schedule.Distal.TwistRateAt(time)));
        }

        private void TakeForces(double weight)
        {
            if (TracksReactions)
            {
                _meanForces.Add(weight, _stage.Forces);
            }
        }

        private void TakeSupportVelocities()
        {
            _proximalVelocity = Velocities[0];
            _distalVelocity = Velocities[Velocities.Length - 1];
        }
    }
}
