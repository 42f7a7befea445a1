using System;
using System.Globalization;
using System.Threading;

namespace Guidewire.Core
{
    /// <summary>The motion of a material rod by implicit schemes: each stage's positions and orientations minimise
    /// inertia plus energies, by Newton's method in O(n).</summary>
    /// <remarks>Positions and velocities obey x' = v, M v' = f; orientations are q = q_start exp(phi) within a step,
    /// with phi' = J(phi)^-1 w and I w' = couple - w x I w along the element's axes. A Runge-Kutta scheme (<see
    /// cref="RungeKuttaStepper"/>) acts on x, v, phi and w alike, so its order holds for large turns too. The other
    /// scheme is BDF2 (<see cref="Bdf2Stepper"/>).</remarks>
    internal sealed class RodDynamics
    {
        private readonly RodTerms _terms;
        private readonly RodSchedule _schedule;
        private readonly RodMotion _motion;
        private readonly ImplicitStepper _stepper;
        private readonly ImplicitStage _stage;
        private readonly StepStart _start;   // of an interval
        private double _intervalStart;       // s
        private readonly WorkLimit _work;

        /// <summary>Makes a rod at rest in this shape.</summary>
        /// <param name="terms">The rod's energies and loads.</param>
        /// <param name="shape">Where it starts; the rod moves it from then on.</param>
        /// <param name="scheme">A Runge-Kutta scheme, or null for BDF2.</param>
        /// <param name="tolerance">On each stage's error: radians, or displacement over L; and on what a step may leave
        /// of the balance of forces, over the largest force in the rod.</param>
        /// <param name="maxIterations">Newton iterations of a stage.</param>
        /// <param name="work">Of the run; null: of this motion alone.</param>
        public RodDynamics(RodTerms terms, RodSchedule schedule, RodShape shape, RungeKuttaScheme? scheme,
            double tolerance, int maxIterations, WorkLimit? work = null)
        {
            _terms = terms;
            _schedule = schedule;
            shape.FitVessel(terms.VesselCount);
            _motion = new RodMotion(shape);
            _stepper = scheme == null ? new Bdf2Stepper(terms, schedule, _motion)
                : (ImplicitStepper)new RungeKuttaStepper(scheme, terms, schedule, _motion);
            _stage = _stepper.Stage;
            MaxIterations = maxIterations;
            Newton.Tolerance = tolerance;
            Newton.Balance = tolerance / (2.0 * _stepper.WeightSum);
            _start = new StepStart(_stepper.Serialize, terms.Rod);
            _work = work ?? new WorkLimit(maxIterations);
            Clock = new Clock(_stepper, schedule, _work);
        }

        /// <summary>Takes over the velocities of the start.</summary>
        /// <param name="isTurned">Whether the clamps' frames have already made their turn of time 0.</param>
        public void Begin(Vector3d[] velocities, Vector3d[] spins, bool isTurned)
        {
            _motion.Begin(velocities, spins);
            _stepper.Begin();
            if (isTurned)
            {
                _stage.Frames.Begin();
            }
        }

        /// <summary>The rod has other elements, and moves on from where they are.</summary>
        public void Remesh()
        {
            _stepper.Remesh();
            _stepper.Begin();
        }

        /// <summary>Goes on from this time, s, at which the proximal frame has made a turn, radians.</summary>
        public void ResumeAt(double time, double proximalTurn)
        {
            Time = time;
            _stage.Frames.Made = (proximalTurn, _stage.Frames.Made.Distal);
        }

        /// <summary>The rod's energies and loads.</summary>
        public RodTerms Terms => _terms;

        /// <summary>Positions, orientations and their rates.</summary>
        public RodMotion Motion => _motion;

        /// <summary>Positions and orientations.</summary>
        public RodShape Shape => _motion.Shape;

        /// <summary>v of the nodes, m/s.</summary>
        public Vector3d[] Velocities => _motion.Velocities;

        /// <summary>w of the elements along their own axes, rad/s.</summary>
        public Vector3d[] Spins => _motion.Spins;

        /// <summary>z' of the angles to an instrument inside, rad/s; none where there is one alone.</summary>
        public double[] TwistRates => _motion.TwistRates;

        /// <summary>Power by which moving blood drags the wire along, W: of massDamping, on the blood's own
        /// way.</summary>
        public double DragPower
        {
            get
            {
                double sum = 0.0;
                for (int i = 0; i <= Shape.ElementCount && _stage.Surrounding != null; i++)
                {
                    Vector3d blood = _stage.Surrounding[i];
                    sum += _terms.Mass.Nodal[i] * Vector3d.Dot(blood - Velocities[i], blood);
                }
                return _terms.Rod.MassDamping * sum;
            }
        }

        /// <summary>The time, s.</summary>
        public double Time { get; private set; }

        /// <summary>Turn that the proximal frame has made, radians.</summary>
        public double ProximalTurn => _stage.Frames.Made.Proximal;

        /// <summary>Turn that the distal frame has made, radians.</summary>
        public double DistalTurn => _stage.Frames.Made.Distal;

        /// <summary>Newton iterations of a stage, but for the shortest intervals.</summary>
        public int MaxIterations { get; }

        /// <summary>Solves the stages, and counts.</summary>
        public Newton Newton => _stage.Newton;

        /// <summary>The forces from outside.</summary>
        public RodReactions Reactions => _stage.Reactions;

        /// <summary>Asked before each interval, so that a host need not wait for a long one.</summary>
        public CancellationToken Cancellation { get; set; }

        /// <summary>Divides steps into intervals.</summary>
        public Clock Clock { get; }

        /// <summary>How many iterations the steps may take.</summary>
        public WorkLimit Work => _work;

        /// <summary>How intervals follow from error estimates.</summary>
        public StepControl Control => _stepper.Control;

        /// <summary>Says after an interval what it has lost, in one line, or null: then a shorter one is
        /// tried.</summary>
        public Func<string?>? FindLost { get; set; }

        /// <summary>Called after each interval that is kept, or null.</summary>
        public Action? IntervalDone { get; set; }

        /// <summary>Whether the scheme estimates the errors of its steps.</summary>
        public bool HasErrorEstimate => _stepper.HasErrorEstimate;

        /// <summary>Elastic plus kinetic energy less the work of the loads, J.</summary>
        public double Energy => KineticEnergy + _terms.Potential(Shape);

        /// <summary>The kinetic energy, J.</summary>
        public double KineticEnergy => _terms.Mass.KineticEnergy(Velocities, Spins)
            + (_terms.Supports.Coaxial == null ? 0.0
                : InnerSpin.KineticEnergy(_terms.Supports.Coaxial, Spins, TwistRates));

        /// <summary>Force of the supports on a node as the rod is now, N.</summary>
        public Vector3d ReactionAt(int node) => Reactions.At(node, Time);

        /// <summary>Makes one step.</summary>
        /// <param name="dt">s.</param>
        /// <returns>Null, or why an interval has no solution, however short; the shape is then not to be
        /// used.</returns>
        public string? Step(double dt)
        {
            Reactions.BeginStep();
            Clock.Begin(Time, dt, _terms.Walls() == null ? 1 : BarrierRange.PartsOf(this, _schedule, dt));
            for (Interval interval = Clock.Next(); interval.Length > 0.0; interval = Clock.Next())
            {
                _start.Save();
                _intervalStart = Time;
                while (true)
                {
                    long factor = _terms.Walls() == null ? 1 : Clock.IterationFactor;
                    Newton.MaxIterations = (int)Math.Min(factor * MaxIterations, int.MaxValue);
                    Cancellation.ThrowIfCancellationRequested();
                    long before = Newton.Iterations;
                    string? failure = _stepper.Step(interval);
                    _work.Spend(Newton.Iterations - before);
                    Time = interval.End;
                    _terms.Walls()?.Barrier.SetTime(Time);    // the last stage's time has another rounding
                    failure ??= FindLost?.Invoke();
                    if (Clock.Accepts(interval, failure))
                    {
                        break;
                    }
                    if (Clock.Failure != null)
                    {
                        return Clock.Failure;
                    }
                    GoBack();
                    interval = Clock.Shorter;
                }
                IntervalDone?.Invoke();
            }
            return null;
        }

        /// <summary>Goes back to the start of the interval without a solution.</summary>
        public void GoBack()
        {
            _start.Restore();
            Time = _intervalStart;
        }

        /// <summary>Writes or restores where the rod is and how it moves: what a motion by any scheme goes on from. For
        /// a step it is all that <see cref="Step(double)"/> may touch.</summary>
        public void Serialize(Snapshot snapshot)
        {
            if (snapshot.IsStep)
            {
                Control.Serialize(snapshot);
                Clock.Serialize(snapshot);
                Time = snapshot.Serialize(Time);
                _stepper.Serialize(snapshot);
                return;
            }
            double time = Time;
            MaterialSnapshot.Serialize(snapshot, _schedule, Shape, Velocities, Spins, ref time);
            Time = time;
            snapshot.Serialize(TwistRates, Shape.TwistCount);
            _stage.Frames.Serialize(snapshot);
            if (!snapshot.IsWritten)
            {
                _stage.Frames.Time = time;
                _stepper.Begin();
            }
        }

        /// <summary>Writes or restores what went before, as far as it means something to a motion by this scheme
        /// and steps of dt (s).</summary>
        public void SerializeHistory(Snapshot snapshot, double dt)
        {
            _terms.Serialize(snapshot);
            SerializeCounts(snapshot);
            snapshot.Section(_stepper.Key + ", steps of " + dt.ToString("R", CultureInfo.InvariantCulture),
                _stepper.Serialize);
        }

        /// <summary>Writes or restores what was counted.</summary>
        public void SerializeCounts(Snapshot snapshot)
        {
            Newton.SerializeCounts(snapshot);
            Control.SerializeCounts(snapshot);
        }
    }
}
