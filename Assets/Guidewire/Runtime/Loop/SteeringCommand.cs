namespace Guidewire.Runtime
{
    /// <summary>What the hand asks of a step.</summary>
    internal struct SteeringCommand
    {
        /// <summary>Whose hub is held: 0 the wire's, k that of catheter k.</summary>
        public int Held;

        /// <summary>Speed of the hub, units per second of in-game time.</summary>
        public double Push;

        /// <summary>Its rotation speed, degrees per second of in-game time.</summary>
        public double Turn;

        public readonly bool Equals(in SteeringCommand other) =>
            Held == other.Held && Push.Equals(other.Push) && Turn.Equals(other.Turn);
    }
}
