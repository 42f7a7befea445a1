using System;
using System.Globalization;
using System.Text.RegularExpressions;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What is said of a wire between walls whose step has no solution.</summary>
    internal sealed class StepFailureTests
    {
        /// <summary>A hub that goes on where the walls block it: its force and the contact that bears most of it,
        /// on the wire and in the vessel, are named, and what lets it give way.</summary>
        [Test]
        public void Jam_NamesForcePlaceAndLimit()
        {
            SimulationParameters parameters = WallScenes.Arch(30, 0.01, 1000.0, 400.0);
            parameters.Drive.HubForceLimit = 0.0;
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed), run.Reason);
            Assert.That(run.Reason, Does.Contain("hubForceLimit").And.Not.Contain("shorter timeStep"));
            Match said = Regex.Match(run.Reason, @"the hub pushes with (\S+) N; the largest of \d+ contact forces is"
                + @" (\S+) N, (\S+) units of wire before its tip, at \((\S+), (\S+), (\S+)\)");
            Assert.That(said.Success, run.Reason);
            double hub = Number(said, 1);
            Assert.That(hub, Is.GreaterThan(1.0));
            Assert.That(Number(said, 2), Is.InRange(0.1 * hub, 10.0 * hub));
            // The place on the wire and the place in the vessel are one.
            double fromTip = Number(said, 3);
            var place = new Vector3d(Number(said, 4), Number(said, 5), Number(said, 6));
            Vector3d[] x = run.State.Positions;
            int n = x.Length - 1;
            double spacing = 300.0 / n;
            Assert.That(fromTip, Is.InRange(0.0, 300.0));
            double at = n - fromTip / spacing;
            int j = (int)Math.Min(Math.Floor(at), n - 1);
            Assert.That(Vector3d.Distance(place, Vector3d.Lerp(x[j], x[j + 1], at - j)), Is.LessThan(spacing));
        }

        /// <summary>Steps and time of a run whose last step has no solution are those of its state: the time that the
        /// reason names is in the step that was not done.</summary>
        [Test]
        public void StepWithoutSolution_IsNotCounted()
        {
            SimulationParameters parameters = WallScenes.Arch(30, 0.01, 500.0, 100.0);
            parameters.Contact.ContactStiffness = 1e-300;
            Simulation run = Simulation.Create(parameters);
            int done = 0;
            Vector3d tip = run.State.Positions[30];
            while (run.Outcome == Outcome.Running)
            {
                (done, tip) = (run.StepCount, run.State.Positions[30]);
                run.Step();
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed), run.Reason);
            double dt = parameters.Method.TimeStep;
            double time = Number(Regex.Match(run.Reason, @"the step to t = (\S+) s has no solution"), 1);
            Assert.That(time, Is.InRange(done * dt, (done + 1) * dt * (1.0 + 1e-5)));
            Assert.That(run.StepCount, Is.EqualTo(done));
            Assert.That(run.Time, Is.EqualTo(done * dt).Within(1e-12));
            Assert.That(run.State.Positions[30], Is.EqualTo(tip));
            Assert.That(run.HasStateOfStep);
        }

        private static double Number(Match match, int group) =>
            double.Parse(match.Groups[group].Value, CultureInfo.InvariantCulture);
    }
}
