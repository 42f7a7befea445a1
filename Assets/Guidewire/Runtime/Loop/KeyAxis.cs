using System;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Keys for the two directions of an axis.</summary>
    [Serializable]
    public sealed class KeyAxis
    {
        [SerializeField, Tooltip("Push, or turn right.")] private KeyCode _up;
        [SerializeField, Tooltip("Another key for it.")] private KeyCode _alsoUp;
        [SerializeField, Tooltip("Pull, or turn left.")] private KeyCode _down;
        [SerializeField, Tooltip("Another key for it.")] private KeyCode _alsoDown;

        /// <summary>Makes two keys for each direction; None for none.</summary>
        public KeyAxis(KeyCode up, KeyCode alsoUp, KeyCode down, KeyCode alsoDown)
        {
            _up = up;
            _alsoUp = alsoUp;
            _down = down;
            _alsoDown = alsoDown;
        }

        /// <summary>1 or -1 while a key of that direction is down, 0 with none or both.</summary>
        internal float Value(in HostInput input)
        {
            return (input.IsHeld(_up) || input.IsHeld(_alsoUp) ? 1f : 0f)
                - (input.IsHeld(_down) || input.IsHeld(_alsoDown) ? 1f : 0f);
        }
    }
}
