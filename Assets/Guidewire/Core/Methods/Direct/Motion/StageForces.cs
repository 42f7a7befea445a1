namespace Guidewire.Core
{
    /// <summary>The external forces on a rod in one stage, or their weighted sum, N; the hub's torque, N
    /// m.</summary>
    internal struct StageForces
    {
        public Vector3d Proximal;
        public Vector3d Distal;
        public Vector3d Load;
        public Vector3d Walls;
        public double HubTorque;  // about its axis

        /// <summary>Adds others with a weight.</summary>
        public void Add(double weight, in StageForces other)
        {
            Proximal += weight * other.Proximal;
            Distal += weight * other.Distal;
            Load += weight * other.Load;
            Walls += weight * other.Walls;
            HubTorque += weight * other.HubTorque;
        }

        /// <summary>Writes or restores.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref Proximal);
            snapshot.Serialize(ref Distal);
            snapshot.Serialize(ref Load);
            snapshot.Serialize(ref Walls);
            snapshot.Serialize(ref HubTorque);
        }
    }
}
