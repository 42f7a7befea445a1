namespace Guidewire.Core
{
    /// <summary>A step that can say how its solver did.</summary>
    internal interface IReportingStep
    {
        /// <summary>What it says.</summary>
        SolverReport Report { get; }

        /// <summary>Fills in what is known only at the end of a run.</summary>
        void CompleteReport();
    }
}
