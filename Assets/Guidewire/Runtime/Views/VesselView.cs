using System.Collections.Generic;
using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Shows the walls, translucent; one without bounds up to half the wire's length from its middle. Walls
    /// that give way are drawn so near the wire. From outside the far wall is seen through the near one, because a
    /// wall's front is the side that the wire sees.</summary>
    [AddComponentMenu("Guidewire/Vessel View"), Manual("views")]
    public sealed class VesselView : LoopView
    {
        private static readonly Color Flesh = new Color(0.85f, 0.35f, 0.3f, 0.25f);

        [Tooltip("Material of the walls, taken as it is; empty: a transparent one of the pipeline.")]
        [SerializeField] private Material? _material;

        private readonly List<MeshObject> _shown = new List<MeshObject>();
        private readonly List<Mesh> _meshes = new List<Mesh>();
        private readonly List<WallMesh> _walls = new List<WallMesh>();
        private Material? _own;

        /// <summary>The walls' meshes.</summary>
        public IReadOnlyList<Mesh> Meshes => _meshes;

        /// <summary>Material of the walls, taken as it is; null: a transparent one of the pipeline.</summary>
        public Material? Material
        {
            get => _material;
            set => _material = value;
        }

        private void LateUpdate()
        {
            if (IsNewRun())
            {
                Build();
            }
            WireState? shown = Loop == null ? null : Loop.Shown;
            for (int i = 0; i < _meshes.Count; i++)
            {
                if (shown != null && _walls[i].Follow(shown))
                {
                    _meshes[i].SetVertices(_walls[i].Vertices);
                    _meshes[i].RecalculateNormals();
                }
                _shown[i].Show(_material ? _material! : Own(), gameObject.layer);
            }
        }

        private void OnDisable() => _shown.ForEach(shown => shown.Hide());

        private void OnDestroy()
        {
            Clear();
            MeshObject.Destroy(_own);
        }

        private Material Own()
        {
            if (!_own)
            {
                _own = LitMaterial.Create(Flesh);
            }
            return _own!;
        }

        private void Build()
        {
            Clear();
            SimulationLoop? loop = Loop;
            if (loop == null || loop.Description == null)
            {
                return;
            }
            foreach (WallMesh wall in loop.Description.Walls)
            {
                var shown = new MeshObject("Wall", loop, wall.Vertices, wall.Triangles);
                shown.Mesh.RecalculateNormals();
                shown.Mesh.RecalculateBounds();
                _shown.Add(shown);
                _meshes.Add(shown.Mesh);
                _walls.Add(wall);
            }
        }

        private void Clear()
        {
            _shown.ForEach(shown => shown.Destroy());
            _shown.Clear();
            _meshes.Clear();
            _walls.Clear();
        }
    }
}
