using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Steers the loop of its object by keys, with whatever input the project has.</summary>
    [RequireComponent(typeof(SimulationLoop))]
    [AddComponentMenu("Guidewire/Key Input"), Manual("input")]
    public sealed class KeyInput : MonoBehaviour, IWireInput
    {
        [Tooltip("Keys that push and pull.")]
        [SerializeField]
        private KeyAxis _push = new KeyAxis(KeyCode.W, KeyCode.UpArrow, KeyCode.S, KeyCode.DownArrow);

        [Tooltip("Keys that turn right and left.")]
        [SerializeField]
        private KeyAxis _turn = new KeyAxis(KeyCode.D, KeyCode.RightArrow, KeyCode.A, KeyCode.LeftArrow);

        private HostInput _input;

        /// <inheritdoc/>
        public float Push => _push.Value(_input);

        /// <inheritdoc/>
        public float Turn => _turn.Value(_input);

        private void OnEnable() => _input = HostInput.Find();
    }
}
