using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    public sealed class ContinueTests
    {
        private static readonly int[] Interruptions = { 0, 2, 7, 23, 34 };    // steps

        private static SimulationParameters Transversal()
        {
            return new SimulationParameters
            {
                Drive = { DisplacementDirection = Vector3d.UnitY },
                Method = { ConstraintSolverSteps = 50, DeltaThreshold = 0.0, MaxSimulationSteps = 100 },
            };
        }

        private static IEnumerable<TestCaseData> Runs()
        {
            yield return Pbd("swings", p => p.Drive.DisplacementDirection = Vector3d.UnitY);
            foreach (Integrator integrator in MethodTable.Of(Solver.Pbd).Integrators)
            {
                yield return Pbd("twists and pushes, " + integrator, p =>
                {
                    p.Method.Integrator = integrator;
                    p.Method.Damping = 0.01;
                    p.Drive.Kind = Drive.Push;
                    p.Drive.DisplacementPerStep = 0.3;
                    p.Drive.TwistPerStep = 0.04;
                });
            }
            yield return Pbd("is turned at both clamps, in the middle of the ramp", p =>
            {
                p.Scene.ProximalEnd = ProximalEnd.Clamped;
                p.Scene.DistalEnd = DistalEnd.Clamped;
                p.Scene.DistalRotation = 2.0;
                p.Scene.DistalDisplacement = -4.0;
                p.Scene.DistalRampTime = 0.5;
            });
            yield return Pbd("is pushed into a bend", p =>
            {
                p.Scene.GuidewireOffset = -310.0;
                p.Scene.Walls = new ContactShape[] { ArchVessel.Shape };
                p.Contact.SphereRadius = 2.0;
                p.Drive.Kind = Drive.Push;
                p.Drive.DisplacementPerStep = 4.0;
            });
            foreach (MethodTraits method in MethodTable.All)
            {
                if (!method.TakesMaterial)
                {
                    continue;
                }
                foreach (Integrator integrator in method.Integrators.Count > 0 ? method.Integrators
                    : new[] { Integrator.Verlet })
                {
                    yield return Material(method.Solver, integrator, "turns in a ramp, under weight", p =>
                    {
                        p.Scene.DistalEnd = DistalEnd.Clamped;
                        p.Scene.DistalRotation = 0.8;
                        p.Scene.DistalDisplacement = -0.5;
                        p.Scene.DistalRampTime = 0.004;
                    });
                    yield return Material(method.Solver, integrator, "is pushed and twisted", p =>
                    {
                        p.Drive.Kind = Drive.Push;
                        p.Drive.DisplacementPerStep = 0.01;
                        p.Drive.TwistPerStep = 0.01;
                    });
                    yield return Material(method.Solver, integrator, "is let go, after its rest shape", p =>
                    {
                        p.Scene.InitialState = InitialState.Equilibrium;
                        p.Scene.TipForce = new Vector3d(0.0, 0.1, 0.0);
                        p.Scene.TipForceReleaseTime = 0.002;
                        p.Method.StatesReactions = true;
                    });
                    yield return Material(method.Solver, integrator, "is displaced at the start", p =>
                    {
                        p.Drive.Displacement = 2.0;
                        p.Drive.DisplacementDirection = Vector3d.UnitY;
                    });
                }
            }
            foreach ((string name, SimulationParameters parameters) in MaterialSnapshotTests.Motions())
            {
                yield return new TestCaseData(parameters).SetName("ContinuedRun_GivesTheSameBits(" + name + ")");
            }
        }

        private static TestCaseData Pbd(string name, Action<SimulationParameters> set)
        {
            SimulationParameters parameters = Transversal();
            set(parameters);
            return new TestCaseData(parameters).SetName("ContinuedRun_GivesTheSameBits(gains " + name + ")");
        }

        private static TestCaseData Material(Solver solver, Integrator integrator, string name,
            Action<SimulationParameters> set)
        {
            SimulationParameters parameters = SimulationParameters.DefaultsOf(solver);
            parameters.Method.Integrator = integrator;
            parameters.Method.TimeStep = 1e-4;
            parameters.Method.Substeps = solver == Solver.Explicit ? 500 : 50;
            parameters.Method.DeltaThreshold = 0.0;
            parameters.Method.MaxSimulationSteps = 60;
            parameters.Scene.NumberRodElements = 12;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Scene.ProximalEnd = ProximalEnd.Clamped;
            set(parameters);
            return new TestCaseData(parameters).SetName("ContinuedRun_GivesTheSameBits(" + solver + ", " + integrator
                + ", " + name + ")");
        }

        [TestCaseSource(nameof(Runs))]
        public void ContinuedRun_GivesTheSameBits_AtAnyStep(SimulationParameters parameters)
        {
            Simulation through = Simulation.Create(parameters);
            Simulation continued = Simulation.Create(parameters);
            for (int k = 0; k < 60; k++)
            {
                // At every step of the first ten, in the middle, and near the end.
                if (k < 10 || k == 25 || k == 47)
                {
                    continued = continued.Continue(parameters);
                }
                through.Step();
                continued.Step();
                AssertSameBits(continued, through, "step " + k);
            }
            Assert.That(through.Outcome, Is.Not.EqualTo(Outcome.Diverged), through.Reason);
        }

        [TestCaseSource(nameof(Runs))]
        public void RestoredRun_GivesTheSameBits_AsOftenAsItIsRestored(SimulationParameters parameters)
        {
            Simulation through = Simulation.Create(parameters);
            var others = new List<Simulation>();
            for (int k = 0; k <= 54; k++)
            {
                if (k % 10 == 4)
                {
                    others.ForEach(other => SameRun.AssertSame(other, through, "step " + k));
                    others.RemoveAll(other => k >= 34);
                }
                if (Array.IndexOf(Interruptions, k) >= 0)
                {
                    byte[] saved = through.Save();
                    for (int repeat = 0; repeat < (k == 7 ? 2 : 1); repeat++)
                    {
                        others.Add(Simulation.Restore(parameters, saved));
                        SameRun.AssertSame(others[others.Count - 1], through, "where it was saved, step " + k);
                    }
                }
                through.Step();
                others.ForEach(other => other.Step());
            }
        }

        /// <summary>Normalising once more would change the last bits of one frame in three, and with them the axis of a
        /// sheath.</summary>
        [Test]
        public void FramesOfTheStart_AreRestoredToTheBit()
        {
            int changed = 0;
            for (int seed = 0; seed < 40; seed++)
            {
                var random = new RandomGeometry(seed);
                SimulationParameters parameters = SheathScenes.Straight(20, -20.0);
                parameters.Scene.StartAxis = new StartAxis(Vector3d.Zero, random.Direction());
                parameters.Scene.Walls = Array.Empty<ContactShape>();
                parameters.Scene.Sheath = null;
                Simulation run = Simulation.Create(parameters);
                Quaterniond[] before = run.State.Orientations;
                Assert.That(Simulation.Restore(parameters, run.Save()).State.Orientations, Is.EqualTo(before));
                var start = new RodStart(run.State.Positions, before, null, null) { IsReached = true };
                parameters.Scene.Start = start;
                Assert.That(new Scene(parameters).Shape.Q, Is.EqualTo(before), "seed " + seed);
                start.IsReached = false;
                Quaterniond[] normalised = new Scene(parameters).Shape.Q;
                changed += Array.Exists(normalised, q => q != before[0]) ? 1 : 0;
            }
            Assert.That(changed, Is.GreaterThan(3), "of 40 frames, by normalising");
        }

        [Test]
        public void RestoredRun_HasEnded_WhereTheSavedOneHad()
        {
            SimulationParameters parameters = Transversal();
            parameters.Method.MaxSimulationSteps = 3;
            Simulation run = Simulation.Create(parameters);
            Wires.Step(run, 3);
            Simulation restored = Simulation.Restore(parameters, run.Save());
            restored.Step();
            SameRun.AssertSame(restored, run, "after its end");
            Assert.That(restored.Outcome, Is.EqualTo(Outcome.Finished));
        }

        [Test]
        public void Restore_Refuses_AnotherWire_AndBytesThatAreNotWhole()
        {
            byte[] saved = Simulation.Create(Transversal()).Save();
            SimulationParameters longer = Transversal();
            longer.Scene.NumberRodElements++;
            Assert.Throws<ArgumentException>(() => Simulation.Restore(longer, saved));
            var half = new byte[800];
            Array.Copy(saved, half, half.Length);
            Assert.Throws<ArgumentException>(() => Simulation.Restore(Transversal(), half));
            Assert.Throws<ArgumentException>(() => Simulation.Restore(Transversal(), Array.Empty<byte>()));
        }

        private static void AssertSameBits(Simulation a, Simulation b, string when)
        {
            Assert.That(a.State.Positions, Is.EqualTo(b.State.Positions), when);
            Assert.That(a.State.Velocities, Is.EqualTo(b.State.Velocities), when);
            Assert.That(a.State.Orientations, Is.EqualTo(b.State.Orientations), when);
            Assert.That(a.State.AngularVelocities, Is.EqualTo(b.State.AngularVelocities), when);
            Assert.That(a.Time, Is.EqualTo(b.Time), when);
            Assert.That(a.StepCount, Is.EqualTo(b.StepCount), when);
            Assert.That(a.PredictionError, Is.EqualTo(b.PredictionError), when);
            Assert.That(a.Outcome, Is.EqualTo(b.Outcome), when);
            Assert.That(a.Reason, Is.EqualTo(b.Reason), when);
            Assert.That(a.Contacts?.MaxPenetration, Is.EqualTo(b.Contacts?.MaxPenetration), when);
            Assert.That(a.Contacts?.DriveShortfall, Is.EqualTo(b.Contacts?.DriveShortfall), when);
            Assert.That(a.Report()?.Method, Is.EqualTo(b.Report()?.Method), when);
            Assert.That(a.Contacts?.Reaction, Is.EqualTo(b.Contacts?.Reaction), when);
        }

        [Test]
        public void Continue_Refuses_GainsAsAMaterial_AndTheReverse()
        {
            SimulationParameters material = SimulationParameters.DefaultsOf(Solver.Direct);
            Assert.That(() => Simulation.Create(Transversal()).Continue(material), Throws.ArgumentException
                .With.Message.StartsWith("solver"));
            Assert.That(() => Simulation.Create(material).Continue(Transversal()), Throws.ArgumentException
                .With.Message.StartsWith("solver"));
        }

        [Test]
        public void Continue_CountsTimeOn_WhenTheStepChanges()
        {
            Simulation first = Simulation.Create(Transversal());
            Wires.Step(first, 10);
            SimulationParameters finer = Transversal();
            finer.Method.TimeStep = 0.001;
            Simulation second = first.Continue(finer);
            Wires.Step(second, 5);
            Assert.That(second.Time, Is.EqualTo(10 * 0.01 + 5 * 0.001).Within(1e-12));
        }

        [Test]
        public void Continue_LeavesTheFirstRunAlone()
        {
            Simulation first = Simulation.Create(Transversal());
            Wires.Step(first, 10);
            Vector3d tip = first.State.Positions[30];
            Wires.Step(first.Continue(Transversal()), 10);
            Assert.That(first.State.Positions[30], Is.EqualTo(tip));
        }

        [Test]
        public void Continue_LeavesTheParametersAlone()
        {
            Simulation first = Simulation.Create(Transversal());
            SimulationParameters parameters = Transversal();
            double displacement = parameters.Drive.Displacement;
            first.Continue(parameters);
            Assert.That(parameters.Scene.Start, Is.Null);
            Assert.That(parameters.Drive.Displacement, Is.EqualTo(displacement).And.Not.Zero);
        }

        [Test]
        public void Continue_Refuses_AnotherNumberOfElements()
        {
            Simulation first = Simulation.Create(Transversal());
            SimulationParameters longer = Transversal();
            longer.Scene.NumberRodElements = 31;
            Assert.Throws<ArgumentException>(() => first.Continue(longer));
        }

        [Test]
        public void Continue_Refuses_ElementsOfOtherLengths()
        {
            Simulation first = Simulation.Create(Transversal());
            SimulationParameters longer = Transversal();
            longer.Scene.GuidewireLength *= 1.01;
            Assert.That(() => first.Continue(longer),
                Throws.ArgumentException.With.Message.StartsWith("instruments need"));
        }
    }
}
