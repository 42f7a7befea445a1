namespace Guidewire.Core
{
    /// <summary>What every method for a material needs to go on, laid out the same for all of them, so that each can
    /// read what another wrote: time, shape, frames, velocities, and how far the prescribed motions have come. After it
    /// each method writes the turns of both clamps' frames, then one section of its own.</summary>
    internal static class MaterialSnapshot
    {
        /// <summary>Writes or takes over the wire's motion.</summary>
        /// <param name="velocities">m/s.</param>
        /// <param name="spins">rad/s along the elements' axes.</param>
        /// <param name="time">s.</param>
        public static void Serialize(Snapshot snapshot, RodSchedule schedule, RodShape shape, Vector3d[] velocities,
            Vector3d[] spins, ref double time)
        {
            snapshot.Serialize(ref time);
            shape.Serialize(snapshot);
            snapshot.Serialize(velocities);
            snapshot.Serialize(spins);
            schedule.Serialize(snapshot, time);
        }
    }
}
