using System;
using Guidewire.Core;

namespace Guidewire.Runtime
{
    /// <summary>Tells from state to state which spheres a wall has begun and ceased to act on.</summary>
    internal sealed class ContactEvents
    {
        private WireContact[] _last = Array.Empty<WireContact>();    // of each sphere; the force is 0 without contact

        /// <summary>None is touched; for another wire.</summary>
        public void Begin(int spheres) => _last = new WireContact[spheres];

        /// <summary>Takes over a state.</summary>
        public void Update(SimulationLoop loop, WireState state, Action<WireContact>? began, Action<WireContact>? ended)
        {
            for (int i = 0; i < _last.Length && i < state.ContactForces.Length; i++)
            {
                bool isTouched = state.ContactForces[i].LengthSquared > 0.0;
                WireContact before = _last[i];
                if (isTouched)
                {
                    _last[i] = new WireContact(loop, state, i);
                }
                else if (before.IsTouched)
                {
                    _last[i] = default;
                    ended?.Invoke(before);
                }
                if (isTouched && !before.IsTouched)
                {
                    began?.Invoke(_last[i]);
                }
            }
        }
    }
}
