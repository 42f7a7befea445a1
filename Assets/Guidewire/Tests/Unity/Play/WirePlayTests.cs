using System.Collections;
using Guidewire.Runtime;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.TestTools;

namespace Guidewire.Unity.Tests
{
    /// <summary>The loop with frames, as PlayMode has it.</summary>
    public sealed class WirePlayTests
    {
        [UnityTest]
        public IEnumerator Loop_StepsTheWire_FrameByFrame()
        {
            var host = new GameObject("Simulation");
            SimulationLoop loop = host.AddComponent<SimulationLoop>();
            loop.Choose("params/default.json", new[] { "constraintSolverSteps=10" }, "", false);
            for (int frame = 0; frame < 30; frame++)
            {
                yield return null;
            }
            Assert.That(loop.Problem, Is.EqualTo(""));
            Assert.That(loop.Session!.Simulation.StepCount, Is.GreaterThan(0));
            Assert.That(loop.Session.Simulation.Time, Is.LessThanOrEqualTo(loop.RealTime + 0.011));
            Object.Destroy(host);
            yield return null;
            Assert.That(loop.Session, Is.Null, "the run is closed with its object");
        }
    }
}
