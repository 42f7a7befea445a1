using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Steers the loop of its object by keys, with the legacy Input Manager.</summary>
    public sealed class KeyInput : MonoBehaviour, IWireInput
    {
        [SerializeField]
        private KeyAxis _push = new KeyAxis(KeyCode.W, KeyCode.UpArrow, KeyCode.S, KeyCode.DownArrow);

        [SerializeField]
        private KeyAxis _turn = new KeyAxis(KeyCode.D, KeyCode.RightArrow, KeyCode.A, KeyCode.LeftArrow);

        private bool _isThere;

        /// <inheritdoc/>
        public float Push => _isThere ? _push.Value : 0f;

        /// <inheritdoc/>
        public float Turn => _isThere ? _turn.Value : 0f;

        private void Awake()
        {
            _isThere = LegacyInput.IsThere();
        }
    }
}
