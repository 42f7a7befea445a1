using System;
using System.Linq;
using System.Collections.Generic;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Friction of a wire with a material on walls: its derivatives, and Coulomb's law against closed
    /// forms.</summary>
    public sealed class FrictionEnergyTests
    {
        private const int N = 4;
        private const double Step = 1e-6;

        [TestCase(1e-5)]
        [TestCase(1.0)]
        public void Force_IsTheSlopeOfItsEnergy(double elasticSlip)
        {
            FrictionEnergy friction = Create(elasticSlip, out RodShape shape);
            var gradient = new RodVector[N + 2];
            friction.AddGradient(shape, gradient);
            double largest = 0.0;
            double worst = 0.0;
            for (int i = 0; i < 6 * N + 3; i++)
            {
                double difference = (friction.Value(Moved(shape, i, Step)) - friction.Value(Moved(shape, i, -Step)))
                    / (2.0 * Step);
                worst = Math.Max(worst, Math.Abs(difference - Entry(gradient, i)));
                largest = Math.Max(largest, Math.Abs(difference));
            }
            Assert.That(largest, Is.GreaterThan(0.0));
            Assert.That(worst, Is.LessThan(1e-6 * largest));
        }

        [Test]
        public void Blocks_AreTheDifferencesOfTheGradient_WhileTurnsAreSmall()
        {
            // Second derivatives of the turn, of its own order, 1e-3, are left out.
            FrictionEnergy friction = Create(0.05, out RodShape shape);
            var blocks = new RodBlock[N + 2];
            friction.AddBlocks(shape, blocks, new RodVector[N + 2], 0, N + 1);
            double[,] exact = DenseMatrix.From(blocks, N + 1);
            double largest = 0.0;
            double worst = 0.0;
            for (int k = 0; k < 6 * N + 3; k++)
            {
                var above = new RodVector[N + 2];
                var below = new RodVector[N + 2];
                friction.AddGradient(Moved(shape, k, Step), above);
                friction.AddGradient(Moved(shape, k, -Step), below);
                for (int i = k; i < 6 * N + 3; i++)
                {
                    double difference = (Entry(above, i) - Entry(below, i)) / (2.0 * Step);
                    worst = Math.Max(worst, Math.Abs(difference - exact[i, k]));
                    largest = Math.Max(largest, Math.Abs(difference));
                }
            }
            Assert.That(worst, Is.LessThan(5e-3 * largest));
        }

        [TestCase(1e-5)]
        [TestCase(1e-2)]
        [TestCase(1.0)]
        public void WorkDoneAgainstIt_IsStoredOrLost_AndNoHeatComesBack(double elasticSlip)
        {
            // f.u = change of F^2/(2k) + heat + k |change of d|^2/2, the last of which is an implicit step's own.
            FrictionEnergy friction = Create(elasticSlip, out RodShape shape);
            var random = new RandomGeometry(41);
            double most = 0.0;
            for (int k = 0; k < 300; k++)
            {
                friction.EndStep(shape);
                double heat = friction.Anchors.Dissipated;
                double stored = friction.Anchors.StoredEnergy;
                RodShape before = Rods.Copy(shape);
                // One node or element after the other goes elsewhere, farther and less far from the walls.
                int i = random.Index(N);
                shape.X[i] += 0.01 * random.Point();
                shape.Q[i] = shape.Q[i] * RotationVector.Exp(0.1 * random.Point());
                friction.Lag(shape);
                var gradient = new RodVector[N + 2];
                friction.AddGradient(shape, gradient);
                double work = 0.0;
                for (int j = 0; j <= N; j++)
                {
                    RodVector g = gradient[j];
                    work += Vector3d.Dot(new Vector3d(g.X1, g.X2, g.X3), shape.X[j] - before.X[j]);
                    work += j == N ? 0.0 : Vector3d.Dot(new Vector3d(g.T1, g.T2, g.T3),
                        RotationVector.Log(before.Q[j].Conjugate * shape.Q[j]));
                }
                friction.EndStep(shape);
                heat = friction.Anchors.Dissipated - heat;
                double more = friction.Anchors.StoredEnergy - stored;
                most = Math.Max(most, stored);
                Assert.That(heat, Is.GreaterThanOrEqualTo(0.0), "case " + k);
                Assert.That(more + heat, Is.LessThanOrEqualTo(work + 1e-12 + 1e-9 * most), "case " + k);
            }
            Assert.That(friction.Anchors.Dissipated, Is.GreaterThan(0.0));
            Assert.That(most, Is.GreaterThan(0.0));
        }

        [Test]
        public void ContactThatEnds_LosesAllThatItHasStored()
        {
            FrictionEnergy friction = Create(1e-2, out RodShape shape);
            friction.EndStep(shape);
            double stored = friction.Anchors.StoredEnergy;
            double heat = friction.Anchors.Dissipated;
            for (int i = 0; i <= N; i++)
            {
                shape.X[i] += new Vector3d(0.0, 10.0, 0.0);
            }
            friction.Lag(shape);
            friction.EndStep(shape);
            Assert.That(stored, Is.GreaterThan(0.0));
            Assert.That(friction.Anchors.StoredEnergy, Is.Zero);
            Assert.That(friction.Anchors.Dissipated - heat, Is.EqualTo(stored).Within(1e-12 * stored));
        }

        [TestCase(0, 2)]
        [TestCase(2, N)]
        public void Heat_IsInProportionToTheCoefficientOfTheElementsThatSlide(int from, int to)
        {
            double[] heat = Array.ConvertAll(new[] { 0.0, 0.3, 0.6 }, coefficient =>
            {
                FrictionEnergy friction = Create(1e-8, out RodShape shape);
                friction.SetCoefficient(0, N, 0.0);
                friction.SetCoefficient(from, to, coefficient);
                friction.Lag(shape);
                friction.EndStep(shape);
                double before = friction.Anchors.Dissipated;
                for (int i = 0; i <= N; i++)
                {
                    shape.X[i] += new Vector3d(0.0, 0.0, 0.05);
                }
                friction.Lag(shape);
                friction.EndStep(shape);
                return friction.Anchors.Dissipated - before;
            });
            Assert.That(heat[0], Is.Zero);
            Assert.That(heat[1], Is.GreaterThan(0.0));
            Assert.That(heat[2] / heat[1], Is.EqualTo(2.0).Within(1e-5), "1e-8 of a way of 0.05 is stored");
        }

        [Test]
        public void Anchors_GoBack_ToWhereTheyWereSaved()
        {
            FrictionEnergy friction = Create(1e-2, out RodShape shape);
            friction.EndStep(shape);
            double stored = friction.Anchors.StoredEnergy;
            double heat = friction.Anchors.Dissipated;
            var start = new StepStart(friction.Anchors.Serialize);
            start.Save();
            for (int i = 0; i <= N; i++)
            {
                shape.X[i] += new Vector3d(0.0, 0.0, 0.1);
            }
            friction.Lag(shape);
            friction.EndStep(shape);
            Assert.That(friction.Anchors.StoredEnergy, Is.Not.EqualTo(stored));
            Assert.That(friction.Anchors.Dissipated, Is.GreaterThan(heat));
            start.Restore();
            Assert.That(friction.Anchors.StoredEnergy, Is.EqualTo(stored));
            Assert.That(friction.Anchors.Dissipated, Is.EqualTo(heat));
        }

        [Test]
        public void Anchors_GoBack_WhereAMotionIsRestored()
        {
            SimulationParameters parameters = OnAnIncline(0.3, 0.25);
            var scene = new MaterialScene(parameters, new Scene(parameters));
            WallTerms walls = DirectSetup.WallTermsOf(parameters, scene, new Barrier(5e-5, 1e3),
                new SupportSpring(scene.Rod, HubLimit.None));
            RodDynamics motion = DirectSetup.DynamicsOf(parameters, scene,
                new RodTerms(scene.Rod, scene.Supports, parameters.Scene, walls, Array.Empty<EnergyTerm>()));
            Rods.Step(motion, 1e-3, 5);
            double stored = walls.Friction!.Anchors.StoredEnergy;
            var start = new StepStart(motion.Serialize);
            start.Save();
            Assert.That(motion.Step(1e-3), Is.Null);
            Assert.That(walls.Friction.Anchors.StoredEnergy, Is.Not.EqualTo(stored));
            start.Restore();
            Assert.That(walls.Friction.Anchors.StoredEnergy, Is.EqualTo(stored));
        }

        [Test]
        public void Anchors_GoWithTheirNodes_IntoAnotherWindow()
        {
            FrictionEnergy friction = Create(1e-2, out RodShape shape);
            friction.EndStep(shape);
            FrictionAnchors all = friction.Anchors;
            var shorter = new FrictionAnchors(2, N - 1);
            shorter.CarryOver(all, Enumerable.Range(1, N).ToArray(), N - 1);
            var back = new FrictionAnchors(2, N);
            back.CarryOver(shorter, Enumerable.Range(-1, N + 1).ToArray(), N);
            // In place the same.
            var own = new FrictionAnchors(2, N);
            own.CarryOver(all, Enumerable.Range(0, N + 1).ToArray(), N);
            own.CarryOver(own, Enumerable.Range(1, N).ToArray(), N - 1);
            own.CarryOver(own, Enumerable.Range(-1, N + 1).ToArray(), N);
            int kept = 0;
            for (int w = 0; w < 2; w++)
            {
                for (int k = 0; k < 2 * N + 1; k++)
                {
                    bool isFirst = k == 0 || k == N + 1;
                    int at = w * (2 * N + 1) + k;
                    Assert.That(back[at].Force, Is.EqualTo(isFirst ? Vector3d.Zero : all[at].Force), "anchor " + at);
                    Assert.That(own[at].Force, Is.EqualTo(back[at].Force), "anchor in place " + at);
                    kept += !isFirst && all[at].Stiffness > 0.0 ? 1 : 0;
                }
            }
            Assert.That(kept, Is.GreaterThan(3));
            Assert.That(back.Dissipated, Is.EqualTo(all.Dissipated));
            Assert.That(own.Dissipated, Is.EqualTo(all.Dissipated));
        }

        // A stiff rod lies along a plane of slope angle: m g sin against mu m g cos.
        [TestCase(0.3, 0.1, Category = "Long")]
        [TestCase(0.3, 0.25)]
        [TestCase(0.3, 0.35)]
        [TestCase(0.3, 0.45, Category = "Long")]
        [Category("Row")]
        public void RodOnAnIncline_StaysBelowTheAngleOfFriction_AndAcceleratesAboveIt(double mu, double slope)
        {
            SimulationParameters parameters = OnAnIncline(mu, slope);
            double angle = Math.Atan(slope);
            Simulation run = Simulation.Create(parameters);
            Wires.Step(run, 200);
            double speed = run.State.Velocities[5].Z;
            double most = 0.0;
            Wires.Finish(run, () => most = Math.Max(most, Math.Abs(run.State.Velocities[5].Z)));
            double gain = run.State.Velocities[5].Z - speed;
            double excess = 9810.0 * (Math.Sin(angle) - mu * Math.Cos(angle));
            string what = "wire on an incline of tangent " + slope + ", friction " + mu + ": ";
            if (excess > 0.0)
            {
                Row.Holds(what + "acceleration, of g (sin - mu cos)", gain / (0.2 * excess), 1.0, 0.01);
            }
            else
            {
                Row.Holds(what + "largest speed, mm/s", most, 0.0, 1e-6);
            }
        }

        [TestCase(0.1, 90.0)]
        [TestCase(0.3, 90.0)]
        [TestCase(0.1, 180.0, Category = "Long")]
        [TestCase(0.05, 90.0, Category = "Long")]
        [TestCase(0.05, 180.0, Category = "Long")]
        [TestCase(0.3, 180.0, Category = "Long")]
        [Category("Row")]
        public void PulledThroughABend_TheForceGrowsByTheCapstansLaw(double mu, double degrees)
        {
            if (mu == 0.05 || degrees > 90.0)
            {
                Rods.OnlyInFull("two coefficients of friction: the law has but their product with the angle");
            }
            // A wire whose rest curvature is the bend's, pulled back against a load at its tip: it lies
            // against the inner wall with the force per length of a limp one.
            double angle = degrees * Math.PI / 180.0;
            const double bend = 30.0;
            const double load = 0.5;
            double pulled = Pull(mu, angle, bend, load);
            double free = Pull(0.0, angle, bend, load);
            string what = "wire pulled through a bend of " + degrees + "°, ";
            Row.Holds(what + "without friction: force at the base, of that at the tip", free / load, 1.0, 0.02);
            Row.Holds(what + "friction " + mu + ": growth of the force, of exp(mu phi)",
                pulled / free / Math.Exp(mu * angle), 1.0, 0.05);
        }

        [TestCase(0.0)]
        [TestCase(0.5, Category = "Long")]
        [TestCase(1.0)]
        [TestCase(2.0)]
        [TestCase(4.0, Category = "Long")]
        [Category("Row")]
        public void TurnedWire_NeedsLessAxialForce_ByTheDirectionOfItsSlip(double turning)
        {
            // A wire lies in a horizontal tube; its surface slips by v along the tube and by turning v around. Friction
            // lifts it along the wall by an angle phi with N = W cos(phi), mu N sin(beta) = W sin(phi),
            // tan(beta) = turning; the force along the tube is mu N cos(beta).
            const double mu = 0.3;
            const double speed = 20.0;   // mm/s
            const double radius = 0.4;   // mm
            SimulationParameters parameters = WallScenes.Wire(30, 1e-3 * radius);
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.Gravity = new Vector3d(0.0, -9.81, 0.0);
            parameters.Scene.Walls = WallScenes.Tube(-50.0, 400.0, 1.0, height: 0.59, friction: mu);
            // Node 0 is held where the wall just begins to push.
            parameters.Contact.ContactDistance = 1e-5;
            parameters.Method.TimeStep = 2e-3;
            parameters.Method.MaxSimulationSteps = 500;
            parameters.Drive.Kind = Drive.Displace;
            parameters.Drive.DisplacementPerStep = speed * parameters.Method.TimeStep;
            parameters.Drive.TwistPerStep = turning * speed / radius * parameters.Method.TimeStep;
            Simulation run = Simulation.Create(parameters);
            double sum = 0.0;
            double carried = 0.0;   // W, what the clamp leaves of the weight to the wall
            Wires.Finish(run, () =>
            {
                sum += run.StepCount > 250 ? run.Report()!.ProximalForce!.Value.Z / 250.0 : 0.0;
                carried += run.StepCount > 250 ? run.Contacts!.Total.Y / 250.0 : 0.0;
            });
            double weight = 6450.0 * Math.PI * 0.16e-6 * 0.3 * 9.81;
            double beta = Math.Atan(turning);
            Assert.That(carried, Is.EqualTo(weight).Within(0.1 * weight));
            double expected = mu * carried * Math.Cos(Math.Atan(mu * Math.Sin(beta))) * Math.Cos(beta);
            Row.Holds("wire pushed along a level tube, turned " + turning + " times as fast: axial force, of mu N "
                + "cos(beta)", sum / expected, 1.0, 0.05);
        }

        private static SimulationParameters OnAnIncline(double mu, double slope)
        {
            SimulationParameters parameters = WallScenes.Wire(10, 0.5e-3);
            parameters.Scene.GuidewireLength = 50.0;
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.ProximalEnd = ProximalEnd.Free;
            double angle = Math.Atan(slope);
            parameters.Scene.Gravity = 9.81 * new Vector3d(0.0, -Math.Cos(angle), Math.Sin(angle));
            parameters.Scene.Walls = new ContactShape[]
            {
                new PlaneShape(new Vector3d(0.0, -0.54, 0.0), Vector3d.UnitY) { FrictionCoefficient = mu },
            };
            parameters.Contact.ContactDistance = 5e-5;
            parameters.Method.TimeStep = 1e-3;
            parameters.Method.MaxSimulationSteps = 400;
            return parameters;
        }

        // Force at the base, N, of a wire that is pulled out of a bend against a force along its tip.
        private static double Pull(double mu, double angle, double bend, double load)
        {
            double straight = 40.0;
            double length = 2.0 * straight + bend * angle;
            SimulationParameters parameters = WallScenes.Wire((int)Math.Round(length / 2.0), 0.2e-3);
            int n = parameters.Scene.NumberRodElements;
            parameters.Scene.GuidewireLength = length;
            parameters.Material.YoungsModulus = 5e9;
            parameters.Material.ShearModulus = 2e9;
            var positions = new Vector3d[n + 1];
            var orientations = new Quaterniond[n];
            var middle = new Vector3d[n + 1];
            for (int i = 0; i <= n; i++)
            {
                positions[i] = At(length * i / n - straight, angle, bend, out double turn);
                if (i > 0)
                {
                    double along = length * (i - 0.5) / n - straight;
                    At(along, angle, bend, out turn);
                    orientations[i - 1] = Quaterniond.FromAxisAngle(Vector3d.UnitX, -turn);
                }
            }
            parameters.Scene.Start = new RodStart(positions, orientations, new Vector3d[n + 1], new Vector3d[n]);
            var knots = new List<Vector3d> { At(-straight - 60.0, angle, bend, out _) };
            for (int k = 0; k <= 90; k++)
            {
                knots.Add(At(bend * angle * k / 90.0, angle, bend, out _));
            }
            knots.Add(At(bend * angle + straight + 60.0, angle, bend, out double end));
            parameters.Scene.Walls = new ContactShape[]
            {
                new TubeShape(knots.ToArray(), knots.ConvertAll(_ => 0.4).ToArray(), true, true)
                {
                    FrictionCoefficient = mu,
                },
            };
            parameters.Scene.TipForce = load * new Vector3d(0.0, Math.Sin(end), Math.Cos(end));
            parameters.Drive.Kind = Drive.Displace;
            parameters.Drive.DisplacementPerStep = -0.05;
            parameters.Method.TimeStep = 2e-3;
            parameters.Method.MaxSimulationSteps = 200;
            Simulation run = Simulation.Create(parameters);
            double sum = 0.0;
            int count = 0;
            Wires.Finish(run, () =>
            {
                if (run.StepCount > 100)
                {
                    sum -= run.Report()!.ProximalForce!.Value.Z;
                    count++;
                }
            });
            Assert.That(run.Contacts!.Passages, Is.EqualTo(0));
            return sum / count;
        }

        // The centreline at an arc length from the bend's start, and how far it has turned from z towards y.
        private static Vector3d At(double s, double angle, double bend, out double turn)
        {
            turn = Math.Min(Math.Max(s / bend, 0.0), angle);
            Vector3d on = bend * new Vector3d(0.0, 1.0 - Math.Cos(turn), Math.Sin(turn));
            double beyond = s < 0.0 ? s : Math.Max(0.0, s - bend * angle);
            return on + beyond * new Vector3d(0.0, Math.Sin(turn), Math.Cos(turn));
        }

        private static FrictionEnergy Create(double elasticSlip, out RodShape shape)
        {
            MaterialRod rod = MaterialRod.Round(N, 0.8, 0.05, 1e6, 1e6, 1e3);
            shape = new RodShape(N);
            for (int i = 0; i <= N; i++)
            {
                shape.X[i] = new Vector3d(0.01 * i, 0.06 + 0.002 * i, 0.2 * i);
            }
            for (int j = 0; j < N; j++)
            {
                shape.Q[j] = Quaterniond.FromAxisAngle(Vector3d.Normalize(new Vector3d(1.0, 2.0, 0.3 * j)), 0.4);
            }
            var wall = new PlaneShape(Vector3d.Zero, new Vector3d(0.1, 1.0, 0.05)) { FrictionCoefficient = 0.4 };
            var ball = ConvexObstacle.Sphere(new Vector3d(0.25, 0.06, 0.3), 0.15);
            ball.FrictionCoefficient = 0.2;
            var barrier = new BarrierEnergy(rod, new ContactShape[] { wall, ball }, 1.0, new Barrier(0.1, 10.0));
            var friction = new FrictionEnergy(barrier, N, elasticSlip);
            friction.BeginStep(shape, 0.1);
            for (int step = 0; step < 2; step++)
            {
                // The second begins with what the first has left in the anchors.
                friction.Lag(shape);
                friction.EndStep(shape);
                friction.Lag(shape);
                for (int i = 0; i <= N; i++)
                {
                    shape.X[i] += new Vector3d(0.001 * i - 0.001 * step, 0.0005, -0.002);
                }
                for (int j = 0; j < N; j++)
                {
                    shape.Q[j] = shape.Q[j] * RotationVector.Exp(new Vector3d(1e-3, -2e-3, 3e-3));
                }
            }
            return friction;
        }

        private static RodShape Moved(RodShape shape, int unknown, double step)
        {
            RodShape moved = Rods.Copy(shape);
            int i = unknown / 6;
            int axis = unknown % 6;
            Vector3d e = axis % 3 == 0 ? Vector3d.UnitX : axis % 3 == 1 ? Vector3d.UnitY : Vector3d.UnitZ;
            if (axis < 3)
            {
                moved.X[i] += step * e;
            }
            else
            {
                moved.Q[i] = moved.Q[i] * RotationVector.Exp(step * e);
            }
            return moved;
        }

        private static double Entry(RodVector[] v, int unknown)
        {
            RodVector g = v[unknown / 6];
            return new[] { g.X1, g.X2, g.X3, g.T1, g.T2, g.T3 }[unknown % 6];
        }
    }
}
