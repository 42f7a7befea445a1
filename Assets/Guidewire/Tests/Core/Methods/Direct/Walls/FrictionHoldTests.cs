using System;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What friction holds: ropes over drums, torque of wires in bends, what is wound up.</summary>
    public sealed class FrictionHoldTests
    {
        private const double Step = 2e-2;         // s
        private const double Drum = 50.0;         // mm, as all lengths
        private const double Rope = 0.3;
        private const double Pull = 0.02;         // N, T1
        private const double Hanging = 100.0;
        private const double Radius = 30.0;       // of the bend
        private const double Straight = 40.0;
        private SimulationParameters? _last;

        // A rope without weight lies over half a drum, bent by T1 and T2; where it lifts off (T2 - b)/(T1 - b) =
        // exp(mu phi R/(R + r)), b = EI/(2 (R + r)^2): friction acts at the drum's surface, tension r above it.
        [TestCase(0.1, 0.95)]
        
        [TestCase(0.3, 0.99)]
        [TestCase(0.5, 0.95)]
        public void RopeOverADrum_DoesNotMove_BelowItsLimit(double mu, double load)
        {
            Simulation run = OverDrum(mu, load, out _);
            Wires.GoOn(run, 100);
            var before = (Vector3d[])run.State.Positions.Clone();
            double farthest = 0.0;
            for (int k = 0; k < 500; k++)
            {
                run.Step();
                farthest = Math.Max(farthest, Wires.Distance(run.State.Positions, before));
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
            Assert.That(farthest, Is.LessThan(1e-3), "mm, from 2 s to 12 s");
        }

        [TestCase(0.1, 1.02)]
        [TestCase(0.3, 1.01)]
        [TestCase(0.5, 1.02, Category = "Long")]
        public void RopeOverADrum_SlidesOff_AboveItsLimit(double mu, double load)
        {
            Simulation run = OverDrum(mu, load, out _);
            double before = run.State.Positions[0].Z;
            for (int k = 0; k < 600 && run.State.Positions[0].Z < before + 0.5 * Hanging; k++)
            {
                run.Step();
            }
            Assert.That(run.State.Positions[0].Z, Is.GreaterThan(before + 0.5 * Hanging));
        }

        [TestCase(0.1)]
        [TestCase(0.3)]
        [TestCase(0.5)]
        public void RopeDrawnOverADrum_PullsWithTheLimit(double mu)
        {
            // Node 0 is drawn at 5 mm/s; drag is 1e-5 of the tensions.
            Simulation run = OverDrum(mu, 0.0, out double limit);
            double sum = 0.0;
            for (int k = 0; k < 200; k++)
            {
                run.Step();
                sum -= k < 100 ? 0.0 : run.Contacts!.Reaction.Z / 100.0;
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
            // Chords of 0.1 rad take 0.6 % at a coefficient of 0.5, half as much those of 0.05 rad.
            Assert.That(sum / limit, Is.EqualTo(1.0).Within(1e-2));
        }

        [TestCase(0.05)]
        [TestCase(0.2)]
        [TestCase(1.0)]
        [TestCase(5.0)]
        public void TurnedInABend_TheTorqueIsThatOfTheLimit_AtAnySpeed(double speed)
        {
            Simulation run = InBend(0.1, out Steering hand);
            Wires.GoOn(run, 25);
            // What is wound up before all of it slips, and the elastic slip, are less than 0.4 rad.
            hand.Turn = speed * Step;
            Wires.GoOn(run, 50 + (int)(0.4 / hand.Turn));
            for (int k = 0; k < 20; k++)
            {
                run.Step();
                double friction = run.Hub()!.Torque - TurningDrag(40.0, 0.2e-3, 127.0, speed);
                Assert.That(friction / Limit(run, 0.1, 0.2e-3), Is.EqualTo(1.0).Within(1e-3));
            }
        }

        [TestCase(0.02)]
        [TestCase(0.2)]
        public void WoundUp_AndLeftForAMinute_TheTorqueIsKept(double mu)
        {
            if (mu < 0.1)
            {
                Rods.OnlyInFull("ten times the coefficient of friction");
            }
            Simulation run = InBend(mu, out Steering hand);
            Wires.GoOn(run, 25);
            hand.Turn = 4.0 * Math.PI / 200.0;
            Wires.GoOn(run, 200);
            hand.Turn = 0.0;
            Wires.GoOn(run, 10);
            double torque = run.Hub()!.Torque;
            Assert.That(torque, Is.GreaterThan(0.95 * Limit(run, mu, 0.2e-3)));
            double minutes = Rods.InFull ? 1.0 : 0.25;    // what creeps, goes as far in each
            Wires.GoOn(run, (int)(60.0 * minutes / Step));
            Assert.That(run.Hub()!.Torque / torque, Is.EqualTo(1.0).Within(1e-3 * minutes));
        }

        [TestCase(0.3, Category = "Long")]
        [TestCase(1.0)]
        public void DraggedAndTurned_OverTenThousandFacets_TheTorqueIsKept(double turning)
        {
            if (turning < 1.0)
            {
                Rods.OnlyInFull("a larger turn in proportion to the push");
            }
            // The surface slips by an angle with tan(beta) = turning: mu r sum N sin(beta), less what drag takes.
            const double mu = 0.3;
            const double radius = 0.4;
            const double ring = 0.5;
            SimulationParameters parameters = WallScenes.Wire(40, 1e-3 * radius);
            parameters.Scene.GuidewireLength = 120.0;
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            var places = new Vector3d[500];
            for (int k = 0; k < places.Length; k++)
            {
                places[k] = new Vector3d(0.0, 0.59, ring * k - 20.0);
            }
            var wall = new MeshShape(TestMeshes.Pipe(places, new double[places.Length], 1.0, 16)
                .Build(places[0], places[places.Length - 1]));
            wall.FrictionCoefficient = mu;
            parameters.Scene.Walls = new ContactShape[] { wall };
            parameters.Contact.ContactDistance = 5e-6;
            parameters.Material.MassDamping = 2.0;
            parameters.Method.TimeStep = 5e-3;
            var hand = new Steering();
            parameters.Drive.Steering = hand;
            Simulation run = Simulation.Create(parameters);
            Wires.GoOn(run, 40);
            hand.Push = ring;
            hand.Turn = turning * hand.Push / radius;
            double fraction = Math.Sin(Math.Atan(turning));
            int facets = 0;
            for (int k = 0; k < 180; k++)
            {
                run.Step();
                double friction = run.Hub()!.Torque - TurningDrag(2.0, 1e-3 * radius, 120.0, hand.Turn / 5e-3);
                if (k >= 40)
                {
                    facets += 2 * run.State.SphereCount;
                    Assert.That(friction / (fraction * Limit(run, mu, 1e-3 * radius)), Is.EqualTo(1.0).Within(0.01),
                        "step " + k);
                }
            }
            Assert.That(facets, Is.GreaterThan(10000), "two triangles a ring, a ring a step");
        }

        [Test]
        public void WoundUpRun_ThatIsContinuedOrRestored_TakesTheSameSteps()
        {
            Simulation whole = InBend(0.2, out Steering hand);
            SimulationParameters parameters = _last!;
            Simulation part = Simulation.Create(parameters);
            for (int k = 0; k < 120; k++)
            {
                hand.Turn = k > 20 && k < 50 ? 0.1 : 0.0;
                whole.Step();
                part = k == 70 ? part.Continue(parameters) : k == 90 ? Simulation.Restore(parameters, part.Save())
                    : part;
                part.Step();
            }
            Assert.That(whole.Hub()!.Torque, Is.GreaterThan(0.9 * Limit(whole, 0.2, 0.2e-3)));
            Assert.That(part.Hub()!.Torque, Is.EqualTo(whole.Hub()!.Torque));
            Assert.That(part.State.Positions, Is.EqualTo(whole.State.Positions));
            Assert.That(part.State.Velocities, Is.EqualTo(whole.State.Velocities));
            Assert.That(part.Report()!.Extremes!.FrictionWork, Is.EqualTo(whole.Report()!.Extremes!.FrictionWork));
        }

        [Test]
        public void WoundUp_TheTorqueIsGone_WhereWallsAreSmoothFromThenOn_AndStaysGone()
        {
            Simulation run = InBend(0.2, out Steering hand);
            SimulationParameters parameters = _last!;
            Wires.GoOn(run, 25);
            hand.Turn = 0.1;
            Wires.GoOn(run, 30);
            hand.Turn = 0.0;
            Wires.GoOn(run, 10);
            double torque = run.Hub()!.Torque;
            Assert.That(torque, Is.GreaterThan(1e-6));
            parameters.Scene.Walls[0].FrictionCoefficient = 0.0;
            run = run.Continue(parameters);
            Wires.GoOn(run, 100);
            Assert.That(Math.Abs(run.Hub()!.Torque), Is.LessThan(1e-3 * torque));
            parameters.Scene.Walls[0].FrictionCoefficient = 0.2;
            run = run.Continue(parameters);
            Wires.GoOn(run, 20);
            Assert.That(Math.Abs(run.Hub()!.Torque), Is.LessThan(1e-3 * torque));
        }

        [Test]
        public void FedFromASheath_ElementsKeepWhatTheyHold_AndRestoredRunsTakeTheSameSteps()
        {
            SimulationParameters parameters = InSheath();
            parameters.Drive.Kind = Drive.Displace;
            parameters.Drive.Table = new DriveTable(
                new TimeTable(new[] { 0.0, 1.0, 1.5, 2.0 }, new[] { 0.0, 0.09, 0.07, 0.085 }),
                new TimeTable(new[] { 0.0, 1.0, 2.0 }, new[] { 0.0, 2.0, 2.0 }));
            parameters.Method.MaxSimulationSteps = 400;
            Simulation run = Simulation.Create(parameters);
            var others = new List<Simulation>();
            int windows = 0;
            int before = 0;
            while (run.Outcome == Outcome.Running)
            {
                double work = run.Report()!.Extremes!.FrictionWork;
                run.Step();
                others.ForEach(other => other.Step());
                int outside = run.Hub()!.SpheresInBody!.Value;
                if (outside != before)
                {
                    windows++;
                    if (windows % 12 == 0)
                    {
                        others.Add(Simulation.Restore(parameters, run.Save()));
                    }
                }
                before = outside;
                Assert.That(run.Report()!.Extremes!.FrictionWork, double.IsNaN(work) ? Is.Not.Null : Is.AtMost(work));
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(windows, Is.GreaterThan(15), "elements come and go");
            Assert.That(run.Report()!.Extremes!.FrictionWork, Is.LessThan(-1e-5));
            foreach (Simulation other in others)
            {
                Assert.That(other.State.Positions, Is.EqualTo(run.State.Positions));
                Assert.That(other.Report()!.Extremes!.FrictionWork, Is.EqualTo(run.Report()!.Extremes!.FrictionWork));
            }
        }

        [Test]
        public void TurnedInASheath_TheTorqueIsSteady_WhereTheWindowIsBuiltAnew()
        {
            // Once in 0.3 rad of its first element; the elastic slip is 0.01 rad.
            SimulationParameters parameters = InSheath();
            var hand = new Steering { Push = 0.5 };
            parameters.Drive.Steering = hand;
            Simulation run = Simulation.Create(parameters);
            Wires.GoOn(run, 140);
            hand.Push = 0.0;
            hand.Turn = 0.05;
            Wires.GoOn(run, 60);
            hand.Turn = 1e-3;
            Wires.GoOn(run, 20);
            double torque = run.Hub()!.Torque;
            Assert.That(torque, Is.GreaterThan(0.9 * Limit(run, 0.2, 0.2e-3)));
            for (int k = 0; k < 350; k++)
            {
                run.Step();
                Assert.That(run.Hub()!.Torque / torque, Is.EqualTo(1.0).Within(0.01), "step " + k);
            }
        }

        // A rope of 0.6 mm over half a drum of 100 mm, pulled with T1 at its end and with a fraction of the limit at
        // node 0; with fraction 0 node 0 is drawn.
        private static Simulation OverDrum(double mu, double fraction, out double limit)
        {
            const int n = 70;
            const double young = 1e7;
            const double apart = 0.12;   // of the rope from the drum, less what its chords take
            double around = Drum + Rope + apart;
            double length = 2.0 * Hanging + Math.PI * around;
            SimulationParameters parameters = WallScenes.Wire(n, 1e-3 * Rope);
            parameters.Scene.GuidewireLength = length;
            parameters.Material.YoungsModulus = young;
            parameters.Material.ShearModulus = 0.4 * young;
            parameters.Material.Density = 1000.0;
            parameters.Material.MassDamping = 7.0;
            double bend = 0.25 * Math.PI * young * Math.Pow(1e-3 * Rope, 4);
            double b = 0.5 * bend / Math.Pow(1e-3 * (Drum + Rope), 2);
            limit = b + (Pull - b) * Math.Exp(mu * Math.PI * Drum / (Drum + Rope));
            var positions = new Vector3d[n + 1];
            var orientations = new Quaterniond[n];
            for (int i = 0; i <= n; i++)
            {
                double turn = Math.Min(Math.Max((length * i / n - Hanging) / around, 0.0), Math.PI);
                double beyond = length * i / n - Hanging - around * turn;
                positions[i] = around * new Vector3d(0.0, -Math.Cos(turn), Math.Sin(turn))
                    + beyond * new Vector3d(0.0, Math.Sin(turn), Math.Cos(turn));
                if (i > 0)
                {
                    Vector3d chord = positions[i] - positions[i - 1];
                    orientations[i - 1] = Quaterniond.FromAxisAngle(Vector3d.UnitX, -Math.Atan2(chord.Y, chord.Z));
                }
            }
            parameters.Scene.Start = new RodStart(positions, orientations, new Vector3d[n + 1], new Vector3d[n]);
            ConvexObstacle drum = ConvexObstacle.Capsule(new Vector3d(-50.0, 0.0, 0.0), new Vector3d(50.0, 0.0, 0.0),
                Drum);
            drum.FrictionCoefficient = mu;
            parameters.Scene.Walls = new ContactShape[] { drum };
            parameters.Scene.ProximalEnd = fraction > 0.0 ? ProximalEnd.Free : ProximalEnd.Held;
            parameters.Scene.TipForce = new Vector3d(0.0, 0.0, fraction > 0.0 ? -fraction * limit : -Pull);
            parameters.Drive.Kind = fraction > 0.0 ? Drive.Force : Drive.Displace;
            parameters.Drive.ExternalForce = new Vector3d(0.0, 0.0, -Pull);
            parameters.Drive.DisplacementPerStep = fraction > 0.0 ? 0.0 : -5.0 * Step;
            parameters.Method.TimeStep = Step;
            return Simulation.Create(parameters);
        }

        // The torque of mass-proportional damping on a wire that turns as a whole, N m.
        private static double TurningDrag(double damping, double radius, double length, double speed) =>
            damping * 6450.0 * 0.5 * Math.PI * Math.Pow(radius, 4) * 1e-3 * length * speed;

        // mu r sum N.
        private static double Limit(Simulation run, double mu, double radius)
        {
            double sum = 0.0;
            foreach (Vector3d force in run.Contacts!.ElementForces)
            {
                sum += force.Length;
            }
            return mu * radius * sum;
        }

        // A straight wire of 0.4 mm in a bend of 30 mm radius, its hub under a hand.
        private Simulation InBend(double mu, out Steering hand)
        {
            const double length = 2.0 * Straight + 0.5 * Math.PI * Radius;
            SimulationParameters parameters = WallScenes.Wire(50, 0.2e-3);
            int n = parameters.Scene.NumberRodElements;
            parameters.Scene.GuidewireLength = length;
            var positions = new Vector3d[n + 1];
            var orientations = new Quaterniond[n];
            for (int i = 0; i <= n; i++)
            {
                positions[i] = At(length * i / n - Straight, out _);
                if (i > 0)
                {
                    At(length * (i - 0.5) / n - Straight, out double turn);
                    orientations[i - 1] = Quaterniond.FromAxisAngle(Vector3d.UnitX, -turn);
                }
            }
            parameters.Scene.Start = new RodStart(positions, orientations, new Vector3d[n + 1], new Vector3d[n]);
            parameters.Scene.Walls = new ContactShape[] { Bend(mu) };
            parameters.Material.MassDamping = 40.0;
            parameters.Method.TimeStep = Step;
            hand = new Steering();
            parameters.Drive.Steering = hand;
            _last = parameters;
            return Simulation.Create(parameters);
        }

        // Its tip on the way from a sheath into the bend.
        private static SimulationParameters InSheath()
        {
            SimulationParameters parameters = WallScenes.Wire(40, 0.2e-3);
            parameters.Scene.GuidewireLength = 160.0;
            parameters.Scene.GuidewireOffset = -170.0;
            parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, -30.0) };
            parameters.Scene.Walls = new ContactShape[] { Bend(0.2) };
            parameters.Material.MassDamping = 20.0;
            parameters.Method.TimeStep = 5e-3;
            return parameters;
        }

        private static TubeShape Bend(double mu)
        {
            var knots = new List<Vector3d> { At(-Straight - 60.0, out _) };
            for (int k = 0; k <= 90; k++)
            {
                knots.Add(At(0.5 * Math.PI * Radius * k / 90.0, out _));
            }
            knots.Add(At(0.5 * Math.PI * Radius + Straight + 60.0, out _));
            return new TubeShape(knots.ToArray(), knots.ConvertAll(_ => 0.6).ToArray(), true, true)
            {
                FrictionCoefficient = mu,
            };
        }

        // The centreline at an arc length from the bend's start, and how far it has turned from z towards y.
        private static Vector3d At(double s, out double turn)
        {
            turn = Math.Min(Math.Max(s / Radius, 0.0), 0.5 * Math.PI);
            Vector3d on = Radius * new Vector3d(0.0, 1.0 - Math.Cos(turn), Math.Sin(turn));
            double beyond = s < 0.0 ? s : Math.Max(0.0, s - 0.5 * Math.PI * Radius);
            return on + beyond * new Vector3d(0.0, Math.Sin(turn), Math.Cos(turn));
        }
    }
}
