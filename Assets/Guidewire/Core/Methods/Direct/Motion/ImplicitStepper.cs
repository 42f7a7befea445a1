namespace Guidewire.Core
{
    /// <summary>A scheme in time that takes a rod through a step by implicit stages.</summary>
    internal abstract class ImplicitStepper
    {
        /// <summary>Steps by these stages.</summary>
        /// <param name="control">Counts the intervals, and divides them where the scheme tells their errors.</param>
        protected ImplicitStepper(ImplicitStage stage, StepControl control)
        {
            Stage = stage;
            Control = control;
        }

        /// <summary>Solves the stages.</summary>
        public ImplicitStage Stage { get; }

        /// <summary>How intervals follow from error estimates.</summary>
        public StepControl Control { get; }

        /// <summary>Whether no interval goes beyond a jump of a load.</summary>
        public virtual bool StopsAtJumps => false;

        /// <summary>By the scheme's estimate, of the last interval: radians, or displacement over L; 0 where it has
        /// none.</summary>
        public double Error { get; protected set; }

        /// <summary>Whether the last interval may be tried by the scheme's start, which it has not used.</summary>
        public bool MayRestart { get; protected set; }

        /// <summary>Whether the scheme estimates the errors of its steps.</summary>
        public virtual bool HasErrorEstimate => false;

        /// <summary>Sum of the magnitudes of the weights: the factor by which stage errors enter a step.</summary>
        public virtual double WeightSum => 1.0;

        /// <summary>Names the scheme: another's history means nothing to it.</summary>
        public abstract string Key { get; }

        /// <summary>The rod begins to move from where it is, as it does.</summary>
        public abstract void Begin();

        /// <summary>The rod has other elements and no past.</summary>
        public virtual void Remesh()
        {
            Stage.Remesh();
            Control.Forget();
            (Error, MayRestart) = (0.0, false);
        }

        /// <summary>Takes the rod through an interval.</summary>
        /// <returns>Null, or why a stage has no solution; the shape is then not to be used.</returns>
        public abstract string? Step(in Interval interval);

        /// <summary>Writes or restores what went before the next step.</summary>
        public virtual void Serialize(Snapshot snapshot) => Stage.Serialize(snapshot);
    }

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
