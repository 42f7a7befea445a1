namespace Guidewire.Core
{
    /// <summary>A scheme in time that takes a rod through a step by implicit stages.</summary>
    internal abstract class ImplicitStepper
    {
        /// <summary>By these stages.</summary>
        /// <param name="control">Counts the steps, and divides them where the scheme tells their errors.</param>
        protected ImplicitStepper(ImplicitStage stage, StepControl control)
        {
            Stage = stage;
            Control = control;
        }

        /// <summary>Solves the stages.</summary>
        public ImplicitStage Stage { get; }

        /// <summary>How steps are subdivided, and their error estimates.</summary>
        public StepControl Control { get; }

        /// <summary>Whether the scheme estimates the errors of its steps.</summary>
        public virtual bool HasErrorEstimate => false;

        /// <summary>Sum of the magnitudes of the weights: the factor by which stage errors enter a step.</summary>
        public virtual double WeightSum => 1.0;

        /// <summary>Names the scheme: another's history means nothing to it.</summary>
        public abstract string Key { get; }

        /// <summary>The rod begins to move from where it is, as it does.</summary>
        public abstract void Begin();

        /// <summary>One step.</summary>
        /// <param name="time">At its start, s.</param>
        /// <param name="dt">s.</param>
        /// <returns>Null, or why a stage has no solution; the shape is then not to be used.</returns>
        public abstract string? Step(double time, double dt);

        /// <summary>Writes or restores all that a step may touch, for a <see cref="StepStart"/>.</summary>
        public virtual void SerializeStep(Snapshot snapshot)
        {
            Stage.SerializeStep(snapshot);
        }

        /// <summary>Writes or restores, at a time, s, what went before the next step.</summary>
        public virtual void SerializeHistory(Snapshot snapshot, double time)
        {
            Stage.SerializeHistory(snapshot);
        }
    }
}
