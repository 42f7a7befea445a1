using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Runs of a wire in two catheters.</summary>
    public sealed class ThreeRunTests
    {
        private const double Length = 400.0;   // of the wire, mm

        // The hubs of both catheters together, elements and leads of 10 mm: all chains have the same stations.
        [TestCase(0)]
        [TestCase(1)]
        public void CatheterWithoutStiffnessAndMass_LeavesTheRestShapeOfTheOthers(int soft)
        {
            Vector3d[] three = AtRest(soft, true);
            Vector3d[] two = AtRest(soft, false);
            Assert.That(Math.Abs(two[40].Y), Is.GreaterThan(0.02 * Length), "it sags");
            Assert.That(Wires.Distance(three, two), Is.LessThan(1e-6 * Length));
        }

        private static Vector3d[] AtRest(int soft, bool isThere)
        {
            SimulationParameters parameters = CoaxialScenes.Three(Integrator.ImplicitEuler);
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Method.MaxSimulationSteps = 0;
            Catheter[] catheters = { parameters.Scene.Catheters[0], parameters.Scene.Catheters[1] };
            catheters[0].Start = 100.0;
            MaterialParameters material = catheters[soft].Material;
            material.YoungsModulus *= 1e-7;
            material.ShearModulus *= 1e-7;
            material.Density *= 1e-7;
            material.Sections = Array.Empty<WireSection>();
            // In one plane: where they twist, the frame of another instrument counts in second order of the elements.
            catheters[1 - soft].Material.Sections[0].RestCurvature = new Vector3d(14.0, 0.0, 0.0);
            parameters.Scene.Catheters = isThere ? catheters : new[] { catheters[1 - soft] };
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            return (Vector3d[])run.State.Positions.Clone();
        }

        // Each hub forth and back to the last element: tips come in and go, in either order.
        [TestCase(true)]
        [TestCase(false)]
        public void TipsGoInAndOut_AndWhatWasAskedIsGone(bool isInnerFirst)
        {
            SimulationParameters parameters = CoaxialScenes.Three(Integrator.ImplicitEuler);
            const double dt = 0.02;
            parameters.Method.TimeStep = dt;
            parameters.Method.MaxSimulationSteps = 200;
            double[] times = { 0.0, 1.0, 2.0, 3.0, 4.0 };
            // Outer tip at 290, inner one at 350, wire's at 400 mm.
            SetDrive(parameters.Drive, times, new[] { 0.0, -0.12, -0.12, -0.2, 0.0 });
            SetDrive(parameters.Scene.Catheters[1].Drive, times,
                isInnerFirst ? new[] { 0.0, -0.08, 0.0, -0.09, 0.0 } : new[] { 0.0, 0.0, -0.09, -0.09, 0.0 });
            SetDrive(parameters.Scene.Catheters[0].Drive, times, new[] { 0.0, 0.0, 0.07, -0.02, 0.0 });
            Simulation run = Simulation.Create(parameters);
            bool isInside = false;
            bool isWireInside = false;
            Wires.Finish(run, () =>
            {
                CoaxialRecord outer = run.Coaxial()!;
                isInside |= outer.Extension < -0.02;
                isWireInside |= outer.Inside!.Extension < -0.02;
            });
            Assert.That(isInside && isWireInside, "both tips were inside");
            CoaxialRecord first = run.Coaxial()!;
            CoaxialRecord inside = first.Inside!;
            AssertSum(first.CommandedDisplacement, first.Displacement, first.Shortfall);
            AssertSum(inside.CommandedDisplacement, inside.Displacement, inside.Shortfall);
            AssertSum(first.WireCommandedDisplacement, first.WireDisplacement, first.WireShortfall);
            Assert.That(inside.Displacement, Is.GreaterThan(0.1));
            Assert.That(run.Hub()!.Insertion, Is.EqualTo(0.0).Within(1e-9));
        }

        // Each hub in turn is pushed or drawn back against its neighbours, which rest or come towards it.
        [Test]
        public void HubsOfThree_DoNotPassOneAnother()
        {
            SimulationParameters parameters = CoaxialScenes.Three(Integrator.ImplicitEuler);
            parameters.Method.MaxSimulationSteps = 1000;
            parameters.Drive.Steering = new Steering();
            Catheter outer = parameters.Scene.Catheters[0];
            Catheter inner = parameters.Scene.Catheters[1];
            outer.Drive.Steering = new Steering();
            inner.Drive.Steering = new Steering();
            Simulation run = Simulation.Create(parameters);
            double least = double.PositiveInfinity;
            foreach ((double a, double b, double c) in new[] { (0.0, -3.0, 0.0), (0.5, -1.0, 0.7), (1.0, 0.0, -1.0),
                (0.2, 2.0, -0.5), (2.0, -2.0, 0.0), (-3.0, 1.0, 1.0) })
            {
                parameters.Drive.Steering.Push = a;
                inner.Drive.Steering.Push = b;
                outer.Drive.Steering.Push = c;
                for (int k = 0; k < 45; k++)
                {
                    run.Step();
                    CoaxialRecord record = run.Coaxial()!;
                    double hub = inner.Start + 1e3 * record.Inside!.Insertion;
                    least = Math.Min(least, Math.Min(hub - 1e3 * run.Hub()!.Insertion,
                        outer.Start + 1e3 * record.Insertion - hub));
                }
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
            Assert.That(least, Is.GreaterThan(-1e-9), "mm between hubs");
            Assert.That(least, Is.LessThan(1e-6), "mm: they meet");
        }

        // The wire's hub comes to the inner catheter's after 100 mm and with it to the outer one's after 30 mm more.
        // Then the outer one draws both back.
        [Test]
        public void HubPressedAgainstOthers_CarriesThemAlong()
        {
            SimulationParameters parameters = CoaxialScenes.Three(Integrator.ImplicitEuler);
            parameters.Drive.Steering = new Steering { Push = 2.0 };
            Catheter outer = parameters.Scene.Catheters[0];
            Catheter inner = parameters.Scene.Catheters[1];
            outer.Drive.Steering = new Steering();
            inner.Drive.Steering = new Steering();
            Simulation run = Simulation.Create(parameters);
            void Check(double wire, double middle, double outermost)
            {
                CoaxialRecord record = run.Coaxial()!;
                Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
                Assert.That(1e3 * run.Hub()!.Insertion, Is.EqualTo(wire).Within(1e-9));
                Assert.That(1e3 * record.Inside!.Insertion, Is.EqualTo(middle).Within(1e-9));
                Assert.That(1e3 * record.Insertion, Is.EqualTo(outermost).Within(1e-9));
            }
            Steps(run, 72);
            Check(144.0, 44.0, 14.0);
            parameters.Drive.Steering.Push = 0.0;
            outer.Drive.Steering.Push = -2.0;
            Steps(run, 5);
            Check(134.0, 34.0, 4.0);
            inner.Drive.Steering.Push = 1.0;
            Steps(run, 5);
            Check(134.0, 34.0, 4.0);
        }

        // A dead load of 50 mN on the straight outer catheter's tip is what the wire's hand bears where it carries that
        // one along. With 60 mN the sudden start is too much in a step or two.
        [TestCase(0.2, double.NaN, 3.0, 1e-6)]
        [TestCase(0.03, double.NaN, 0.0, 1e-6)]
        [TestCase(0.2, 0.06, 3.0, 0.05)]
        public void HubThatCarriesOthers_BearsTheirForces_WithinBothLimits(double limit, double ofOuter, double goes,
            double error)
        {
            SimulationParameters parameters = CoaxialScenes.Three(Integrator.ImplicitEuler);
            parameters.Drive.Steering = new Steering { Push = 0.05 };
            parameters.Drive.HubForceLimit = limit;
            parameters.Material.Sections = Array.Empty<WireSection>();
            parameters.Scene.Walls = WallScenes.Tube(-100.0, 700.0, 20.0);
            foreach (Catheter one in parameters.Scene.Catheters)
            {
                one.Start = 1.0;
                one.Material.Sections = Array.Empty<WireSection>();
                one.Drive.Steering = new Steering();
            }
            Catheter outer = parameters.Scene.Catheters[0];
            outer.TipForce = new Vector3d(0.0, 0.0, -0.05);
            outer.Drive.HubForceLimit = ofOuter;
            Simulation run = Simulation.Create(parameters);
            Steps(run, 80);
            CoaxialRecord record = run.Coaxial()!;
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
            TestContext.WriteLine("{0:G4} N of the outer one, {1:G4} N of the wire", record.Force, run.Hub()!.Force);
            Assert.That(1e3 * record.Insertion, Is.EqualTo(goes).Within(error));
            Assert.That(1e3 * run.Hub()!.Insertion, Is.EqualTo(1.0 + goes).Within(error));
        }

        [Test]
        public void RunAgain_HasTheSameBits_AndASnapshotGoesOnToThem()
        {
            SimulationParameters parameters = CoaxialScenes.Three(Integrator.ImplicitEuler);
            parameters.Method.MaxSimulationSteps = 40;
            parameters.Drive.InsertionSpeed = 0.3;
            parameters.Scene.Catheters[0].Drive.InsertionSpeed = 0.35;
            parameters.Scene.Catheters[1].Drive.InsertionSpeed = -0.2;
            parameters.Scene.Catheters[1].Drive.RotationSpeed = 4.0;
            SameRun.AssertSame(Wires.RunAndRestore(parameters, 17), Wires.RunAndRestore(parameters, 25), "again");
        }

        private static void Steps(Simulation run, int count)
        {
            for (int k = 0; k < count; k++)
            {
                run.Step();
            }
        }

        private static void SetDrive(DriveParameters drive, double[] times, double[] insertions) =>
            drive.Table = new DriveTable(new TimeTable(times, insertions), new TimeTable(times, new double[5]));

        private static void AssertSum(double asked, double gone, double shortfall) =>
            Assert.That(asked, Is.EqualTo(gone + shortfall).Within(1e-9));
    }
}
