using System.Text.RegularExpressions;
using Guidewire.Core;
using Guidewire.Runtime;
using NUnit.Framework;
using UnityEngine;
using UnityEngine.TestTools;

namespace Guidewire.Unity.Tests
{
    /// <summary>The loop without frames, as EditMode has it: no message is sent, its methods are called.</summary>
    public sealed class SimulationLoopTests
    {
        private GameObject _object = null!;
        private SimulationLoop _loop = null!;

        [SetUp]
        public void Make()
        {
            _object = new GameObject("Simulation");
            _loop = _object.AddComponent<SimulationLoop>();
            _loop.Stepping = SteppingMode.Frames;
        }

        [TearDown]
        public void Destroy()
        {
            _loop.Close();
            Object.DestroyImmediate(_object);
        }

        private Simulation Load(params string[] overrides)
        {
            _loop.ParameterAsset = new TextAsset("{}") { name = "defaults" };
            _loop.Overrides = overrides;
            _loop.Load();
            Assert.That(_loop.Problem, Is.EqualTo(""));
            return _loop.Session!.Simulation;
        }

        [Test]
        public void Load_BuildsTheWireOfTheFile()
        {
            Assert.That(Load().State.ElementCount, Is.EqualTo(30));
            Assert.That(Load("numberRodElements=12").State.ElementCount, Is.EqualTo(12));
            Assert.That(_loop.Generation, Is.EqualTo(2));
        }

        [Test]
        public void Advance_MakesTheStepsThatThePaceAsksFor()
        {
            Simulation simulation = Load("constraintSolverSteps=1");
            _loop.Advance(0.05f);
            Assert.That(simulation.StepCount, Is.EqualTo(5).Or.EqualTo(4), "0.05 s at dt = 0.01 s, in float");
        }

        [Test]
        public void Advance_DoesNotMakeUpForALostSecond()
        {
            Simulation simulation = Load("constraintSolverSteps=1", "timeStep=0.0001");
            _loop.Advance(1f);
            int after = simulation.StepCount;
            Assert.That(after, Is.LessThanOrEqualTo(100), "steps a frame at most");
            _loop.Advance(0f);
            Assert.That(simulation.StepCount, Is.LessThanOrEqualTo(after + 1));
        }

        [Test]
        public void Step_IsTheStepThatCoreMakes()
        {
            Simulation simulation = Load();
            Simulation alone = Simulation.Create(new SimulationParameters());
            for (int k = 0; k < 20; k++)
            {
                _loop.Step();
                alone.Step();
            }
            for (int i = 0; i <= 30; i++)
            {
                Assert.That(simulation.State.Positions[i], Is.EqualTo(alone.State.Positions[i]), "sphere " + i);
            }
        }

        [Test]
        public void SetParameter_TakesEffectAndKeepsTheWire()
        {
            Load("constraintSolverSteps=10");
            _loop.Step();
            Vector3d tip = _loop.Session!.Simulation.State.Positions[30];
            _loop.Set("stretchStiffness", "0.25");
            _loop.Set("constraintSolverSteps", "20");
            Assert.That(_loop.Session.Parameters.Pbd.StretchStiffness, Is.EqualTo(0.25));
            Assert.That(_loop.Session.Parameters.Method.ConstraintSolverSteps, Is.EqualTo(20));
            Assert.That(_loop.Session.Simulation.State.Positions[30], Is.EqualTo(tip));
            Assert.That(_loop.Session.Simulation.StepCount, Is.EqualTo(1));
        }

        [Test]
        public void ParameterOutOfRange_StopsWithAMessage_AndLoadStartsAnew()
        {
            Load();
            LogAssert.Expect(LogType.Error, new Regex("timeStep"));
            _loop.Set("timeStep", "-1.0");
            Assert.That(_loop.Problem, Does.Contain("timeStep = -1.0").And.Contain("> 0"));
            int steps = _loop.Session!.Simulation.StepCount;
            _loop.Step();
            Assert.That(_loop.Session.Simulation.StepCount, Is.EqualTo(steps));
            Load();
            Assert.That(_loop.Parameters!.Method.TimeStep, Is.EqualTo(0.01));
            _loop.Step();
            Assert.That(_loop.Session!.Simulation.StepCount, Is.EqualTo(1));
        }
    }
}
