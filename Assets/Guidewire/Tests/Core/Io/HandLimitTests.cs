using System;
using System.Threading;
using Guidewire.Core;
using Guidewire.Io;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Runs that a hand steers in a host with frames: hubs that slip, and steps that another thread
    /// ends.</summary>
    public sealed class HandLimitTests
    {
        private const string Tube = "{\"solver\": \"direct\", \"guidewireLength\": 100, \"numberRodElements\": 20,"
            + " \"guidewireOffset\": 10, \"wireRadius\": 0.0004, \"youngsModulus\": 25e9, \"proximalEnd\": \"clamped\","
            + " \"vessel\": {\"shape\": \"tube\", \"radius\": 3, \"knots\": [[0, 0, 0], [0, 0, 200]]}}";

        private static SimulationSession Open(bool isSteered, CancellationToken cancellation, params string[] overrides)
        {
            return SimulationSession.Open(ParameterSource.OfText("tube", Tube), overrides, "", isSteered,
                limitsHubs: true, cancellation);
        }

        [Test]
        public void SteeredHub_SlipsWhereTheCoiledWireWouldYield()
        {
            // F r/(2 EI) of curvature, times the radius a: 1 % of strain.
            double stiffness = 25e9 * Math.PI / 4.0 * Math.Pow(0.0004, 4);
            double limit = 2.0 * stiffness * 0.01 / (0.003 * 0.0004);
            using SimulationSession session = Open(true, default);
            Assert.That(session.Parameters.Drive.HubForceLimit, Is.EqualTo(limit).Within(1e-6).Percent);
            session.Set("massDamping", "3");
            Assert.That(session.Parameters.Drive.HubForceLimit, Is.EqualTo(limit).Within(1e-6).Percent);
            // The widest place counts, 6 mm at the hub, whatever the lumen is at the tip.
            using SimulationSession funnel = Open(true, default, "vessel.radius=[6, 2, 2]", "guidewireOffset=0",
                "vessel.knots=[[0, 0, 0], [0, 0, 50], [0, 0, 200]]");
            Assert.That(funnel.Parameters.Drive.HubForceLimit, Is.EqualTo(0.5 * limit).Within(1.0).Percent);
        }

        [Test]
        public void EachOfThreeSteeredHubs_SlipsAtTheLimitOfItsOwnInstrument()
        {
            using SimulationSession session = Open(true, default, "catheters=["
                + "{\"start\": 30, \"length\": 40, \"elements\": 8, \"wireRadius\": 0.0014, \"lumenRadius\": 0.0011,"
                + " \"youngsModulus\": 1e9, \"shearModulus\": 4e8, \"density\": 1200},"
                + "{\"start\": 20, \"length\": 60, \"elements\": 12, \"wireRadius\": 0.001, \"lumenRadius\": 0.0006,"
                + " \"youngsModulus\": 2e9, \"shearModulus\": 8e8, \"density\": 1200}]");
            // 2 EI 0.01/(r a) of each, with r = 3 mm.
            double[] radius = { 0.0014, 0.001 };
            double[] inner = { 0.0011, 0.0006 };
            for (int i = 0; i < 2; i++)
            {
                double stiffness = (i + 1) * 1e9 * Math.PI / 4.0 * (Math.Pow(radius[i], 4) - Math.Pow(inner[i], 4));
                Assert.That(session.Parameters.Scene.Catheters[i].Drive.HubForceLimit,
                    Is.EqualTo(2.0 * stiffness * 0.01 / (0.003 * radius[i])).Within(1e-6).Percent);
            }
            session.Step(0.1, 0.0);
            Assert.That(session.Simulation.Outcome, Is.EqualTo(Outcome.Running), session.Simulation.Reason);
        }

        [Test]
        public void LimitOfTheParameters_AndRunsThatNobodySteers_AreLeftAlone()
        {
            using SimulationSession given = Open(true, default, "hubForceLimit=0.25");
            Assert.That(given.Parameters.Drive.HubForceLimit, Is.EqualTo(0.25));
            using SimulationSession driven = Open(false, default);
            Assert.That(driven.Parameters.Drive.HubForceLimit, Is.NaN, "that of a hand");
        }

        [Test]
        public void CancelledStep_Throws_AndLeavesTheStateOfTheStepBefore()
        {
            using var cancel = new CancellationTokenSource();
            using SimulationSession session = Open(true, cancel.Token);
            session.Step(0.4, 0.0);
            var before = (Vector3d[])session.Simulation.State.Positions.Clone();
            cancel.Cancel();
            Assert.Throws<OperationCanceledException>(() => session.Step(0.4, 0.0));
            Assert.That(session.Simulation.StepCount, Is.EqualTo(1));
            Assert.That(session.Simulation.State.Positions, Is.EqualTo(before));
        }
    }
}
