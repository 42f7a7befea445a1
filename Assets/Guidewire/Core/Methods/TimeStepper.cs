using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Advances a wire in time by steps of one method, and reports their success. One implementation per
    /// method, chosen when a run is built.</summary>
    internal abstract class TimeStepper
    {
        /// <summary>Distance in units between the last sphere's prediction and where the constraints left it in the
        /// last step (Delta_p, thesis 4.1.1).</summary>
        public double PredictionError { get; protected internal set; }

        /// <summary>Why the method gave up in the last step, in one line, or null.</summary>
        public string? Failure { get; protected set; }

        /// <summary>How the last step lost the wire, in one line, or null. With a material the state is that of the
        /// step before.</summary>
        public string? Divergence { get; protected set; }

        /// <summary>Why the wire is in a steady state after the last step, in one line, or null.</summary>
        public string? SteadyState { get; protected set; }

        /// <summary>How many steps, up to the last, make that state.</summary>
        public int SteadySteps { get; protected set; } = 1;

        /// <summary>Adds what is not accurate in the steps so far: long steps or few iterations may leave a wire wrong
        /// without losing it.</summary>
        public virtual void AddWarnings(List<RunWarning> warnings)
        {
        }

        /// <summary>The forces that act on the wire from outside, and the results of contact; null where nobody asked
        /// for them.</summary>
        public virtual ContactRecord? Contacts => null;

        /// <summary>Strains, forces, couples and energies of the wire as it is; null with pbd.</summary>
        public virtual StressRecord? Stress() => null;

        /// <summary>Energy of motion, that stored in all instruments, and minus the work of the loads that have a
        /// potential, J; null with pbd.</summary>
        public virtual Vector3d? Energies()
        {
            StressRecord? stress = Stress();
            return stress == null ? (Vector3d?)null
                : new Vector3d(stress.KineticEnergy, stress.ElasticEnergy, stress.PotentialEnergy);
        }

        /// <summary>What is read off at the hub and the tip; null where the method does not compute it.</summary>
        public virtual HubRecord? Hub() => null;

        /// <summary>Gives the results of the outermost catheter, and of the one inside it; null without
        /// one.</summary>
        public virtual CoaxialRecord? Coaxial() => null;

        /// <summary>Where the sheath ends, m; null without one.</summary>
        public virtual Vector3d? ExitOfSheath => null;

        /// <summary>Whether the wire's tip is in its sheath, or in a catheter whose own tip is within a wall and whose
        /// axis the wire's does not follow.</summary>
        /// <param name="field">Where the wall is, if it moves.</param>
        public bool IsTipCovered(ContactShape wall, WallField? field) =>
            Hub()?.SpheresInBody == 0 || Coaxial() is CoaxialRecord outer && IsIn(outer, wall, field, out _);

        // Whether the wire's tip is in this catheter or one inside it, and how far beyond this one, m.
        private static bool IsIn(CoaxialRecord catheter, ContactShape wall, WallField? field, out double beyond)
        {
            double beyondInner = 0.0;
            bool isInInner = catheter.Inside != null && IsIn(catheter.Inside, wall, field, out beyondInner);
            beyond = catheter.Extension + beyondInner;
            Vector3d tip = catheter.Positions[catheter.Positions.Length - 1];
            return isInInner || (beyond <= 0.0 && wall.IsWithin(field?.AtRest(tip) ?? tip));
        }

        /// <summary>Where a wall is now, of which the wire's scene has this number; null where it stands
        /// still.</summary>
        public virtual WallField? FieldOf(int wall) => null;

        /// <summary>Advances the state by one step.</summary>
        public abstract void Advance(RodState state);

        /// <summary>The solver's report on its own work after the steps so far; null with pbd.</summary>
        public virtual SolverReport? Report() => null;

        /// <summary>Writes into a snapshot, or restores from one, all that the next step depends on besides the
        /// <see cref="RodState"/>: history, predictors, counters, what is prescribed.</summary>
        public virtual void Serialize(Snapshot snapshot)
        {
        }
    }

    /// <summary>Results of a solver for a material about its own work, at the end of a run. A number that does not
    /// apply is NaN, a
    /// force or couple that the method does not compute null.</summary>
    public sealed class SolverReport
    {
        /// <summary>How the method stands to the loads and the rule of convergence, in one line.</summary>
        public string Method { get; internal set; } = "";

        /// <summary>Factorisations of the whole rod.</summary>
        public long Factorisations { get; internal set; }

        /// <summary>Solutions with a factorisation that was kept.</summary>
        public long KeptSolutions { get; internal set; }

        /// <summary>Stages that needed the slower search for a minimum.</summary>
        public long Searches { get; internal set; }

        /// <summary>Newton iterations of the stages between walls; NaN without walls.</summary>
        public double WallIterations { get; internal set; } = double.NaN;

        /// <summary>Steps, and parts of steps, that had no solution and were halved; NaN but with direct.</summary>
        public double HalvedSteps { get; internal set; } = double.NaN;

        /// <summary>Gap below which barriers act, m; NaN without walls.</summary>
        public double ContactDistance { get; internal set; } = double.NaN;

        /// <summary>Stiffness of a contact, N/m; NaN without walls.</summary>
        public double ContactStiffness { get; internal set; } = double.NaN;

        /// <summary>Newton iterations that the rest shape took.</summary>
        public int EquilibriumIterations { get; internal set; }

        /// <summary>Largest unbalanced force of the rest shape over EI/L^2 + loads.</summary>
        public double EquilibriumResidual { get; internal set; } = double.NaN;

        /// <summary>Smallest eigenvalue of the rest shape's second derivative against l on turns and l/L^2 on shifts,
        /// N.</summary>
        public double SmallestEigenvalue { get; internal set; } = double.NaN;

        /// <summary>Largest error that a step left, by the solver's own measure.</summary>
        public double LargestError { get; internal set; } = double.NaN;

        /// <summary>Steps whose error was above the tolerance.</summary>
        public long StepsNotConverged { get; internal set; }

        /// <summary>Largest error of a time step, as the scheme's embedded solution has it: radians, or displacement
        /// over L.</summary>
        public double TimeStepError { get; internal set; } = double.NaN;

        /// <summary>Steps that were taken within the logged ones, which end at jumps of loads and are cut where an
        /// error is requested.</summary>
        public long InnerSteps { get; internal set; }

        /// <summary>Longest substep, s, with which explicit steps are stable about the wire's rest shape.</summary>
        public double StableSubstep { get; internal set; } = double.NaN;

        /// <summary>Force of the proximal support on the wire at the end, N.</summary>
        public Vector3d? ProximalForce { get; internal set; }

        /// <summary>Couple of the proximal clamp on the wire at the end, N m, along the world's axes.</summary>
        public Vector3d? ProximalMoment { get; internal set; }

        /// <summary>Force of the distal support on the wire at the end, N.</summary>
        public Vector3d? DistalForce { get; internal set; }

        /// <summary>Couple of the distal clamp on the wire at the end, N m, along the world's axes.</summary>
        public Vector3d? DistalMoment { get; internal set; }

        /// <summary>Energy stored in the wire and its motion, less the work of dead loads, J.</summary>
        public double Energy { get; internal set; } = double.NaN;

        /// <summary>Largest values of the run; null with xpbd and explicit.</summary>
        public RunExtremes? Extremes { get; internal set; }

        /// <summary>Writes or restores what the rest shape of the start left here, and the run's extremes; the
        /// rest is stated anew by each report.</summary>
        internal void Serialize(Snapshot snapshot)
        {
            Method = snapshot.Serialize(Method);
            Factorisations = snapshot.Serialize(Factorisations);
            EquilibriumIterations = snapshot.Serialize(EquilibriumIterations);
            EquilibriumResidual = snapshot.Serialize(EquilibriumResidual);
            SmallestEigenvalue = snapshot.Serialize(SmallestEigenvalue);
            Extremes?.Serialize(snapshot);
        }
    }

    /// <summary>Counts steps and gives the time, t = t_0 + (k - k_0) dt, where k_0 is the step at which dt was last
    /// changed.</summary>
    internal sealed class StepClock
    {
        private readonly double _timeStep;
        private int _step;
        private int _originStep;
        private double _originTime;

        /// <param name="timeStep">dt, s.</param>
        public StepClock(double timeStep)
        {
            _timeStep = timeStep;
        }

        /// <summary>Counts the steps so far.</summary>
        public int StepCount => _step;

        /// <summary>t after them, s.</summary>
        public double Time => _originTime + (_step - _originStep) * _timeStep;

        /// <summary>Counts one step more.</summary>
        public void Advance() => _step++;

        /// <summary>Writes the clock into a snapshot, or goes on from one; with another dt from that moment
        /// on.</summary>
        public void Serialize(Snapshot snapshot)
        {
            double timeStep = _timeStep;
            snapshot.Serialize(ref timeStep);
            snapshot.Serialize(ref _step);
            snapshot.Serialize(ref _originStep);
            snapshot.Serialize(ref _originTime);
            if (timeStep != _timeStep)
            {
                _originTime += (_step - _originStep) * timeStep;
                _originStep = _step;
            }
        }
    }

    /// <summary>A run as built by a method, before its first step.</summary>
    internal sealed class MethodStart
    {
        /// <summary>A wire and what steps it.</summary>
        public MethodStart(RodState state, TimeStepper stepper)
        {
            State = state;
            Stepper = stepper;
        }

        /// <summary>The wire at its start.</summary>
        public RodState State { get; }

        /// <summary>What steps the wire.</summary>
        public TimeStepper Stepper { get; }

        /// <summary>Why there is no start, in one line, or null.</summary>
        public string? Failure { get; set; }

        /// <summary>Whether the wire starts in its rest shape.</summary>
        public bool IsAtRest { get; set; }
    }
}
