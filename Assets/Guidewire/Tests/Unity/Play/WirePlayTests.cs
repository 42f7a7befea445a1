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
        private const int Most = 3000;    // frames, in which a thread opens the run and makes ten steps

        [UnityTest]
        public IEnumerator Loop_StepsTheWire_FrameByFrame()
        {
            var host = new GameObject("Simulation");
            SimulationLoop loop = host.AddComponent<SimulationLoop>();
            loop.ParameterAsset = new TextAsset("{\"constraintSolverSteps\": 10}") { name = "defaults" };
            for (int frame = 0; frame < Most && (loop.State == null || loop.State.StepCount < 10); frame++)
            {
                yield return null;
            }
            Assert.That(loop.Problem, Is.EqualTo(""));
            Assert.That(loop.State!.StepCount, Is.GreaterThanOrEqualTo(10));
            Assert.That(loop.State.Time, Is.LessThanOrEqualTo(loop.RealTime + 0.011));
            Object.Destroy(host);
            yield return null;
            Assert.That(loop.State, Is.Null, "the run is closed with its object");
        }
    }
}
