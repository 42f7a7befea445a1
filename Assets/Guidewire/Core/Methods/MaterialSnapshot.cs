namespace Guidewire.Core
{
    /// <summary>The state that every method for a material needs to continue, in one common layout, so that each can
    /// read the state of another: time, shape, frames, velocities, and the progress of the prescribed motions. After it
    /// each method writes the turns of both clamps' frames, then one section of its own.</summary>
    internal static class MaterialSnapshot
    {
        /// <summary>Writes or restores the wire's motion.</summary>
        /// <param name="velocities">m/s.</param>
        /// <param name="spins">rad/s along the elements' axes.</param>
        /// <param name="time">s.</param>
        public static void Serialize(Snapshot snapshot, RodSchedule schedule, RodShape shape, Vector3d[] velocities,
            Vector3d[] spins, ref double time)
        {
            snapshot.Serialize(ref time);
            shape.Serialize(snapshot);
            snapshot.Serialize(velocities, shape.ElementCount + 1);
            snapshot.Serialize(spins, shape.ElementCount);
            schedule.Serialize(snapshot, time);
        }
    }
}
