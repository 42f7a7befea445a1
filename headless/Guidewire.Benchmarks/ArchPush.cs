namespace Guidewire.Benchmarks
{
    /// <summary>A nitinol wire (r = 0.4 mm, 300 mm) that is pushed 150 mm from a straight sheath into
    /// <see cref="ArchWalls"/>.</summary>
    internal sealed class ArchPush
    {
        private const double Insertion = 150.0;  // mm

        private readonly SimulationParameters _parameters;

        /// <param name="wall">One of <see cref="ArchWalls"/>.</param>
        /// <param name="elements">n.</param>
        /// <param name="speed">mm/s.</param>
        /// <param name="timeStep">s.</param>
        public ArchPush(ContactShape wall, int elements, double speed, double timeStep)
        {
            _parameters = new SimulationParameters
            {
                Scene =
                {
                    NumberRodElements = elements,
                    GuidewireOffset = -300.0,
                    ProximalEnd = ProximalEnd.Clamped,
                    Walls = new[] { wall },
                },
                Material = { WireRadius = 0.4e-3 },
                Method =
                {
                    Solver = Solver.Direct,
                    Integrator = Integrator.ImplicitEuler,
                    TimeStep = timeStep,
                    DeltaThreshold = 0.0,
                    MaxSimulationSteps = (int)Math.Round(Insertion / (speed * timeStep)),
                },
                Drive = { Kind = Drive.Displace, Displacement = 0.0, DisplacementPerStep = speed * timeStep },
            };
            Duration = Insertion / speed;
        }

        /// <summary>s of simulated time.</summary>
        public double Duration { get; }

        /// <summary>At its start.</summary>
        public Simulation Start() => Simulation.Create(_parameters);

        /// <summary>Runs the push to its end and returns its Newton iterations per step.</summary>
        public static double Finish(Simulation run)
        {
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
            }
            if (run.Outcome != Outcome.Finished || run.Contacts!.Passages > 0)
            {
                throw new InvalidOperationException("the push did not end inside: " + run.Reason);
            }
            return run.Report()!.WallIterations / run.StepCount;
        }
    }
}
