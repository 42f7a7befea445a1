using System;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Keys for the two directions of an axis.</summary>
    [Serializable]
    public sealed class KeyAxis
    {
        [SerializeField] private KeyCode _up;
        [SerializeField] private KeyCode _alsoUp;
        [SerializeField] private KeyCode _down;
        [SerializeField] private KeyCode _alsoDown;

        /// <summary>Two keys for each direction; None for none.</summary>
        public KeyAxis(KeyCode up, KeyCode alsoUp, KeyCode down, KeyCode alsoDown)
        {
            _up = up;
            _alsoUp = alsoUp;
            _down = down;
            _alsoDown = alsoDown;
        }

        /// <summary>1 or -1 while a key of that direction is down, 0 with none or both.</summary>
        public float Value => (IsHeld(_up, _alsoUp) ? 1f : 0f) - (IsHeld(_down, _alsoDown) ? 1f : 0f);

        private static bool IsHeld(KeyCode key, KeyCode other)
        {
            return Input.GetKey(key) || Input.GetKey(other);
        }
    }
}
