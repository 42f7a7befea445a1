namespace Guidewire.Benchmarks
{
    /// <summary>The wire of the free cantilever, at rest under its tip force, and its motion once let go.</summary>
    internal sealed class FreeCantilever
    {
        /// <summary>The duration of the motion, s.</summary>
        public const double Duration = 0.2;

        /// <summary>n, scheme and dt (s) with which it is timed: the cheapest below 0.3 % error.</summary>
        public const int Elements = 10;
        public const Integrator Scheme = Integrator.Esdirk3;
        public const double TimeStep = 2e-3;

        private const double Length = 300.0;  // mm
        private const double Load = 0.1;      // F L^2/EI

        private readonly SimulationParameters _parameters;
        private readonly int _steps;

        /// <summary>Finds the rest shape.</summary>
        public FreeCantilever(int elements, Integrator scheme, double timeStep)
        {
            _steps = (int)Math.Round(Duration / timeStep);
            _parameters = Parameters(elements, scheme, timeStep);
            double radius = _parameters.Material.WireRadius;
            double bending = _parameters.Material.YoungsModulus * 0.25 * Math.PI * radius * radius * radius * radius;
            double length = Length * _parameters.Scene.MetresPerUnit;
            _parameters.Scene.TipForce = new Vector3d(0.0, -Load * bending / (length * length), 0.0);
            _parameters.Scene.InitialState = InitialState.Equilibrium;
            RodState rest = Simulation.Create(_parameters).State;
            _parameters.Scene.Start = new RodStart(rest.Positions, rest.Orientations, rest.Velocities,
                rest.AngularVelocities)
            {
                ProximalFrame = Quaterniond.Identity,    // the clamp's; the first element is bent against it
            };
            _parameters.Scene.TipForce = Vector3d.Zero;
            _parameters.Scene.InitialState = InitialState.Straight;
        }

        /// <summary>The motion; returns where the tip is in the end, mm.</summary>
        /// <param name="tip">Receives the tip's y after every step, mm; or null.</param>
        public double Run(double[]? tip)
        {
            Simulation simulation = Simulation.Create(_parameters);
            for (int i = 0; i < _steps; i++)
            {
                simulation.Step();
                if (tip != null)
                {
                    tip[i] = simulation.State.Positions[_parameters.Scene.NumberRodElements].Y;
                }
            }
            return simulation.State.Positions[_parameters.Scene.NumberRodElements].Y;
        }

        /// <summary>RMS of the difference of two motions of the tip over RMS of the finer, at the steps of the
        /// coarser.</summary>
        public static double Difference(double[] coarse, double[] fine)
        {
            int every = fine.Length / coarse.Length;
            double square = 0.0;
            double reference = 0.0;
            for (int i = 0; i < coarse.Length; i++)
            {
                double y = fine[(i + 1) * every - 1];
                square += (coarse[i] - y) * (coarse[i] - y);
                reference += y * y;
            }
            return Math.Sqrt(square / reference);
        }

        /// <summary>The motion of the tip, y after every step, mm.</summary>
        public static double[] Tip(int elements, Integrator scheme, double timeStep)
        {
            var cantilever = new FreeCantilever(elements, scheme, timeStep);
            double[] tip = new double[cantilever._steps];
            cantilever.Run(tip);
            return tip;
        }

        private static SimulationParameters Parameters(int elements, Integrator scheme, double timeStep)
        {
            var parameters = new SimulationParameters
            {
                Method =
                {
                    Solver = Solver.Direct,
                    Integrator = scheme,
                    TimeStep = timeStep,
                    MaxSimulationSteps = int.MaxValue,
                    DeltaThreshold = 0.0,
                },
                Scene = { NumberRodElements = elements, GuidewireLength = Length, GuidewireOffset = 0.0 },
                Drive = { Displacement = 0.0 },
            };
            parameters.Scene.ProximalEnd = ProximalEnd.Clamped;
            return parameters;
        }
    }
}
