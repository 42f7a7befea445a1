using System.Collections.Generic;
using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>The catheters over a wire as a tube each, in a colour of its own through which the wire is seen. Meshes
    /// are made when a run is built, and rewritten.</summary>
    internal sealed class CatheterTubes
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

        private sealed class Drawn
        {
            private readonly Color _colour;
            private Material? _material;    // made when it is first needed

            public Drawn(SimulationLoop loop, int spheres, in Color colour, float times)
            {
                Tube = new TubeMesh(spheres, RingsPerElement, Sides);
                Object = new MeshObject("Catheter", loop, Tube.Vertices, Tube.Triangles);
                _colour = colour;
                Times = times;
                Colours = new float[spheres];
            }

            public TubeMesh Tube { get; }

            public MeshObject Object { get; }

            public Material Material => _material ? _material! : _material = LitMaterial.Create(_colour);

            public void Destroy()
            {
                Object.Destroy();
                MeshObject.Destroy(_material);
            }

            // In the colour map, which its material does not have.
            public float[] Colours { get; }

            // Its radius over the wire's.
            public float Times { get; }
        }

        /// <summary>How many catheters are drawn.</summary>
        public int Count => _drawn.Count;

        /// <summary>The tube of a catheter as it was last drawn.</summary>
        public TubeMesh TubeOf(int catheter) => _drawn[catheter].Tube;

        /// <summary>Makes the meshes of another run.</summary>
        public void Build(SimulationLoop loop, SimulationParameters parameters,
            IReadOnlyList<CatheterState> catheters)
        {
            Clear();
            for (int k = 0; k < catheters.Count; k++)
            {
                _drawn.Add(new Drawn(loop, catheters[k].Positions.Length, Colours[k % Colours.Length],
                    (float)(parameters.Scene.Catheters[k].Material.WireRadius / parameters.Material.WireRadius)));
            }
        }

        /// <summary>Draws the catheters.</summary>
        /// <param name="radius">That the wire is drawn with, units.</param>
        /// <param name="material">Instead of their own, or null.</param>
        public void Draw(IReadOnlyList<CatheterState> catheters, float radius, Material? material, int layer)
        {
            for (int k = 0; k < _drawn.Count; k++)
            {
                Drawn drawn = _drawn[k];
                if (drawn.Tube.Write(catheters[k].Positions, catheters[k].Orientations[0], drawn.Times * radius,
                    drawn.Colours))
                {
                    drawn.Object.Mesh.SetVertices(drawn.Tube.Vertices);
                    drawn.Object.Mesh.SetNormals(drawn.Tube.Normals);
                    drawn.Object.Mesh.RecalculateBounds();
                }
                drawn.Object.Show(material ? material! : drawn.Material, layer);
            }
        }

        /// <summary>Hides them until they are drawn again.</summary>
        public void Hide() => _drawn.ForEach(drawn => drawn.Object.Hide());

        /// <summary>Destroys the meshes.</summary>
        public void Clear()
        {
            foreach (Drawn drawn in _drawn)
            {
                drawn.Destroy();
            }
            _drawn.Clear();
        }
    }
}
