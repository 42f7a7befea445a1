namespace Guidewire.Core
{
    /// <summary>A part of a step that a scheme solves at once; times in s.</summary>
    internal struct Interval
    {
        public double Start;
        public double Length;       // 0 where nothing is left
        public double End;          // start plus length up to rounding
        public double Jump;         // when a load jumps next: a stage at that time is before the jump
        public double Nearly;       // within which two times are the same
        public double StepLength;   // of the step to which it belongs
        public bool IsRestarted;    // it had no solution by the scheme itself: the scheme's start is used

        /// <summary>Part of the step.</summary>
        public readonly double Fraction => Length / StepLength;
    }
}
