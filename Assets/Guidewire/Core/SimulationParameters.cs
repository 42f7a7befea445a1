namespace Guidewire.Core
{
    /// <summary>What moves sphere 0.</summary>
    public enum Drive
    {
        /// <summary>One displacement at the start, then held: the steady-state simulation of thesis 3.1.4.</summary>
        Hold,

        /// <summary>Moved every step along a fixed direction.</summary>
        Displace,

        /// <summary>Moved every step along the first rod element (thesis eq. 3.6).</summary>
        Push,

        /// <summary>Free, under an external force.</summary>
        Force,
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

        /// <summary>Direct solver, L-stable Runge-Kutta with 2 stages, order 2.</summary>
        Sdirk2,

        /// <summary>Direct solver, L-stable Runge-Kutta with 3 stages, order 3.</summary>
        Sdirk3,

        /// <summary>Direct solver, L-stable Runge-Kutta with 5 stages, order 4.</summary>
        Sdirk4,
    }

    /// <summary>The order in which one Gauss-Seidel sweep visits the rod elements.</summary>
    public enum SweepOrder
    {
        /// <summary>From sphere 0 to the last.</summary>
        Naive,

        /// <summary>Alternately from both ends inwards (Kugelstadt and Schoemer 2016, section 5).</summary>
        Bilateral,
    }

    /// <summary>What touches a wall besides the spheres.</summary>
    public enum ElementContact
    {
        /// <summary>Rod elements; their spheres share the push by the lever rule.</summary>
        Barycentric,

        /// <summary>Nothing.</summary>
        None,

        /// <summary>Rod elements, by the rule as published (thesis 3.1.2).</summary>
        Seed,
    }

    /// <summary>Everything that one run is told, as typed values. The initial values are the defaults (thesis
    /// table 4.1). Text, units and allowed ranges of each stand in the parameter table of Guidewire.Io.</summary>
    public sealed class SimulationParameters
    {
        /// <summary>m, Gauss-Seidel iterations a step.</summary>
        public int ConstraintSolverSteps { get; set; } = 500;

        /// <summary>dt in s.</summary>
        public double TimeStep { get; set; } = 0.01;

        /// <summary>Displacement of sphere 0 at the start in units; only with <see cref="Core.Drive.Hold"/>.</summary>
        public double Displacement { get; set; } = 10.0;

        /// <summary>Direction of the displacement; any length but 0, it is normalised.</summary>
        public Vector3d DisplacementDirection { get; set; } = Vector3d.UnitZ;

        /// <summary>What moves sphere 0.</summary>
        public Drive Drive { get; set; } = Drive.Hold;

        /// <summary>Motion of sphere 0 in units a step; with <see cref="Core.Drive.Displace"/> and
        /// <see cref="Core.Drive.Push"/>.</summary>
        public double DisplacementPerStep { get; set; }

        /// <summary>Force on sphere 0 in mass unit * unit / s^2; with <see cref="Core.Drive.Force"/>.</summary>
        public Vector3d ExternalForce { get; set; }

        /// <summary>Acceleration of every free sphere in unit/s^2.</summary>
        public Vector3d Gravity { get; set; }

        /// <summary>L in units.</summary>
        public double GuidewireLength { get; set; } = 300.0;

        /// <summary>n; the wire has n + 1 spheres.</summary>
        public int NumberRodElements { get; set; } = 30;

        /// <summary>M in mass units, shared evenly by the spheres (thesis eq. 3.2).</summary>
        public double TotalMass { get; set; } = 0.01;

        /// <summary>z of sphere 0 before its displacement, in units.</summary>
        public double GuidewireOffset { get; set; } = -120.0;

        /// <summary>k_B, gain of the bend-twist constraint in units of length: at l the sweep breaks down.</summary>
        public double BendStiffness { get; set; } = 0.1;

        /// <summary>k_A, gain of the stretch constraint, dimensionless: at 2 the sweep breaks down.</summary>
        public double StretchStiffness { get; set; } = 0.1;

        /// <summary>r in units.</summary>
        public double SphereRadius { get; set; } = 5.0;

        /// <summary>Distance kept beyond the radius, in units.</summary>
        public double CollisionMargin { get; set; }

        /// <summary>k_C, gain of a contact, dimensionless.</summary>
        public double CollisionStiffness { get; set; } = 1e-4;

        /// <summary>What touches a wall besides the spheres.</summary>
        public ElementContact ElementContact { get; set; } = ElementContact.Barycentric;

        /// <summary>Turn of element 0 about its own axis in radians a step; where it is not 0 the element's frame is
        /// held.</summary>
        public double TwistPerStep { get; set; }

        /// <summary>The vessel and what stands in it, placed; none costs nothing.</summary>
        public ContactShape[] Walls { get; set; } = System.Array.Empty<ContactShape>();

        /// <summary>epsilon, in units: a steady state's prediction errors lie below it; 0 switches the test
        /// off.</summary>
        public double DeltaThreshold { get; set; } = 0.001;

        /// <summary>Steps in a row that a steady state must last.</summary>
        public int SteadyStateHold { get; set; } = 100;

        /// <summary>d, the share of its velocity that a sphere loses a step.</summary>
        public double Damping { get; set; }

        /// <summary>How positions are predicted.</summary>
        public Integrator Integrator { get; set; } = Integrator.Verlet;

        /// <summary>The order of one sweep.</summary>
        public SweepOrder SweepOrder { get; set; } = SweepOrder.Naive;

        /// <summary>Steps after which a run is finished.</summary>
        public int MaxSimulationSteps { get; set; } = 4000;

        /// <summary>Where a vessel's origin lies, in units.</summary>
        public Vector3d Position { get; set; }

        /// <summary>Factors on a vessel's size along its own axes.</summary>
        public Vector3d Scale { get; set; } = new Vector3d(1.0, 1.0, 1.0);

        /// <summary>A vessel's Euler angles in degrees, about z, then x, then y, as in Unity.</summary>
        public Vector3d Rotation { get; set; }

        /// <summary>A hand that pushes and turns the wire as it goes, in place of the drive's motion, or
        /// null.</summary>
        public Steering? Steering { get; set; }

        /// <summary>What keeps the wire together: gains (pbd) or a material (the others).</summary>
        public Solver Solver { get; set; } = Solver.Pbd;

        /// <summary>The material, for every solver but pbd.</summary>
        public MaterialParameters Material { get; private set; } = new MaterialParameters();

        /// <summary>Whether a run with a material states the support's force at the first sphere after each step; it
        /// costs a little of each. With gains it is stated wherever there are walls.</summary>
        public bool StatesReactions { get; set; }

        /// <summary>A start other than the straight wire along z at rest, or null.</summary>
        public RodStart? Start { get; set; }

        /// <summary>The same values; walls and steering are shared.</summary>
        internal SimulationParameters Copy()
        {
            var copy = (SimulationParameters)MemberwiseClone();
            copy.Material = Material.Copy();
            return copy;
        }
    }
}
