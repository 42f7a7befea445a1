namespace Guidewire.Core
{
    /// <summary>Takes a wire from one moment to the next. One implementation a method.</summary>
    internal interface ITimeStep
    {
        /// <summary>Distance in units between the last sphere's prediction and where the constraints left it in the
        /// last step (Delta_p, thesis 4.1.1).</summary>
        double PredictionError { get; }

        /// <summary>Why the method gave up in the last step, in one line, or null.</summary>
        string? Failure { get; }

        /// <summary>Advances the state by one step.</summary>
        void Advance(RodState state);
    }
}
