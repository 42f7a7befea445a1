// What the sample for the Input System calls of that package.
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
            where TValue : struct
        {
            return (TValue)(object)(enabled ? Value : 0f);
        }
    }

    public class InputActionReference : ScriptableObject
    {
        public InputAction action { get; } = new InputAction();
    }
}
