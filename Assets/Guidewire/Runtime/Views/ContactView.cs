using System;
using Guidewire.Core;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Shows where the wire touches a wall (balls) and the walls' force on each sphere (sticks). The longest
    /// stick has a fixed length; what it stands for is the largest force of late.</summary>
    [AddComponentMenu("Guidewire/Contact View"), Manual("views")]
    public sealed class ContactView : LoopView
    {
        private const double Fading = 0.99;    // fraction of the largest force that is left a frame later

        [Tooltip("Material of the marks, taken as it is; empty: a yellow one of the pipeline.")]
        [SerializeField] private Material? _material;

        [Tooltip("Length of the longest force line, in units.")]
        [SerializeField, Min(0f)] private float _length = 40f;

        private Mesh? _ball;
        private Material? _yellow;
        private double _largest;

        /// <summary>Whether contacts are drawn.</summary>
        [field: SerializeField, Tooltip("Whether contacts are drawn.")] public bool IsShown { get; set; } = true;

        /// <summary>Material of the marks, taken as it is; null: a yellow one of the pipeline.</summary>
        public Material? Material
        {
            get => _material;
            set => _material = value;
        }

        /// <summary>Length of the longest force line, in units.</summary>
        public float Length
        {
            get => _length;
            set => _length = value;
        }

        private void LateUpdate()
        {
            bool isNew = IsNewRun();
            WireState? state = Loop == null ? null : Loop.Shown;
            if (state == null || !IsShown)
            {
                return;
            }
            Loop!.WantsContactPoints = true;
            _largest = isNew ? 0.0 : _largest;
            if (!_ball)
            {
                _ball = BallsAndSticks.CreateSphere();
            }
            Material material = _material ? _material! : Yellow();
            DrawPoints(state, 0.3f * (float)Loop.Parameters!.Contact.SphereRadius, material);
            DrawForces(state, material);
        }

        private void OnDestroy()
        {
            MeshObject.Destroy(_ball);
            MeshObject.Destroy(_yellow);
        }

        private Material Yellow() => _yellow ? _yellow! : _yellow = LitMaterial.Create(new Color(1f, 0.85f, 0.1f));

        private void DrawPoints(WireState state, float radius, Material material)
        {
            Matrix4x4 place = Place;
            for (int k = 0; k < state.ContactPointCount; k++)
            {
                BallsAndSticks.DrawSphere(_ball!, place, state.ContactPoints[k].ToUnity(), radius, material,
                    gameObject.layer);
            }
        }

        private void DrawForces(WireState state, Material material)
        {
            Matrix4x4 place = Place;
            Vector3d[] forces = state.ContactForces;
            _largest *= Fading;
            for (int i = 0; i < forces.Length; i++)
            {
                _largest = Math.Max(_largest, forces[i].Length);
            }
            for (int i = 0; i < forces.Length && _largest > 0.0; i++)
            {
                Vector3 stick = (_length / _largest * forces[i]).ToUnity();
                BallsAndSticks.DrawStick(_ball!, place, state.Rod.Positions[i].ToUnity(), stick, 1f, material,
                    gameObject.layer);
            }
        }
    }
}
