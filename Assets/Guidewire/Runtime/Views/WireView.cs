using System;
using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Shows the wire as one tube, its catheters as others, and where asked for its spheres and directors.
    /// Meshes are made when a wire is built and rewritten after that.</summary>
    [ExecuteAlways]    // the editor has it draw the wire at its start
    [AddComponentMenu("Guidewire/Wire View"), Manual("views")]
    public sealed class WireView : LoopView
    {
        private const double ThinnestOfLength = 1.0 / 300.0;

        [Tooltip("Material of the plain wire, taken as it is; empty: a lit one of the pipeline.")]
        [SerializeField] private Material? _material;

        [Tooltip("Material of catheters, taken as it is; empty: transparent ones of the pipeline.")]
        [SerializeField] private Material? _catheterMaterial;

        [Tooltip("Rings per element.")]
        [SerializeField, Range(1, 16)] private int _ringsPerElement = 4;

        [Tooltip("Vertices per ring.")]
        [SerializeField, Range(3, 32)] private int _sides = 12;

        [Tooltip("Radius of the tube over sphereRadius, or over the radius of a wire with a material.")]
        [SerializeField, Range(0.05f, 1f)] private float _thickness = 1f;

        [Tooltip("What the colour of the wire shows.")]
        [SerializeField] private Colouring _colouring = Colouring.Plain;

        [Tooltip("Stretch at the end of the colour scale, dimensionless.")]
        [SerializeField, Min(0f)] private float _stretchRange = 0.02f;

        [Tooltip("Curvature at the end of the colour scale, in 1/unit.")]
        [SerializeField, Min(0f)] private float _bendingRange = 0.02f;

        [Tooltip("Twist at the end of the colour scale, in rad/unit.")]
        [SerializeField, Min(0f)] private float _twistRange = 0.02f;

        private readonly CatheterTubes _catheters = new CatheterTubes();
        private TubeMesh? _tube;
        private MeshObject? _object;
        private Mesh? _ball;
        private Material? _coloured;
        private Texture2D? _map;
        private Material[] _directors = Array.Empty<Material>();
        private float[] _colours = Array.Empty<float>();

        /// <summary>Whether the spheres are drawn.</summary>
        [field: SerializeField, Tooltip("Whether the spheres are drawn.")] public bool ShowsSpheres { get; set; }

        /// <summary>Whether the directors are drawn: d1 red, d2 green, d3 blue.</summary>
        [field: SerializeField, Tooltip("Whether the directors are drawn: d1 red, d2 green, d3 blue.")]
        public bool ShowsDirectors { get; set; }

        /// <summary>What the colour shows.</summary>
        public Colouring Colouring
        {
            get => _colouring;
            set => _colouring = value;
        }

        /// <summary>Material of the plain wire, taken as it is; null: a lit one of the pipeline.</summary>
        public Material? Material
        {
            get => _material;
            set => _material = value;
        }

        /// <summary>Material of catheters, taken as it is; null: transparent ones of the pipeline.</summary>
        public Material? CatheterMaterial
        {
            get => _catheterMaterial;
            set => _catheterMaterial = value;
        }

        /// <summary>Radius of the tube over sphereRadius, or over the radius of a wire with a material.</summary>
        public float Thickness
        {
            get => _thickness;
            set => _thickness = value;
        }

        /// <summary>The value of the last colour.</summary>
        public float Range => _colouring == Colouring.Stretch ? _stretchRange
            : _colouring == Colouring.Bending ? _bendingRange : _twistRange;

        /// <summary>Radius that the wire is drawn with, units.</summary>
        internal float DrawnRadius { get; private set; }

        /// <summary>The tube as it was last drawn, or null before the first wire.</summary>
        internal TubeMesh? Tube => _tube;

        /// <summary>The mesh of the wire's tube, in units of the loop's frame; null before the first wire. It is
        /// rewritten each frame.</summary>
        public Mesh? Mesh => _object?.Mesh;

        /// <summary>The renderer of that mesh, such as for its shadows; null before the first wire.</summary>
        public MeshRenderer? Renderer => _object?.Renderer;

        /// <summary>The tubes of the catheters.</summary>
        internal CatheterTubes Catheters => _catheters;

        /// <summary>Shows the next of plain, stretch, bending, twist.</summary>
        public void NextColouring() => _colouring = (Colouring)(((int)_colouring + 1) % 4);

        /// <summary>Draws the wire as this frame has it.</summary>
        public void Draw()
        {
            bool isNew = IsNewRun();
            WireState? state = Loop == null ? null : Loop.Shown;
            if (state == null)
            {
                Hide();
                return;
            }
            Draw(Loop!, state, Loop!.Parameters!, isNew);
        }

        /// <summary>Draws a wire at its start, in Edit Mode; null: none can be built.</summary>
        internal void DrawStart(WireState? start, SimulationParameters? parameters)
        {
            if (Loop != null && isActiveAndEnabled && start != null)
            {
                Draw(Loop, start, parameters!, _catheters.Count != start.Catheters.Count);
            }
            else
            {
                OnDestroy();
            }
        }

        private void Draw(SimulationLoop loop, WireState state, SimulationParameters parameters, bool isNew)
        {
            float radius = _thickness * (float)Radius(parameters);
            DrawnRadius = radius;
            if (isNew || _tube == null || _object == null || _tube.Spheres != state.Rod.SphereCount)
            {
                Build(loop, state.Rod);
                _catheters.Build(loop, parameters, state.Catheters);
            }
            for (int i = 0; i < _colours.Length; i++)
            {
                _colours[i] = ColourMap.Coordinate(Value(state.Rod, i), Range);
            }
            if (_tube!.Write(state.Rod, ShowsSpheres ? 0.5f * radius : radius, _colours))
            {
                Mesh!.SetVertices(_tube.Vertices);
                Mesh.SetNormals(_tube.Normals);
                Mesh.SetUVs(0, _tube.Colours);
                Mesh.RecalculateBounds();
            }
            Material wire = _colouring == Colouring.Plain && _material ? _material! : Coloured();
            _object!.Show(wire, gameObject.layer);
            if (ShowsSpheres)
            {
                DrawSpheres(state.Rod, radius, wire);
            }
            if (ShowsDirectors)
            {
                DrawDirectors(state.Rod, radius);
            }
            _catheters.Draw(state.Catheters, radius, _catheterMaterial, gameObject.layer);
        }

        private void LateUpdate() => Draw();

        private void OnDisable()
        {
            Hide();
            if (!Application.isPlaying)
            {
                OnDestroy();
            }
        }

        // In Edit Mode the editor says what is shown.
        private void Hide()
        {
            if (Application.isPlaying)
            {
                _object?.Hide();
                _catheters.Hide();
            }
        }

        private void OnDestroy()
        {
            MeshObject.Destroy(_map);
            MeshObject.Destroy(_coloured);
            MeshObject.Destroy(_ball);
            Array.ForEach(_directors, MeshObject.Destroy);
            _directors = Array.Empty<Material>();
            _object?.Destroy();
            _object = null;
            _catheters.Clear();
        }

        private void Build(SimulationLoop loop, RodState state)
        {
            _object?.Destroy();
            _tube = new TubeMesh(state.SphereCount, _ringsPerElement, _sides);
            _colours = new float[state.SphereCount];
            _object = new MeshObject("Wire", loop, _tube.Vertices, _tube.Triangles);
        }

        // Made when it is first needed: a view may be told its material after it was added.
        private Material Coloured()
        {
            if (!_coloured)
            {
                _map = ColourMap.Create();
                _coloured = LitMaterial.Create(new Color(1f, 1f, 1f));
                LitMaterial.SetTexture(_coloured, _map);
            }
            return _coloured!;
        }

        private double Value(RodState state, int i)
        {
            switch (_colouring)
            {
                case Colouring.Stretch:
                    return RodStrain.Stretch(state, i);
                case Colouring.Bending:
                    return RodStrain.Curvature(state, i);
                case Colouring.Twist:
                    return RodStrain.Twist(state, i);
                default:
                    return 0.0;
            }
        }

        // What meets walls, units; of a material at least so much that it is seen.
        private static double Radius(SimulationParameters parameters)
        {
            if (!MethodTable.Of(parameters.Method.Solver).TakesMaterial)
            {
                return parameters.Contact.SphereRadius;
            }
            double own = parameters.Material.WireRadius / parameters.Scene.MetresPerUnit;
            return Math.Max(own, ThinnestOfLength * parameters.Scene.GuidewireLength);
        }

        private Mesh Ball()
        {
            if (!_ball)
            {
                _ball = BallsAndSticks.CreateSphere();
            }
            return _ball!;
        }

        private void DrawSpheres(RodState state, float radius, Material material)
        {
            for (int i = 0; i < state.SphereCount; i++)
            {
                BallsAndSticks.DrawSphere(Ball(), Place, state.Positions[i].ToUnity(), radius, material,
                    gameObject.layer);
            }
        }

        private void DrawDirectors(RodState state, float radius)
        {
            if (_directors.Length == 0)
            {
                _directors = new[]
                {
                    LitMaterial.Create(new Color(0.9f, 0.2f, 0.2f)), LitMaterial.Create(new Color(0.2f, 0.8f, 0.3f)),
                    LitMaterial.Create(new Color(0.3f, 0.4f, 0.9f)),
                };
            }
            Matrix4x4 place = Place;
            int layer = gameObject.layer;
            float length = radius + 0.5f * (float)state.ElementLength;
            for (int j = 0; j < state.ElementCount; j++)
            {
                Vector3 middle = (0.5 * (state.Positions[j] + state.Positions[j + 1])).ToUnity();
                Quaterniond q = state.Orientations[j];
                for (int k = 0; k < 3; k++)
                {
                    Vector3d director = k == 0 ? q.Director1 : k == 1 ? q.Director2 : q.Director3;
                    BallsAndSticks.DrawStick(Ball(), place, middle, length * director.ToUnity(), 0.1f * radius,
                        _directors[k], layer);
                }
            }
        }
    }
}
