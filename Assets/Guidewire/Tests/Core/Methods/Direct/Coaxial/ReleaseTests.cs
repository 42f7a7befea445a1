using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Forces by which hubs are driven, in closed form, against centred differences of the energy with all
    /// nodes, frames and angles held, in shapes at rest and far from it.</summary>
    public sealed class ReleaseTests
    {
        private const double Step = 1e-5;   // of lengths of some 1
        private const double Rest = 0.0;
        private const double Disturbed = 0.05;

        [Test]
        public void ForceOfAnInnerHub_IsTheSlopeOfTheEnergy([Values(2, 3)] int instruments,
            [Values(Rest, Disturbed)] double disturbance)
        {
            var forces = new Compared();
            for (int k = 0; k < 40; k++)
            {
                CoaxialPair tubes = instruments == 2 ? Two(k) : ThreeTubes.Mixed(k % 4);
                Disturb(tubes, disturbance, k, 0.0);
                for (int i = 1; i < instruments; i++)
                {
                    int hub = i;
                    double slope = EnergySlopes.FineDifference(Step, d => EnergyAt(tubes, hub, d, 0.0));
                    forces.Add(tubes.Terms.Release!.InnerForce(tubes.Shape, tubes.Terms, i), slope);
                }
            }
            Assert.That(forces.Largest, Is.GreaterThan(0.05));
            Assert.That(forces.Error, Is.LessThan(1e-8));
        }

        [Test]
        public void ForcesInASheath_AreTheSlopesOfTheEnergy([Values(2, 3)] int instruments,
            [Values(Rest, Disturbed)] double disturbance)
        {
            var inner = new Compared();
            var all = new Compared();
            for (int k = 0; k < 40; k++)
            {
                CoaxialPair tubes = instruments == 2 ? Two(k) : ThreeTubes.Mixed(k % 4);
                Disturb(tubes, disturbance, k, 0.07 + 0.0213 * k);
                for (int i = 1; i < instruments; i++)
                {
                    int hub = i;
                    double slope = EnergySlopes.FineDifference(Step, d => EnergyAt(tubes, hub, d, 0.0));
                    inner.Add(tubes.Terms.Release!.InnerForce(tubes.Shape, tubes.Terms, i), slope);
                }
                all.Add(tubes.Terms.Release!.SheathForce(tubes.Shape),
                    EnergySlopes.FineDifference(Step, d => EnergyAt(tubes, 0, 0.0, d)));
            }
            Assert.That(inner.Error, Is.LessThan(5e-6));
            Assert.That(all.Largest, Is.GreaterThan(0.05));
            Assert.That(all.Error, Is.LessThan(5e-6));
        }

        // Of cores that give way: at first without memory, then with that of another shape, the exit beside where it
        // was.
        [Test]
        public void ForcesOfCoresThatGiveWay_AreTheSlopesOfTheEnergy([Values(2, 3)] int instruments,
            [Values] bool isSteel, [Values(0.0, 0.027, -0.027)] double moved)
        {
            var inner = new Compared();
            var all = new Compared();
            for (int k = 0; k < 12; k++)
            {
                CoaxialPair tubes = instruments == 2 ? Two(3 * k) : ThreeTubes.Mixed(k % 4);
                tubes.GiveWay(0.5, isSteel);
                double sheathed = 0.07 + 0.0639 * k;
                Disturb(tubes, Disturbed, k, sheathed);
                if (moved != 0.0)
                {
                    tubes.Terms.Fibres!.EndStep(tubes.Shape);
                    tubes.Coaxial.SetHubs((double[])tubes.Coaxial.Joints.Hubs.Leads.Clone(), sheathed + 0.5 * moved);
                    tubes.Terms.Fibres.EndStep(tubes.Shape);
                    tubes.Coaxial.SetHubs((double[])tubes.Coaxial.Joints.Hubs.Leads.Clone(), sheathed + moved);
                    tubes.Solve(instruments == 2 ? new[] { 0.0, 0.7 } : new[] { 0.0, 0.7, -0.5 });
                    for (int j = 1; j < tubes.Shape.ElementCount; j++)
                    {
                        // What is in the sheath is stiff.
                        bool isOut = tubes.Coaxial.Joints.Stations[j - 1] >= sheathed + Math.Abs(moved);
                        double by = (isOut ? 0.01 : 0.0) * Math.Sin(3.0 * j + k);
                        tubes.Shape.Q[j] *= Quaterniond.FromAxisAngle(Vector3d.UnitX, by);
                    }
                }
                Assert.That(Math.Abs(tubes.Terms.Fibres!.Loss), moved == 0.0 ? Is.Zero : Is.GreaterThan(0.0));
                for (int i = 1; i < instruments; i++)
                {
                    int hub = i;
                    double slope = EnergySlopes.FineDifference(Step, d => EnergyAt(tubes, hub, d, 0.0));
                    inner.Add(tubes.Terms.Release!.InnerForce(tubes.Shape, tubes.Terms, i), slope);
                }
                all.Add(tubes.Terms.Release!.SheathForce(tubes.Shape),
                    EnergySlopes.FineDifference(Step, d => EnergyAt(tubes, 0, 0.0, d)));
            }
            Assert.That(inner.Error, Is.LessThan(2e-5));
            Assert.That(all.Largest, Is.GreaterThan(0.05));
            Assert.That(all.Error, Is.LessThan(2e-5));
        }

        // A border within the wire at a node of the catheter; the wire's own nodes and borders at the catheter's tip.
        // Almost without shear, by which a force jumps there.
        [TestCase(0.25, 0.6, 0)]
        [TestCase(0.25, 0.0, 0)]
        [TestCase(-0.35, 0.6, 7)]
        [TestCase(-0.25, 0.6, 5)]
        [TestCase(-0.3, 0.6, 6)]
        [TestCase(-0.175, 0.6, 4)]
        public void BorderAtANode_ReleasesWhatItDoesBesideIt(double lead, double turn, int beyond)
        {
            double[] by = { -1e-9, -1.2e-16, -6e-17, 0.0, 6e-17, 1.2e-16, 1e-9 };
            var force = new double[by.Length];
            for (int k = 0; k < by.Length; k++)
            {
                var pair = new CoaxialPair(
                    new[]
                    {
                        new[] { new CoaxialPair.Piece(0.5, 1.0, 0.7), new CoaxialPair.Piece(0.5, 0.6, -0.7) },
                        new[] { new CoaxialPair.Piece(0.55, 0.8, 0.0), new CoaxialPair.Piece(0.3, 0.3, 2.0) },
                    }, new[] { 10, 17 }, 0.3, new[] { 0.0, lead + by[k] }, new[] { 0, beyond }, 1e8);
                pair.Solve(turn);
                force[k] = pair.Force;
            }
            TestContext.WriteLine(string.Join(" ", force));
            Assert.That(Math.Abs(force[3]), Is.GreaterThan(0.05));
            Assert.That(force, Is.All.EqualTo(force[3]).Within(1e-7));
        }

        // There the energy has a kink. Stations of 20 and of 40 elements end beside the length by rounding.
        [Test]
        public void TipsInOnePlace_ReleaseWhatTheyDoBeyondIt_WhateverIsRounded([Values(10, 20, 37, 40)] int elements)
        {
            double[] by = { -1e-12, -2.4e-16, -1.2e-16, 0.0, 1.2e-16, 2.4e-16, 1e-9 };
            var force = new double[by.Length];
            for (int k = 0; k < by.Length; k++)
            {
                var pair = new CoaxialPair(
                    new[]
                    {
                        new[] { new CoaxialPair.Piece(0.6, 1.0, 0.0), new CoaxialPair.Piece(0.4, 1.0, 1.5) },
                        new[] { new CoaxialPair.Piece(0.62, 0.5, 0.0), new CoaxialPair.Piece(0.23, 0.5, 3.0) },
                    }, new[] { elements, 17 }, 0.3, new[] { 0.0, -0.15 + by[k] }, new[] { 0, 0 }, 1e8);
                pair.Solve(0.6);
                force[k] = pair.Force;
            }
            TestContext.WriteLine(string.Join(" ", force));
            Assert.That(Math.Abs(force[6] - force[0]), Is.GreaterThan(0.05), "the kink");
            Array.Resize(ref force, 6);
            Assert.That(force, Is.All.EqualTo(force[0]).Within(1e-7));
        }

        [Test]
        public void BordersThatMeetInASheath_ReleaseWhatTheyDoBesideIt()
        {
            // Straight, whatever is there: the energy has no kink. At a node, within an element, and at the outer hub.
            foreach (double lead in new[] { 0.25, 0.23, 0.55 })
            {
                var forces = new Compared();
                double first = Math.Max(0.55 - lead, 0.2);
                for (int k = -1; k <= 1; k++)
                {
                    var pair = new CoaxialPair(
                        new[]
                        {
                            new CoaxialPair.Piece(first, 1.0, 0.7), new CoaxialPair.Piece(1.0 - first, 0.6, -0.7),
                        }, 10,
                        new[] { new CoaxialPair.Piece(0.55, 0.8, 0.0), new CoaxialPair.Piece(0.5, 0.3, 2.0) }, 17, 0.3,
                        lead);
                    pair.Build(0, lead + 1e-9 * k, 0.43);
                    pair.Solve(0.6);
                    forces.Add(pair.Force, EnergySlopes.FineDifference(Step, d => EnergyAt(pair, 1, d, 0.0)));
                }
                Assert.That(forces.Largest, Is.GreaterThan(0.02));
                Assert.That(forces.Error, Is.LessThan(5e-6), "lead " + lead);
            }
        }

        [Test]
        public void LoadsOnAnInstrument_AreAmongTheForceOfItsHub_WhereverTheOriginIs()
        {
            CoaxialPair tubes = ThreeTubes.Mixed(0);
            Disturb(tubes, Disturbed, 3, 0.0);
            double free = tubes.Terms.Release!.InnerForce(tubes.Shape, tubes.Terms, 2);
            SetLoads(tubes);
            var forces = new Compared();
            for (int i = 1; i < 3; i++)
            {
                int hub = i;
                double slope = EnergySlopes.FineDifference(Step, d => EnergyAt(tubes, hub, d, 0.0));
                forces.Add(tubes.Terms.Release!.InnerForce(tubes.Shape, tubes.Terms, i), slope);
            }
            Assert.That(forces.Error, Is.LessThan(1e-8));
            double loaded = tubes.Terms.Release!.InnerForce(tubes.Shape, tubes.Terms, 2);
            Assert.That(Math.Abs(loaded - free), Is.GreaterThan(0.1));
            for (int i = 0; i < tubes.Shape.X.Length; i++)
            {
                tubes.Shape.X[i] += new Vector3d(3.0, -7.0, 20.0);
            }
            Assert.That(tubes.Terms.Release!.InnerForce(tubes.Shape, tubes.Terms, 2), Is.EqualTo(loaded).Within(1e-8));
        }

        // Weight, a force per length, one at the tip and one at a point of each.
        private static void SetLoads(CoaxialPair tubes)
        {
            var loads = new PrescribedLoads[3];
            for (int i = 0; i < 3; i++)
            {
                loads[i] = new PrescribedLoads(new SceneParameters
                {
                    GuidewireLength = 1.0,
                    Gravity = new Vector3d(200.0, -300.0, 900.0),
                    DistributedForce = new Vector3d(0.1, 0.0, -0.2 * i),
                    TipForce = new Vector3d(-0.1, 0.2, 0.3),
                    PointLoads = new[] { new PointLoad(0.83, new Vector3d(0.3, 0.1, -0.2)) },
                }, 1.0, Vector3d.Zero);
            }
            tubes.Terms.CoaxialLoads = new CoaxialLoads(tubes.Coaxial, tubes.Instruments, loads);
            tubes.Terms.CoaxialLoads.Set(tubes.Terms.Loads.Force, 0.0);
            tubes.Coaxial.TakeLoads(tubes.Shape);
        }

        // A bent catheter of two pieces with a wire of three, tips in and out of one another.
        private static CoaxialPair Two(int k)
        {
            double extension = -0.4713 + 0.0231 * k;
            int beyond = extension > 0.003 ? (int)Math.Floor(extension / 0.15 - 0.02) + 1 : 0;
            return new CoaxialPair(
                new[] { new CoaxialPair.Piece(0.6, 1.0, 0.0, 0.0, 0.2), new CoaxialPair.Piece(0.4, 0.7, 1.5) }, 10,
                new[]
                {
                    new CoaxialPair.Piece(0.9, 0.5, 0.0), new CoaxialPair.Piece(0.37, 0.5, 0.8, -0.4, -0.3),
                    new CoaxialPair.Piece(0.23, 0.3, 3.0),
                }, 10, 0.3, 0.5 - extension, beyond);
        }

        // At its rest shape with hubs turned, or from there on with all coordinates a little elsewhere.
        private static void Disturb(CoaxialPair tubes, double by, int seed, double sheathed)
        {
            var leads = new double[tubes.Coaxial.Joints.Count];
            var beyond = new int[leads.Length];
            var turns = new double[leads.Length];
            for (int i = 1; i < leads.Length; i++)
            {
                leads[i] = tubes.Coaxial.Joints.LeadOf(i);
                beyond[i] = tubes.Coaxial.Joints.BeyondOf(i);
                turns[i] = i == 1 ? 0.7 : -0.5;
            }
            tubes.Build(beyond, leads, sheathed);
            tubes.Solve(turns);
            var random = new RandomGeometry(seed);
            RodShape shape = tubes.Shape;
            for (int j = 0; j < shape.ElementCount && by > 0.0; j++)
            {
                // What is in a sheath, and a joint that is cut by its exit, is stiff.
                if (j > 0 && tubes.Coaxial.Joints.Stations[j - 1] >= sheathed)
                {
                    shape.Q[j] *= Quaterniond.FromAxisAngle(random.Direction(), by * random.Number(-1.0, 1.0));
                }
                shape.X[j + 1] = shape.X[j]
                    + tubes.Coaxial.Rod.Length[j] * (shape.Q[j].Director3 + 1e-7 * random.Point());
            }
            for (int j = 0; j < shape.Twist.Length && by > 0.0; j++)
            {
                shape.Twist[j] += by * random.Number(-1.0, 1.0);
            }
            tubes.Bending.SetIdleTwists(tubes.Shape);
        }

        // J, with a hub on by 'on', and all by 'out' out of the sheath.
        private static double EnergyAt(CoaxialPair tubes, int instrument, double on, double outOfSheath)
        {
            CoaxialJoints joints = tubes.Coaxial.Joints;
            var leads = (double[])joints.Hubs.Leads.Clone();
            double sheathed = joints.Sheathed;
            double lead = leads[instrument];
            leads[instrument] -= on;
            tubes.Coaxial.SetHubs(leads, sheathed - outOfSheath);
            double energy = EnergySlopes.OfInstruments(tubes.Terms, tubes.Shape);
            leads[instrument] = lead;
            tubes.Coaxial.SetHubs(leads, sheathed);
            tubes.Terms.CoaxialLoads?.Place(tubes.Terms.Loads.Force);
            return energy;
        }

        private sealed class Compared
        {
            private double _error;

            public double Largest { get; private set; }

            public double Error
            {
                get
                {
                    TestContext.WriteLine("{0:G3} of {1:G3} N", _error, Largest);
                    return _error / Largest;
                }
            }

            public void Add(double force, double slope)
            {
                _error = Math.Max(_error, Math.Abs(force - slope));
                Largest = Math.Max(Largest, Math.Abs(slope));
            }
        }
    }
}
