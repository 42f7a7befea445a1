#if GUIDEWIRE_INPUT_SYSTEM && ENABLE_INPUT_SYSTEM
#define HAS_INPUT_SYSTEM
#endif
using System;
using UnityEngine;
#if HAS_INPUT_SYSTEM
using UnityEngine.InputSystem;
using UnityEngine.InputSystem.Controls;
#endif

namespace Guidewire.Runtime
{
    /// <summary>Keys and mouse from whatever the project reads them with: the Input Manager where it is active, else
    /// the Input System package, else nothing. Never throws.</summary>
    /// <remarks>Where the Player settings leave input to that package alone, every call of Unity's Input throws. The
    /// setting cannot change while the project plays, so it is asked for once, by whoever needs it.</remarks>
    public readonly struct HostInput
    {
        private readonly bool _isLegacy;

        private HostInput(bool isLegacy)
        {
            _isLegacy = isLegacy;
        }

        /// <summary>Finds out what there is.</summary>
        public static HostInput Find()
        {
#if ENABLE_LEGACY_INPUT_MANAGER
            try
            {
                Input.GetKey(KeyCode.Space);
                return new HostInput(true);
            }
            catch (InvalidOperationException)
            {
                return default;
            }
#else
            return default;
#endif
        }

        /// <summary>Whether keys are reported at all.</summary>
        public bool IsThere =>
#if HAS_INPUT_SYSTEM
            _isLegacy || Keyboard.current != null;
#else
            _isLegacy;
#endif

        /// <summary>Where the mouse is, pixels.</summary>
        public Vector2 Mouse
        {
            get
            {
#if ENABLE_LEGACY_INPUT_MANAGER
                if (_isLegacy)
                {
                    Vector3 position = Input.mousePosition;
                    return new Vector2(position.x, position.y);
                }
#endif
#if HAS_INPUT_SYSTEM
                if (UnityEngine.InputSystem.Mouse.current != null)
                {
                    return UnityEngine.InputSystem.Mouse.current.position.ReadValue();
                }
#endif
                return default;
            }
        }

        /// <summary>How far the wheel was turned in this frame, notches.</summary>
        public float Wheel
        {
            get
            {
#if ENABLE_LEGACY_INPUT_MANAGER
                if (_isLegacy)
                {
                    return Input.mouseScrollDelta.y;
                }
#endif
#if HAS_INPUT_SYSTEM
                if (UnityEngine.InputSystem.Mouse.current != null)
                {
                    // One notch a frame: platforms scale it differently.
                    return Mathf.Clamp(UnityEngine.InputSystem.Mouse.current.scroll.ReadValue().y, -1f, 1f);
                }
#endif
                return 0f;
            }
        }

        /// <summary>Whether the right mouse button is down.</summary>
        public bool IsRightButtonDown
        {
            get
            {
#if ENABLE_LEGACY_INPUT_MANAGER
                if (_isLegacy)
                {
                    return Input.GetMouseButton(1);
                }
#endif
#if HAS_INPUT_SYSTEM
                return UnityEngine.InputSystem.Mouse.current != null
                    && UnityEngine.InputSystem.Mouse.current.rightButton.isPressed;
#else
                return false;
#endif
            }
        }

        /// <summary>Whether a key is down.</summary>
        public bool IsHeld(KeyCode key)
        {
#if ENABLE_LEGACY_INPUT_MANAGER
            if (_isLegacy)
            {
                return Input.GetKey(key);
            }
#endif
#if HAS_INPUT_SYSTEM
            KeyControl? control = ControlOf(key);
            return control != null && control.isPressed;
#else
            return false;
#endif
        }

        /// <summary>Says whether a key went down in this frame.</summary>
        public bool WasPressed(KeyCode key)
        {
#if ENABLE_LEGACY_INPUT_MANAGER
            if (_isLegacy)
            {
                return Input.GetKeyDown(key);
            }
#endif
#if HAS_INPUT_SYSTEM
            KeyControl? control = ControlOf(key);
            return control != null && control.wasPressedThisFrame;
#else
            return false;
#endif
        }

#if HAS_INPUT_SYSTEM
        // Letters, the space bar and arrows: what this package uses by itself.
        private static KeyControl? ControlOf(KeyCode key)
        {
            if (Keyboard.current == null)
            {
                return null;
            }
            if (key >= KeyCode.A && key <= KeyCode.Z)
            {
                return Keyboard.current[Key.A + (key - KeyCode.A)];
            }
            switch (key)
            {
                case KeyCode.Space:
                    return Keyboard.current[Key.Space];
                case KeyCode.UpArrow:
                    return Keyboard.current[Key.UpArrow];
                case KeyCode.DownArrow:
                    return Keyboard.current[Key.DownArrow];
                case KeyCode.LeftArrow:
                    return Keyboard.current[Key.LeftArrow];
                case KeyCode.RightArrow:
                    return Keyboard.current[Key.RightArrow];
                default:
                    return null;
            }
        }
#endif
    }
}
