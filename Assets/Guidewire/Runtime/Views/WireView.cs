using Guidewire.Core;
using Guidewire.Io;
using UnityEngine;
using UnityEngine.Rendering;

namespace Guidewire.Runtime
{
    /// <summary>Shows the wire as one tube, and where asked for its spheres and directors. Meshes are made when a wire
    /// is built and rewritten after that. All is drawn at this object's transform: it stands on the loop's object, or
    /// below it.</summary>
    public sealed class WireView : MonoBehaviour
    {
        [SerializeField] private SimulationLoop _loop = null!;

        [Tooltip("Material of the tube; its texture becomes the colour map.")]
        [SerializeField] private Material _material = null!;

        [Tooltip("Transparent material of catheters, so that the wire inside is visible.")]
        [SerializeField] private Material _catheterMaterial = null!;

        [Tooltip("Rings per element.")]
        [SerializeField, Range(1, 16)] private int _ringsPerElement = 4;

        [Tooltip("Vertices per ring.")]
        [SerializeField, Range(3, 32)] private int _sides = 12;

        private const double ThinnestOfLength = 1.0 / 300.0;

        [Tooltip("Radius of the tube over sphereRadius, or over the radius of a wire with a material.")]
        [SerializeField, Range(0.05f, 1f)] private float _thickness = 1f;

        [SerializeField] private Colouring _colouring = Colouring.Plain;

        [Tooltip("Stretch at the end of the colour scale, dimensionless.")]
        [SerializeField] private float _stretchRange = 0.02f;

        [Tooltip("Curvature at the end of the colour scale, in 1/unit.")]
        [SerializeField] private float _bendingRange = 0.02f;

        [Tooltip("Twist at the end of the colour scale, in rad/unit.")]
        [SerializeField] private float _twistRange = 0.02f;

        private TubeMesh _tube = null!;
        private Mesh _mesh = null!;
        private Mesh _ball = null!;
        private Material _coloured = null!;
        private Material[] _directors = null!;
        private float[] _colours = null!;
        private CatheterView _catheters = null!;
        private int _generation;

        /// <summary>Whether the spheres are drawn.</summary>
        [field: SerializeField] public bool ShowsSpheres { get; set; }

        /// <summary>Whether the directors are drawn: d1 red, d2 green, d3 blue.</summary>
        [field: SerializeField] public bool ShowsDirectors { get; set; }

        /// <summary>What the colour shows.</summary>
        public Colouring Colouring => _colouring;

        /// <summary>The value of the last colour.</summary>
        public float Range => _colouring == Colouring.Stretch ? _stretchRange
            : _colouring == Colouring.Bending ? _bendingRange : _twistRange;

        /// <summary>Radius that the wire is drawn with, units.</summary>
        internal float DrawnRadius { get; private set; }

        /// <summary>The tube as it was last drawn, or null before the first wire.</summary>
        internal TubeMesh? Tube => _tube;

        /// <summary>Shows the next of plain, stretch, bending, twist.</summary>
        public void NextColouring()
        {
            _colouring = (Colouring)(((int)_colouring + 1) % 4);
        }

        /// <summary>Draws the wire as it is now.</summary>
        public void Draw()
        {
            SimulationSession? session = _loop.Session;
            if (session == null)
            {
                return;
            }
            RodState state = session.Simulation.State;
            float radius = _thickness * (float)Radius(session.Parameters);
            DrawnRadius = radius;
            if (_generation != _loop.Generation)
            {
                Build(state);
                _generation = _loop.Generation;
            }
            for (int i = 0; i < _colours.Length; i++)
            {
                _colours[i] = ColourMap.Coordinate(Value(state, i), Range);
            }
            if (_tube.Write(state, ShowsSpheres ? 0.5f * radius : radius, _colours))
            {
                _mesh.SetVertices(_tube.Vertices);
                _mesh.SetNormals(_tube.Normals);
                _mesh.SetUVs(0, _tube.Colours);
                _mesh.RecalculateBounds();
            }
            if (ShowsSpheres)
            {
                DrawSpheres(state, radius);
            }
            if (ShowsDirectors)
            {
                DrawDirectors(state, radius);
            }
            _catheters.Draw();
        }

        private void Awake()
        {
            _coloured = new Material(_material) { mainTexture = ColourMap.Create() };
            _directors = new[]
            {
                Marks.Coloured(_material, 0.9f, 0.2f, 0.2f), Marks.Coloured(_material, 0.2f, 0.8f, 0.3f),
                Marks.Coloured(_material, 0.3f, 0.4f, 0.9f),
            };
            _ball = Marks.CreateSphere();
            _catheters = gameObject.AddComponent<CatheterView>();
            _catheters.Begin(_loop, this, _catheterMaterial);
            gameObject.AddComponent<MeshFilter>();
            gameObject.AddComponent<MeshRenderer>().sharedMaterial = _coloured;
        }

        private void LateUpdate()
        {
            Draw();
        }

        private void OnDestroy()
        {
            Destroy(_coloured.mainTexture);
            Destroy(_coloured);
            Destroy(_ball);
            Destroy(_mesh);
            foreach (Material material in _directors)
            {
                Destroy(material);
            }
        }

        private void Build(RodState state)
        {
            Destroy(_mesh);
            _tube = new TubeMesh(state.SphereCount, _ringsPerElement, _sides);
            _colours = new float[state.SphereCount];
            _mesh = new Mesh { name = "Wire", indexFormat = IndexFormat.UInt32 };
            _mesh.MarkDynamic();
            _mesh.SetVertices(_tube.Vertices);
            _mesh.SetTriangles(_tube.Triangles, 0);
            GetComponent<MeshFilter>().sharedMesh = _mesh;
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
            return System.Math.Max(own, ThinnestOfLength * parameters.Scene.GuidewireLength);
        }

        private void DrawSpheres(RodState state, float radius)
        {
            Matrix4x4 place = transform.localToWorldMatrix;
            for (int i = 0; i < state.SphereCount; i++)
            {
                Marks.DrawSphere(_ball, place, state.Positions[i].ToUnity(), radius, _coloured);
            }
        }

        private void DrawDirectors(RodState state, float radius)
        {
            Matrix4x4 place = transform.localToWorldMatrix;
            float length = radius + 0.5f * (float)state.ElementLength;
            for (int j = 0; j < state.ElementCount; j++)
            {
                Vector3 middle = (0.5 * (state.Positions[j] + state.Positions[j + 1])).ToUnity();
                Quaterniond q = state.Orientations[j];
                Marks.DrawStick(_ball, place, middle, length * q.Director1.ToUnity(), 0.1f * radius, _directors[0]);
                Marks.DrawStick(_ball, place, middle, length * q.Director2.ToUnity(), 0.1f * radius, _directors[1]);
                Marks.DrawStick(_ball, place, middle, length * q.Director3.ToUnity(), 0.1f * radius, _directors[2]);
            }
        }
    }
}
