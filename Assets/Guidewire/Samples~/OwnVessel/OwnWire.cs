using Guidewire.Runtime;
using UnityEngine;

/// <summary>Steers a wire by keys of its own and draws it with a line renderer; the vessel is a SceneVessel.</summary>
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
        _wire.Push = Input.GetKey(KeyCode.UpArrow) ? 1f : Input.GetKey(KeyCode.DownArrow) ? -0.5f : 0f;
        _wire.Turn = Input.GetKey(KeyCode.RightArrow) ? 0.25f : Input.GetKey(KeyCode.LeftArrow) ? -0.25f : 0f;
        if (_positions.Length != _wire.SphereCount)
        {
            _positions = new Vector3[_wire.SphereCount];
            _line.positionCount = _positions.Length;
        }
        _wire.GetPositions(_positions);
        _line.SetPositions(_positions);
    }
}
