using System;
using System.Collections.Generic;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>What became of a run.</summary>
    public sealed class RunResult
    {
        internal RunResult(Outcome outcome, string reason, bool isReliable, bool reused, bool keptEarlier = false)
        {
            IsReliable = isReliable;
            Outcome = outcome;
            Reason = reason;
            Reused = reused;
            KeptPreviousRun = keptEarlier;
        }

        /// <summary>The outcome's one word, as in summary.json.</summary>
        public string Word => RunSummary.Word(Outcome);

        /// <summary>Says how the run ended.</summary>
        public Outcome Outcome { get; }

        /// <summary>Why, in one line.</summary>
        public string Reason { get; }

        /// <summary>Whether the result can be trusted, as far as the run can tell; see <see
        /// cref="Simulation.IsReliable"/>.</summary>
        public bool IsReliable { get; }

        /// <summary>What is not as it should be at its end, one line each.</summary>
        public IReadOnlyList<string> Warnings { get; internal set; } = Array.Empty<string>();

        /// <summary>True when an earlier result of the same parameters stood in for it.</summary>
        public bool Reused { get; }

        /// <summary>True when the run came to no end of its own, and a whole result that the folder held before it is
        /// there still.</summary>
        public bool KeptPreviousRun { get; }
    }
}
