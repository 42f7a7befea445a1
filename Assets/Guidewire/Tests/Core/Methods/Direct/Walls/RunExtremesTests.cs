using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What a run's extremes and contacts say, against closed forms and against what each step says.</summary>
    public sealed class RunExtremesTests
    {
        [Test]
        public void WireThatLiesInATube_IsPushedByItsWeightPerLengthAndDiameter()
        {
            Simulation run = Wires.GoOn(Simulation.Create(Level(0.0)), 400);
            double weight = 6450.0 * Math.PI * 0.16e-6 * 9.81;   // N/m
            ContactRecord contacts = run.Contacts!;
            Vector3d sum = Vector3d.Zero;
            foreach (Vector3d force in contacts.ElementForces)
            {
                sum += force;
            }
            Assert.That(Vector3d.Distance(sum, contacts.WallForces[0]), Is.LessThan(1e-12));
            Assert.That(contacts.ElementForces[15].Y, Is.EqualTo(weight * 0.01).Within(1e-3 * weight * 0.01));
            // The barrier of an end holds half of what others do: the wire bends there, and its neighbour bears more.
            Assert.That(contacts.Pressure, Is.InRange(weight / 0.8e-3, 1.1 * weight / 0.8e-3));
            RunExtremes extremes = run.Report()!.Extremes!;
            Assert.That(extremes.WallPressure, Is.GreaterThanOrEqualTo(contacts.Pressure));
            Assert.That(extremes.ElementForce, Is.GreaterThanOrEqualTo(contacts.ElementForces[15].Length));
            Assert.That(extremes.FrictionPower, Is.NaN);
            Assert.That(extremes.AxialForce, Is.NaN, "nothing holds the wire");
        }

        [Test]
        public void FrictionTakes_WhatTheHubPutsIn()
        {
            // Pushed along a level tube at 20 mm/s: friction takes what the hub gives, less what the drag does.
            SimulationParameters parameters = Level(0.3);
            parameters.Scene.ProximalEnd = ProximalEnd.Clamped;
            parameters.Scene.Walls = WallScenes.Tube(-50.0, 400.0, 1.0, height: 0.59, friction: 0.3);
            parameters.Contact.ContactDistance = 1e-5;
            parameters.Drive.Kind = Drive.Displace;
            parameters.Drive.DisplacementPerStep = 0.1;
            Simulation run = Wires.GoOn(Simulation.Create(parameters), 200);
            double before = run.Report()!.Extremes!.FrictionWork;
            double push = run.Contacts!.Reaction.Z;
            double drag = 40.0 * 6450.0 * Math.PI * 0.16e-6 * 0.3 * 0.02;
            run.Step();
            RunExtremes extremes = run.Report()!.Extremes!;
            Assert.That(push, Is.GreaterThan(0.0));
            Assert.That(extremes.FrictionWork - before, Is.EqualTo((drag - push) * 1e-4).Within(1e-3 * push * 1e-4));
            Assert.That(extremes.FrictionPower, Is.LessThanOrEqualTo(0.0));
            Assert.That(extremes.AxialForce, Is.GreaterThanOrEqualTo(push * (1.0 - 1e-6)));
        }

        // The element beyond the tip is the axial spring of all of the wire: its own stretch is no strain of the wire.
        [TestCase(0.03)]
        [TestCase(0.6)]
        public void WireThatHangsInACatheter_StrainsNoMoreThanItsWeightDoes_HoweverShortTheElementBeyondTheTip(
            double beyond)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            Catheter catheter = parameters.Scene.Catheters[0];
            catheter.Start = 110.0 - 10.0 * beyond;
            catheter.Material.Sections = Array.Empty<WireSection>();
            parameters.Material.Sections = Array.Empty<WireSection>();
            parameters.Scene.Gravity = new Vector3d(0.0, 0.0, 9.81);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            Simulation run = Wires.GoOn(Simulation.Create(parameters), 1);
            // Below the middle of the first element; each bears its own, the catheter with the larger strain.
            double strain = 9.81 * 0.245 * 1200.0 / 4e9;
            Assert.That(run.Report()!.Extremes!.Strain, Is.EqualTo(strain).Within(0.1).Percent);
        }

        [Test]
        public void CurvatureAndStrain_AreTheLargestOfAllSteps()
        {
            SimulationParameters parameters = WallScenes.Arch(30, 0.01, 100.0, 100.0);
            parameters.Material.RestCurvature = new Vector3d(5.0, 0.0, 0.0);
            Simulation run = Simulation.Create(parameters);
            double curvature = 0.0;
            double strain = 0.0;
            double force = 0.0;
            double when = 0.0;
            while (run.Outcome == Outcome.Running)
            {
                StressRecord stress = run.Stress()!;
                for (int k = 0; k < 30; k++)
                {
                    Vector3d here = stress.Curvature[k];
                    curvature = Math.Max(curvature, Math.Sqrt(here.X * here.X + here.Y * here.Y));
                    double bend = Math.Sqrt((here.X - 5.0) * (here.X - 5.0) + here.Y * here.Y);
                    strain = Math.Max(strain, 0.4e-3 * bend
                        + Math.Max(Math.Abs(stress.Strain[Math.Max(k - 1, 0)].Z), Math.Abs(stress.Strain[k].Z)));
                }
                run.Step();
                double now = Math.Abs(run.Hub()!.Force);
                when = now > force ? run.Time : when;
                force = Math.Max(force, now);
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            RunExtremes extremes = run.Report()!.Extremes!;
            // The last state is not among those looked at; stretch is along the chord there, along d3 here.
            Assert.That(extremes.Curvature, Is.GreaterThanOrEqualTo(curvature * (1.0 - 1e-12)));
            Assert.That(extremes.Curvature, Is.EqualTo(Math.Max(curvature, run.Hub()!.LargestCurvature))
                .Within(1e-9 * curvature));
            Assert.That(extremes.Strain, Is.EqualTo(strain).Within(1e-3 * strain));
            Assert.That(extremes.AxialForce, Is.EqualTo(force).Within(1e-6 * force));
            Assert.That(extremes.AxialForceTime, Is.EqualTo(when).Within(1e-9));
        }

        [TestCase(0.19, 3, true)]
        [TestCase(0.21, 3, false)]
        [TestCase(0.19, 0, true)]
        [TestCase(0.21, 0, false)]
        public void WireBentToFiveTimesItsRadius_IsNotReliable(double strain, int steps, bool isReliable)
        {
            // By a couple at its tip, to the arc M = EI k, whose outermost fibre is strained by r k.
            SimulationParameters parameters = Rods.Clamped(60, Solver.Direct, 1e-3, steps);
            MaterialParameters material = parameters.Material;
            double radius = material.WireRadius;
            parameters.Scene.GuidewireLength = 30e3 * radius;
            double bend = material.YoungsModulus * Math.PI * Math.Pow(radius, 4) / 4.0;
            parameters.Scene.TipMoment = new Vector3d(bend * strain / radius, 0.0, 0.0);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            Simulation run = Simulation.Create(parameters);
            Wires.Step(run, steps);
            Assert.That(run.Report()!.Extremes!.Strain, Is.EqualTo(strain).Within(1e-6));
            Assert.That(run.Outcome, Is.EqualTo(steps > 0 ? Outcome.Finished : Outcome.Converged), run.Reason);
            Assert.That(run.IsReliable, Is.EqualTo(isReliable));
            Assert.That(System.Linq.Enumerable.Where(run.Warnings, line => !line.Contains("elastic line")),
                Is.EqualTo(isReliable ? Array.Empty<string>() : new[]
            {
                "the outermost fibre was strained by up to 21 % at t = 0 s: a real instrument would have kinked",
            }));
        }

        // A tip of a coil around a core: what is solid is a tenth of the wire, and strained by a tenth.
        [TestCase(false)]
        [TestCase(true)]
        public void CoiledTip_IsStrainedByItsCore(bool isSection)
        {
            SimulationParameters parameters = Rods.Clamped(60, Solver.Direct, 1e-3, 0);
            MaterialParameters material = parameters.Material;
            double radius = material.WireRadius;
            parameters.Scene.GuidewireLength = 15e3 * radius;    // less than a ring
            double bend = material.YoungsModulus * Math.PI * Math.Pow(radius, 4) / 4.0;
            parameters.Scene.TipMoment = new Vector3d(bend * 0.3 / radius, 0.0, 0.0);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            material.CoreDiameter = isSection ? (double?)null : 0.2 * radius;
            material.Sections = isSection ? new[]
            {
                new WireSection { From = 0.0, To = 15e3 * radius, WireRadius = radius, CoreDiameter = 0.2 * radius },
            }
                : Array.Empty<WireSection>();
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Report()!.Extremes!.Strain, Is.EqualTo(0.03).Within(1e-6));
            Assert.That(run.IsReliable, Is.True, string.Join("; ", run.Warnings));
        }

        // The joint at a border has the mean compliance of both sections, and the thicker one is strained more there
        // than
        // the thin one anywhere.
        [TestCase(4.0, 1.0)]
        [TestCase(1.0, 4.0)]
        public void JointBetweenSections_IsStrainedByTheThickerOne(double first, double second)
        {
            const double radius = 1e-4;
            const double couple = 1e-6;
            SimulationParameters parameters = Rods.Clamped(60, Solver.Direct, 1e-3, 0);
            parameters.Scene.GuidewireLength = 60.0;
            parameters.Material.WireRadius = radius * first;
            parameters.Material.Sections = new[] { new WireSection { From = 30.0, To = 60.0,
                WireRadius = radius * second } };
            parameters.Scene.TipMoment = new Vector3d(couple, 0.0, 0.0);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            Simulation run = Simulation.Create(parameters);
            double bend = parameters.Material.YoungsModulus * Math.PI * Math.Pow(radius, 4) / 4.0;
            double atBorder = 0.5 * couple * (1.0 + 1.0 / 256.0) / bend;
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            Assert.That(run.Report()!.Extremes!.Strain, Is.EqualTo(4.0 * radius * atBorder).Within(0.1).Percent);
        }

        [Test]
        public void TimeOfTheLargestForce_IsThatOfAPullToo()
        {
            var extremes = new RunExtremes();
            extremes.TakeHub(1.0, -3.0, 1.0, 0.0);
            extremes.TakeHub(-2.0, 2.0, 2.0, 0.0);
            extremes.TakeHub(-1.5, 1.0, 3.0, 0.0);
            Assert.That(extremes.AxialForce, Is.EqualTo(2.0));
            Assert.That(extremes.AxialForceTime, Is.EqualTo(2.0));
            Assert.That(extremes.AxialTorqueTime, Is.EqualTo(1.0));
        }

        [Test]
        public void Extremes_GoOnWithTheRun()
        {
            Simulation run = Simulation.Create(WallScenes.Arch(30, 0.01, 100.0, 60.0));
            Wires.Step(run, 50);
            Simulation next = Simulation.Restore(WallScenes.Arch(30, 0.01, 100.0, 60.0), run.Save());
            Assert.That(next.Report()!.Extremes!.WallPressure, Is.EqualTo(run.Report()!.Extremes!.WallPressure));
            Assert.That(next.Contacts!.ElementForces, Is.EqualTo(run.Contacts!.ElementForces));
        }

        // A wire near the wall of a level tube, under its weight.
        private static SimulationParameters Level(double friction)
        {
            SimulationParameters parameters = WallScenes.Wire(30, 0.4e-3);
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.ProximalEnd = ProximalEnd.Free;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Scene.Walls = WallScenes.Tube(-50.0, 400.0, 1.0, friction: friction);
            parameters.Method.TimeStep = 5e-3;
            parameters.Material.MassDamping = 40.0;    // 1/s
            parameters.Method.SolverTolerance = 1e-9;
            parameters.Method.MaxSimulationSteps = 1000;
            return parameters;
        }
    }
}
