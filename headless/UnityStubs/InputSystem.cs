// What this package and its sample call of the Input System.
using UnityEngine.InputSystem.Controls;

namespace UnityEngine.InputSystem
{
    public sealed class InputAction
    {
        public bool enabled { get; private set; }

        /// <summary>What the device says, for the test.</summary>
        public float Value { get; set; }

        public void Enable() => enabled = true;

        public void Disable() => enabled = false;

        public TValue ReadValue<TValue>()
            where TValue : struct => (TValue)(object)(enabled ? Value : 0f);
    }

    public class InputActionReference : ScriptableObject
    {
        public InputAction action { get; } = new InputAction();
    }

    public enum Key
    {
        None = 0,
        Space = 1,
        A = 15,
        Z = 40,
        LeftArrow = 61,
        RightArrow = 62,
        UpArrow = 63,
        DownArrow = 64,
    }

    public class Keyboard
    {
        private readonly KeyControl[] _keys = new KeyControl[128];

        public static Keyboard current { get; internal set; }

        public KeyControl this[Key key] => _keys[(int)key] ??= new KeyControl();
    }

    public class Mouse
    {
        public static Mouse current { get; internal set; }

        public Vector2Control position { get; } = new Vector2Control();

        public DeltaControl scroll { get; } = new DeltaControl();

        public ButtonControl rightButton { get; } = new ButtonControl();
    }
}

namespace UnityEngine.InputSystem.Controls
{
    public class ButtonControl
    {
        public bool isPressed { get; internal set; }

        public bool wasPressedThisFrame { get; internal set; }
    }

    public class KeyControl : ButtonControl
    {
    }

    public class Vector2Control
    {
        internal Vector2 Value;

        public Vector2 ReadValue() => Value;
    }

    public class DeltaControl : Vector2Control
    {
    }
}
