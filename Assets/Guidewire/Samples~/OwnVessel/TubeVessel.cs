using UnityEngine;

/// <summary>Gives its object the mesh of a bent tube, which is closed at both ends, before the wire is built. A mesh of
/// your own takes its place: remove this and choose the mesh in the MeshFilter.</summary>
[RequireComponent(typeof(MeshFilter))]
public sealed class TubeVessel : MonoBehaviour
{
    private const int Sides = 16;
    private const int Rings = 30;

    [SerializeField, Tooltip("Radius in units of the object."), Min(0.1f)] private float _radius = 6f;
    [SerializeField, Tooltip("Sideways, units, at the end of 200 units."), Min(0f)] private float _bend = 80f;

    private void Awake()
    {
        var points = new Vector3[Rings * Sides];
        var triangles = new int[6 * (Rings - 1) * Sides + 6 * (Sides - 2)];
        int next = 0;
        for (int a = 0; a < points.Length; a++)
        {
            float z = -140f + 340f * (a / Sides) / (Rings - 1);
            float angle = 2f * Mathf.PI * (a % Sides) / Sides;
            float aside = z > 0f ? _bend * z * z / 40000f : 0f;
            points[a] = new Vector3(_radius * Mathf.Cos(angle) + aside, _radius * Mathf.Sin(angle), z);
            if (a + Sides < points.Length)
            {
                int b = a % Sides == Sides - 1 ? a + 1 - Sides : a + 1;
                foreach (int corner in new[] { a, a + Sides, b, b, a + Sides, b + Sides })
                {
                    triangles[next++] = corner;
                }
            }
        }
        int last = (Rings - 1) * Sides;
        for (int k = 1; k + 1 < Sides; k++)
        {
            foreach (int corner in new[] { 0, k, k + 1, last, last + k + 1, last + k })
            {
                triangles[next++] = corner;
            }
        }
        var mesh = new Mesh { name = "Tube" };
        mesh.SetVertices(points);
        mesh.SetTriangles(triangles, 0);
        mesh.RecalculateNormals();
        mesh.RecalculateBounds();
        GetComponent<MeshFilter>().sharedMesh = mesh;
    }
}
