using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What is told of a wire that goes through itself, and what is not; its passages on paths that are
    /// known.</summary>
    public sealed class StrandMonitorTests
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
            StrandMonitor monitor = Monitor(out double diameter);
            double radius = 8.0;
            double pitch = pitchInDiameters * diameter;
            double turn = Math.Sqrt(Math.Pow(2.0 * Math.PI * radius, 2.0) + pitch * pitch);
            monitor.Follow(Curve(s => new Vector3d(radius * Math.Cos(2.0 * Math.PI * s / turn),
                radius * Math.Sin(2.0 * Math.PI * s / turn), pitch * s / turn)), 0.5);
            Assert.That(Warning(monitor).HasValue, Is.EqualTo(overlaps), Warning(monitor)?.Text);
            if (overlaps)
            {
                Assert.That(Warning(monitor)!.Value.Text, Does.Contain("t = 0.5 s")
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
            StrandMonitor monitor = Monitor(out double diameter);
            double r = radiusInDiameters * diameter;
            double arc = Math.PI * r;
            double from = 0.5 * (Length - arc);
            monitor.Follow(Curve(s => s < from ? new Vector3d(0.0, -r, s - from)
                : s < from + arc ? new Vector3d(0.0, -r * Math.Cos((s - from) / r), r * Math.Sin((s - from) / r))
                : new Vector3d(0.0, r, from + arc - s)), 0.5);
            Assert.That(Warning(monitor), Is.Null);
        }

        [Test]
        public void HairpinWhoseLegsMeet_IsToldWithItsPlaces()
        {
            StrandMonitor monitor = Monitor(out double diameter);
            // Two straight legs that cross at 90 mm from either end.
            monitor.Follow(Curve(s => s < 0.5 * Length ? new Vector3d(0.0, 0.4 * (s - 90.0), 0.9 * s)
                : new Vector3d(0.4 * diameter, 0.4 * (Length - s - 90.0) * -1.0, 0.9 * (Length - s))), 1.25);
            Assert.That(Warning(monitor)!.Value.Text, Does.Contain("t = 1.25 s").And.Contain("at 90 and 150 units")
                .And.Contain(" are 0.4 of a diameter"));
        }

        [Test]
        public void Ring_IsClosedWhereItsEndsMeet_AndItsNeighboursAreNot()
        {
            StrandMonitor monitor = Monitor(out _);
            double r = Length / (2.0 * Math.PI);
            monitor.Follow(Curve(s => new Vector3d(0.0, r * Math.Cos(s / r), r * Math.Sin(s / r))), 0.5);
            Assert.That(Warning(monitor), Is.Null);
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

        [TestCase(0.3, 2, 1)]
        [TestCase(0.3, 300, 1)]     // steps far below the radius
        [TestCase(-1.5, 2, 0)]      // beside the strand
        public void StrandThroughStrand_Counts_BesideItDoesNot(double across, int steps, int expected)
        {
            Vector3d[] x = Loop(across, 0.5);
            var passages = Passages(x);
            for (int step = 1; step <= steps; step++)
            {
                passages.Follow(Loop(across, 0.5 - 1.0 * step / steps), 0.0);
            }
            passages.Follow(Loop(across, -0.5), 0.0);
            Assert.That(passages.Passages, Is.EqualTo(expected));
        }

        // From the crossing to the tip the wire is 1.9 long: strands that go half as far may have gone round the tip.
        [TestCase(0.0, 1)]
        [TestCase(0.8, 1)]
        [TestCase(1.1, 0)]
        public void StrandsThatAreKeptApart_HavePassed_WhereTheyCannotHaveGoneRoundTheTip(double away, long expected)
        {
            StrandMonitor passages = Passages(Loop(0.3, 0.05), keepsApart: true);
            passages.Follow(Array.ConvertAll(Loop(0.3, -0.05), x => x + away * Vector3d.UnitX), 0.0);
            Assert.That(passages.Passages, Is.EqualTo(expected));
        }

        [Test]
        public void ThereAndBackWithinALook_IsNoPassage_AndEachWayIsOne()
        {
            var passages = Passages(Loop(0.3, 0.5));
            passages.Follow(Loop(0.3, 0.51), 0.0);
            Assert.That(passages.Passages, Is.Zero);
            passages.Follow(Loop(0.3, -0.5), 0.0);
            passages.Follow(Loop(0.3, 0.5), 0.0);
            Assert.That(passages.Passages, Is.EqualTo(2));
        }

        [Test]
        public void SlidingAlongItself_IsNoPassage()
        {
            // A coil of two turns, one above the other, that advances along itself.
            Vector3d[] At(double shift)
            {
                var x = new Vector3d[81];
                for (int i = 0; i < x.Length; i++)
                {
                    double angle = 0.16 * (i + shift);
                    x[i] = new Vector3d(Math.Cos(angle), Math.Sin(angle), 0.02 * angle);
                }
                return x;
            }
            var passages = Passages(At(0.0));
            for (int step = 1; step <= 40; step++)
            {
                passages.Follow(At(0.5 * step), 0.0);
            }
            Assert.That(passages.Passages, Is.Zero);
        }

        private static StrandMonitor Monitor(out double diameter)
        {
            const double radius = 0.178;
            diameter = 2.0 * radius;
            var length = new double[N];
            var radii = new double[N];
            Array.Fill(length, Length / N);
            Array.Fill(radii, radius);
            return new StrandMonitor(length, radii, N);
        }

        private static RunWarning? Warning(StrandMonitor monitor) => monitor.WarningOf("the wire");

        // Of an instrument of radius 0.05 that starts so.
        private static StrandMonitor Passages(Vector3d[] start, bool keepsApart = false)
        {
            int n = start.Length - 1;
            var radii = new double[n];
            Array.Fill(radii, 0.05);
            var length = new double[n];
            for (int j = 0; j < n; j++)
            {
                length[j] = Vector3d.Distance(start[j], start[j + 1]);
            }
            var monitor = new StrandMonitor(length, radii, n, keepsApart);
            monitor.Begin(start);
            return monitor;
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

        // Two strands that cross where the second one is so far across, at a height over the first.
        private static Vector3d[] Loop(double across, double height) => new[]
        {
            new Vector3d(-1.0, 0.0, 0.0), new Vector3d(0.1, 0.0, 0.0), new Vector3d(1.0, 0.0, 0.0),
            new Vector3d(2.0, 1.0, 0.0), new Vector3d(1.0, 2.0, height), new Vector3d(across, 1.0, height),
            new Vector3d(across, -0.9, height),
        };
    }
}
