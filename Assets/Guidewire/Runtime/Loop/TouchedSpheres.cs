using System;
using Guidewire.Core;

namespace Guidewire.Runtime
{
    /// <summary>Which spheres a wall acts on, from step to step.</summary>
    internal sealed class TouchedSpheres
    {
        private bool[] _touched = Array.Empty<bool>();

        /// <summary>None is touched; for another wire.</summary>
        public void Begin(int spheres) => _touched = new bool[spheres];

        /// <summary>Takes over a step.</summary>
        /// <param name="forces">Of the walls on each sphere; empty without walls.</param>
        /// <param name="began">Called with the index of each sphere that a wall acts on now and did not before.</param>
        /// <param name="ended">Called with the index of each one that it no longer acts on.</param>
        public void Update(Vector3d[] forces, Action<int>? began, Action<int>? ended)
        {
            for (int i = 0; i < _touched.Length; i++)
            {
                bool isTouched = i < forces.Length && forces[i].LengthSquared > 0.0;
                if (isTouched != _touched[i])
                {
                    _touched[i] = isTouched;
                    (isTouched ? began : ended)?.Invoke(i);
                }
            }
        }
    }
}
