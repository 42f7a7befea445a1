using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Balls and sticks for one frame: spheres, directors, contact points and forces. One mesh, drawn as
    /// often as asked, so that nothing is kept and nothing is left as garbage.</summary>
    internal static class BallsAndSticks
    {
        private const int Rows = 8;
        private const int Columns = 12;

        /// <summary>A ball of radius 1 around the origin.</summary>
        public static Mesh CreateSphere()
        {
            var normals = new Vector3[(Rows + 1) * Columns];
            var triangles = new int[6 * Rows * Columns];
            int index = 0;
            for (int a = 0; a < normals.Length; a++)
            {
                float latitude = Mathf.PI * (a / Columns) / Rows;
                float longitude = 2f * Mathf.PI * (a % Columns) / Columns;
                normals[a] = new Vector3(Mathf.Sin(latitude) * Mathf.Cos(longitude), Mathf.Cos(latitude),
                    Mathf.Sin(latitude) * Mathf.Sin(longitude));
                if (a / Columns < Rows)
                {
                    int b = a % Columns == Columns - 1 ? a + 1 - Columns : a + 1;
                    triangles[index++] = a;
                    triangles[index++] = b;
                    triangles[index++] = a + Columns;
                    triangles[index++] = b;
                    triangles[index++] = b + Columns;
                    triangles[index++] = a + Columns;
                }
            }
            var mesh = new Mesh { name = "Ball" };
            mesh.SetVertices(normals);
            mesh.SetNormals(normals);
            mesh.SetTriangles(triangles, 0);
            return mesh;
        }

        /// <summary>Draws a ball; nothing where its position is not finite.</summary>
        /// <param name="place">From the wire's frame to the world.</param>
        public static void DrawSphere(Mesh ball, in Matrix4x4 place, Vector3 centre, float radius, Material material,
            int layer)
        {
            if (centre.IsFinite())
            {
                Matrix4x4 own = Matrix4x4.TRS(centre, Quaternion.identity, radius * Vector3.one);
                Graphics.DrawMesh(ball, place * own, material, layer);
            }
        }

        /// <summary>Draws a ball drawn out to a stick from a point along a vector.</summary>
        /// <param name="place">From the wire's frame to the world.</param>
        public static void DrawStick(Mesh ball, in Matrix4x4 place, Vector3 from, Vector3 along, float radius,
            Material material, int layer)
        {
            float half = 0.5f * along.magnitude;
            if (from.IsFinite() && half > 0f && !float.IsInfinity(half))
            {
                Quaternion rotation = Quaternion.FromToRotation(Vector3.forward, along);
                var scale = new Vector3(radius, radius, half);
                Graphics.DrawMesh(ball, place * Matrix4x4.TRS(from + 0.5f * along, rotation, scale), material, layer);
            }
        }
    }
}
