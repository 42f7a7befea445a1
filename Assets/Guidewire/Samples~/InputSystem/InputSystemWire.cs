using Guidewire.Runtime;
using UnityEngine;
using UnityEngine.InputSystem;

/// <summary>Steers the loop of its object by two actions of the Input System, axes from -1 to 1. Their bindings are in
/// the Inspector; without any they are the left stick and W, S, A, D.</summary>
public sealed class InputSystemWire : MonoBehaviour, IWireInput
{
    [SerializeField, Tooltip("Pushes and pulls.")]
    private InputAction _push = new InputAction("push", InputActionType.Value);

    [SerializeField, Tooltip("Turns right and left.")]
    private InputAction _turn = new InputAction("turn", InputActionType.Value);

    /// <inheritdoc/>
    public float Push => _push.ReadValue<float>();

    /// <inheritdoc/>
    public float Turn => _turn.ReadValue<float>();

    private void OnEnable()
    {
        Bind(_push, "<Gamepad>/leftStick/y", "<Keyboard>/s", "<Keyboard>/w");
        Bind(_turn, "<Gamepad>/leftStick/x", "<Keyboard>/a", "<Keyboard>/d");
        _push.Enable();
        _turn.Enable();
    }

    private void OnDisable()
    {
        _push.Disable();
        _turn.Disable();
    }

    private static void Bind(InputAction action, string stick, string negative, string positive)
    {
        if (action.bindings.Count == 0)
        {
            action.AddBinding(stick);
            action.AddCompositeBinding("1DAxis").With("Negative", negative).With("Positive", positive);
        }
    }
}
