using System.Collections.Generic;
using Guidewire.Core;
using Guidewire.Io;
using UnityEngine;
using UnityEngine.Rendering;

namespace Guidewire.Runtime
{
    /// <summary>Shows the catheters over the wire as a tube each, in a colour of its own through which the wire is
    /// seen. Meshes are made when a run is built, and rewritten. All is drawn at this object's transform, as
    /// <see cref="WireView"/> does, whose object it stands on.</summary>
    public sealed class CatheterView : MonoBehaviour
    {
        private const int RingsPerElement = 4;
        private const int Sides = 12;
        private const float Opacity = 0.5f;   // as in rendered pictures

        private static readonly Color[] Colours =
        {
            new Color(1f, 0.62f, 0.18f, Opacity), new Color(0.71f, 0.55f, 1f, Opacity),
            new Color(0.37f, 0.83f, 0.55f, Opacity),
        };

        private readonly List<Drawn> _drawn = new List<Drawn>();
        private SimulationLoop _loop = null!;
        private WireView _wire = null!;
        private Material _material = null!;
        private int _generation;

        private sealed class Drawn
        {
            public Drawn(int spheres, TubeMesh tube, Mesh mesh, Material material, float times)
            {
                Tube = tube;
                Mesh = mesh;
                Material = material;
                Times = times;
                Colours = new float[spheres];
            }

            public TubeMesh Tube { get; }

            public Mesh Mesh { get; }

            public Material Material { get; }

            // In the colour map, which its material does not have.
            public float[] Colours { get; }

            // Its radius over the wire's.
            public float Times { get; }
        }

        /// <summary>How many catheters are drawn.</summary>
        internal int Count => _drawn.Count;

        /// <summary>Draws from now on what a loop simulates.</summary>
        /// <param name="wire">The wire's view, which says how thick the wire is drawn.</param>
        /// <param name="material">What the catheters' materials are made from.</param>
        internal void Begin(SimulationLoop loop, WireView wire, Material material)
        {
            _loop = loop;
            _wire = wire;
            _material = material;
        }

        /// <summary>The tube of a catheter as it was last drawn.</summary>
        internal TubeMesh TubeOf(int catheter)
        {
            return _drawn[catheter].Tube;
        }

        /// <summary>Draws the catheters as they are now.</summary>
        public void Draw()
        {
            SimulationSession? session = _loop.Session;
            if (session == null)
            {
                return;
            }
            IReadOnlyList<CoaxialRecord> catheters = session.Simulation.Catheters();
            if (_generation != _loop.Generation)
            {
                Build(session.Parameters, catheters);
                _generation = _loop.Generation;
            }
            for (int k = 0; k < _drawn.Count; k++)
            {
                Drawn drawn = _drawn[k];
                if (drawn.Tube.Write(catheters[k].Positions, catheters[k].Orientations[0],
                    drawn.Times * _wire.DrawnRadius, drawn.Colours))
                {
                    drawn.Mesh.SetVertices(drawn.Tube.Vertices);
                    drawn.Mesh.SetNormals(drawn.Tube.Normals);
                    drawn.Mesh.RecalculateBounds();
                }
                Graphics.DrawMesh(drawn.Mesh, transform.localToWorldMatrix, drawn.Material, 0);
            }
        }

        private void OnDestroy()
        {
            Clear();
        }

        private void Build(SimulationParameters parameters, IReadOnlyList<CoaxialRecord> catheters)
        {
            Clear();
            for (int k = 0; k < catheters.Count; k++)
            {
                var tube = new TubeMesh(catheters[k].Positions.Length, RingsPerElement, Sides);
                var mesh = new Mesh { name = "Catheter", indexFormat = IndexFormat.UInt32 };
                mesh.MarkDynamic();
                mesh.SetVertices(tube.Vertices);
                mesh.SetTriangles(tube.Triangles, 0);
                var material = new Material(_material) { mainTexture = null, color = Colours[k % Colours.Length] };
                _drawn.Add(new Drawn(catheters[k].Positions.Length, tube, mesh, material,
                    (float)(parameters.Scene.Catheters[k].Material.WireRadius / parameters.Material.WireRadius)));
            }
        }

        private void Clear()
        {
            foreach (Drawn drawn in _drawn)
            {
                Destroy(drawn.Mesh);
                Destroy(drawn.Material);
            }
            _drawn.Clear();
        }
    }
}
