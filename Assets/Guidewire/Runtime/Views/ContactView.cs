using System;
using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Shows where the wire touches a wall (balls) and the walls' force on each sphere (sticks). The longest
    /// stick has a fixed length; what it stands for is the largest force of late.</summary>
    public sealed class ContactView : MonoBehaviour
    {
        private const double Fading = 0.99;    // fraction of the largest force that is left a frame later

        [SerializeField] private SimulationLoop _loop = null!;

        [Tooltip("Material of the marks.")]
        [SerializeField] private Material _material = null!;

        [Tooltip("Length of the longest force line, in units.")]
        [SerializeField] private float _length = 40f;

        private Mesh _ball = null!;
        private Material _yellow = null!;
        private int[] _hints = Array.Empty<int>();    // one a wall and element, see ContactShape.Nearest
        private int _generation;
        private double _largest;

        /// <summary>Whether contacts are drawn.</summary>
        [field: SerializeField] public bool IsShown { get; set; } = true;

        private void Awake()
        {
            _ball = Marks.CreateSphere();
            _yellow = Marks.Coloured(_material, 1f, 0.85f, 0.1f);
        }

        private void LateUpdate()
        {
            Simulation? simulation = _loop.Session?.Simulation;
            if (simulation == null || simulation.Contacts == null || !IsShown)
            {
                return;
            }
            SimulationParameters parameters = _loop.Session!.Parameters;
            RodState state = simulation.State;
            if (_generation != _loop.Generation)
            {
                _generation = _loop.Generation;
                _hints = new int[parameters.Scene.Walls.Length * state.ElementCount];
                Array.Fill(_hints, -1);
                _largest = 0.0;
            }
            DrawPoints(state, parameters);
            DrawForces(state, simulation.Contacts.Forces);
        }

        private void OnDestroy()
        {
            Destroy(_ball);
            Destroy(_yellow);
        }

        private void DrawPoints(RodState state, SimulationParameters parameters)
        {
            Matrix4x4 place = transform.localToWorldMatrix;
            double range = parameters.Contact.SphereRadius + parameters.Contact.CollisionMargin;
            float radius = 0.3f * (float)parameters.Contact.SphereRadius;
            for (int k = 0; k < _hints.Length; k++)
            {
                int j = k % state.ElementCount;
                ContactShape wall = parameters.Scene.Walls[k / state.ElementCount];
                Vector3d a = state.Positions[j];
                Vector3d b = state.Positions[j + 1];
                if (wall.Nearest(a, b, range, ref _hints[k], out SurfaceContact contact))
                {
                    Marks.DrawSphere(_ball, place, contact.Point.ToUnity(), radius, _yellow);
                }
            }
        }

        private void DrawForces(RodState state, Vector3d[] forces)
        {
            Matrix4x4 place = transform.localToWorldMatrix;
            _largest *= Fading;
            for (int i = 0; i < forces.Length; i++)
            {
                _largest = Math.Max(_largest, forces[i].Length);
            }
            for (int i = 0; i < forces.Length && _largest > 0.0; i++)
            {
                Vector3 stick = (_length / _largest * forces[i]).ToUnity();
                Marks.DrawStick(_ball, place, state.Positions[i].ToUnity(), stick, 1f, _yellow);
            }
        }
    }
}
