namespace Guidewire.Benchmarks
{
    /// <summary>A nitinol wire of 0.36 mm that is fed into <see cref="ArchWalls"/>.</summary>
    internal static class FedWire
    {
        /// <summary>The speed of its hub, m/s.</summary>
        public const double Speed = 0.02;

        /// <summary>The time step, s.</summary>
        public const double TimeStep = 0.02;

        /// <summary>A wire whose tip is at the origin; what drives it is the caller's.</summary>
        /// <param name="length">mm.</param>
        public static SimulationParameters Parameters(double length, int elements, ContactShape wall, int steps)
        {
            return new SimulationParameters
            {
                Scene =
                {
                    NumberRodElements = elements,
                    GuidewireLength = length,
                    GuidewireOffset = -length,
                    ProximalEnd = ProximalEnd.Clamped,
                    Walls = new[] { wall },
                },
                Material = { WireRadius = 0.18e-3, YoungsModulus = 60e9, ShearModulus = 23e9, MassDamping = 20.0 },
                Method =
                {
                    Solver = Solver.Direct,
                    Integrator = Integrator.ImplicitEuler,
                    TimeStep = TimeStep,
                    DeltaThreshold = 0.0,
                    MaxSimulationSteps = steps,
                },
                Drive = { Kind = Drive.Displace, Displacement = 0.0 },
            };
        }

        /// <summary>Makes one step and returns its time, us.</summary>
        /// <param name="readsHub">Whether the hub's force is read within that time.</param>
        /// <exception cref="InvalidOperationException">The run has failed.</exception>
        public static double Step(Simulation run, bool readsHub)
        {
            long start = Stopwatch.GetTimestamp();
            run.Step();
            if (readsHub)
            {
                run.Hub();
            }
            double time = 1e6 * (Stopwatch.GetTimestamp() - start) / Stopwatch.Frequency;
            if (run.Outcome == Outcome.Failed)
            {
                throw new InvalidOperationException(run.Reason);
            }
            return time;
        }
    }
}
