using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Keeps its object at a place of the wire, forward along it. A Rigidbody of the object becomes kinematic:
    /// it pushes others and the wire feels nothing of it.</summary>
    [AddComponentMenu("Guidewire/Wire Attachment"), Manual("coupling")]
    public sealed class WireAttachment : LoopView
    {
        [Tooltip("Where along the wire: 0 the hub, 1 the tip.")]
        [SerializeField, Range(0f, 1f)] private float _place = 1f;

        /// <summary>Where along the wire: 0 the hub, 1 the tip.</summary>
        public float PlaceAlongWire { get => _place; set => _place = value; }

        private void FixedUpdate()
        {
            if (TryGetComponent(out Rigidbody body) && Find(out Vector3 position, out Quaternion rotation))
            {
                body.isKinematic = true;
                body.MovePosition(position);
                body.MoveRotation(rotation);
            }
        }

        private void LateUpdate()
        {
            if (!TryGetComponent(out Rigidbody _) && Find(out Vector3 position, out Quaternion rotation))
            {
                transform.position = position;
                transform.rotation = rotation;
            }
        }

        private bool Find(out Vector3 position, out Quaternion rotation)
        {
            (position, rotation) = (Vector3.zero, Quaternion.identity);
            if (Loop == null || Loop.Shown == null)
            {
                return false;
            }
            RodState wire = Loop.Shown.Rod;
            float along = Mathf.Clamp(_place, 0f, 1f) * wire.ElementCount;
            int element = System.Math.Min((int)along, wire.ElementCount - 1);
            Vector3d point = Vector3d.Lerp(wire.Positions[element], wire.Positions[element + 1], along - element);
            position = Loop.transform.TransformPoint(point.ToUnity());
            rotation = Loop.transform.rotation * wire.Orientations[element].ToUnity();
            return position.IsFinite();
        }
    }
}
