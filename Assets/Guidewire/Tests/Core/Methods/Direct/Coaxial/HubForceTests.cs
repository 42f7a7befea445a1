using System;
using System.Linq;
using Guidewire.Io;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Forces of several hubs where they are known, and where no hand could hold them.</summary>
    public sealed class HubForceTests
    {
        private const double Radius = 0.25e-3;      // m
        private const double Drop = 3.0;            // units, from the catheter's tip to the axis of a wire on the plane
        private const double Young = 2e9;           // Pa

        /// <summary>A wire comes out of a rigid catheter at 45 degrees to a plane without friction, and lies on it. To
        /// push it on moves what lies there along the plane: its hub has no force. The plane bends it by a force at
        /// one point: of an elastica that turns from 45 degrees to 0, f = B/2 (I/D)^2 with I the integral of
        /// sqrt(sin t) and D the drop.</summary>
        [TestCase(80)]
        [TestCase(160, Category = "Long")]
        public void WireThatLiesOnAPlane_IsPushedWithoutForce_AndBearsThatOfAnElastica(int elements)
        {
            SimulationSession run = Open("'solver': 'direct', 'guidewireLength': 110, 'numberRodElements': "
                + elements + ", 'guidewireOffset': -90, 'wireRadius': 0.00025, 'youngsModulus': 2e9,"
                + " 'shearModulus': 8e8,"
                + " 'massDamping': 50, 'proximalEnd': 'clamped', 'drive': 'displace', 'insertionSpeed': 0.008,"
                + " 'timeStep': 0.02, 'deltaThreshold': 0, 'maxSimulationSteps': 170, 'hubForceLimit': null,"
                + " 'catheters': [{'start': 90, 'length': 20, 'elements': " + elements / 6 + ", 'wireRadius': 0.0008,"
                + " 'lumenRadius': 0.0006, 'youngsModulus': 6e13, 'shearModulus': 2.3e13, 'density': 1400,"
                + " 'hubForceLimit': null}],"
                + " 'vessel': {'shape': 'plane', 'point': [0, -" + Side + ", " + Far + "],"
                + " 'normal': [0, 1, -1]}");
            double hub = 0.0;
            double wall = 0.0;
            int taken = 0;
            while (run.Simulation.Outcome == Outcome.Running)
            {
                run.Simulation.Step();
                if (run.Simulation.StepCount > 100)
                {
                    hub += run.Simulation.Hub()!.Force;
                    wall += run.Simulation.Contacts!.WallForces[0].Length;
                    taken++;
                }
            }
            Assert.That(run.Simulation.Outcome, Is.EqualTo(Outcome.Finished), run.Simulation.Reason);
            double bend = Young * Math.PI / 4.0 * Math.Pow(Radius, 4);
            double integral = 0.0;
            const int Pieces = 20000;
            for (int k = 0; k < Pieces; k++)
            {
                integral += Math.Sqrt(Math.Sin((k + 0.5) * Math.PI / 4.0 / Pieces)) * Math.PI / 4.0 / Pieces;
            }
            double right = 0.5 * bend * Math.Pow(1e3 * integral / Drop, 2);
            TestContext.WriteLine("hub {0:G4} N, wall {1:G5} N for {2:G5} N", hub / taken, wall / taken, right);
            Assert.That(hub / taken, Is.Zero.Within(0.003 * right));
            Assert.That(wall / taken, Is.EqualTo(right).Within(3.0).Percent);
            Assert.That(run.Simulation.Hub()!.ForceError, Is.LessThan(0.1 * right));
        }

        /// <summary>Bent tips of two catheters that start straight spring to the walls and out of one another: each of
        /// three hubs holds no more than 0.02 N, and goes no faster than it may slip.</summary>
        [Test]
        public void ThreeHubsOfSmallForce_KeepIt_FromAColdStartOn()
        {
            const double Limit = 0.02;
            const double Speed = 0.5;
            SimulationSession run = Open("'solver': 'direct', 'instrument': 'workhorse-0.014', 'guidewireLength': 320,"
                + " 'numberRodElements': 64, 'guidewireOffset': -150, 'massDamping': 20, 'proximalEnd': 'clamped',"
                + " 'drive': 'displace', 'insertionSpeed': 0.03, 'hubForceLimit': 0.02, 'timeStep': 0.01,"
                + " 'deltaThreshold': 0, 'maxSimulationSteps': 4, 'vessel': {'shape': 'tube', 'smooth': true,"
                + " 'openStart': true, 'openEnd': true, 'radius': 2, 'frictionCoefficient': 0.1,"
                + " 'knots': [[0, 0, -5], [0, 0, 300]]},"
                + " 'catheters': [{'start': 215, 'length': 80, 'elements': 16, 'hubForceLimit': 0.02, 'wireRadius':"
                + " 0.001, 'lumenRadius': 0.0009, 'youngsModulus': 2e9, 'shearModulus': 8e8, 'density': 1400,"
                + " 'wireSections': [{'from': 60, 'to': 80, 'restCurvature': [60, 0, 0]}]}, {'start': 150,"
                + " 'length': 155,"
                + " 'elements': 31, 'hubForceLimit': 0.02, 'wireRadius': 0.0004, 'lumenRadius': 0.00027,"
                + " 'youngsModulus':"
                + " 3e9, 'shearModulus': 1e9, 'density': 1400, 'wireSections': [{'from': 135, 'to': 155,"
                + " 'restCurvature': [0, 60, 0]}]}]");
            double[] before = new double[3];
            while (run.Simulation.Outcome == Outcome.Running)
            {
                run.Simulation.Step();
                var catheters = run.Simulation.Catheters();
                double[] forces = { run.Simulation.Hub()!.Force, catheters[0].Force, catheters[1].Force };
                double[] now = { run.Simulation.Hub()!.Insertion, catheters[0].Insertion, catheters[1].Insertion };
                Assert.That(forces.Max(Math.Abs), Is.LessThanOrEqualTo(1.001 * Limit), "N");
                Assert.That(now.Zip(before, (a, b) => Math.Abs(a - b)).Max(),
                    Is.LessThanOrEqualTo(0.01 * Speed + 1e-12));
                before = now;
            }
            Assert.That(run.Simulation.Outcome, Is.EqualTo(Outcome.Finished), run.Simulation.Reason);
            Assert.That(run.Simulation.Catheters()[1].SlippedFrom, Is.EqualTo(0.01).Within(1e-12));
        }

        private static string Side => Text((Drop + 1e3 * Radius) / Math.Sqrt(2.0));

        private static string Far => Text(20.0 + (Drop + 1e3 * Radius) / Math.Sqrt(2.0));

        private static string Text(double number) => number.ToString("R",
            System.Globalization.CultureInfo.InvariantCulture);

        private static SimulationSession Open(string keys) =>
            SimulationSession.Open(ParameterSource.OfText("scene", "{" + keys.Replace('\'', '"') + "}"),
                Array.Empty<string>(), "", false, limitsHubs: false, default);
    }
}
