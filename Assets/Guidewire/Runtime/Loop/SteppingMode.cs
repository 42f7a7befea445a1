namespace Guidewire.Runtime
{
    /// <summary>Who makes a loop's steps.</summary>
    public enum SteppingMode
    {
        /// <summary>A thread of the loop's own: no frame waits for a step. Where there are no threads (WebGL), and in
        /// batch mode, as <see cref="Frames"/>.</summary>
        Worker,

        /// <summary>Update, between two frames, as many as the loop's budget allows.</summary>
        Frames,

        /// <summary>FixedUpdate, without a budget: as many as its fixed time asks for.</summary>
        FixedSteps,
    }
}
