using System;
using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>The surface of a wire: rings around a smooth curve through all spheres, with round ends. Its arrays are
    /// made once and rewritten in place.</summary>
    /// <remarks>Between spheres j and j + 1 runs the cubic with the tangents m_i = (x_{i+1} - x_{i-1})/2 (Catmull-Rom,
    /// one-sided at the ends), so the surface goes through the spheres and has no kinks. Rings preserve their direction
    /// from one to the next (the last ring's normal, made perpendicular to the new tangent), so the surface does not
    /// twist where the wire does not bend; the first ring takes the first director.</remarks>
    internal sealed class TubeMesh
    {
        private const int Cap = 3;    // rings of a round end, beside its pole

        private readonly int _sides;
        private readonly int _perElement;
        private readonly int _spheres;
        private readonly float[] _cosine;
        private readonly float[] _sine;
        private int _next;

        /// <summary>A tube around n + 1 spheres.</summary>
        /// <param name="spheres">n + 1, at least 2.</param>
        /// <param name="perElement">Rings an element, at least 1.</param>
        /// <param name="sides">Corners of a ring, at least 3.</param>
        public TubeMesh(int spheres, int perElement, int sides)
        {
            _spheres = spheres;
            _perElement = perElement;
            _sides = sides;
            _cosine = new float[sides];
            _sine = new float[sides];
            for (int k = 0; k < sides; k++)
            {
                _cosine[k] = Mathf.Cos(2f * Mathf.PI * k / sides);
                _sine[k] = Mathf.Sin(2f * Mathf.PI * k / sides);
            }
            int rings = (spheres - 1) * perElement + 1 + 2 * Cap;
            Vertices = new Vector3[rings * sides];
            Normals = new Vector3[rings * sides];
            Colours = new Vector2[rings * sides];
            Triangles = new int[6 * sides * (rings - 1)];
            WriteTriangles(rings);
        }

        /// <summary>The number of spheres, n + 1.</summary>
        public int Spheres => _spheres;

        /// <summary>The vertices in units.</summary>
        public Vector3[] Vertices { get; }

        /// <summary>The outward unit normals.</summary>
        public Vector3[] Normals { get; }

        /// <summary>Coordinates in the colour map, x in [0, 1].</summary>
        public Vector2[] Colours { get; }

        /// <summary>Three indices a triangle, clockwise from outside as Unity has it.</summary>
        public int[] Triangles { get; }

        /// <summary>Gives the index of the first vertex of the ring around a sphere.</summary>
        public int RingOf(int sphere) => (Cap + sphere * _perElement) * _sides;

        /// <summary>Rewrites the surface; leaves it as it is where a position is not finite.</summary>
        /// <param name="state">The wire.</param>
        /// <param name="radius">Units.</param>
        /// <param name="colours">A coordinate in the colour map for each sphere, in [0, 1].</param>
        public bool Write(RodState state, float radius, float[] colours) =>
            Write(state.Positions, state.Orientations[0], radius, colours);

        /// <summary>The same for spheres that are not a wire's.</summary>
        /// <param name="x">Where they are, units.</param>
        /// <param name="first">Orientation of the first element.</param>
        /// <param name="radius">Units.</param>
        /// <param name="colours">As of the other.</param>
        public bool Write(Vector3d[] x, in Quaterniond first, float radius, float[] colours)
        {
            for (int i = 0; i < _spheres; i++)
            {
                if (!x[i].ToUnity().IsFinite())
                {
                    return false;
                }
            }
            _next = 0;
            Vector3 normal = first.Director1.ToUnity();
            Vector3 tangent = Vector3.forward;
            for (int j = 0; j + 1 < _spheres; j++)
            {
                Vector3 a = x[j].ToUnity();
                Vector3 b = x[j + 1].ToUnity();
                Vector3 ma = Tangent(x, j);
                Vector3 mb = Tangent(x, j + 1);
                int rings = j + 2 == _spheres ? _perElement + 1 : _perElement;
                for (int k = 0; k < rings; k++)
                {
                    float t = (float)k / _perElement;
                    Vector3 centre = Point(a, b, ma, mb, t);
                    tangent = Direction(Slope(a, b, ma, mb, t), tangent);
                    normal = Across(normal, tangent);
                    float colour = Mathf.Lerp(colours[j], colours[j + 1], t);
                    if (_next == 0)
                    {
                        WriteCap(centre, -tangent, tangent, normal, radius, colour, true);
                    }
                    WriteRing(centre, tangent, normal, radius, 0f, colour);
                }
            }
            WriteCap(x[_spheres - 1].ToUnity(), tangent, tangent, normal, radius, colours[_spheres - 1], false);
            return true;
        }

        private Vector3 Tangent(Vector3d[] x, int i)
        {
            int before = Math.Max(i - 1, 0);
            int after = Math.Min(i + 1, _spheres - 1);
            return (x[after] - x[before]).ToUnity() / (after - before);
        }

        private static Vector3 Point(Vector3 a, Vector3 b, Vector3 ma, Vector3 mb, float t)
        {
            float s = 1f - t;
            return s * s * (1f + 2f * t) * a + t * t * (3f - 2f * t) * b + t * s * s * ma - t * t * s * mb;
        }

        private static Vector3 Slope(Vector3 a, Vector3 b, Vector3 ma, Vector3 mb, float t)
        {
            float s = 1f - t;
            return 6f * t * s * (b - a) + s * (1f - 3f * t) * ma + t * (3f * t - 2f) * mb;
        }

        private static Vector3 Direction(Vector3 slope, Vector3 fallback)
        {
            float length = slope.magnitude;
            return length > 1e-12f ? slope / length : fallback;
        }

        // The part of a normal that is perpendicular to the tangent; any perpendicular one where none is left.
        private static Vector3 Across(Vector3 normal, Vector3 tangent)
        {
            Vector3 across = normal - Vector3.Dot(normal, tangent) * tangent;
            if (!(across.sqrMagnitude > 1e-8f))
            {
                across = Vector3.Cross(tangent, Mathf.Abs(tangent.x) < 0.9f ? Vector3.right : Vector3.up);
            }
            return across.normalized;
        }

        // slant: sine of the angle by which the ring's normals lean along the tangent.
        private void WriteRing(Vector3 centre, Vector3 tangent, Vector3 normal, float radius, float slant, float colour)
        {
            Vector3 binormal = Vector3.Cross(tangent, normal);
            float upright = Mathf.Sqrt(Mathf.Max(0f, 1f - slant * slant));
            for (int k = 0; k < _sides; k++)
            {
                Vector3 outward = _cosine[k] * normal + _sine[k] * binormal;
                Vertices[_next] = centre + radius * outward;
                Normals[_next] = upright * outward + slant * tangent;
                Colours[_next] = new Vector2(colour, 0.5f);
                _next++;
            }
        }

        private void WriteCap(Vector3 centre, Vector3 outward, Vector3 tangent, Vector3 normal, float radius,
            float colour, bool isFirst)
        {
            for (int k = 1; k <= Cap; k++)
            {
                float angle = 0.5f * Mathf.PI * (isFirst ? Cap + 1 - k : k) / Cap;
                float height = Mathf.Sin(angle);
                float slant = isFirst ? -height : height;
                Vector3 middle = centre + radius * height * outward;
                WriteRing(middle, tangent, normal, radius * Mathf.Cos(angle), slant, colour);
            }
        }

        private void WriteTriangles(int rings)
        {
            int index = 0;
            for (int ring = 0; ring + 1 < rings; ring++)
            {
                for (int k = 0; k < _sides; k++)
                {
                    int a = ring * _sides + k;
                    int b = ring * _sides + (k + 1) % _sides;
                    Triangles[index++] = a;
                    Triangles[index++] = b;
                    Triangles[index++] = a + _sides;
                    Triangles[index++] = b;
                    Triangles[index++] = b + _sides;
                    Triangles[index++] = a + _sides;
                }
            }
        }
    }
}
