namespace Guidewire.Core
{
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
}
