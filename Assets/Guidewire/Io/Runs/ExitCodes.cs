using System;
using Guidewire.Core;

namespace Guidewire.Io
{
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
