namespace Guidewire.Core
{
    /// <summary>How the accelerations of a stage are predicted: a_First + Fraction (a_Second - a_First).</summary>
    internal struct StagePredictor
    {
        public int First;
        public int Second;
        public double Fraction;

        /// <summary>Gives that of one stage alone.</summary>
        public static StagePredictor Of(int stage) => new StagePredictor { First = stage, Second = stage };

        /// <summary>2 a - a_old, for a scheme of one stage that stores the step before as second.</summary>
        public static StagePredictor OneStage => new StagePredictor { First = 0, Second = 1, Fraction = -1.0 };
    }
}
