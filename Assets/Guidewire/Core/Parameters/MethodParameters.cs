using System.Threading;

namespace Guidewire.Core
{
    /// <summary>How a run is simulated: the method, its steps, and what ends it.</summary>
    public sealed class MethodParameters
    {
        /// <summary>What holds the wire together: pbd stiffness (pbd) or a material (the others).</summary>
        public Solver Solver { get; set; } = Solver.Pbd;

        /// <summary>The time step dt, s.</summary>
        public double TimeStep { get; set; } = 0.01;

        /// <summary>m, Gauss-Seidel iterations a step.</summary>
        public int ConstraintSolverSteps { get; set; } = 500;

        /// <summary>How positions are predicted.</summary>
        public Integrator Integrator { get; set; } = Integrator.Verlet;

        /// <summary>The order of one iteration.</summary>
        public SweepOrder SweepOrder { get; set; } = SweepOrder.Naive;

        /// <summary>d, the fraction of its velocity that a sphere loses a step, with pbd.</summary>
        public double Damping { get; set; }

        /// <summary>Parts into which the explicit and the compliant solver divide a time step.</summary>
        public int Substeps { get; set; } = 1;

        /// <summary>Error that a solver may leave in a step: radians, or displacement over L; of the direct solver also
        /// what it may leave of the balance of forces, over the largest force in the wire.</summary>
        public double SolverTolerance { get; set; } = 1e-6;

        /// <summary>Error that a step of the direct solver may make, as its embedded solution has it: radians, or
        /// displacement over L. Steps are then cut and grown within <see cref="TimeStep"/>; 0 leaves them as they
        /// are.</summary>
        public double TimeStepError { get; set; }

        /// <summary>Newton iterations after which the direct solver gives up a stage; a rest shape gets ten times as
        /// many.</summary>
        public int MaxNewtonIterations { get; set; } = 50;

        /// <summary>epsilon, in units: with pbd, a steady state's prediction errors lie below it (<see
        /// cref="PbdMonitor"/>); a wire with a material is no farther from rest (<see cref="RestMonitor"/>). 0 switches
        /// the test off.</summary>
        public double DeltaThreshold { get; set; } = 0.001;

        /// <summary>Steps in a row that a steady state must last, with pbd.</summary>
        public int SteadyStateHold { get; set; } = 100;

        /// <summary>Steps after which a run is finished.</summary>
        public int MaxSimulationSteps { get; set; } = 4000;

        /// <summary>Whether a run with a material states the support's force at the first sphere after each step; it
        /// costs a little of each. With pbd it is stated wherever there are walls.</summary>
        public bool StatesReactions { get; set; }

        /// <summary>Ends a step of the direct solver that is still at work: <see cref="Simulation.Step"/> throws an
        /// <see cref="System.OperationCanceledException"/>, the state stays that of the step before, and the run cannot
        /// go on.</summary>
        public CancellationToken Cancellation { get; set; }

        /// <summary>Gives a copy of these parameters; lists and walls are shared.</summary>
        internal MethodParameters Copy() => (MethodParameters)MemberwiseClone();
    }

    /// <summary>What holds the wire together. The first takes pbd stiffness per iteration, the others a
    /// material.</summary>
    public enum Solver
    {
        /// <summary>Gauss-Seidel with pbd stiffness (the thesis).</summary>
        Pbd,

        /// <summary>Gauss-Seidel with compliance, multipliers and substeps (Macklin 2016).</summary>
        Xpbd,

        /// <summary>Newton's method over the whole rod, block-tridiagonal.</summary>
        Direct,

        /// <summary>Forces and explicit steps.</summary>
        Explicit,
    }

    /// <summary>How positions are predicted.</summary>
    public enum Integrator
    {
        /// <summary>Thesis eq. 2.7, first step by Euler.</summary>
        Verlet,

        /// <summary>Thesis eqs. 2.5 and 2.6 with the new velocity in the second.</summary>
        Euler,

        /// <summary>Positions and orientations by Verlet's formula.</summary>
        OrientationVerlet,

        /// <summary>Positions by Euler, orientations by Verlet's formula.</summary>
        EulerOrientationVerlet,

        /// <summary>Direct solver, order 1.</summary>
        ImplicitEuler,

        /// <summary>Direct solver, two-step, order 2.</summary>
        Bdf2,

        /// <summary>Direct solver, TR-BDF2: L-stable Runge-Kutta with an explicit first stage and 2 implicit ones,
        /// order 2.</summary>
        Trbdf2,

        /// <summary>Direct solver, ESDIRK3(2)4L[2]SA: explicit first stage and 3 implicit ones, order 3.</summary>
        Esdirk3,

        /// <summary>Direct solver, ESDIRK4(3)6L[2]SA: explicit first stage and 5 implicit ones, order 4.</summary>
        Esdirk4,
    }

    /// <summary>The order in which one Gauss-Seidel iteration visits the rod elements.</summary>
    public enum SweepOrder
    {
        /// <summary>Elements are swept from sphere 0 to the last.</summary>
        Naive,

        /// <summary>Alternately from both ends inwards (Kugelstadt and Schoemer 2016, section 5).</summary>
        Bilateral,
    }

    /// <summary>Properties of a pbd wire, which has no material and whose mass is given as a whole.</summary>
    public sealed class PbdParameters
    {
        /// <summary>k_A, pbd stiffness of the stretch constraint, dimensionless: at 2 the iteration diverges.</summary>
        public double StretchStiffness { get; set; } = 0.1;

        /// <summary>k_B, pbd stiffness of the bend-twist constraint in units of length: at l the iteration
        /// diverges.</summary>
        public double BendStiffness { get; set; } = 0.1;

        /// <summary>M in mass units, distributed evenly over the spheres (thesis eq. 3.2).</summary>
        public double TotalMass { get; set; } = 0.01;

        /// <summary>Gives a copy of these parameters; lists and walls are shared.</summary>
        internal PbdParameters Copy() => (PbdParameters)MemberwiseClone();
    }
}
