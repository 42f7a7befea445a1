using Guidewire.Core;
using UnityEngine;
using UnityEngine.Events;

namespace Guidewire.Runtime
{
    /// <summary>Calls what the Inspector lists when the wire touches a wall, leaves it, comes to its target or ends its
    /// run.</summary>
    [AddComponentMenu("Guidewire/Wire Events"), Manual("events")]
    public sealed class WireEvents : LoopView
    {
        [Tooltip("A wall has begun to act on a sphere: where, with which force, which vessel.")]
        [SerializeField] private UnityEvent<WireContact> _contactBegan = new UnityEvent<WireContact>();

        [Tooltip("A wall has ceased to act on a sphere.")]
        [SerializeField] private UnityEvent<WireContact> _contactEnded = new UnityEvent<WireContact>();

        [Tooltip("The tip has come to the target of the vessel: its place in the world.")]
        [SerializeField] private UnityEvent<Vector3> _targetReached = new UnityEvent<Vector3>();

        [Tooltip("The run has ended by itself: how and why, in one line.")]
        [SerializeField] private UnityEvent<string> _ended = new UnityEvent<string>();

        private SimulationLoop? _listened;

        /// <summary>A wall has begun to act on a sphere.</summary>
        public UnityEvent<WireContact> ContactBegan => _contactBegan;

        /// <summary>A wall has ceased to act on a sphere.</summary>
        public UnityEvent<WireContact> ContactEnded => _contactEnded;

        /// <summary>The tip has come to the target of the vessel.</summary>
        public UnityEvent<Vector3> TargetReached => _targetReached;

        /// <summary>The run has ended by itself.</summary>
        public UnityEvent<string> Ended => _ended;

        private void OnEnable() => Listen(Loop);

        private void OnDisable() => Listen(null);

        private void Update()
        {
            if (Loop != _listened)
            {
                Listen(Loop);
            }
        }

        private void Listen(SimulationLoop? loop)
        {
            if (_listened is { } before)
            {
                before.ContactBegan -= _contactBegan.Invoke;
                before.ContactEnded -= _contactEnded.Invoke;
                before.TargetReached -= _targetReached.Invoke;
                before.Ended -= End;
            }
            _listened = loop;
            if (loop != null)
            {
                loop.ContactBegan += _contactBegan.Invoke;
                loop.ContactEnded += _contactEnded.Invoke;
                loop.TargetReached += _targetReached.Invoke;
                loop.Ended += End;
            }
        }

        private void End(Outcome outcome, string reason) =>
            _ended.Invoke(outcome.ToString().ToLowerInvariant() + ": " + reason);
    }
}
