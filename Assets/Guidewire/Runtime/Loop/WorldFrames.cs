using System;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>A wire in the world, by its object's transform.</summary>
    internal static class WorldFrames
    {
        /// <summary>Positions of all spheres.</summary>
        /// <exception cref="ArgumentException">The array has another length.</exception>
        public static void GetPositions(Transform place, WireState? state, Vector3[] positions)
        {
            CheckLength(positions.Length, state == null ? 0 : state.Rod.SphereCount);
            for (int i = 0; i < positions.Length; i++)
            {
                positions[i] = place.TransformPoint(state!.Rod.Positions[i].ToUnity());
            }
        }

        /// <summary>Gets the orientations of all elements.</summary>
        /// <exception cref="ArgumentException">The array has another length.</exception>
        public static void GetOrientations(Transform place, WireState? state, Quaternion[] orientations)
        {
            CheckLength(orientations.Length, state == null ? 0 : state.Rod.ElementCount);
            for (int j = 0; j < orientations.Length; j++)
            {
                orientations[j] = place.rotation * state!.Rod.Orientations[j].ToUnity();
            }
        }

        private static void CheckLength(int given, int needed)
        {
            if (given != needed)
            {
                throw new ArgumentException("an array of length " + given + " is given, and " + needed + " are needed");
            }
        }
    }
}
