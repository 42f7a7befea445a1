using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What is told of a wire that goes through itself, and what is not.</summary>
    public sealed class SelfOverlapTests
    {
        private const int N = 120;
        private const double Length = 240.0;

        // Turns of a helix are a pitch apart, along its axis, times the cosine of its slope.
        [TestCase(2.2, false)]
        [TestCase(1.05, false)]
        [TestCase(0.9, true)]
        [TestCase(0.3, true)]
        public void Coil_OverlapsWhereItsTurnsAreNearerThanADiameter(double pitchInDiameters, bool overlaps)
        {
            SelfOverlap monitor = Monitor(out double diameter);
            double radius = 8.0;
            double pitch = pitchInDiameters * diameter;
            double turn = Math.Sqrt(Math.Pow(2.0 * Math.PI * radius, 2.0) + pitch * pitch);
            monitor.Update(0, Curve(s => new Vector3d(radius * Math.Cos(2.0 * Math.PI * s / turn),
                radius * Math.Sin(2.0 * Math.PI * s / turn), pitch * s / turn)), 0.5);
            Assert.That(monitor.Warning.HasValue, Is.EqualTo(overlaps), monitor.Warning?.Text);
            if (overlaps)
            {
                Assert.That(monitor.Warning!.Value.Text, Does.Contain("t = 0.5 s")
                    .And.Contain(" are " + pitchInDiameters.ToString("G2",
                        System.Globalization.CultureInfo.InvariantCulture)));
            }
        }

        // Bent to its own radius its ends are a diameter apart after half a turn, never before that arc is over.
        [TestCase(0.55)]
        [TestCase(2.0)]
        [TestCase(20.0)]
        public void Hairpin_DoesNotOverlap(double radiusInDiameters)
        {
            SelfOverlap monitor = Monitor(out double diameter);
            double r = radiusInDiameters * diameter;
            double arc = Math.PI * r;
            double from = 0.5 * (Length - arc);
            monitor.Update(0, Curve(s => s < from ? new Vector3d(0.0, -r, s - from)
                : s < from + arc ? new Vector3d(0.0, -r * Math.Cos((s - from) / r), r * Math.Sin((s - from) / r))
                : new Vector3d(0.0, r, from + arc - s)), 0.5);
            Assert.That(monitor.Warning, Is.Null);
        }

        [Test]
        public void HairpinWhoseLegsMeet_IsToldWithItsPlaces()
        {
            SelfOverlap monitor = Monitor(out double diameter);
            // Two straight legs that cross at 90 mm from either end.
            monitor.Update(0, Curve(s => s < 0.5 * Length ? new Vector3d(0.0, 0.4 * (s - 90.0), 0.9 * s)
                : new Vector3d(0.4 * diameter, 0.4 * (Length - s - 90.0) * -1.0, 0.9 * (Length - s))), 1.25);
            Assert.That(monitor.Warning!.Value.Text, Does.Contain("t = 1.25 s").And.Contain("at 90 and 150 units")
                .And.Contain(" are 0.4 of a diameter"));
        }

        [Test]
        public void Ring_IsClosedWhereItsEndsMeet_AndItsNeighboursAreNot()
        {
            SelfOverlap monitor = Monitor(out _);
            double r = Length / (2.0 * Math.PI);
            monitor.Update(0, Curve(s => new Vector3d(0.0, r * Math.Cos(s / r), r * Math.Sin(s / r))), 0.5);
            Assert.That(monitor.Warning, Is.Null);
        }

        [TestCase(Solver.Pbd)]
        [TestCase(Solver.Direct)]
        [TestCase(Solver.Xpbd)]
        public void RunThatStartsSo_IsNotReliable_WithEveryMethod(Solver solver)
        {
            SimulationParameters parameters = Rods.Clamped(80, solver, 1e-6, 2);
            parameters.Scene.ProximalEnd = solver == Solver.Pbd ? ProximalEnd.Held : ProximalEnd.Free;
            parameters.Contact.SphereRadius = 0.5;
            parameters.Scene.GuidewireLength = 100.0;
            parameters.Scene.StartShape = StartShape.Helix;
            parameters.Scene.StartRadius = 3.0;
            parameters.Scene.StartTurns = 5.3;
            Simulation run = Simulation.Create(parameters);
            run.Step();
            run = Simulation.Restore(parameters, run.Save());
            run.Step();
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(run.IsReliable, Is.False);
            Assert.That(run.Warnings, Has.Some.Contains("the wire goes through itself: at t = "));
        }

        private static SelfOverlap Monitor(out double diameter)
        {
            SimulationParameters parameters = Rods.Clamped(N, Solver.Direct, 1e-3, 1);
            parameters.Scene.GuidewireLength = Length;
            diameter = 2e3 * parameters.Material.WireRadius;
            return new SelfOverlap(parameters);
        }

        private static Vector3d[] Curve(Func<double, Vector3d> at)
        {
            var x = new Vector3d[N + 1];
            for (int i = 0; i <= N; i++)
            {
                x[i] = at(Length * i / N);
            }
            return x;
        }
    }
}
