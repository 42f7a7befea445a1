using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Intervals by a Runge-Kutta scheme, each of one or more stages. None goes beyond a jump of a load whose
    /// time is known, nor beyond a row of a load's table.</summary>
    /// <remarks>An explicit first stage has the rates of the last one before; at the start and after a jump of a load
    /// or of a support those of <see cref="ConsistentStart"/>. Where these are more than a step can resolve (a support
    /// that was displaced at once, a wire far from its rest shape) the motion begins with a step of <see
    /// cref="RungeKuttaScheme.Start"/>, which brings what is stiff to rest; so does an interval of which a stage has no
    /// solution.</remarks>
    internal sealed class RungeKuttaStepper : ImplicitStepper
    {
        private const double LargestStart = 0.5;   // radians, or L, by which rates at the start may move the rod
        private const double SamePosition = 1e-9;  // radians, or of L

        private readonly RodTerms _terms;
        private readonly RodSchedule _schedule;
        private readonly RodMotion _motion;
        private readonly RungeKuttaScheme _scheme;
        private readonly RungeKuttaScheme _starter = RungeKuttaScheme.Start();
        private readonly ConsistentStart _start;
        private bool _hasRates;               // the last stage has the rates of the next step's start
        private Vector3d _proximalVelocity;   // of the supports in the last step, m/s
        private Vector3d _distalVelocity;

        /// <summary>Makes a stepper of a rod under these terms.</summary>
        public RungeKuttaStepper(RungeKuttaScheme scheme, RodTerms terms, RodSchedule schedule, RodMotion motion)
            : base(new ImplicitStage(terms, schedule, motion, scheme.StageCount, scheme.IsFirstExplicit),
                new StepControl(scheme.EmbeddedOrder))
        {
            _scheme = scheme;
            _terms = terms;
            _schedule = schedule;
            _motion = motion;
            _start = new ConsistentStart(terms, Stage.Damping, Stage.Inner);
        }

        /// <inheritdoc/>
        public override bool HasErrorEstimate => _scheme.ErrorWeights != null;

        /// <inheritdoc/>
        public override double WeightSum => _scheme.WeightSum;

        /// <inheritdoc/>
        public override string Key => _scheme.StageCount + " stages "
            + _scheme.Diagonal.ToString("R", CultureInfo.InvariantCulture);

        /// <inheritdoc/>
        public override void Begin()
        {
            _proximalVelocity = _motion.Velocities[0];
            _distalVelocity = _motion.Velocities[_motion.Shape.ElementCount];
        }

        /// <inheritdoc/>
        public override bool StopsAtJumps => true;

        /// <inheritdoc/>
        public override string? Step(in Interval interval)
        {
            bool isStart = _scheme.IsFirstExplicit && (!InitialiseRates(interval) || interval.IsRestarted);
            if (interval.IsRestarted)
            {
                Stage.Forget();
            }
            MayRestart = _scheme.IsFirstExplicit && !isStart;
            RungeKuttaScheme used = isStart ? _starter : _scheme;
            double time = interval.Start;
            double dt = interval.Length;
            Stage.BeginStep(time, dt);
            double[] final = used.Rows[used.StageCount - 1];
            int first = used.IsFirstExplicit ? 1 : 0;
            if (first > 0)
            {
                Stage.Reactions.AddStage(interval.Fraction * final[0]);
            }
            for (int s = first; s < used.StageCount; s++)
            {
                Stage.BeginStage(used.Rows[s], dt);
                StagePredictor predictor = Stage.HasPast ? used.Predictors[s] : StagePredictor.Of(Math.Max(s - 1, 0));
                // That of a start ends the step as the scheme's own last one does.
                int stage = s == used.StageCount - 1 ? _scheme.StageCount - 1 : s;
                string? failure = Stage.Solve(time + used.Times[s] * dt, interval.Jump, stage, predictor);
                if (failure != null)
                {
                    return failure;
                }
                Stage.Reactions.AddStage(interval.Fraction * final[s]);
            }
            Stage.Accept();
            Error = used.ErrorWeights == null ? 0.0
                : Stage.Rates.Error(used.ErrorWeights, dt, _terms.Rod.TotalLength);
            _hasRates = true;
            Stage.HasPast = !isStart;
            Stage.EndStep();
            return null;
        }

        /// <inheritdoc/>
        public override void Remesh()
        {
            base.Remesh();
            _hasRates = false;
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            base.Serialize(snapshot);
            snapshot.Serialize(ref _proximalVelocity);
            snapshot.Serialize(ref _distalVelocity);
            if (snapshot.IsStep)
            {
                snapshot.Serialize(ref _hasRates);
                return;
            }
            Control.Serialize(snapshot);
            // Rates are those of this rod under these loads; a reader on which other forces act starts again.
            _terms.SetTime(_schedule, Stage.Frames.Time);
            double own = _start.CheckSum(_motion.Shape);
            double sum = own;
            snapshot.Serialize(ref sum);
            snapshot.Serialize(ref _hasRates);
            _hasRates &= sum == own;
        }

        /// <summary>Sets the rates of an explicit first stage.</summary>
        /// <returns>False where they are more than the interval can resolve.</returns>
        private bool InitialiseRates(in Interval interval)
        {
            double time = interval.Start;
            double h = interval.Length;
            double after = time + interval.Nearly;
            StageRates rates = Stage.Rates;
            Vector3d proximal = _schedule.Hub.VelocityAt(after);
            Vector3d distal = _schedule.Distal.VelocityAt(after);
            bool isInPlace = _start.IsHeldAt(_motion.Shape, _schedule, time,
                SamePosition * _terms.Rod.TotalLength)
                && Stage.Frames.AreInPlace(time, SamePosition);
            bool jumps = proximal != _proximalVelocity || distal != _distalVelocity;
            if (_hasRates && isInPlace && !jumps && _schedule.NextJump(time - interval.Nearly) > after)
            {
                rates.SetFirst(_motion.Velocities, _motion.Spins, true);
                Stage.Inner.SetFirst(true);
                return true;
            }
            if (jumps || !_hasRates)
            {
                _start.Jump(_motion.Velocities, proximal, distal);
                Stage.Reactions.AddImpulse(_start.Forces, interval.StepLength);
            }
            _proximalVelocity = proximal;
            _distalVelocity = distal;
            Stage.HasPast = false;
            Stage.BeginRates(after, h);
            double move = _start.SetRates(_motion.Shape, _motion.Spins, rates.Acceleration[0], rates.SpinRate[0]);
            if (!isInPlace || !(h * h * move <= LargestStart))
            {
                rates.Clear();
                Stage.Inner.Clear();
                return false;
            }
            rates.SetFirst(_motion.Velocities, _motion.Spins, false);
            Stage.Inner.SetFirst(false);
            Stage.Reactions.Record(_start.Forces);
            return true;
        }
    }

    /// <summary>The coefficients of a diagonally implicit Runge-Kutta scheme, all L-stable and stiffly accurate: the
    /// last stage is the end of the step, so what is stiff (stretch, shear) is at rest there.</summary>
    /// <remarks>All but the simplest have an explicit first stage, whose rates are those at the step's start: their
    /// other stages are of order 2, and where rotation excites the stiff stretch all the time the step stays at least
    /// that order. With implicit stages alone, which are of order 1, it does not.</remarks>
    internal sealed class RungeKuttaScheme
    {
        private RungeKuttaScheme(double[][] rows, double[]? embedded)
        {
            Rows = rows;
            double[] weights = rows[rows.Length - 1];
            Diagonal = weights[weights.Length - 1];
            Times = new double[rows.Length];
            for (int i = 0; i < rows.Length; i++)
            {
                foreach (double a in rows[i])
                {
                    Times[i] += a;
                }
            }
            Times[rows.Length - 1] = 1.0;  // without the rounding of the sum
            foreach (double b in weights)
            {
                WeightSum += Math.Abs(b);
            }
            if (embedded != null)
            {
                ErrorWeights = new double[embedded.Length];
                for (int i = 0; i < embedded.Length; i++)
                {
                    ErrorWeights[i] = weights[i] - embedded[i];
                }
            }
            Predictors = new StagePredictor[rows.Length];
            for (int i = 0; i < rows.Length; i++)
            {
                Predictors[i] = PredictorOf(i);
            }
        }

        /// <summary>Lower triangle a_ij of the coefficients; row i has i+1 entries.</summary>
        public double[][] Rows { get; }

        /// <summary>c_i, the stages' times in units of the time step.</summary>
        public double[] Times { get; }

        /// <summary>Sum of the magnitudes of the weights b_i: the factor by which stage errors enter a step.</summary>
        public double WeightSum { get; }

        /// <summary>From which stages each is predicted.</summary>
        public StagePredictor[] Predictors { get; }

        /// <summary>gamma, the same on the whole diagonal.</summary>
        public double Diagonal { get; }

        /// <summary>Number of stages, an explicit one counted.</summary>
        public int StageCount => Rows.Length;

        /// <summary>Whether the first stage is the step's start.</summary>
        public bool IsFirstExplicit => Rows[0][0] == 0.0;

        /// <summary>b_i - b^_i, by which the stages' rates give the difference to the embedded solution; null where
        /// there is none.</summary>
        public double[]? ErrorWeights { get; }

        /// <summary>Order of the embedded solution.</summary>
        public int EmbeddedOrder { get; private set; }

        /// <summary>Gives backward Euler, order 1.</summary>
        public static RungeKuttaScheme ImplicitEuler() => new RungeKuttaScheme(new[] { new[] { 1.0 } }, null);

        /// <summary>Two implicit stages, order 2, gamma = 1 - 1/sqrt(2) (Alexander 1977): takes nothing from the rates
        /// at the step's start, so a motion may begin with it far from balance.</summary>
        public static RungeKuttaScheme Start()
        {
            double g = 1.0 - Math.Sqrt(0.5);
            return new RungeKuttaScheme(new[] { new[] { g }, new[] { 1.0 - g, g } }, null);
        }

        /// <summary>Gives TR-BDF2 (Bank et al. 1985; as a Runge-Kutta scheme Hosea and Shampine 1996): order 2,
        /// embedded 3;
        /// d = 1 - 1/sqrt(2), w = sqrt(2)/4.</summary>
        public static RungeKuttaScheme TrBdf2()
        {
            double d = 1.0 - Math.Sqrt(0.5);
            double w = 0.25 * Math.Sqrt(2.0);
            return new RungeKuttaScheme(new[] { new[] { 0.0 }, new[] { d, d }, new[] { w, w, d } },
                new[] { (1.0 - w) / 3.0, (3.0 * w + 1.0) / 3.0, d / 3.0 })
            {
                EmbeddedOrder = 3,
            };
        }

        /// <summary>Gives ESDIRK3(2)4L[2]SA, the implicit part of ARK3(2)4L[2]SA (Kennedy and Carpenter 2003): order 3,
        /// embedded 2.</summary>
        public static RungeKuttaScheme Esdirk3()
        {
            const double g = 1767732205903.0 / 4055673282236.0;
            return new RungeKuttaScheme(new[]
            {
                new[] { 0.0 },
                new[] { g, g },
                new[] { 2746238789719.0 / 10658868560708.0, -640167445237.0 / 6845629431997.0, g },
                new[]
                {
                    1471266399579.0 / 7840856788654.0, -4482444167858.0 / 7529755066697.0,
                    11266239266428.0 / 11593286722821.0, g,
                },
            }, new[]
            {
                2756255671327.0 / 12835298489170.0, -10771552573575.0 / 22201958757719.0,
                9247589265047.0 / 10645013368117.0, 2193209047091.0 / 5459859503100.0,
            })
            {
                EmbeddedOrder = 2,
            };
        }

        /// <summary>Gives ESDIRK4(3)6L[2]SA, the implicit part of ARK4(3)6L[2]SA (Kennedy and Carpenter 2003): order 4,
        /// embedded 3, gamma = 1/4.</summary>
        public static RungeKuttaScheme Esdirk4()
        {
            const double g = 0.25;
            return new RungeKuttaScheme(new[]
            {
                new[] { 0.0 },
                new[] { g, g },
                new[] { 8611.0 / 62500.0, -1743.0 / 31250.0, g },
                new[] { 5012029.0 / 34652500.0, -654441.0 / 2922500.0, 174375.0 / 388108.0, g },
                new[]
                {
                    15267082809.0 / 155376265600.0, -71443401.0 / 120774400.0, 730878875.0 / 902184768.0,
                    2285395.0 / 8070912.0, g,
                },
                new[] { 82889.0 / 524892.0, 0.0, 15625.0 / 83664.0, 69875.0 / 102672.0, -2260.0 / 8211.0, g },
            }, new[]
            {
                4586570599.0 / 29645900160.0, 0.0, 178811875.0 / 945068544.0, 814220225.0 / 1159782912.0,
                -3700637.0 / 11593932.0, 61727.0 / 225920.0,
            })
            {
                EmbeddedOrder = 3,
            };
        }

        /// <summary>The line through two of the known stages, those before this one and, one step earlier, the others,
        /// that is least wrong at this stage's time: of the pairs, the one with the smallest product of the two
        /// distances, which goes with the second derivative, and the weights' magnitudes, which go with
        /// noise.</summary>
        private StagePredictor PredictorOf(int stage)
        {
            double time = Times[stage];
            if (StageCount == 1)
            {
                return StagePredictor.OneStage;
            }
            int before = stage > 0 ? stage - 1 : StageCount - 1;
            var best = new StagePredictor { First = before, Second = before };
            double least = double.PositiveInfinity;
            for (int i = 0; i < StageCount; i++)
            {
                double first = time - Times[i] + (i < stage ? 0.0 : 1.0);
                for (int k = 0; k < StageCount; k++)
                {
                    double second = time - Times[k] + (k < stage ? 0.0 : 1.0);
                    double fraction = first / (first - second);
                    double wrong = Math.Abs(first * second) * (Math.Abs(fraction) + Math.Abs(1.0 - fraction));
                    if (Math.Abs(first) < Math.Abs(second) && wrong < least)
                    {
                        least = wrong;
                        best = new StagePredictor { First = i, Second = k, Fraction = fraction };
                    }
                }
            }
            return best;
        }
    }

    /// <summary>The rates of a rod in the stages of a step, and what a Runge-Kutta scheme makes of them: y_i = y_0 +
    /// dt sum a_ik y'_k for y = x, v, phi and w.</summary>
    /// <remarks>Where a scheme's first stage is explicit, its rates are those at the step's start: x' = v, phi' = w
    /// (phi = 0 there), v' and w' of the last stage before.</remarks>
    internal sealed class StageRates
    {
        private readonly Vector3d[][] _velocity;      // by stage: x'
        private readonly Vector3d[][] _acceleration;  // v'
        private readonly Vector3d[][] _turnRate;      // phi'
        private readonly Vector3d[][] _spinRate;      // w'; two or more, the second the step before of one stage
        private readonly int _last;
        private readonly RodShape _shape;             // of the rod

        /// <summary>Rates of a rod in these stages, all 0.</summary>
        public StageRates(int stageCount, RodShape shape)
        {
            _last = stageCount - 1;
            _shape = shape;
            _velocity = Arrays(stageCount, shape.X.Length);
            _acceleration = Arrays(stageCount, shape.X.Length);
            _turnRate = Arrays(stageCount, shape.Q.Length);
            _spinRate = Arrays(Math.Max(stageCount, 2), shape.Q.Length);
        }

        private int Elements => _shape.ElementCount;

        private int Nodes => _shape.ElementCount + 1;

        /// <summary>v' by stage, m/s^2.</summary>
        public Vector3d[][] Acceleration => _acceleration;

        /// <summary>w' by stage, rad/s^2.</summary>
        public Vector3d[][] SpinRate => _spinRate;

        /// <summary>Forgets all stages.</summary>
        public void Clear()
        {
            Clear(_acceleration);
            Clear(_spinRate);
        }

        private static void Clear(Vector3d[][] rates)
        {
            foreach (Vector3d[] list in rates)
            {
                Array.Clear(list, 0, list.Length);
            }
        }

        /// <summary>Takes the rates at a step's start as those of the first stage.</summary>
        /// <param name="fromLast">Whether v' and w' are those of the last stage; else they are already set.</param>
        public void SetFirst(Vector3d[] velocities, Vector3d[] spins, bool fromLast)
        {
            Array.Copy(velocities, _velocity[0], Nodes);
            Array.Copy(spins, _turnRate[0], Elements);
            if (fromLast)
            {
                Array.Copy(_acceleration[_last], _acceleration[0], Nodes);
                Array.Copy(_spinRate[_last], _spinRate[0], Elements);
            }
        }

        /// <summary>Sets what a stage has from those before it.</summary>
        /// <param name="inertia">Its step has begun and its stage length is set; receives the stage.</param>
        /// <param name="row">a_ik; its length is the stage's index plus 1.</param>
        /// <param name="velocityHistory">Receives v^, m/s.</param>
        public void Prepare(InertiaEnergy inertia, double[] row, double dt, Vector3d[] positions,
            Vector3d[] velocities, Vector3d[] spins, Vector3d[] velocityHistory)
        {
            int before = row.Length - 1;
            double h = inertia.StageLength;
            Vector3d[] free = inertia.FreePositions;
            Array.Copy(positions, free, Nodes);
            Array.Copy(velocities, velocityHistory, Nodes);
            Array.Clear(inertia.TurnHistory, 0, Elements);
            Array.Copy(spins, inertia.SpinHistory, Elements);
            for (int k = 0; k < before; k++)
            {
                double weight = dt * row[k];
                Add(free, weight, _velocity[k], Nodes);
                Add(velocityHistory, weight, _acceleration[k], Nodes);
                Add(inertia.TurnHistory, weight, _turnRate[k], Elements);
                Add(inertia.SpinHistory, weight, _spinRate[k], Elements);
            }
            Add(free, h, velocityHistory, Nodes);
        }

        private static void Add(Vector3d[] sum, double weight, Vector3d[] rate, int count)
        {
            for (int i = 0; i < count; i++)
            {
                sum[i] += weight * rate[i];
            }
        }

        /// <summary>Takes the rates of a stage that is solved.</summary>
        /// <param name="isSecondStep">For a scheme of one stage: whether there is a step before.</param>
        public void Record(int stage, RodShape shape, InertiaEnergy inertia, Vector3d[] velocityHistory,
            bool isSecondStep)
        {
            if (_last == 0)
            {
                Array.Copy(_spinRate[0], _spinRate[1], shape.ElementCount);
            }
            double h = inertia.StageLength;
            double perStage = 1.0 / h;
            for (int i = 0; i < Nodes; i++)
            {
                Vector3d a = (perStage * perStage) * (shape.X[i] - inertia.FreePositions[i]);
                _acceleration[stage][i] = a;
                _velocity[stage][i] = velocityHistory[i] + h * a;
            }
            inertia.SetRates(shape, _turnRate[stage], _spinRate[stage]);
            if (_last == 0 && !isSecondStep)
            {
                // At the first step the rates of the step before it are taken equal to its own.
                Array.Copy(_spinRate[0], _spinRate[1], shape.ElementCount);
            }
        }

        /// <summary>The velocities in the last stage, which ends the step.</summary>
        public void Accept(InertiaEnergy inertia, Vector3d[] velocities, Vector3d[] spins)
        {
            double h = inertia.StageLength;
            Array.Copy(_velocity[_last], velocities, Nodes);
            for (int j = 0; j < Elements; j++)
            {
                spins[j] = inertia.SpinHistory[j] + h * _spinRate[_last][j];
            }
        }

        /// <summary>How far the embedded solution is from the step's: the largest turn in radians or displacement over
        /// L.</summary>
        /// <param name="weights">b_i - b^_i.</param>
        public double Error(double[] weights, double dt, double length)
        {
            double shift = 0.0;
            double turn = 0.0;
            for (int i = 0; i < Nodes; i++)
            {
                Vector3d x = Vector3d.Zero;
                for (int k = 0; k < weights.Length; k++)
                {
                    x += weights[k] * _velocity[k][i];
                }
                shift = Math.Max(shift, x.LengthSquared);
            }
            for (int j = 0; j < Elements; j++)
            {
                Vector3d phi = Vector3d.Zero;
                for (int k = 0; k < weights.Length; k++)
                {
                    phi += weights[k] * _turnRate[k][j];
                }
                turn = Math.Max(turn, phi.LengthSquared);
            }
            return dt * Math.Max(Math.Sqrt(shift) / length, Math.Sqrt(turn));
        }

        /// <summary>Writes or restores what the next step needs.</summary>
        public void Serialize(Snapshot snapshot)
        {
            foreach (Vector3d[] acceleration in _acceleration)
            {
                snapshot.Serialize(acceleration, Nodes);
            }
            foreach (Vector3d[] spinRate in _spinRate)
            {
                snapshot.Serialize(spinRate, Elements);
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
