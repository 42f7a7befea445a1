using UnityEngine;

/// <summary>Stands in for a tracked controller: moves its object to and fro along z and turns it about z. With an XR rig
/// remove it, and give the controller's object to the hub control as its handle.</summary>
public sealed class HandMotion : MonoBehaviour
{
    [SerializeField, Tooltip("Largest distance in the scene's units."), Min(0f)] private float _distance = 0.08f;
    [SerializeField, Tooltip("Largest turn in degrees."), Min(0f)] private float _turn = 90f;
    [SerializeField, Tooltip("Time to and fro in s."), Min(0.1f)] private float _period = 12f;

    private Vector3 _start;
    private float _time;

    private void Start() => _start = transform.localPosition;

    private void Update()
    {
        _time += Time.deltaTime;
        float fraction = 0.5f - 0.5f * Mathf.Cos(2f * Mathf.PI * _time / _period);
        transform.localPosition = _start + fraction * _distance * Vector3.forward;
        transform.localRotation = Quaternion.Euler(0f, 0f, fraction * _turn);
    }
}
