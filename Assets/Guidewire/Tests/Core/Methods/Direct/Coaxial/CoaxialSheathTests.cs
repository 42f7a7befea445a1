using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire in a catheter in a sheath, against one instrument in a sheath and against what is
    /// exact.</summary>
    public sealed class CoaxialSheathTests
    {
        private const double Exit = 157.5;    // units, between two nodes

        // 300 mm of wire, or of a catheter with its material, of which 142.5 are beyond the exit, bent by a load.
        [TestCase(false)]
        [TestCase(true)]
        public void OtherInstrumentOfNoStiffness_LeavesOneAloneInItsSheath(bool isCatheter)
        {
            SimulationParameters alone = Sheathed(60);
            Catheter catheter = alone.Scene.Catheters[0];
            alone.Scene.Catheters = Array.Empty<Catheter>();
            SimulationParameters both = Sheathed(60);
            if (isCatheter)
            {
                both.Material.YoungsModulus *= 1e-7;
                both.Material.ShearModulus *= 1e-7;
                alone.Material.WireRadius = catheter.Material.WireRadius;
                alone.Material.InnerRadius = catheter.Material.InnerRadius;
                alone.Material.YoungsModulus = catheter.Material.YoungsModulus;
                alone.Material.ShearModulus = catheter.Material.ShearModulus;
                alone.Material.Density = catheter.Material.Density;
                both.Scene.GuidewireLength = 290.0;
                both.Scene.NumberRodElements = 58;
                both.Scene.Catheters[0].Length = 300.0;
                both.Scene.Catheters[0].Elements = 60;
                both.Scene.Catheters[0].TipForce = both.Scene.TipForce;
                both.Scene.TipForce = Vector3d.Zero;
            }
            else
            {
                both.Scene.Catheters[0].Material.YoungsModulus *= 1e-7;
                both.Scene.Catheters[0].Material.ShearModulus *= 1e-7;
                both.Scene.Catheters[0].Material.Sections = Array.Empty<WireSection>();
            }
            Simulation one = Wires.Finish(alone);
            Simulation two = Wires.Finish(both);
            Vector3d tip = isCatheter ? two.Coaxial()!.Positions[60] : two.State.Positions[60];
            double force = isCatheter ? two.Coaxial()!.Force : two.Hub()!.Force;
            TestContext.WriteLine("{0} and {1}; {2:G6} and {3:G6} N", one.State.Positions[60], tip,
                one.Hub()!.Force, force);
            Assert.That(tip.X, Is.GreaterThan(2.0), "mm: it is bent");
            Assert.That((tip - one.State.Positions[60]).Length, Is.LessThan(1e-5 * 142.5));
            Assert.That(force, Is.EqualTo(one.Hub()!.Force).Within(5e-4 * Math.Abs(one.Hub()!.Force)));
        }

        [Test]
        public void OuterCatheterOfNoStiffness_LeavesTwoAloneInTheirSheath()
        {
            SimulationParameters pair = Sheathed(60);
            SimulationParameters three = Sheathed(60);
            var outer = new Catheter { Length = 195.0, Elements = 39 };
            CoaxialScenes.SetTube(outer, 1.35e-3, 1.0e-3, 400.0, 150.0);
            three.Scene.Catheters = new[] { outer, three.Scene.Catheters[0] };
            Simulation two = Wires.Finish(pair);
            Simulation all = Wires.Finish(three);
            CoaxialRecord inner = all.Coaxial()!.Inside!;
            TestContext.WriteLine("{0} and {1}; {2:G6} and {3:G6} N, {4:G6} and {5:G6} N", two.State.Positions[60],
                all.State.Positions[60], two.Hub()!.Force, all.Hub()!.Force, two.Coaxial()!.Force,
                inner.Force + all.Coaxial()!.Force);
            Assert.That(two.State.Positions[60].X, Is.GreaterThan(2.0), "mm: it is bent");
            Assert.That((two.State.Positions[60] - all.State.Positions[60]).Length, Is.LessThan(1e-5 * 142.5));
            double scale = Math.Abs(two.Hub()!.Force);
            Assert.That(all.Hub()!.Force, Is.EqualTo(two.Hub()!.Force).Within(5e-4 * scale));
            Assert.That(inner.Force + all.Coaxial()!.Force, Is.EqualTo(two.Coaxial()!.Force).Within(1e-3 * scale));
        }

        // Nothing loads them: the sheath drives both out by 1/2 B k^2, B the sum of both stiffnesses, k their mean by
        // stiffness; the wire's hub alone has 1/2 B_c B_w/B (k_c - k_w)^2 of the catheter's tip less what straightens
        // it in the sheath, 1/2 B_w k_w^2. So at any place of the exit in an element, and whether turned or not.
        [TestCase(0.4, 0.0)]
        [TestCase(0.41, Math.PI)]
        [TestCase(0.43, 0.0)]
        [TestCase(0.479, Math.PI)]
        public void BentInstruments_AreDrivenOut_ByTheirBendingEnergyPerLength(double sheathed, double turn)
        {
            const double outer = 2e-3;
            const double inner = 5e-4;
            const double k = 4.0;
            const double kw = -1.5;
            var pair = new CoaxialPair(new[] { new CoaxialPair.Piece(1.0, outer, k) }, 10,
                new[] { new CoaxialPair.Piece(0.9, inner, kw) }, 9, -0.999, 0.2);
            pair.Build(0, 0.2, sheathed);
            pair.Solve(turn);
            double own = turn == 0.0 ? kw : -kw;
            double sum = outer + inner;
            double mean = (outer * k + inner * own) / sum;
            double wire = 0.5 * outer * inner / sum * (k - own) * (k - own) - 0.5 * inner * kw * kw;
            Assert.That(pair.Terms.Release!.SheathForce(pair.Shape),
                Is.EqualTo(-0.5 * sum * mean * mean).Within(1e-3 * 0.5 * sum * k * k));
            Assert.That(pair.Force, Is.EqualTo(wire).Within(1e-3 * 0.5 * sum * k * k));
        }

        // Not at a node: there the shear force jumps, and with it this one by 0.5 %.
        [TestCase(0.13)]
        [TestCase(0.31)]
        [TestCase(0.56)]
        public void SheathForce_IsTheDifferenceOfTheRestShapesEnergies(double sheathed)
        {
            CoaxialPair pair = Loaded(sheathed);
            double force = pair.Terms.Release!.SheathForce(pair.Shape);
            double wire = pair.Force;
            double torque = pair.Torque;
            double Energy(double on, double wireOn, double turn)
            {
                pair.Build(0, 0.25 + on - wireOn, sheathed - on);
                pair.Solve(0.9 + turn);
                return pair.Terms.Potential(pair.Shape);
            }

            // The outer hub's node is at rest: it is moved by the displacement into the sheath alone, and the lead.
            double outer = EnergySlopes.Difference(1e-4, d => Energy(d, d, 0.0));
            double scale = Math.Abs(force) + Math.Abs(wire);
            Assert.That(Math.Abs(force), Is.GreaterThan(1e-4));
            Assert.That(force, Is.EqualTo(outer).Within(1e-5 * scale));
            Assert.That(wire, Is.EqualTo(EnergySlopes.Difference(1e-4, d => Energy(0.0, d, 0.0))).Within(1e-5 * scale));
            Assert.That(torque, Is.EqualTo(EnergySlopes.Difference(1e-4, d => Energy(0.0, 0.0, d)))
                .Within(1e-6 * Math.Abs(torque)));
        }

        // sqrt(c) L_t tan(sqrt(c) L) = 1 with L_t of both in the sheath and L beyond it: there the twist of pi is no
        // longer stable.
        [TestCase(0.5)]
        [TestCase(0.53)]
        public void Stability_EndsEarlier_WithALengthOfBothInTheSheath(double sheathed)
        {
            const double b = 0.6;
            const double nu = 0.3;
            double free = 1.5 - sheathed;
            double exact = Bisection.Limit(1e-3, 0.5 * Math.PI / free - 1e-9,
                root => root * sheathed * Math.Tan(root * free) < 1.0);
            double coarse = Threshold(15, b, nu, sheathed) / exact - 1.0;
            double fine = Threshold(30, b, nu, sheathed) / exact - 1.0;
            TestContext.WriteLine("{0:G4} and {1:G4}", coarse, fine);
            Assert.That(Math.Abs(coarse), Is.LessThan(2.5e-3));
            Assert.That(Math.Abs(fine), Is.LessThan(0.4 * Math.Abs(coarse)));
        }

        // sqrt(c), c = k^2 B_o B_i/(B_o + B_i) (1/C_o + 1/C_i).
        private static double Threshold(int n, double b, double nu, double sheathed)
        {
            double perCurvature = Math.Sqrt(b / (1.0 + b) * (1.0 + nu) * (1.0 + 1.0 / b));
            return Bisection.Limit(0.2, 3.0, root =>
            {
                double curvature = root / perCurvature;
                var pair = new CoaxialPair(new[] { new CoaxialPair.Piece(1.5, 1.0, curvature) }, n,
                    new[] { new CoaxialPair.Piece(1.5, b, curvature) }, n, nu, 0.0);
                pair.Build(0, 0.0, sheathed);
                return pair.IsStable(Math.PI);
            }, 30);
        }

        // Bent and turned, with a load, and a tip of the inner one within.
        private static CoaxialPair Loaded(double sheathed)
        {
            var pair = new CoaxialPair(
                new[] { new CoaxialPair.Piece(0.6, 2e-3, 1.0), new CoaxialPair.Piece(0.4, 1e-3, 3.0, 1.0) }, 20,
                new[] { new CoaxialPair.Piece(0.83, 5e-4, 0.0), new CoaxialPair.Piece(0.2, 2e-4, -4.0) }, 10, 0.3, 0.25)
            {
                TipForce = new Vector3d(1e-3, 5e-4, 0.0),
            };
            pair.Build(0, 0.25, sheathed);
            pair.Solve(0.9);
            return pair;
        }

        // Slowly, both hubs forth and back and turned, both tips out of the sheath and in again.
        [Test]
        public void ClosedCycleOfBothHubs_TakesNoWork()
        {
            double one = CycleWork(0.1, out double peak);
            double two = CycleWork(0.2, out _);
            TestContext.WriteLine("{0:G3} and {1:G3} of {2:G3} J", one, two, peak);
            Assert.That(peak, Is.GreaterThan(1e-5));
            Assert.That(Math.Abs(one), Is.LessThan(1e-4 * peak));
        }

        private static double CycleWork(double perStep, out double peak)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, 243.0) };
            parameters.Scene.Walls = WallScenes.Floor(-500.0);
            parameters.Material.Sections[0].From = 100.0;
            parameters.Material.Sections[0].RestCurvature = new Vector3d(10.0, 0.0, 0.0);
            parameters.Scene.Catheters[0].Material.Sections[0].From = 30.0;
            parameters.Scene.Catheters[0].Material.Sections[0].RestCurvature = new Vector3d(6.0, 4.0, 0.0);
            return CoaxialScenes.CycleWork(parameters, perStep, out peak);
        }

        [Test]
        public void RunThatIsRestored_TakesTheSameSteps()
        {
            SimulationParameters parameters = Fed();
            parameters.Method.MaxSimulationSteps = 120;
            Wires.RunAndRestore(parameters, 50);
        }

        // The catheter's hub to the exit, where it stops; the wire's to the catheter's; and both tips into the sheath.
        [TestCase(0.0, 0.5, 0.15)]
        [TestCase(0.6, 0.5, 0.15)]
        [TestCase(-0.5, -0.5, double.NaN)]
        public void HubsGoAsFarAsTheExit_AndBothTipsInAndOutAgain(double wire, double catheter, double most)
        {
            SimulationParameters parameters = Fed();
            Catheter outer = parameters.Scene.Catheters[0];
            double dt = parameters.Method.TimeStep;
            parameters.Drive.Steering = new Steering { Push = 1e3 * wire * dt };
            outer.Drive.Steering = new Steering { Push = 1e3 * catheter * dt };
            Simulation run = Simulation.Create(parameters);
            for (int k = 0; k < 400; k++)
            {
                if (k == 200 && double.IsNaN(most))
                {
                    parameters.Drive.Steering.Push *= -1.0;
                    outer.Drive.Steering.Push *= -1.0;
                    Assert.That(run.Hub()!.LengthInBody, Is.Zero);
                    Assert.That(run.Hub()!.SpheresInBody, Is.Zero);
                    Assert.That(run.State.Positions[40].X, Is.Zero.Within(1e-2), "units: on the sheath's axis");
                }
                run.Step();
                Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
            }
            CoaxialRecord record = run.Coaxial()!;
            Assert.That(record.CommandedDisplacement, Is.EqualTo(record.Displacement + record.Shortfall).Within(1e-9));
            Assert.That(record.WireCommandedDisplacement,
                Is.EqualTo(record.WireDisplacement + record.WireShortfall).Within(1e-9));
            Assert.That(run.Contacts!.Passages, Is.Zero);
            Assert.That(record.Insertion, Is.EqualTo(double.IsNaN(most) ? 0.0 : most).Within(1e-9));
            Assert.That(run.Hub()!.Insertion, Is.EqualTo(wire > 0.0 ? most + 0.1 : 0.0).Within(1e-9));
            double inBody = 0.4 - 0.25 + run.Hub()!.Insertion;
            Assert.That(run.Hub()!.LengthInBody, Is.EqualTo(inBody).Within(1e-9));
        }

        // The sheath's exit is at 250. Both tips are drawn back into it, or the wire's into a catheter in the vessel.
        [TestCase(-0.5, 240.0, 0.34)]
        [TestCase(0.0, 260.0, 0.29)]
        public void TipDrawnBackIntoItsSheathOrCatheter_HasNotLeftTheVessel(double catheter, double inlet, double time)
        {
            SimulationParameters parameters = Fed();
            parameters.Scene.Walls = WallScenes.Tube(inlet, 1000.0, 12.0);
            parameters.Drive.InsertionSpeed = -0.5;
            parameters.Scene.Catheters[0].Drive.InsertionSpeed = catheter;
            parameters.Method.MaxSimulationSteps = (int)Math.Ceiling(time / parameters.Method.TimeStep);
            Simulation run = Wires.Finish(parameters);
            Assert.That(run.State.Positions[40].Z, Is.LessThan(inlet));
            Assert.That(run.Hub()!.SpheresInBody == 0, Is.EqualTo(catheter < 0.0));
            Assert.That(run.Warnings, Has.None.Contains("open rim"));
        }

        [Test]
        public void TipBetweenThoseOfTwoCatheters_IsInTheOuterOne()
        {
            SimulationParameters parameters = CoaxialScenes.Three(Integrator.ImplicitEuler);
            parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, 250.0) };
            parameters.Scene.Walls = WallScenes.Tube(260.0, 1000.0, 12.0);
            parameters.Drive.InsertionSpeed = -0.5;
            parameters.Scene.Catheters[1].Drive.InsertionSpeed = -0.5;
            parameters.Method.MaxSimulationSteps = 145;
            Simulation run = Wires.Finish(parameters);
            CoaxialRecord outer = run.Coaxial()!;
            Assert.That(run.State.Positions[40].Z, Is.LessThan(260.0).And.GreaterThan(250.0));
            Assert.That(outer.Positions[outer.Positions.Length - 1].Z, Is.GreaterThan(260.0));
            Assert.That(outer.Inside!.Extension, Is.Positive);
            Assert.That(run.Warnings, Has.None.Contains("open rim"));
        }

        [Test]
        public void Step_LeavesNothingForTheCollector_WhereNoNodeComesOrGoes()
        {
            SimulationParameters parameters = Fed();
            parameters.Drive.InsertionSpeed = 1e-5;
            parameters.Scene.Catheters[0].Drive.InsertionSpeed = 1e-5;
            Assert.That(Garbage.LeftBySteps(Simulation.Create(parameters), 20, 20), Is.Zero);
        }

        [TestCase(90.0, "catheters[0] has to start with its hub in the sheath: it is 0.01 m beyond")]
        [TestCase(101.0, "catheters[0]: an insertion of 0.0035 m is more than its hub's distance")]
        [TestCase(401.0, "its exit has to be on the wire at its start")]
        public void ExitThatTheHubsWouldPass_IsRefused(double exit, string expected)
        {
            SimulationParameters parameters = Fed();
            parameters.Method.MaxSimulationSteps = 25;
            parameters.Scene.Walls = WallScenes.Floor(-500.0);
            parameters.Scene.Sheath!.Exit = new Vector3d(0.0, 0.0, exit);
            Assert.That(Simulation.FindProblemOfStart(parameters), Does.Contain(expected));
        }

        // Both hubs push and turn, out of a sheath into a tube, through its closed end; the hubs are 150 and 250 mm
        // behind the exit.
        private static SimulationParameters Fed()
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, 250.0) };
            parameters.Scene.Walls = WallScenes.Tube(240.0, 1000.0, 12.0, openStart: false, friction: 0.1);
            parameters.Drive.InsertionSpeed = 0.15;
            parameters.Drive.RotationSpeed = 2.0;
            parameters.Scene.Catheters[0].Drive.InsertionSpeed = 0.07;
            return parameters;
        }

        private static SimulationParameters Sheathed(int elements)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Scene.GuidewireLength = 300.0;
            parameters.Scene.NumberRodElements = elements;
            parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, Exit) };
            parameters.Scene.TipForce = new Vector3d(0.01, 0.0, 0.0);
            parameters.Scene.Walls = WallScenes.Floor(-500.0);
            parameters.Material.Sections = Array.Empty<WireSection>();
            parameters.Material.MassDamping = 30.0;
            parameters.Method.TimeStep = 0.05;
            parameters.Method.MaxSimulationSteps = 200;
            Catheter catheter = parameters.Scene.Catheters[0];
            catheter.Start = 0.0;
            catheter.Length = 200.0;
            catheter.Elements = elements * 2 / 3;
            catheter.Material.Sections = Array.Empty<WireSection>();
            return parameters;
        }
    }
}
