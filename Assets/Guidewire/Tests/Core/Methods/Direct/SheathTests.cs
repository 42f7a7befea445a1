using System;
using NUnit.Framework;
using static Guidewire.Core.Tests.SheathScenes;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire that is fed into a vessel from a sheath: only what is outside is simulated, and it is as if all
    /// of it were.</summary>
    public sealed class SheathTests
    {
        [Test]
        public void WireFedInAndWithdrawn_HasItsEnergyBack()
        {
            // A straight wire that bears on the bend, and back; without friction nothing else takes energy.
            SimulationParameters parameters = Sheathed(40, 0.2, 25.0);
            parameters.Material.Sections = Array.Empty<WireSection>();
            parameters.Drive.Table = new DriveTable(
                new TimeTable(new[] { 0.0, 1.3, 2.6, 3.0 }, new[] { 0.0, 0.13, -0.002, -0.002 }),
                new TimeTable(new[] { 0.0 }, new[] { 0.0 }));
            parameters.Method.MaxSimulationSteps = 600;
            Simulation run = Simulation.Create(parameters);
            double peak = 0.0;
            int least = int.MaxValue;
            int most = 0;
            Wires.Finish(run, () =>
            {
                peak = Math.Max(peak, run.Stress()!.ElasticEnergy);
                least = Math.Min(least, run.Hub()!.SpheresInBody!.Value);
                most = Math.Max(most, run.Hub()!.SpheresInBody!.Value);
                Assert.That(run.State.SphereCount, Is.EqualTo(41));
                for (int i = 0; i < 41 - run.Hub()!.SpheresInBody!.Value; i++)
                {
                    Vector3d place = run.State.Positions[i];
                    Assert.That(Math.Abs(place.X) + Math.Abs(place.Y), Is.LessThan(1e-3), "on the sheath's axis");
                }
            });
            Assert.That(most - least, Is.GreaterThan(25), "elements came and went");
            StressRecord end = run.Stress()!;
            Assert.That(end.ElasticEnergy + end.KineticEnergy, Is.LessThan(1e-6 * peak));
            Assert.That(run.Hub()!.LengthInBody, Is.EqualTo(0.023).Within(1e-5));
            Assert.That(run.Contacts!.Passages, Is.Zero);
        }

        // At constant speed along a smooth tube the hub alone does work: on the weight of what is simulated.
        [TestCase(9.0, 0.02)]
        [TestCase(-9.0, 0.02)]
        [TestCase(9.0, -0.02)]
        [TestCase(0.0, 0.02)]
        public void Energy_IsTheHubsWork_AlsoWhereAnElementComesOrGoes_UnderGravity(double gravity, double speed)
        {
            SimulationParameters parameters = Straight(60, -10.0);
            parameters.Material.MassDamping = 0.0;
            parameters.Scene.Gravity = new Vector3d(0.0, 0.0, gravity);
            parameters.Scene.GuidewireOffset = speed < 0.0 ? -200.0 : -295.0;
            parameters.Drive.InsertionSpeed = speed;
            parameters.Method.MaxSimulationSteps = 200;
            Simulation run = Simulation.Create(parameters);
            double before = 0.0;
            double workBefore = 0.0;
            double most = 0.0;
            double usual = 0.0;
            int outside = 0;
            int events = 0;
            Wires.Finish(run, () =>
            {
                StressRecord stress = run.Stress()!;
                double energy = stress.KineticEnergy + stress.ElasticEnergy + stress.PotentialEnergy;
                HubRecord hub = run.Hub()!;
                double error = Math.Abs(energy - before - (hub.Work - workBefore));
                most = run.StepCount > 40 ? Math.Max(most, error) : 0.0;
                usual = Math.Max(usual, Math.Abs(hub.Work - workBefore));
                events += hub.SpheresInBody != outside ? 1 : 0;
                (before, workBefore, outside) = (energy, hub.Work, hub.SpheresInBody!.Value);
            });
            TestContext.Out.WriteLine("error " + most + " of " + usual + ", events " + events);
            Assert.That(events, Is.GreaterThan(5));
            Assert.That(most, Is.LessThan(1e-12));
        }

        [Test]
        public void ForceAndTorque_HaveNoJumpWhereAnElementComesIn()
        {
            // A wire that bears on the bend; its hub goes on and turns.
            SimulationParameters parameters = Sheathed(60, 0.3, 110.0);
            parameters.Drive.InsertionSpeed = 2.0 * Speed;
            parameters.Drive.RotationSpeed = 2.0;
            parameters.Method.MaxSimulationSteps = 240;
            Simulation run = Simulation.Create(parameters);
            int before = 0;
            double force = 0.0;
            double torque = 0.0;
            double usual = 0.0;
            double usualTurn = 0.0;
            double atEntry = 0.0;
            double atEntryTurn = 0.0;
            int entries = 0;
            Wires.Finish(run, () =>
            {
                HubRecord hub = run.Hub()!;
                double jump = Math.Abs(hub.Force - force);
                double turn = Math.Abs(hub.Torque - torque);
                bool enters = hub.SpheresInBody != before;
                if (run.StepCount > 50)
                {
                    entries += enters ? 1 : 0;
                    usual = enters ? usual : Math.Max(usual, jump);
                    usualTurn = enters ? usualTurn : Math.Max(usualTurn, turn);
                    atEntry = enters ? Math.Max(atEntry, jump) : atEntry;
                    atEntryTurn = enters ? Math.Max(atEntryTurn, turn) : atEntryTurn;
                }
                before = hub.SpheresInBody!.Value;
                force = hub.Force;
                torque = hub.Torque;
            });
            Assert.That(entries, Is.GreaterThanOrEqualTo(5), "one in 25 steps of the last 140");
            Assert.That(atEntry, Is.LessThanOrEqualTo(usual));
            Assert.That(atEntryTurn, Is.LessThanOrEqualTo(usualTurn));
        }

        [Test]
        public void WireWithdrawnFartherThanItIsOut_IsAskedForMoreThanItGoes()
        {
            // 25 mm are out of the sheath, and it is pulled by 60.
            SimulationParameters parameters = Sheathed(40, 0.2, 25.0);
            parameters.Drive.InsertionSpeed = -2.0 * Speed;
            parameters.Method.MaxSimulationSteps = 300;
            Simulation run = Wires.Run(parameters);
            double asked = 1e3 * 2.0 * Speed * 300 * parameters.Method.TimeStep;
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(run.Contacts!.DriveAsked, Is.EqualTo(asked).Within(1e-9));
            Assert.That(-1e3 * run.Hub()!.Insertion + run.Contacts.DriveShortfall, Is.EqualTo(asked).Within(1e-6));
        }

        [Test]
        public void RunThatIsRestored_TakesTheSameSteps()
        {
            SimulationParameters parameters = Sheathed(40, 0.2, 60.0);
            parameters.Drive.InsertionSpeed = Speed;
            parameters.Drive.RotationSpeed = 2.0;
            parameters.Method.MaxSimulationSteps = 160;
            Simulation run = Wires.RunAndRestore(parameters, 70);
            parameters.Scene.Sheath = null;
            Assert.That(() => run.Continue(parameters), Throws.ArgumentException.With.Message.StartsWith("sheath"));
        }

        [Test]
        public void SheathedPart_WindsUpAsTheSpringThatItIs()
        {
            // A tip bent by 45 degrees bears on the lumen of a bend: a torque of GJ/L over the whole length.
            SimulationParameters parameters = Sheathed(60, 0.6, 90.0);
            parameters.Drive.Table = new DriveTable(new TimeTable(new[] { 0.0, 1.5 }, new[] { 0.0, 0.06 }),
                new TimeTable(new[] { 1.5, 2.5 }, new[] { 0.0, 1.0 }));
            parameters.Method.MaxSimulationSteps = 600;
            Simulation run = Wires.Finish(parameters);
            HubRecord hub = run.Hub()!;
            double stiffness = CrossSection.At(parameters.Material, 0.0).TwistStiffness;
            double sheathed = 0.6 - hub.LengthInBody!.Value;
            Vector3d[] curvature = run.Stress()!.Curvature;
            Assert.That(hub.Torque, Is.GreaterThan(1e-6));
            for (int k = 1; k < 60 - hub.SpheresInBody; k++)
            {
                Assert.That(-curvature[k].Z, Is.EqualTo(hub.Torque / stiffness).Within(1e-6 * hub.Torque / stiffness));
            }
            Assert.That(-hub.Twist, Is.GreaterThan(0.9 * hub.Torque * sheathed / stiffness));
            double first = 2.0 * Math.Atan2(run.State.Orientations[30].Z, run.State.Orientations[30].W);
            Assert.That(hub.Turn - first, Is.EqualTo(30.5 * 0.01 * hub.Torque / stiffness).Within(1e-6));
        }

        [Test]
        public void JointThatWinds_HasTheEnergyOfItsWholeTurn([Values(-0.9, 0.9)] double turn)
        {
            // 1/2 K (a - a0)^2 over three turns, from iterate to iterate; a snapshot holds how many they were.
            MaterialRod rod = Rods.Wire(3);
            Joint[] joints = rod.Joints(new RodSupports { Clamp = ClampRule.HalfElement });
            joints[0].Rest = new Vector3d(0.0, 0.0, 0.4);
            var term = new BendTwistEnergy<RotationVectorLaw>(joints, true, false, true);
            var shape = new RodShape(3);
            for (int k = 1; k <= 21; k++)
            {
                Array.Fill(shape.Q, shape.Q[0] * RotationVector.Exp(turn * Vector3d.UnitZ));
                term.Anchor(shape);
                double strain = k * turn - 0.4;
                Assert.That(term.TurnOf(shape, 0).Z, Is.EqualTo(k * turn).Within(1e-12));
                Assert.That(term.Value(shape), Is.EqualTo(0.5 * joints[0].Twist * strain * strain)
                    .Within(1e-12 * joints[0].Twist * strain * strain));
                Assert.That(term.TurnCouple(shape), Is.EqualTo(-joints[0].Twist * strain)
                    .Within(1e-12 * joints[0].Twist * Math.Abs(strain)));
            }
            var snapshot = new Snapshot();
            term.Serialize(snapshot);
            var reader = new BendTwistEnergy<RotationVectorLaw>(joints, true, false, true);
            reader.Serialize(snapshot.ToRead());
            Assert.That(reader.Value(shape), Is.EqualTo(term.Value(shape)));
            term.Remesh();
            reader = new BendTwistEnergy<RotationVectorLaw>(joints, true, false, true);
            Assert.That(term.TurnOf(shape, 0).Z, Is.EqualTo(reader.TurnOf(shape, 0).Z).And.LessThan(Math.PI));
        }

        [Test]
        public void TipThatJumpsRound_LosesNoTurn([Values(0.01, 0.05)] double timeStep)
        {
            // So long a wire winds up by more than half a turn before its tip gives way in the bend.
            SimulationParameters parameters = Sheathed(150, 1.5, 90.0);
            parameters.Drive.Table = new DriveTable(new TimeTable(new[] { 0.0, 1.5 }, new[] { 0.0, 0.11 }),
                new TimeTable(new[] { 1.5, 4.5 }, new[] { 0.0, 3.0 * Math.PI }));
            parameters.Method.TimeStep = timeStep;
            parameters.Method.MaxSimulationSteps = (int)Math.Round(4.5 / timeStep);
            Simulation run = Simulation.Create(parameters);
            double largest = 0.0;
            double before = 0.0;
            Wires.Finish(run, () =>
            {
                HubRecord hub = run.Hub()!;
                largest = Math.Max(largest, Math.Abs(hub.Turn + hub.Twist - before));
                before = hub.Turn + hub.Twist;
                double stiffness = CrossSection.At(parameters.Material, 0.0).TwistStiffness;
                double sheathed = 1.5 - hub.LengthInBody!.Value;
                Assert.That(-hub.Twist, Is.EqualTo(hub.Torque * sheathed / stiffness).Within(1.5),
                    "what is wound up is the torque's, at step " + run.StepCount);
            });
            Assert.That(largest, Is.GreaterThan(Math.PI), "it jumped");
        }

        [Test]
        public void StretchedWire_IsSimulatedAsFarAsItIsOut()
        {
            // A follower force of EA/5 draws 60 of 300 mm out of a sheath whose hub stands still.
            SimulationParameters parameters = Straight(60, -12.0);
            double stiffness = parameters.Material.YoungsModulus * Math.PI * Radius * Radius;
            parameters.Drive.HubForceLimit = 0.0;
            parameters.Scene.TipFollowerForce = new Vector3d(0.0, 0.0, 0.2 * stiffness);
            parameters.Scene.TipFollowerForceTable = new TimeTable(new[] { 0.0, 0.2 }, new[] { 0.0, 1.0 });
            parameters.Method.MaxSimulationSteps = 40;
            Simulation run = Wires.Finish(parameters);
            Vector3d[] x = run.State.Positions;
            HubRecord hub = run.Hub()!;
            int outside = Array.FindAll(x, node => node.Z > 0.0).Length;
            Assert.That(x[60].Z, Is.EqualTo(5.0 + 0.2 * 300.0).Within(0.1), "F L/EA");
            Assert.That(outside, Is.GreaterThan(10));
            Assert.That(hub.SpheresInBody, Is.EqualTo(outside));
            Assert.That(hub.LengthInBody, Is.EqualTo(1e-3 * (5.0 * (outside - 1) + x[61 - outside].Z)).Within(1e-9));
        }

        [Test]
        public void RunEnds_WhereTheWireHasComeToRest()
        {
            SimulationParameters parameters = Straight(60, -12.0);
            parameters.Drive.Table = new DriveTable(new TimeTable(new[] { 0.0, 0.05 }, new[] { 0.0, 1e-3 }),
                new TimeTable(new[] { 0.0 }, new[] { 0.0 }));
            parameters.Method.DeltaThreshold = 1e-6;
            parameters.Method.MaxSimulationSteps = 4000;
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged), run.Reason);
            Assert.That(1e-3 * run.State.Positions[60].Z, Is.EqualTo(6e-3).Within(1e-6));
        }

        [TestCase("points out of the vessel", 0.0, 0.0, 0.0, -1.0, 0.1)]
        [TestCase("is not that of the wire", 0.0, 0.0, 0.0, 0.0, 0.1)]
        [TestCase("units off the wire's axis", 0.5, 0.0, 0.0, 1.0, 0.1)]
        [TestCase("has to be on the wire", 0.0, 0.0, 80.0, 1.0, 0.1)]
        [TestCase("longer than the wire", 0.0, 0.0, 0.0, 1.0, 100.0)]
        public void SheathThatFeedsNothing_IsRefusedInOnePhrase(string words, double x, double y, double z,
            double along, double time)
        {
            SimulationParameters parameters = Sheathed(20, 0.1, 25.0);
            parameters.Drive.InsertionSpeed = Speed;
            parameters.Method.MaxSimulationSteps = (int)(time / parameters.Method.TimeStep);
            parameters.Scene.Sheath = new Sheath
            {
                Exit = new Vector3d(x, y, z),
                Direction = new Vector3d(0.0, along == 0.0 ? 1.0 : 0.0, along),
            };
            string? problem = Simulation.FindProblemOfStart(parameters);
            Assert.That(problem, Does.StartWith("sheath").And.Contain(words).And.Not.Contain("\n"));
        }

        [Test]
        public void ExitLessThanAnElementInsideAClosedVessel_LetsTheWireGoOutAndIn([Values(0.3, 2.0)] double exit)
        {
            // Elements of 5 mm come through the closed end of a tube, a half sphere from z = 0 on, in their sheath, and
            // go back.
            SimulationParameters parameters = Sheathed(40, 0.2, 7.0);
            parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, exit) };
            parameters.Scene.Walls = WallScenes.Tube(Lumen, 300.0, Lumen, openStart: false);
            parameters.Drive.Table = new DriveTable(
                new TimeTable(new[] { 0.0, 1.0, 2.0 }, new[] { 0.0, 0.043, 0.0 }),
                new TimeTable(new[] { 0.0, 1.0 }, new[] { 0.0, 2.0 }));
            parameters.Method.TimeStep = 0.02;
            parameters.Method.MaxSimulationSteps = 100;
            Assert.That(Simulation.FindProblemOfStart(parameters), Is.Null);
            Simulation run = Wires.Finish(parameters);
            Assert.That(run.Hub()!.LengthInBody, Is.EqualTo(1e-3 * (7.0 - exit)).Within(1e-5));
            Assert.That(run.Contacts!.Passages, Is.Zero);
            Assert.That(run.Contacts.MaxPenetration, Is.Zero);
            parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, -0.3) };
            Assert.That(Simulation.FindProblemOfStart(parameters), Does.Contain("starts outside"));
        }

        [Test]
        public void ExitThatIsNotNamed_IsOneElementInsideTheInlet()
        {
            SimulationParameters parameters = Sheathed(20, 0.1, 25.0);
            parameters.Scene.Sheath = new Sheath();
            Simulation run = Simulation.Create(parameters);
            // Nodes stand at z = 25, 20, ... -75 mm, the inlet at -12: the first inside is at -10.
            Assert.That(run.Hub()!.LengthInBody, Is.EqualTo(0.03).Within(1e-12));
        }

        [Test]
        public void WireInASheath_IsTheWholeWireInALongTightTube()
        {
            // Gates: force, torque and angle of the tip within 2 %, its place within 3 % of the lumen's radius. The
            // tube has 0.05 mm of play and a mouth 6 mm long, and the drag of the wire within it is taken off.
            SimulationParameters sheathed = Turned();
            SimulationParameters whole = Turned();
            whole.Scene.Sheath = null;
            whole.Scene.Walls = new ContactShape[] { Vessel(0.23) };
            Simulation a = Wires.Finish(sheathed);
            Simulation b = Wires.Finish(whole);
            HubRecord one = a.Hub()!;
            HubRecord other = b.Hub()!;
            double drag = whole.Material.MassDamping * 0.04 * (0.3 - one.LengthInBody!.Value)
                * CrossSection.At(whole.Material, 0.0).LineDensity;
            Assert.That(one.Force, Is.GreaterThan(5e-3));
            Assert.That(one.Force, Is.EqualTo(other.Force - drag).Within(0.02 * other.Force));
            Assert.That(one.Torque, Is.EqualTo(other.Torque).Within(0.02 * other.Torque));
            Assert.That(one.Turn + one.Twist, Is.EqualTo(other.Turn + other.Twist).Within(0.02));
            int n = a.State.ElementCount;
            Assert.That(Vector3d.Distance(a.State.Positions[n], b.State.Positions[n]), Is.LessThan(0.03 * Lumen));
        }

        private static SimulationParameters Turned()
        {
            SimulationParameters parameters = Sheathed(60, 0.3, 100.0);
            parameters.Drive.InsertionSpeed = 0.04;
            parameters.Drive.RotationSpeed = 0.6;
            parameters.Method.MaxSimulationSteps = 420;
            return parameters;
        }
    }
}
