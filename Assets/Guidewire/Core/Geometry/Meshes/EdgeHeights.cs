using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Heights of a point over the three edges of a triangle, in its plane and positive inside, each times
    /// |n| and the edge's length: (n x e).(p - v).</summary>
    internal readonly struct EdgeHeights
    {
        public readonly double First;
        public readonly double Second;
        public readonly double Third;

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public EdgeHeights(
            in Vector3d p, in Vector3d n, in Vector3d v0, in Vector3d v1, in Vector3d v2,
            in Vector3d e0, in Vector3d e1, in Vector3d e2)
        {
            First = Vector3d.Dot(Vector3d.Cross(n, e0), p - v0);
            Second = Vector3d.Dot(Vector3d.Cross(n, e1), p - v1);
            Third = Vector3d.Dot(Vector3d.Cross(n, e2), p - v2);
        }

        /// <summary>True for a point above the triangle.</summary>
        public bool AreInside => First >= 0.0 && Second >= 0.0 && Third >= 0.0;
    }
}
