using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Friction between a wire and the lumen of a bent catheter: the capstan's law, and what it holds at
    /// rest.</summary>
    public sealed class LumenFrictionTests
    {
        private const double Load = 0.1;    // N, at the wire's tip along the catheter's end
        private const double Length = 200.0;  // of the catheter, mm

        // Where the angle ends and the limp wire's own bending: 1 % of the pull, far below what is looked for.
        private const double Tolerance = 0.01;

        [Test]
        public void PulledWire_HasTheCapstansForce([Values(0.05, 0.2, 0.5)] double coefficient,
            [Values(30.0, 90.0, 180.0)] double degrees)
        {
            double grows = Math.Exp(coefficient * Math.PI / 180.0 * degrees);
            Simulation run = Start(coefficient, degrees, out Steering hub, out _);
            hub.Push = -0.05;
            Wires.GoOn(run, 12);
            Assert.That(run.Coaxial()!.WireForce, Is.EqualTo(-Load * grows).Within(Tolerance * Load * grows), "drawn");
            double drawn = run.Coaxial()!.WireForce;
            double both = run.Coaxial()!.Force + drawn;
            hub.Push = 0.0;
            Wires.GoOn(run, 12);
            Assert.That(run.Coaxial()!.WireForce, Is.EqualTo(drawn).Within(Tolerance * Load), "at rest");
            hub.Push = 0.05;
            Wires.GoOn(run, 12);
            Assert.That(run.Coaxial()!.WireForce, Is.EqualTo(-Load / grows).Within(Tolerance * Load), "let out");
            // What friction takes from one hub it gives the other.
            Assert.That(run.Coaxial()!.Force + run.Coaxial()!.WireForce, Is.EqualTo(both).Within(Tolerance * Load));
        }

        // The wire is drawn back: friction of the lumen counts towards the force at which its hub slips. It goes till
        // it has its limit, and stays.
        [TestCase(0.2, 90.0, 0.12)]
        [TestCase(0.2, 90.0, 0.135)]
        [TestCase(0.5, 180.0, 0.3)]
        public void SlippingHub_HasItsLimitWithFriction(double coefficient, double degrees, double limit)
        {
            Simulation run = StartSlipping(coefficient, degrees, limit, out Steering hub);
            Simulation free = StartSlipping(0.0, degrees, limit, out Steering freeHub);
            hub.Push = -0.05;
            freeHub.Push = -0.05;
            Wires.GoOn(run, 12);
            Wires.GoOn(free, 12);
            double grown = Load * Math.Exp(coefficient * Math.PI / 180.0 * degrees);
            Assert.That(limit, Is.LessThan(grown), "what it would be");
            Assert.That(run.Coaxial()!.WireForce, Is.InRange(-limit, -0.979 * limit));
            Assert.That(run.Coaxial()!.FrictionForce, Is.EqualTo(run.Coaxial()!.WireForce + Load)
                .Within(Tolerance * Load));
            Assert.That(run.Coaxial()!.WireShortfall, Is.GreaterThan(0.9 * run.Coaxial()!.WireCommandedDisplacement));
            Assert.That(run.Coaxial()!.WireDisplacement + run.Coaxial()!.WireShortfall,
                Is.EqualTo(run.Coaxial()!.WireCommandedDisplacement).Within(1e-12));
            Assert.That(free.Coaxial()!.WireShortfall, Is.Zero, "without friction it does not slip");
        }

        // The hub is where the catheter's is: it cannot give way to the pull, and loses nothing.
        [Test]
        public void HubBeyondItsLimit_IsSaidToBe_WhereItFallsShortOfNothing()
        {
            Simulation run = StartSlipping(0.0, 90.0, 0.5 * Load, out Steering hub, 0.0);
            Wires.GoOn(run, 3);
            run.End(Outcome.Interrupted, "asked");
            Assert.That(run.Coaxial()!.WireShortfall, Is.Zero);
            Assert.That(run.Coaxial()!.WireForce, Is.EqualTo(-Load).Within(Tolerance * Load));
            Assert.That(run.Reason, Does.Contain("the wire's hub had up to 0.1 N, above its hubForceLimit of 0.05 N,"
                + " in 3 of"));
        }

        [Test]
        public void WithoutACoefficient_ThereIsNone()
        {
            Simulation run = Start(0.0, 90.0, out Steering hub, out _);
            hub.Push = -0.05;
            Wires.GoOn(run, 12);
            Assert.That(run.Coaxial()!.FrictionForce, Is.Zero);
            Assert.That(run.Coaxial()!.WireForce, Is.EqualTo(-Load).Within(Tolerance * Load));
            Assert.That(run.Coaxial()!.OverlapAngle, Is.EqualTo(0.5 * Math.PI).Within(Tolerance));
        }

        [TestCase(0.3, 1.2, 0.0)]
        [TestCase(0.3, 1.2, 0.4)]
        [TestCase(-0.3, 1.2, 0.4)]
        [TestCase(-0.02, 2.0, 0.4)]
        public void Bounds_AreTheSolutionOfTheCapstansEquation(double force, double angle, double end)
        {
            // dT/ds = mu |T| kappa along the lumen as the wire is pushed on, in 200,000 pieces, and mu P at each end.
            const double mu = 0.3;
            const int pieces = 200000;
            double t = force + mu * end;
            for (int k = 0; k < pieces; k++)
            {
                t += mu * Math.Abs(t) * angle / pieces;
            }
            var friction = new LumenFriction(mu, 1e-6);
            friction.Slide(1e-3);
            Assert.That(friction.Force(force, angle, end), Is.EqualTo(t + mu * end - force).Within(1e-5));
            // Drawn back, all signs are reversed; in between after half of the distance.
            friction.Slide(-1e-3);
            Assert.That(friction.Force(-force, angle, end), Is.EqualTo(-(t + mu * end - force)).Within(1e-5));
            friction.Slide(1e-6);
            Assert.That(friction.Force(force, angle, end), Is.Zero.Within(1e-12));
        }

        // A limp wire in a limp catheter, both pulled at their tips, through one that is bent by an angle and does not
        // give: for all in a lumen together dT/ds = mu |T kappa|, and for the wire in its own. Both are drawn back;
        // then the catheter is let out while the wire is drawn.
        [TestCase(0.2, 0.1, 90.0)]
        [TestCase(0.5, 0.3, 180.0)]
        [TestCase(0.0, 0.3, 90.0)]
        [TestCase(0.3, 0.0, 90.0)]
        public void LumensInOneAnother_HaveTheForcesOfIntegratedCapstans(double inner, double outer, double degrees)
        {
            const double InnerLoad = 0.07;
            Start(outer, degrees, out Steering hub, out SimulationParameters parameters);
            Catheter around = parameters.Scene.Catheters[0];
            CoaxialScenes.SetTube(around, 1.35e-3, 1.0e-3, 1e13, 4e12);
            var limp = new Catheter { Length = 235.0, Elements = 47, Start = 25.0, LumenFriction = inner };
            CoaxialScenes.SetTube(limp, 0.25e-3, 0.15e-3, 5e8, 2e8);
            limp.TipForce = InnerLoad / Load * parameters.Scene.TipForce;
            limp.Drive.Steering = new Steering();
            parameters.Scene.Catheters = new[] { around, limp };
            Simulation run = Simulation.Create(parameters);
            double both = run.Coaxial()!.Force + run.Coaxial()!.Inside!.Force + run.Coaxial()!.WireForce;
            hub.Push = -0.05;
            limp.Drive.Steering.Push = -0.025;
            Wires.GoOn(run, 12);
            AssertForces(run, Integrated(Load, inner, degrees), Integrated(Load + InnerLoad, outer, degrees), both);
            limp.Drive.Steering.Push = 0.025;
            Wires.GoOn(run, 12);
            AssertForces(run, Integrated(Load, inner, degrees), Integrated(Load + InnerLoad, -outer, degrees), both);
        }

        private static void AssertForces(Simulation run, double wire, double inside, double all)
        {
            CoaxialRecord outer = run.Coaxial()!;
            double innerForce = outer.Inside!.Force;
            TestContext.WriteLine("{0:G5} of {1:G5} N, {2:G5} of {3:G5} N", outer.WireForce, -wire,
                innerForce + outer.WireForce, -inside);
            Assert.That(outer.WireForce, Is.EqualTo(-wire).Within(Tolerance * wire));
            Assert.That(innerForce + outer.WireForce, Is.EqualTo(-inside).Within(Tolerance * inside));
            Assert.That(outer.Force + innerForce + outer.WireForce, Is.EqualTo(all).Within(Tolerance * Load));
        }

        // Of a tension from the tip to the hub, in 100,000 pieces.
        private static double Integrated(double tension, double coefficient, double degrees)
        {
            const int pieces = 100_000;
            for (int k = 0; k < pieces; k++)
            {
                tension += coefficient * Math.Abs(tension) * Math.PI / 180.0 * degrees / pieces;
            }
            return tension;
        }

        // A limp wire through a catheter that is bent by an angle and does not give, its tip pulled along.
        private static Simulation Start(double coefficient, double degrees, out Steering hub,
            out SimulationParameters parameters, double lead = 50.0)
        {
            parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            double angle = Math.PI / 180.0 * degrees;
            parameters.Method.TimeStep = 0.01;
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Scene.GuidewireLength = 275.0;
            parameters.Scene.NumberRodElements = 50;
            parameters.Scene.TipForce = Load * new Vector3d(0.0, -Math.Sin(angle), Math.Cos(angle));
            parameters.Material.Sections = Array.Empty<WireSection>();
            parameters.Material.WireRadius = 0.1e-3;
            parameters.Material.YoungsModulus = 2e9;
            parameters.Material.ShearModulus = 1e9;
            hub = new Steering();
            parameters.Drive.Steering = hub;
            Catheter catheter = parameters.Scene.Catheters[0];
            catheter.Length = Length;
            catheter.Elements = 40;
            catheter.Start = lead;
            catheter.LumenFriction = coefficient;
            catheter.Material.YoungsModulus = 1e13;
            catheter.Material.ShearModulus = 4e12;
            catheter.Material.Sections = Array.Empty<WireSection>();
            catheter.Material.RestCurvature = new Vector3d(angle / (1e-3 * Length), 0.0, 0.0);
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
            return run;
        }

        /// <summary>Coefficients that no file may have: the force overflows, and no result with it is
        /// reliable.</summary>
        [TestCase(10.0)]
        [TestCase(1e3)]
        [TestCase(1e300)]
        public void ForceBeyondWhatTheWireBears_IsNotReliable(double coefficient)
        {
            Start(coefficient, 90.0, out _, out SimulationParameters parameters);
            parameters.Drive.Steering = null;
            parameters.Drive.InsertionSpeed = -0.05;
            parameters.Method.MaxSimulationSteps = 12;
            Simulation run = Simulation.Create(parameters);
            Wires.Step(run, 12);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            double force = run.Hub()!.Force;
            TestContext.WriteLine("{0:G4} N", force);
            Assert.That(Math.Abs(force) <= 0.2 * Math.PI * 1e-8 * 2e9, Is.False);
            Assert.That(run.Warnings, Has.Some.Contains("outermost fibre was strained"));
            Assert.That(run.IsReliable, Is.False);
        }

        // It goes on with a hub that slips, as hubs do between walls: one that is far from both.
        private static Simulation StartSlipping(double coefficient, double degrees, double limit, out Steering hub,
            double lead = 50.0)
        {
            Simulation run = Start(coefficient, degrees, out hub, out SimulationParameters parameters, lead);
            parameters.Scene.InitialState = InitialState.Straight;
            parameters.Scene.Walls = new ContactShape[] { new PlaneShape(new Vector3d(500.0, 0.0, 0.0),
                -Vector3d.UnitX) };
            parameters.Drive.HubForceLimit = limit;
            return run.Continue(parameters);
        }
    }
}
