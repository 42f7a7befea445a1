namespace Guidewire.Core
{
    /// <summary>A wire in a sheath, of which only the part near the exit and beyond is simulated.</summary>
    internal sealed class SheathedWire : CoaxialInstruments
    {
        private readonly StressRecord _stress;

        /// <summary>At its start.</summary>
        /// <param name="failure">Why there is no rest shape to start from, or null.</param>
        public SheathedWire(SimulationParameters parameters, SolverReport report, CoaxialSetup setup,
            MaterialDrive[] drives, out string? failure)
            : base(parameters, report, setup, drives, out failure)
        {
            _stress = new StressRecord(setup.Wire.Rod.JointLengths(setup.Wire.Supports));
        }

        /// <inheritdoc/>
        public override void BeginStep()
        {
            Chain.MoveWindow();
            Chain.TakeTime();
            base.BeginStep();
        }

        /// <inheritdoc/>
        public override HubRecord? Hub()
        {
            HubRecord hub = base.Hub()!;
            Wire.WriteBody(hub, Setup.Sheath!, Chain.Rod.Joints.Sheathed);
            return hub;
        }

        /// <inheritdoc/>
        public override StressRecord Stress()
        {
            Chain.TakeTime();
            Wire.TakeForces(Rod.Dynamics.Terms, Rod.Dynamics.Shape);
            _stress.Take(Rod.Stress(), Setup.Wire.Rod, Chain.Rod.Joints.First, Setup.Axis, Wire.Thrust, Wire.Torque);
            return _stress;
        }
    }
}
