using System;

namespace Guidewire.Core
{
    /// <summary>Where a rod was and how it moved when a step began, to take the step again.</summary>
    internal sealed class StepStart
    {
        private readonly RodShape _shape;
        private readonly Vector3d[] _velocities;
        private readonly Vector3d[] _spins;
        private (double Proximal, double Distal) _turns;

        /// <summary>Room for a rod of n elements.</summary>
        public StepStart(int elementCount)
        {
            _shape = new RodShape(elementCount);
            _velocities = new Vector3d[elementCount + 1];
            _spins = new Vector3d[elementCount];
        }

        /// <summary>Keeps the rod's motion.</summary>
        public void Save(RodShape shape, Vector3d[] velocities, Vector3d[] spins, ClampFrames frames)
        {
            _shape.CopyFrom(shape);
            Array.Copy(velocities, _velocities, velocities.Length);
            Array.Copy(spins, _spins, spins.Length);
            _turns = frames.Made;
        }

        /// <summary>Gives it back.</summary>
        public void Restore(RodShape shape, Vector3d[] velocities, Vector3d[] spins, ClampFrames frames)
        {
            shape.CopyFrom(_shape);
            Array.Copy(_velocities, velocities, velocities.Length);
            Array.Copy(_spins, spins, spins.Length);
            frames.Made = _turns;
        }
    }
}
