using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>From which stages another is predicted.</summary>
    public sealed class StagePredictorTests
    {
        [TestCase(Integrator.ImplicitEuler)]
        [TestCase(Integrator.Trbdf2)]
        [TestCase(Integrator.Esdirk3)]
        [TestCase(Integrator.Esdirk4)]
        public void AnAccelerationThatGrowsEvenly_IsPredictedExactly(Integrator integrator)
        {
            RungeKuttaScheme scheme = DirectSetup.Scheme(integrator)!;
            for (int stage = 0; stage < scheme.StageCount; stage++)
            {
                StagePredictor predictor = scheme.Predictors[stage];
                double first = TimeOf(scheme, predictor.First, stage);
                double second = TimeOf(scheme, predictor.Second, stage);
                double predicted = first + predictor.Fraction * (second - first);
                Assert.That(predicted, Is.EqualTo(scheme.Times[stage]).Within(1e-14), "stage " + stage);
            }
        }

        /// <summary>When the acceleration in this place was taken, in steps: stages that are still to come are those of
        /// the step before, and a scheme of one stage keeps the step before that in its second place.</summary>
        private static double TimeOf(RungeKuttaScheme scheme, int place, int stage)
        {
            if (place == scheme.StageCount)
            {
                return scheme.Times[0] - 2.0;
            }
            return scheme.Times[place] - (place < stage ? 0.0 : 1.0);
        }
    }
}
