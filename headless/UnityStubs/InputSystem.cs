// What this package and its sample call of the Input System.
using System.Collections.Generic;
using UnityEngine.InputSystem.Controls;

namespace UnityEngine.InputSystem
{
    public enum InputActionType
    {
        Value,
        Button,
        PassThrough,
    }

    public struct InputBinding
    {
        public string path { get; set; }
    }

    public static class InputActionSetupExtensions
    {
        public struct BindingSyntax
        {
        }

        public struct CompositeSyntax
        {
            internal InputAction Action;

            public CompositeSyntax With(string name, string binding, string groups = null, string processors = null)
            {
                Action.Paths.Add(new InputBinding { path = binding });
                return this;
            }
        }

        public static BindingSyntax AddBinding(this InputAction action, string path, string interactions = null,
            string processors = null, string groups = null)
        {
            action.Paths.Add(new InputBinding { path = path });
            return default;
        }

        public static CompositeSyntax AddCompositeBinding(this InputAction action, string composite,
            string interactions = null, string processors = null) => new CompositeSyntax { Action = action };
    }

    [System.Serializable]
    public sealed class InputAction
    {
        internal readonly List<InputBinding> Paths = new List<InputBinding>();

        public InputAction(string name = null, InputActionType type = InputActionType.Value, string binding = null)
        {
        }

        public IReadOnlyList<InputBinding> bindings => Paths;

        public bool enabled { get; private set; }

        /// <summary>What the device says, for the test.</summary>
        public float Value { get; set; }

        public void Enable() => enabled = true;

        public void Disable() => enabled = false;

        public TValue ReadValue<TValue>()
            where TValue : struct => (TValue)(object)(enabled ? Value : 0f);
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
