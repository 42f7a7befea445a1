using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>A camera that circles a point of a loop's frame: right mouse button turns, wheel zooms. Lengths are the
    /// wire's units, wherever the loop's object stands and however it is scaled.</summary>
    [AddComponentMenu("Guidewire/Orbit Camera"), Manual("views")]
    public sealed class OrbitCamera : LoopView
    {
        private const float NearClip = 0.02f;    // of the distance: a scene in metres has millimetres of wire before it

        [Tooltip("Point at the centre of the view, in units.")]
        [SerializeField] private Vector3 _target;

        [Tooltip("Distance from it, in units.")]
        [SerializeField, Min(1f)] private float _distance = 400f;

        [Tooltip("Angle about the vertical axis, in degrees.")]
        [SerializeField, Range(-360f, 360f)] private float _yaw = -90f;

        [Tooltip("Angle above the horizontal plane, in degrees.")]
        [SerializeField, Range(-89f, 89f)] private float _pitch = 20f;

        [Tooltip("Degrees per pixel of mouse motion.")]
        [SerializeField, Min(0f)] private float _turnSpeed = 0.3f;

        private HostInput _input;
        private Vector2 _lastMouse;

        /// <summary>Whether the tip of the wire is kept in the middle.</summary>
        [field: SerializeField, Tooltip("Whether the tip of the wire is kept in the middle.")]
        public bool FollowsTip { get; set; }

        /// <summary>Point at the centre of the view, in units of the loop's frame.</summary>
        public Vector3 Target
        {
            get => _target;
            set => _target = value;
        }

        /// <summary>Distance from it, in units.</summary>
        public float Distance
        {
            get => _distance;
            set => _distance = value;
        }

        private void OnEnable() => _input = HostInput.Find();

        private void LateUpdate()
        {
            FollowMouse(_input.Mouse);
            SimulationLoop? loop = Loop;
            if (FollowsTip && loop != null && loop.Shown != null)
            {
                RodState state = loop.Shown.Rod;
                Vector3 tip = state.Positions[state.ElementCount].ToUnity();
                _target = tip.IsFinite() ? tip : _target;
            }
            Look(loop);
        }

        /// <summary>Puts the camera where it looks from.</summary>
        internal void Look() => Look(Loop);

        private void Look(SimulationLoop? loop)
        {
            Quaternion rotation = Quaternion.Euler(_pitch, _yaw, 0f);
            Vector3 middle = loop == null ? _target : loop.transform.TransformPoint(_target);
            float unit = loop == null ? 1f : loop.transform.lossyScale.magnitude / Vector3.one.magnitude;
            transform.position = middle - rotation * Vector3.forward * (_distance * unit);
            transform.rotation = rotation;
            if (TryGetComponent(out Camera own))
            {
                own.nearClipPlane = Mathf.Min(own.nearClipPlane, NearClip * _distance * unit);
            }
        }

        private void FollowMouse(Vector2 mouse)
        {
            if (_input.IsRightButtonDown)
            {
                _yaw += _turnSpeed * (mouse.x - _lastMouse.x);
                _pitch = Mathf.Clamp(_pitch - _turnSpeed * (mouse.y - _lastMouse.y), -89f, 89f);
            }
            _lastMouse = mouse;
            _distance = Mathf.Clamp(_distance * Mathf.Exp(-0.1f * _input.Wheel), 1f, 5000f);
        }
    }
}
