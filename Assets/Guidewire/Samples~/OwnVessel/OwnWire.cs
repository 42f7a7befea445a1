using Guidewire.Runtime;
using UnityEngine;

/// <summary>Draws a wire with a line renderer and counts its contacts; KeyInput beside the loop steers it.</summary>
public sealed class OwnWire : MonoBehaviour
{
    [SerializeField, Tooltip("The wire.")] private SimulationLoop _wire = null!;
    [SerializeField, Tooltip("Draws it.")] private LineRenderer _line = null!;
    [SerializeField, Tooltip("Spheres at the wall."), Min(0)] private int _touching;
    private Vector3[] _positions = System.Array.Empty<Vector3>();

    private void Start()
    {
        _line.widthMultiplier = 0.0018f;    // the width of the line in metres
        _wire.ContactBegan += contact => _touching++;
        _wire.ContactEnded += contact => _touching--;
        _wire.Ended += (outcome, reason) => Debug.Log("the run has ended, " + outcome + ": " + reason);
    }

    private void LateUpdate()
    {
        if (_positions.Length != _wire.SphereCount)
        {
            _positions = new Vector3[_wire.SphereCount];
            _line.positionCount = _positions.Length;
        }
        _wire.GetPositions(_positions);
        _line.SetPositions(_positions);
    }
}
