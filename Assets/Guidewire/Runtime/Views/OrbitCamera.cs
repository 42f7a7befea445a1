using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>A camera that circles a point: right mouse button turns, wheel zooms.</summary>
    public sealed class OrbitCamera : MonoBehaviour
    {
        [SerializeField] private SimulationLoop _loop = null!;

        [Tooltip("Point at the centre of the view, in units.")]
        [SerializeField] private Vector3 _target;

        [Tooltip("Distance from it, in units.")]
        [SerializeField] private float _distance = 400f;

        [Tooltip("Angle about the vertical axis, in degrees.")]
        [SerializeField] private float _yaw = -90f;

        [Tooltip("Angle above the horizontal plane, in degrees.")]
        [SerializeField, Range(-89f, 89f)] private float _pitch = 20f;

        [Tooltip("Degrees per pixel of mouse motion.")]
        [SerializeField] private float _turnSpeed = 0.3f;

        private Vector3 _lastMouse;
        private bool _hasMouse;

        /// <summary>Whether the tip of the wire is kept in the middle.</summary>
        public bool FollowsTip { get; set; }

        private void Awake()
        {
            _hasMouse = LegacyInput.IsThere();
        }

        private void LateUpdate()
        {
            if (_hasMouse)
            {
                FollowMouse(Input.mousePosition);
            }
            if (FollowsTip && _loop.Session != null)
            {
                RodState state = _loop.Session.Simulation.State;
                Vector3 tip = state.Positions[state.ElementCount].ToUnity();
                _target = tip.IsFinite() ? tip : _target;
            }
            Quaternion rotation = Quaternion.Euler(_pitch, _yaw, 0f);
            transform.position = _target - rotation * Vector3.forward * _distance;
            transform.rotation = rotation;
        }

        private void FollowMouse(Vector3 mouse)
        {
            if (Input.GetMouseButton(1))
            {
                _yaw += _turnSpeed * (mouse.x - _lastMouse.x);
                _pitch = Mathf.Clamp(_pitch - _turnSpeed * (mouse.y - _lastMouse.y), -89f, 89f);
            }
            _lastMouse = mouse;
            _distance = Mathf.Clamp(_distance * Mathf.Exp(-0.1f * Input.mouseScrollDelta.y), 1f, 5000f);
        }
    }
}
