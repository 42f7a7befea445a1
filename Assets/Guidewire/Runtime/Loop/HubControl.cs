using System;
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

    /// <summary>What each hub is asked to do, the wire's first: push and turn, from -1 to 1.</summary>
    internal sealed class HubCommands
    {
        /// <summary>The largest number of hubs.</summary>
        public const int Most = 8;

        private readonly float[] _pushes = new float[Most];
        private readonly float[] _turns = new float[Most];

        public float PushOf(int hub) => hub < Most ? _pushes[hub] : 0f;

        public float TurnOf(int hub) => hub < Most ? _turns[hub] : 0f;

        /// <summary>Sets what a hub is asked; does nothing for one that no run has.</summary>
        public void Set(int hub, float push, float turn)
        {
            if (hub >= 0 && hub < Most)
            {
                (_pushes[hub], _turns[hub]) = (push, turn);
            }
        }

        /// <summary>Writes speeds of push and turn of each hub.</summary>
        public void Write(double[] speeds, float pushSpeed, float turnSpeed)
        {
            for (int hub = 0; hub < Most; hub++)
            {
                speeds[2 * hub] = Clamped(_pushes[hub]) * pushSpeed;
                speeds[2 * hub + 1] = Clamped(_turns[hub]) * turnSpeed;
            }
        }

        // What is no number moves nothing.
        private static float Clamped(float value) => float.IsNaN(value) ? 0f : Mathf.Clamp(value, -1f, 1f);
    }
}
