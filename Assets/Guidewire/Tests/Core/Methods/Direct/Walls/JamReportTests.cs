using System;
using System.Globalization;
using System.Text.RegularExpressions;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What is said of a wire between walls whose step has no solution.</summary>
    [TestFixture]
    internal sealed class JamReportTests
    {
        /// <summary>A hub that goes on where the walls bar its way: its force and the contact that bears most of it,
        /// on the wire and in the vessel, are named, and what lets it give way.</summary>
        [Test]
        public void Jam_NamesForcePlaceAndLimit()
        {
            Simulation run = Wires.Run(WallScenes.Arch(30, 0.01, 1000.0, 400.0));
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Failed), run.Reason);
            Assert.That(run.Reason, Does.Contain("hubForceLimit").And.Not.Contain("shorter timeStep"));
            Match said = Regex.Match(run.Reason, @"the hub pushes with (\S+) N; of \d+ contacts the hardest pushes with"
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

        private static double Number(Match match, int group)
        {
            return double.Parse(match.Groups[group].Value, CultureInfo.InvariantCulture);
        }
    }
}
