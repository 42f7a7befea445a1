using System;
using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Another instrument in the place of a withdrawn one: the rest goes on from where it was.</summary>
    internal sealed class CoaxialExchangeTests
    {
        [TestCase(0)]
        [TestCase(1)]
        public void SameInstrument_GoesOnAsIfNothingHadHappened(int instrument)
        {
            Simulation run = Withdrawn(instrument, out SimulationParameters parameters);
            Vector3d[] before = (Vector3d[])run.State.Positions.Clone();
            Simulation same = Simulation.Restore(parameters, run.Save());
            Simulation other = run.Continue(With(parameters, instrument, 5e-7, 0));
            Assert.That(other.HasElementsOf(same), Is.False, "it is another one");
            Assert.That(Largest(other.State.Positions, before), Is.LessThan(1e-6));
            for (int k = 0; k < 60; k++)
            {
                Steer(parameters, k < 20 ? 0.0 : 0.5, instrument);
                same.Step();
                other.Step();
                Assert.That((other.Outcome, other.Time), Is.EqualTo((Outcome.Running, same.Time)), other.Reason);
                // The masses are those of when nodes came in or went last: of the new one they are newer, up to there.
                double within = k < 20 || k >= 40 ? 1e-6 : 1e-3;
                Assert.That(other.Hub()!.Force, Is.EqualTo(same.Hub()!.Force).Within(within));
                Assert.That(other.Coaxial()!.Force, Is.EqualTo(same.Coaxial()!.Force).Within(within));
                Assert.That(other.Energies()!.Value.Y, Is.EqualTo(same.Energies()!.Value.Y).Within(1e-8));
            }
            TestContext.WriteLine("{0} units apart, {1} N", Largest(other.State.Positions, same.State.Positions),
                other.Coaxial()!.Force - same.Coaxial()!.Force);
            Assert.That(Largest(other.State.Positions, same.State.Positions), Is.LessThan(1e-6));
            Assert.That(same.Contacts!.LargestForce, Is.GreaterThan(1e-3), "it lies at a wall");
            Assert.That(other.Contacts!.LargestForce, Is.EqualTo(same.Contacts.LargestForce).Within(1e-6));
        }

        [Test]
        public void OtherCatheter_LeavesTheWireWhereItIs_AndGoesOver()
        {
            Simulation run = Withdrawn(1, out SimulationParameters parameters);
            double insertion = run.Coaxial()!.Insertion;
            SimulationParameters next = With(parameters, 1, 20.0, 7);
            next.Scene.Catheters[0].Material.YoungsModulus *= 2.0;
            next.Scene.Catheters[0].FrictionCoefficient = 0.1;    // where no instrument had any before
            Simulation other = run.Continue(next);
            Assert.That(other.Coaxial()!.Positions, Has.Length.EqualTo(run.Coaxial()!.Positions.Length + 7));
            Assert.That((other.Time, other.Coaxial()!.Insertion), Is.EqualTo((run.Time, insertion)));
            Vector3d tip = other.Coaxial()!.Positions[^1];
            Assert.That((tip - run.Coaxial()!.Positions[^1]).Length, Is.LessThan(1e-6), "its tip is where that was");
            run.Step();
            other.Step();
            double area = Math.PI * Math.Pow(parameters.Material.WireRadius, 2.0);
            double shortened = run.Hub()!.Force * parameters.Scene.Catheters[0].Length
                / (parameters.Material.YoungsModulus * area);
            Assert.That(Largest(other.State.Positions, run.State.Positions), Is.LessThan(shortened),
                "no more than the thrust shortens the wire alone, as far as the catheter reaches");
            byte[] saved = other.Save();
            Steer(next, 0.5, 1);
            for (int k = 0; k < 30; k++)
            {
                other.Step();
            }
            Assert.That(other.Outcome, Is.EqualTo(Outcome.Running), other.Reason);
            Assert.That(other.Coaxial()!.Insertion, Is.EqualTo(insertion + 0.015).Within(1e-9));
            Assert.That(other.Contacts!.Passages, Is.Zero);
            Simulation restored = Simulation.Restore(next, saved);
            for (int k = 0; k < 30; k++)
            {
                restored.Step();
            }
            Assert.That(restored.Coaxial()!.Positions[^1], Is.EqualTo(other.Coaxial()!.Positions[^1]));
        }

        [Test]
        public void WhatIsInTheVesselOrDoesNotFit_IsRefused()
        {
            SimulationParameters parameters = Scene();
            Simulation run = Simulation.Create(parameters);
            Refused(run, With(parameters, 1, 0.0, 2),
                "the catheter needs to be withdrawn by 15 mm more, into the sheath");
            Refused(run, With(parameters, 0, 0.0, 2), "the wire needs to be withdrawn by 65 mm more, into the sheath");
            run = Withdrawn(1, out parameters);
            Refused(run, With(parameters, 1, -90.0, 2),
                "the wire is 66 mm too short: the hub of the catheter would be behind its own");
            SimulationParameters more = With(parameters, 1, 0.0, 2);
            more.Scene.Walls = parameters.Scene.Walls.Concat(WallScenes.Floor(-500.0)).ToArray();
            Refused(run, more, "walls cannot come or go together with an instrument");
            parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            run = Simulation.Create(parameters);
            Refused(run, With(parameters, 1, 0.0, 2), "the catheter cannot be exchanged: without a sheath there is "
                + "nothing into which it could be withdrawn");
            Refused(run, With(parameters, 0, 0.0, 2),
                "the wire needs to be withdrawn by 290 mm more, into the first element of the catheter");
        }

        [Category("Long")]
        [TestCase(false)]
        [TestCase(true)]
        public void NoInstrumentIsEverOutside_AfterRandomExchanges(bool hasOuter)
        {
            int exchanged = 0;
            int runs = RandomGeometry.Cases(40, 4);
            for (int seed = 0; seed < runs; seed++)
            {
                var random = new RandomGeometry(seed);
                SimulationParameters parameters = Scene(hasOuter);
                Simulation run = Simulation.Create(parameters);
                Advance(run, parameters, Enumerable.Range(0, hasOuter ? 3 : 2).ToArray(), 0.5, 5.0, 120);
                for (int k = 0; k < 4; k++)
                {
                    int instrument = random.Index(hasOuter ? 3 : 2);
                    for (int i = 0; i < 60 && run.FindInVessel(instrument) != null; i++)
                    {
                        Advance(run, parameters, new[] { instrument }, -1.0, 0.0, 5);
                    }
                    SimulationParameters next = Drawn(random, parameters, instrument);
                    try
                    {
                        run = run.Continue(next);
                    }
                    catch (ArgumentException refusal)
                    {
                        TestContext.WriteLine(seed + ": " + refusal.Message);
                        continue;
                    }
                    exchanged++;
                    parameters = next;
                    Advance(run, parameters, new[] { instrument }, 1.0, random.Number(-10.0, 10.0), 40);
                }
                Assert.That((run.Contacts!.Passages, run.Contacts.MaxPenetration), Is.EqualTo((0L, 0.0)), "" + seed);
            }
            Assert.That(exchanged, Is.GreaterThan(runs), "exchanges");
        }

        // Another one of random stiffness, elements and length.
        private static SimulationParameters Drawn(RandomGeometry random, SimulationParameters parameters,
            int instrument)
        {
            bool isWire = instrument == 0;
            SimulationParameters next = With(parameters, instrument, isWire ? -random.Number(0.0, 40.0)
                : random.Number(0.0, 0.3) * parameters.Scene.Catheters[instrument - 1].Length, 0);
            Catheter? catheter = isWire ? null : next.Scene.Catheters[instrument - 1];
            MaterialParameters material = isWire ? next.Material : catheter!.Material;
            material.YoungsModulus = Math.Pow(10.0, isWire ? random.Number(9.5, 11.0) : random.Number(8.0, 10.0));
            double length = isWire ? next.Scene.GuidewireLength : catheter!.Length;
            double bend = isWire ? 30.0 : 20.0;
            material.Sections = new[]
            {
                new WireSection { From = length - random.Number(10.0, 60.0), To = length,
                    RestCurvature = new Vector3d(random.Number(-bend, bend), random.Number(-5.0, 5.0), 0.0) },
            };
            int elements = random.Index(40);
            next.Scene.NumberRodElements = isWire ? 30 + elements : next.Scene.NumberRodElements;
            if (catheter != null)
            {
                catheter.Elements = 10 + elements;
            }
            return next;
        }

        // These hubs, units and rad/s; after each step every node is in the lumen of the arch.
        private static void Advance(Simulation run, SimulationParameters parameters, int[] hubs, double push,
            double turn, int steps)
        {
            for (int k = 0; k <= parameters.Scene.Catheters.Count; k++)
            {
                Steering steering = k == 0 ? parameters.Drive.Steering!
                    : parameters.Scene.Catheters[k - 1].Drive.Steering!;
                steering.Push = hubs.Contains(k) ? push : 0.0;
                steering.Turn = hubs.Contains(k) ? parameters.Method.TimeStep * turn : 0.0;
            }
            for (int k = 0; k < steps; k++)
            {
                run.Step();
                Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
                double farthest = run.Catheters().SelectMany(one => one.Positions).Concat(run.State.Positions)
                    .Max(WallScenes.FromArchAxis);
                Assert.That(farthest, Is.LessThan(WallScenes.LumenRadius + 0.03), "with the chords of 40 pieces");
            }
        }

        // Of 400 mm of wire 65 are beyond the exit of the sheath, and of its catheter 15, before an arch.
        private static SimulationParameters Scene(bool hasOuter = false)
        {
            SimulationParameters parameters = hasOuter ? CoaxialScenes.Three(Integrator.ImplicitEuler)
                : CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Scene.GuidewireOffset = -400.0;
            parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, -65.0) };
            parameters.Method.SolverTolerance = 1e-10;
            parameters.Scene.Walls = new ContactShape[] { WallScenes.ArchTube(40) };
            parameters.Drive.Steering = new Steering();
            foreach (Catheter catheter in parameters.Scene.Catheters)
            {
                catheter.Drive.Steering = new Steering();
            }
            return parameters;
        }

        // The catheter into the sheath and the wire into the arch; or the wire into the sheath and the catheter out.
        private static Simulation Withdrawn(int instrument, out SimulationParameters parameters)
        {
            parameters = Scene();
            Simulation run = Simulation.Create(parameters);
            int other = 1 - instrument;
            Steer(parameters, 0.5, other);
            Make(run, other == 0 ? 120 : 80);
            Steer(parameters, -0.5, instrument);
            Make(run, instrument == 0 ? 132 : 32);
            Steer(parameters, 0.0, 0);
            Make(run, 50);
            Assert.That(run.FindInVessel(instrument), Is.Null);
            Assert.That(run.FindInVessel(other), Does.Contain("needs to be withdrawn"));
            return run;
        }

        private static void Make(Simulation run, int steps)
        {
            for (int k = 0; k < steps; k++)
            {
                run.Step();
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
        }

        // In every step from now on, units.
        private static void Steer(SimulationParameters parameters, double push, int instrument)
        {
            parameters.Drive.Steering!.Push = instrument == 0 ? push : 0.0;
            parameters.Scene.Catheters[0].Drive.Steering!.Push = instrument == 1 ? push : 0.0;
        }

        private static void MoveTip(MaterialParameters material, double back)
        {
            WireSection section = material.Sections[0];
            material.Sections = new[]
            {
                new WireSection { From = section.From - back, To = section.To - back,
                    YoungsModulus = section.YoungsModulus, ShearModulus = section.ShearModulus,
                    RestCurvature = section.RestCurvature },
            };
        }

        // The same with one that is shorter, its tip at the start where it was, and has more elements.
        private static SimulationParameters With(SimulationParameters parameters, int instrument, double shorter,
            int more)
        {
            SimulationParameters next = parameters.Copy();
            next.Scene.GuidewireLength -= instrument == 0 ? shorter : 0.0;
            next.Scene.GuidewireOffset += instrument == 0 ? shorter : 0.0;
            next.Scene.NumberRodElements += instrument == 0 ? more : 0;
            next.Scene.Catheters = parameters.Scene.Catheters.Select((former, k) => new Catheter
            {
                Length = former.Length - (instrument == k + 1 ? shorter : 0.0),
                Elements = former.Elements + (instrument == k + 1 ? more : 0),
                Start = former.Start + (instrument == 0 ? -shorter : instrument == k + 1 ? shorter : 0.0),
                Material = former.Material.Copy(), Drive = former.Drive,
            }).ToArray();
            MoveTip(instrument == 0 ? next.Material : next.Scene.Catheters[instrument - 1].Material, shorter);
            return next;
        }

        private static void Refused(Simulation run, SimulationParameters next, string expected) =>
            Assert.That(() => run.Continue(next), Throws.ArgumentException.With.Message.EqualTo(expected));

        private static double Largest(Vector3d[] one, Vector3d[] other) =>
            one.Zip(other, (a, b) => (a - b).Length).Max();
    }
}
