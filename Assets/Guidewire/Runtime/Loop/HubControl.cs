using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Moves a hub: by two fields that an Animator or a Timeline can animate, or after an object, such as a
    /// tracked handle. Several, one an instrument, move several hubs at once.</summary>
    [AddComponentMenu("Guidewire/Hub Control"), Manual("input")]
    [DefaultExecutionOrder(-50)]    // before the loop, so that the newest place counts
    public sealed class HubControl : LoopView
    {
        [Tooltip("Which instrument it moves: 0 the wire, k catheter k.")]
        [SerializeField, Range(0, HubCommands.Most - 1)] private int _instrument;

        [Tooltip("From -1, pull at the loop's full speed, to 1, push.")]
        [SerializeField, Range(-1f, 1f)] private float _push;

        [Tooltip("From -1, turn left at the loop's full speed, to 1, turn right.")]
        [SerializeField, Range(-1f, 1f)] private float _turn;

        [Tooltip("An object whose motion along the wire's first element, and turn about it, the hub makes; it lags "
            + "behind what is faster than the loop's speeds. Empty: the two fields.")]
        [SerializeField] private Transform? _handle;

        private float _pushed;    // of the handle's motion, what the hub was asked for: units
        private float _turned;    // degrees
        private float _turnOfHandle;
        private Vector3 _start;
        private Quaternion _last;
        private bool _isHeld;

        /// <summary>Which instrument it moves: 0 the wire, k catheter k.</summary>
        public int Instrument { get => _instrument; set => _instrument = value; }

        /// <summary>From -1, pull at the loop's full speed, to 1, push.</summary>
        public float Push { get => _push; set => _push = value; }

        /// <summary>From -1, turn left at the loop's full speed, to 1, turn right.</summary>
        public float Turn { get => _turn; set => _turn = value; }

        /// <summary>The object that the hub follows; null: <see cref="Push"/> and <see cref="Turn"/> count.</summary>
        public Transform? Handle
        {
            get => _handle;
            set => (_handle, _isHeld) = (value, false);
        }

        private void Update()
        {
            if (Loop == null || !_handle)
            {
                _isHeld = false;
                Loop?.SteerHub(_instrument, _push, _turn);
            }
            else
            {
                Follow(Loop, _handle!);
            }
        }

        private void OnDisable()
        {
            _isHeld = false;
            if (Loop != null)
            {
                Loop.SteerHub(_instrument, 0f, 0f);
            }
        }

        // In the frame of the loop's object, where the wire's first element lies along z.
        private void Follow(SimulationLoop loop, Transform handle)
        {
            Vector3 place = loop.transform.InverseTransformPoint(handle.position);
            Quaternion now = Quaternion.Inverse(loop.transform.rotation) * handle.rotation;
            float seconds = Time.deltaTime * loop.Pace;
            if (!_isHeld || loop.IsPaused || seconds <= 0f)
            {
                (_start, _last, _isHeld) = (place, now, true);
                (_pushed, _turned, _turnOfHandle) = (0f, 0f, 0f);
                loop.SteerHub(_instrument, 0f, 0f);
                return;
            }
            Quaternion step = now * Quaternion.Inverse(_last);
            _turnOfHandle += Mathf.DeltaAngle(0f, 2f * Mathf.Rad2Deg * Mathf.Atan2(step.z, step.w));
            _last = now;
            float push = Fraction(place.z - _start.z - _pushed, seconds * loop.PushSpeed);
            float turn = Fraction(_turnOfHandle - _turned, seconds * loop.TurnSpeed);
            _pushed += push * seconds * loop.PushSpeed;
            _turned += turn * seconds * loop.TurnSpeed;
            loop.SteerHub(_instrument, push, turn);
        }

        private static float Fraction(float left, float most) => most > 0f ? Mathf.Clamp(left / most, -1f, 1f) : 0f;
    }
}
