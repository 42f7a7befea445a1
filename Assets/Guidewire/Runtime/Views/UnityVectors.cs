using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>From Core's doubles to Unity's floats, at the edge and nowhere else.</summary>
    internal static class UnityVectors
    {
        /// <summary>The same vector in float.</summary>
        public static Vector3 ToUnity(this Vector3d v)
        {
            return new Vector3((float)v.X, (float)v.Y, (float)v.Z);
        }

        /// <summary>Whether all components are numbers that a mesh can hold.</summary>
        public static bool IsFinite(this Vector3 v)
        {
            float sum = v.x + v.y + v.z;
            return !float.IsNaN(sum) && !float.IsInfinity(sum);
        }
    }
}
