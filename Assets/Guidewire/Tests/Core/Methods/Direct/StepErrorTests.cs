using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Errors that embedded solutions tell, steps that are cut by them, and steps that end at jumps.</summary>
    public sealed class StepErrorTests
    {
        private const int N = 10;
        private const double Amplitude = 1e-3;  // L
        private static readonly Integrator[] Schemes = { Integrator.Trbdf2, Integrator.Esdirk3, Integrator.Esdirk4 };

        [Test]
        public void ErrorOfAStep_FallsWithTheLowerOrderPlusOne([ValueSource(nameof(Schemes))] Integrator scheme)
        {
            // A quarter of a period of the first mode, 211 ms: the two solutions of a step differ by dt^(p+1), p the
            // lower of their orders.
            RungeKuttaScheme own = DirectSetup.Scheme(scheme)!;
            double order = Math.Min(scheme == Integrator.Trbdf2 ? 2 : 3, own.EmbeddedOrder);
            double coarse = LargestError(scheme, 12);
            double fine = LargestError(scheme, 24);
            Assert.That(Math.Log(coarse / fine, 2.0), Is.EqualTo(order + 1.0).Within(0.3));
        }

        [Test]
        public void CutSteps_KeepTheErrorThatIsAskedFor([ValueSource(nameof(Schemes))] Integrator scheme)
        {
            // The first mode, 1e-3 L, with logged steps of a fifth of its period. An error of T in each of k steps adds
            // up to k T/(1e-3) of the amplitude at the most, and to as much in the velocity.
            double whole = PeriodError(scheme, 0.0, out _);
            double rough = PeriodError(scheme, 1e-6, out long few);
            double good = PeriodError(scheme, 1e-8, out long many);
            Assert.That(rough, Is.LessThan(Math.Min(whole, 2.0 * few * 1e-6 / Amplitude)));
            Assert.That(good, Is.LessThan(2.0 * many * 1e-8 / Amplitude));
            Assert.That(good, Is.LessThan(0.2 * rough));
            Assert.That(few, Is.GreaterThan(5));
            Assert.That(many, Is.GreaterThan(few));
        }

        [Test]
        public void CutSteps_GrowAgain_AndNeverBeyondTheLoggedOne([ValueSource(nameof(Schemes))] Integrator scheme)
        {
            // A tip force that is let go while the wire rests: what is short then is long again when the fast modes are
            // damped, which L-stable schemes do.
            SimulationParameters parameters = Released(scheme, 5.3);
            parameters.Method.TimeStepError = 1e-3;
            Simulation run = Simulation.Create(parameters);
            long before = 0;
            long last = 0;
            while (run.Outcome == Outcome.Running)
            {
                before = last;
                run.Step();
                last = run.Report()!.InnerSteps;
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished));
            Assert.That(last - before, Is.EqualTo(1), "a loose tolerance leaves the last step whole");
            Assert.That(run.Report()!.StepsNotConverged, Is.Zero);
            Assert.That(run.Report()!.TimeStepError, Is.LessThanOrEqualTo(1e-3));
        }

        [Test]
        public void StepThatCannotBeGoodEnough_IsCutToItsBound_AndCounted()
        {
            SimulationParameters parameters = Released(Integrator.Trbdf2, 0.0);
            parameters.Method.TimeStepError = 1e-300;
            parameters.Method.MaxSimulationSteps = 1;
            Simulation run = Wires.Finish(parameters);
            Assert.That(run.Report()!.InnerSteps, Is.InRange(1024, 1040));
            Assert.That(run.Report()!.StepsNotConverged, Is.InRange(1024, 1040));
        }

        [Test]
        public void Step_EndsWhereTheTipForceIsLetGo([ValueSource(nameof(Schemes))] Integrator scheme)
        {
            // In the middle of a step: one step more, and the wire is where it is with steps that meet the release.
            SimulationParameters off = Released(scheme, 5.3);
            SimulationParameters fine = Released(Integrator.Esdirk4, 53.0);
            fine.Method.TimeStep *= 0.1;
            fine.Method.MaxSimulationSteps *= 10;
            SimulationParameters met = Released(scheme, 5.0);
            SimulationParameters metFine = Released(Integrator.Esdirk4, 50.0);
            metFine.Method.TimeStep *= 0.1;
            metFine.Method.MaxSimulationSteps *= 10;
            Simulation run = Wires.Run(off);
            Assert.That(run.Report()!.InnerSteps, Is.EqualTo(run.StepCount + 1));
            double error = Wires.Distance(run.State, Wires.Run(fine).State);
            double inStep = Wires.Distance(Wires.Run(met).State, Wires.Run(metFine).State);
            Assert.That(error, Is.LessThan(2.0 * inStep));
        }

        [Test]
        public void WireDrivenTooFastForAStage_GoesOn([ValueSource(nameof(Schemes))] Integrator scheme) =>
            // A wire of 0.1 m whose base is pulled back by 0.8 mm in each step of 0.1 ms, at once: in the second step a
            // stage of order 3 has no solution that begins with the rates of the first. The wave of tension comes back
            // from the tip as a thrust that buckles the wire within a step; where it buckles to is then the scheme's
            // choice, and esdirk3's turns a joint by more than it can tell some steps after the tenth.
            Assert.That(Wires.Run(PulledBack(scheme, 1e-4, 10)).Outcome, Is.EqualTo(Outcome.Finished));

        private static SimulationParameters PulledBack(Integrator scheme, double step, int steps)
        {
            SimulationParameters parameters = Rods.Clamped(12, Solver.Direct, step, steps);
            parameters.Method.Integrator = scheme;
            parameters.Scene.GuidewireLength = 109.0;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.6);
            parameters.Material.WireRadius = 1.1157e-4;
            parameters.Material.YoungsModulus = 4.594e8;
            parameters.Material.ShearModulus = 1.767e8;
            parameters.Material.Density = 641.7;
            parameters.Drive.Kind = Drive.Displace;
            parameters.Drive.DisplacementPerStep = -7700.0 * step;
            parameters.Drive.DisplacementDirection = Vector3d.UnitZ;
            return parameters;
        }

        [TestCase(1.0, 0.0, false)]
        [TestCase(0.5, 0.0, true)]
        [TestCase(1.0, 1e-3, true)]
        public void WireThatBucklesWithinAStep_FailsByTheStepsName_AndAShorterOneDoes(double fraction, double stepError,
            bool lasts)
        {
            SimulationParameters parameters = PulledBack(Integrator.Esdirk3, fraction * 1e-4, (int)(60.0 / fraction));
            parameters.Method.TimeStepError = stepError;
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(lasts ? Outcome.Finished : Outcome.Failed), run.Reason);
            Assert.That(lasts ? "timeStep" : run.Reason, Does.Contain("timeStep"));
        }

        [TestCase(Integrator.ImplicitEuler)]
        [TestCase(Integrator.Bdf2)]
        public void SchemeThatTellsNoError_TakesNoTolerance(Integrator scheme)
        {
            SimulationParameters parameters = Released(scheme, 0.0);
            parameters.Method.TimeStepError = 1e-6;
            Assert.That(ParameterConflict.Find(parameters)!.Key, Is.EqualTo("timeStepError"));
        }

        /// <summary>Bent by its tip, L/30, and let go after so many of 20 steps of 2 ms.</summary>
        private static SimulationParameters Released(Integrator scheme, double after)
        {
            const double Step = 2e-3;
            SimulationParameters parameters = Rods.Clamped(N, Solver.Direct, Step, 20);
            parameters.Method.Integrator = scheme;
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Scene.TipForce = new Vector3d(0.0, 0.1 * Rods.BendForce, 0.0);
            parameters.Scene.TipForceReleaseTime = after * Step;
            return parameters;
        }

        private static double LargestError(Integrator scheme, int steps)
        {
            RodDynamics motion = InFirstMode(scheme, 0.0, out double omega, out _);
            Rods.Step(motion, 0.5 * Math.PI / omega / steps, steps);
            return motion.Control.LargestError;
        }

        /// <summary>Distance of the tip's y - i v/omega from its start after one period, over the amplitude.</summary>
        private static double PeriodError(Integrator scheme, double tolerance, out long steps)
        {
            const int Steps = 5;
            RodDynamics motion = InFirstMode(scheme, tolerance, out double omega, out double start);
            Rods.Step(motion, 2.0 * Math.PI / omega / Steps, Steps);
            steps = motion.Control.Steps;
            double real = motion.Shape.X[N].Y / start - 1.0;
            double imaginary = motion.Velocities[N].Y / (omega * start);
            return Math.Sqrt(real * real + imaginary * imaginary);
        }

        private static RodDynamics InFirstMode(Integrator scheme, double tolerance, out double omega, out double tip)
        {
            MaterialRod rod = Rods.Wire(N);
            RodVector[] mode = Modes.Of(rod, new RodSupports()).First(out omega);
            RodShape shape = Rods.Straight(rod);
            RodStep.Apply(rod, new RodSupports(), Rods.Straight(rod), mode, Amplitude * Rods.Length, shape);
            tip = shape.X[N].Y;
            RodDynamics motion = MotionTests.Start(rod, new RodSupports(), Rods.Schedule(), shape, scheme, 1e-12);
            motion.Control.Tolerance = tolerance;
            return motion;
        }
    }
}
