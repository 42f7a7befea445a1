using System;
using System.Collections.Generic;
using Guidewire.Core;
using Guidewire.Io;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Says once how a run has ended, or what has stopped it.</summary>
    internal sealed class RunReport
    {
        private Outcome _reported;

        /// <summary>What stopped the loop, in one line; empty where nothing did.</summary>
        public string Problem { get; private set; } = "";

        /// <summary>Begins with another run.</summary>
        public void Begin() => (Problem, _reported) = ("", Outcome.Running);

        /// <summary>Stops with what was thrown.</summary>
        public void Stop(Exception error)
        {
            bool isExpected = error is ParameterException || error is ArgumentException;
            Problem = isExpected ? error.Message : "internal error: " + error.Message;
            Debug.LogError("guidewire: " + (isExpected ? error.Message : error.ToString()));
        }

        /// <summary>Says what of a run is allowed but most likely not meant.</summary>
        public static void Warn(IReadOnlyList<string> warnings)
        {
            foreach (string warning in warnings)
            {
                Debug.LogWarning("guidewire: " + warning);
            }
        }

        /// <summary>Takes a state.</summary>
        /// <returns>Whether the run has ended with it.</returns>
        public bool Update(WireState state)
        {
            if (state.Outcome == _reported)
            {
                return false;
            }
            _reported = state.Outcome;
            if (state.Outcome == Outcome.Running)
            {
                return false;
            }
            string line = state.Outcome.ToString().ToLowerInvariant() + ": " + state.Reason;
            if (state.Outcome == Outcome.Diverged || state.Outcome == Outcome.Failed)
            {
                Problem = line;
                Debug.LogError("guidewire: " + line);
            }
            else
            {
                Debug.Log("guidewire: " + line);
            }
            return true;
        }
    }
}
