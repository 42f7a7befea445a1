namespace Guidewire.Benchmarks
{
    /// <summary>The default wire (thesis table 4.1) with sweeps of one's choice, let go from a wave along its whole
    /// length: where nothing has moved yet, numbers too small for full precision would be timed.</summary>
    internal sealed class SteppedWire
    {
        private const double WaveElements = 40.0;    // of one period
        private const double WaveAngle = 0.3;    // radians, the largest
        private readonly RodState _state;
        private readonly PositionBasedStep _step;

        /// <param name="elements">n.</param>
        /// <param name="iterations">m.</param>
        /// <param name="choice">Gives the sweeps to use, or null where they cannot be had.</param>
        public SteppedWire(int elements, int iterations, Func<ScalarIterations, IIterations?> choice)
        {
            var parameters = new SimulationParameters();
            _state = new RodState(elements, 10.0 * elements, parameters.Pbd.TotalMass, 0.0);
            _state.InverseMasses[0] = 0.0;
            Bend(_state);
            var scalar = new ScalarIterations(new StretchConstraint(_state, parameters.Pbd.StretchStiffness),
                new BendTwistConstraint(_state, parameters.Pbd.BendStiffness), SweepOrder.Naive);
            Sweeps = choice(scalar);
            _step = new PositionBasedStep(parameters.Method.TimeStep,
                new VerletPrediction(parameters.Method.Damping, parameters.Scene.Gravity),
                    new OrientationEulerPrediction(), null,
                new GaussSeidelSolver(iterations, scalar, Sweeps ?? scalar, null), null);
        }

        /// <summary>The sweeps in use, or null where they could not be had.</summary>
        public IIterations? Sweeps { get; }

        /// <summary>Does one step.</summary>
        public void Step() => Advance(1);

        /// <summary>Does some steps.</summary>
        public void Advance(int steps)
        {
            for (int k = 0; k < steps; k++)
            {
                _step.Advance(_state);
            }
        }

        private static void Bend(RodState state)
        {
            for (int j = 0; j < state.ElementCount; j++)
            {
                double phase = 2.0 * Math.PI * j / WaveElements;
                var axis = new Vector3d(Math.Cos(0.5 * phase), Math.Sin(0.5 * phase), 0.0);
                state.Orientations[j] = Quaterniond.FromAxisAngle(axis, WaveAngle * Math.Sin(phase));
                state.Place(j + 1, state.Positions[j] + state.ElementLength * state.Orientations[j].Director3);
            }
        }
    }
}
