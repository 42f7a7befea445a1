namespace Guidewire.Runtime
{
    /// <summary>A hub after a step, in SI units.</summary>
    public struct HubState
    {
        /// <summary>How far it has gone since the start, m.</summary>
        public double Insertion;

        /// <summary>How far it has turned since the start, rad.</summary>
        public double Turn;

        /// <summary>Its force on its instrument along its axis, N, a thrust positive.</summary>
        public double Force;

        /// <summary>Its torque on its instrument about its axis, N m.</summary>
        public double Torque;

        /// <summary>Displacement that was asked of it and not made, m.</summary>
        public double Shortfall;
    }
}
