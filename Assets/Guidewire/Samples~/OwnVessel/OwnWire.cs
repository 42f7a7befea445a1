using Guidewire.Runtime;
using UnityEngine;

/// <summary>Draws a wire with a line renderer and counts its contacts; KeyInput beside the loop steers it.</summary>
public sealed class OwnWire : MonoBehaviour
{
    [SerializeField] private SimulationLoop _wire = null!;
    [SerializeField] private LineRenderer _line = null!;
    [SerializeField] private int _touching;    // spheres at the vessel's wall, for the Inspector
    private Vector3[] _positions = System.Array.Empty<Vector3>();

    private void Start()
    {
        _wire.ContactBegan += sphere => _touching++;
        _wire.ContactEnded += sphere => _touching--;
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
