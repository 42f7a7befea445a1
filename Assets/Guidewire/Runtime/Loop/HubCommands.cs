using System;
using UnityEngine;

namespace Guidewire.Runtime
{
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
