using Guidewire.Runtime;
using UnityEngine;
using UnityEngine.InputSystem;

/// <summary>Steers the loop of its object by two actions of the Input System, axes from -1 to 1.</summary>
public sealed class InputSystemWire : MonoBehaviour, IWireInput
{
    [SerializeField] private InputActionReference _push = null!;
    [SerializeField] private InputActionReference _turn = null!;

    /// <inheritdoc/>
    public float Push => _push.action.ReadValue<float>();

    /// <inheritdoc/>
    public float Turn => _turn.action.ReadValue<float>();

    private void OnEnable()
    {
        _push.action.Enable();
        _turn.action.Enable();
    }

    private void OnDisable()
    {
        _push.action.Disable();
        _turn.action.Disable();
    }
}
