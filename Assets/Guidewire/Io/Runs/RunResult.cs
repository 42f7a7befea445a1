using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>What became of a run.</summary>
    public sealed class RunResult
    {
        internal RunResult(Outcome outcome, string reason)
        {
            Outcome = outcome;
            Reason = reason;
        }

        /// <summary>The outcome's one word, as in summary.json.</summary>
        public string Word => RunSummary.Word(Outcome);

        /// <summary>How it ended.</summary>
        public Outcome Outcome { get; }

        /// <summary>Why, in one line.</summary>
        public string Reason { get; }
    }
}
