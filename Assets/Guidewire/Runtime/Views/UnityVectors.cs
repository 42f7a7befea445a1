using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Translates between Core's doubles and Unity's floats, at the edge and nowhere else.</summary>
    internal static class UnityVectors
    {
        /// <summary>Gives the same vector in float.</summary>
        public static Vector3 ToUnity(this Vector3d v) => new Vector3((float)v.X, (float)v.Y, (float)v.Z);

        /// <summary>Gives the same orientation in float.</summary>
        public static Quaternion ToUnity(this Quaterniond q) =>
            new Quaternion((float)q.X, (float)q.Y, (float)q.Z, (float)q.W);

        /// <summary>Gives the same vector in double.</summary>
        public static Vector3d ToCore(this Vector3 v) => new Vector3d(v.x, v.y, v.z);

        /// <summary>Whether all components are numbers that a mesh can hold.</summary>
        public static bool IsFinite(this Vector3 v)
        {
            float sum = v.x + v.y + v.z;
            return !float.IsNaN(sum) && !float.IsInfinity(sum);
        }
    }
}
