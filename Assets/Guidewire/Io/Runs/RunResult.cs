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

    /// <summary>What a process tells its caller.</summary>
    public static class ExitCodes
    {
        /// <summary>Bad arguments or parameters, or an output folder that cannot be written.</summary>
        public const int BadInput = 2;

        /// <summary>An error of the program itself.</summary>
        public const int Internal = 70;

        /// <summary>Gives the code of an outcome.</summary>
        /// <exception cref="ArgumentOutOfRangeException">A run that has not ended has none.</exception>
        public static int Of(Outcome outcome)
        {
            switch (outcome)
            {
                case Outcome.Converged:
                case Outcome.Finished:
                    return 0;
                case Outcome.Diverged:
                    return 4;
                case Outcome.Failed:
                    return 5;
                case Outcome.Interrupted:
                    return 130;
                default:
                    throw new ArgumentOutOfRangeException(nameof(outcome), outcome, "the run has not ended");
            }
        }
    }
}
