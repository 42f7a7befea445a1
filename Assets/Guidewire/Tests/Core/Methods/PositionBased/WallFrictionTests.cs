using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Coulomb friction of walls: what it takes to push a wire, what a wire at rest holds, how a wire slides
    /// down a slope.</summary>
    internal sealed class WallFrictionTests
    {
        private const double Coefficient = 0.3;
        private const double Accuracy = 0.02;    // of mu times the weight
        private const double ConservativeTimeOfImpact = 10.0 / 11.0;    // of the spheres: the first is held

        [Test]
        public void WirePushedAlongAPlane_NeedsMuTimesItsWeight(
            [Values(ElementContact.Barycentric, ElementContact.None)] ElementContact rule,
            [Values(0.01, 0.3, 1.0)] double gain)
        {
            if (gain != 0.3)
            {
                Rods.OnlyInFull("a gain between the two");
            }
            SimulationParameters p = LyingWire(rule, gain);
            p.Drive.Kind = Drive.Displace;
            p.Drive.DisplacementPerStep = 0.002;
            Simulation simulation = Simulation.Create(p);
            Vector3d reaction = MeanReaction(simulation, 1000, 500, out Vector3d wall);

            // The held sphere carries a little of the wire, which at a gain of 0.01 sinks in by a hundredth of a unit.
            double weight = gain < 0.1 ? wall.Y : Weight(p) * ConservativeTimeOfImpact;
            Assert.That(wall.Y, Is.EqualTo(Weight(p) * ConservativeTimeOfImpact).Within(0.06 * Weight(p)));
            Assert.That(reaction.Z - Drag(p), Is.EqualTo(Coefficient * weight).Within(Accuracy * Coefficient * weight));
            Assert.That(wall.Z, Is.EqualTo(-Coefficient * wall.Y).Within(1e-3 * Coefficient * wall.Y));
            Assert.That(simulation.State.Velocities[10].Z, Is.GreaterThan(0.0));
        }

        [Test]
        public void WireWithoutFriction_NeedsNothing()
        {
            SimulationParameters p = LyingWire(ElementContact.Barycentric, 0.3);
            p.Scene.Walls[0].FrictionCoefficient = 0.0;
            p.Drive.Kind = Drive.Displace;
            p.Drive.DisplacementPerStep = 0.002;
            Vector3d reaction = MeanReaction(Simulation.Create(p), 1000, 500, out _);
            Assert.That(Math.Abs(reaction.Z - Drag(p)), Is.LessThan(0.001 * Coefficient * Weight(p)));
        }

        [Test]
        public void FreeWire_StaysUnderLessThanMuTimesItsWeight_AndGoesUnderMore(
            [Values(ElementContact.Barycentric, ElementContact.None)] ElementContact rule)
        {
            if (rule == ElementContact.None)
            {
                Rods.OnlyInFull("its friction on the way, above and below, and this test of the other rule");
            }
            // Put on at sphere 0; the others are reached by compression, less than 1e-3 units in all. Contacts that let
            // go and catch again jitter by some 1e-6 units, along the wire too.
            double[] ways = AfterForce(rule, 0.98, out _);
            Assert.That(ways[10], Is.LessThan(1e-6), "last sphere");
            Assert.That(ways[0], Is.LessThan(1e-3), "first sphere");

            // What is left meets damping: v = (F - mu W) dt/(d M), for the time of the whole force.
            double[] moved = AfterForce(rule, 1.02, out double expected);
            Assert.That(moved[10], Is.EqualTo(expected).Within(0.05 * expected));
        }

        [Test]
        public void WireOnASlope_GainsSpeedByWhatFrictionLeavesOfItsWeight(
            [Values(ElementContact.Barycentric, ElementContact.None)] ElementContact rule,
            [Values(0.2, 0.35)] double slope)
        {
            // Gravity along the wire and into the plane: a = g (sin - mu cos), or 0 where that is negative.
            const int Steps = 500;
            SimulationParameters p = LyingWire(rule, 0.3);
            double g = 10.0;
            double angle = Math.Atan(slope);
            p.Scene.Gravity = new Vector3d(0.0, -g * Math.Cos(angle), g * Math.Sin(angle));
            p.Drive.Kind = Drive.Force;
            p.Method.Damping = 0.0;
            Simulation simulation = Simulation.Create(p);
            Wires.Step(simulation, Steps);
            double speed = 0.0;
            foreach (Vector3d v in simulation.State.Velocities)
            {
                speed += v.Z / simulation.State.SphereCount;
            }
            double rate = g * (Math.Sin(angle) - Coefficient * Math.Cos(angle));
            double expected = Math.Max(0.0, rate) * Steps * p.Method.TimeStep;
            Assert.That(speed, Is.EqualTo(expected).Within(0.02 * expected + 1e-9));
        }

        [Test]
        public void Contact_RubsByAtMostMuTimesItsPushes_AndHoldsWhatNeedsLess()
        {
            var random = new RandomGeometry(43);
            for (int i = 0; i < RandomGeometry.Cases(5000); i++)
            {
                var state = new RodState(1, 1.0, random.Number(0.01, 1.0), 0.0);
                Vector3d n = random.Direction();
                double s = random.Number(0.0, 1.0);
                double mu = random.Number(0.01, 2.0);
                int iterations = 20;
                Vector3d[] from = { random.Point(), random.Point() };
                var x = new[] { from[0] + 0.1 * random.Point(), from[1] + 0.1 * random.Point() };
                Vector3d start = Vector3d.Lerp(x[0], x[1], s);
                var elements = new ContactConstraint(state, 4, iterations);
                elements.Clear(from);
                double reach = random.Number(0.0, 0.2);
                elements.AddElement(
                    0, new SurfaceContact(s, Vector3d.Lerp(from[0], from[1], s), n, 0.0), reach, 0.3, mu);
                for (int sweep = 0; sweep < iterations; sweep++)
                {
                    elements.Iterate(x);
                }
                Vector3d moved = Vector3d.Lerp(x[0], x[1], s) - start;
                double pushed = Vector3d.Dot(moved, n);
                Vector3d taken = moved - pushed * n;
                Vector3d asked = Along(start - Vector3d.Lerp(from[0], from[1], s), n);
                Vector3d left = Along(Vector3d.Lerp(x[0], x[1], s) - Vector3d.Lerp(from[0], from[1], s), n);
                double most = mu * pushed;
                Assert.That(taken.Length, Is.EqualTo(Math.Min(most, asked.Length)).Within(1e-12), "case " + i);
                Assert.That(Vector3d.Dot(taken, left), Is.LessThanOrEqualTo(1e-12), "against the slip, case " + i);
                Assert.That(left.Length, Is.EqualTo(asked.Length - taken.Length).Within(1e-12), "case " + i);
            }
        }

        [Test]
        public void PublishedRule_HasNoFriction_AndSaysSo()
        {
            SimulationParameters p = LyingWire(ElementContact.Thesis, 0.3);
            Assert.That(() => Simulation.Create(p),
                Throws.ArgumentException.With.Message.Contains("elementContact").And.Message.Contains("frictionC"));
        }

        private static Vector3d Along(in Vector3d motion, in Vector3d n) => motion - Vector3d.Dot(motion, n) * n;

        // How far each sphere is moved by a fraction of mu times the weight, put on slowly: what is put on at once
        // swings to twice its force.
        private static double[] AfterForce(ElementContact rule, double fraction, out double expected)
        {
            const int Steps = 1500;
            SimulationParameters p = LyingWire(rule, 0.3);
            p.Drive.Kind = Drive.Force;
            double friction = Coefficient * Weight(p);
            double dt = p.Method.TimeStep;
            expected = (fraction - 1.0) * friction * dt / (p.Method.Damping * p.Pbd.TotalMass) * Steps * dt;
            Simulation simulation = Simulation.Create(p);
            Wires.Step(simulation, 500);
            var before = (Vector3d[])simulation.State.Positions.Clone();
            for (int k = 0; k < 2 * Steps; k++)
            {
                double part = Math.Min(1.0, k / (double)Steps);
                simulation.State.Forces[0] = new Vector3d(0.0, 0.0, part * fraction * friction);
                simulation.Step();
            }
            var ways = new double[before.Length];
            for (int i = 0; i < ways.Length; i++)
            {
                ways[i] = Math.Abs(simulation.State.Positions[i].Z - before[i].Z);
            }
            return ways;
        }

        private static Vector3d MeanReaction(Simulation simulation, int before, int over, out Vector3d wall)
        {
            Vector3d sum = Vector3d.Zero;
            wall = Vector3d.Zero;
            for (int k = 0; k < before + over; k++)
            {
                simulation.Step();
                sum += k >= before ? simulation.Contacts!.Reaction : Vector3d.Zero;
                wall += k >= before ? simulation.Contacts!.Total : Vector3d.Zero;
            }
            wall = wall / over;
            return sum / over;
        }

        // What damping takes of the free spheres' motion at the drive's speed: d m v/dt.
        private static double Drag(SimulationParameters p)
        {
            double speed = p.Drive.DisplacementPerStep / p.Method.TimeStep;
            return p.Method.Damping * p.Pbd.TotalMass * ConservativeTimeOfImpact * speed / p.Method.TimeStep;
        }

        private static double Weight(SimulationParameters p) => p.Pbd.TotalMass * -p.Scene.Gravity.Y;

        private static SimulationParameters LyingWire(ElementContact rule, double gain)
        {
            SimulationParameters p = Wires.LyingOnAPlane(Drive.Hold, gain);
            p.Scene.Walls[0].FrictionCoefficient = Coefficient;
            p.Contact.ElementContact = rule;
            p.Pbd.StretchStiffness = 1.0;
            p.Method.Damping = 0.1;
            return p;
        }
    }
}
