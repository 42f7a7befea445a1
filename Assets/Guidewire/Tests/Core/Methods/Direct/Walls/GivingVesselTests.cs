using System;
using System.Collections.Generic;
using System.Linq;
using System.Numerics;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Vessels that give way as a whole, as beams on an elastic foundation.</summary>
    public sealed class GivingVesselTests
    {
        private const double OfWire = 1.9e-3;      // EI, N m^2
        private const double OfVessel = 2.9e-4;
        private const double Length = 0.3;         // m
        private const double Radius = 0.4e-3;      // of the wire, m

        /// <summary>A point is where the map back finds it, and both derivatives are those of the maps.</summary>
        [Test]
        public void Field_AndItsDerivatives_BelongTogether([Values] bool moves)
        {
            WallMotion motion = Waved(0.02, moves);
            WallBeam beam = motion.Beam!;
            var field = new WallField(motion);
            field.SetTime(0.3);
            var random = new System.Random(3);
            Vector3d[] q = Displacements(beam, random, 0.1);
            for (int k = 0; k < 200; k++)
            {
                field.SetBeam(q, 1.0);
                double s = 12.0 * random.NextDouble() - 1.0;
                Vector3d rest = Curve(s) + 0.3 * Point(random);
                Vector3d x = field.Moved(rest);
                Assert.That(Vector3d.Distance(field.AtRest(x, out Matrix3 gradient), rest), Is.LessThan(1e-12));
                BeamWeight weight = field.WeightAt(rest);
                Vector3d dx = Point(random);
                Vector3d difference = (0.5 / 1e-6) * (field.AtRest(x + 1e-6 * dx) - field.AtRest(x - 1e-6 * dx));
                Assert.That(Vector3d.Distance(gradient * dx, difference), Is.LessThan(1e-7), "by the place, " + s);
                Vector3d[] dq = Displacements(beam, random, 1.0);
                field.SetBeam(q.Zip(dq, (one, other) => one + 1e-6 * other).ToArray(), 1.0);
                Vector3d above = field.Moved(rest);
                field.SetBeam(q.Zip(dq, (one, other) => one - 1e-6 * other).ToArray(), 1.0);
                difference = (0.5 / 1e-6) * (above - field.Moved(rest));
                Assert.That(Vector3d.Distance(weight.Move(dq, new Vector3d[dq.Length]), difference),
                    Is.LessThan(1e-7), "by the splines, " + s);
            }
        }

        /// <summary>Forces on nodes and splines are the differences of the energy, and those on the vessel are
        /// opposite to those on the wire.</summary>
        [Test]
        public void Gradient_IsTheDifferenceOfTheEnergy_AndActionIsReaction(
            [ValueSource(typeof(TestShapes), nameof(TestShapes.Names))] string name)
        {
            int tried = 0;
            for (int seed = 0; seed < 9000 && tried < 6; seed++)
            {
                ContactShape wall = TestShapes.Make(name);
                wall.Motion = new WallMotion(Array.Empty<MotionCycle>(), Array.Empty<Vector3d[]>(), 1.0, 0.0)
                {
                    Beam = new WallBeam(Enumerable.Range(0, 25).Select(k => new Vector3d(0.0, 0.2 * Math.Sin(0.25 * k),
                        0.2 * (k - 12))).ToArray(), 1.0, 10.0, 3.0, 1.0, 1.0, (false, false)),
                };
                MaterialRod rod = MaterialRod.Round(6, 1.2, 0.3, 1e6, 1e6, 1e3);
                var energy = new BarrierEnergy(rod, new[] { wall }, 1.0, new Barrier(0.1, 10.0));
                var random = new RandomGeometry(seed);
                var shape = new RodShape(6);
                shape.FitVessel(wall.Motion.Beam.Count);
                Displacements(wall.Motion.Beam, new System.Random(seed), 0.1).CopyTo(shape.Vessel, 0);
                Vector3d x = random.Point();
                Vector3d step = 0.2 * random.Direction();
                for (int i = 0; i <= 6; i++, x += step + 0.05 * random.Point())
                {
                    shape.X[i] = x;
                }
                double value = energy.Value(shape);
                if (!(value > 0.0) || !(value < 1e3))
                {
                    continue;
                }
                tried++;
                var gradient = new RodVector[8 + shape.Vessel.Length];
                var measured = default(GradientMeasures);
                energy.AddGradient(shape, gradient, 0, 7, ref measured);
                Vector3d sum = Vector3d.Zero;
                for (int i = 0; i < gradient.Length; i++)
                {
                    Vector3d[] of = i < 8 ? shape.X : shape.Vessel;
                    int at = i < 8 ? i : i - 8;
                    sum += gradient[i].X;
                    foreach (Vector3d along in new[] { Vector3d.UnitX, Vector3d.UnitY, Vector3d.UnitZ })
                    {
                        if (i == 7)
                        {
                            continue;
                        }
                        Vector3d was = of[at];
                        of[at] = was + 1e-7 * along;
                        double above = energy.Value(shape);
                        of[at] = was - 1e-7 * along;
                        double below = energy.Value(shape);
                        of[at] = was;
                        Assert.That(Vector3d.Dot(gradient[i].X, along), Is.EqualTo((above - below) / 2e-7)
                            .Within(1e-4 * measured.LargestForce), name + ", seed " + seed + ", " + i);
                    }
                }
                Assert.That(sum.Length, Is.LessThan(1e-13 * gradient.Sum(one => one.X.Length)));
            }
            Assert.That(tried, Is.GreaterThanOrEqualTo(2));
        }

        /// <summary>A wire that is bent at rest, in a straight vessel that it may leave by a clearance: small slopes by
        /// Hermite elements, of a vessel with 120 of them, between barriers at the nodes.</summary>
        [TestCase(null, 1.936, 0.0)]
        [TestCase(5e2, 0.78922, 13.7903)]
        [TestCase(2e3, 1.33660, 7.8349)]
        [TestCase(2e4, 1.83238, 1.8160)]
        public void Clearance_LeavesThrustAndDisplacement(double? foundation, double thrust, double displacement)
        {
            const double scale = 0.01;    // of the slopes, which are small then
            SimulationParameters parameters = Bent(120, 30.0 * scale, 4.0 * scale, foundation, 2e-4 * scale);
            Simulation simulation = Simulation.Create(parameters);
            simulation.Step();
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Running), simulation.Reason);
            Assert.That(simulation.Contacts!.Forces.Sum(force => force.Length) / scale,
                Is.EqualTo(thrust).Within(1e-2 * thrust));
            Assert.That(Largest(simulation) / scale, Is.EqualTo(displacement).Within(1e-2 * displacement));
        }

        /// <summary>A wire that fills its vessel, as two beams that are tied to one another with free ends: the fourth
        /// derivative of y times (EI_v + EI_w), plus k y, is EI_w times that of the wire at rest. Of the sine is left
        /// (EI_v k^4 + k_f)/((EI_v + EI_w) k^4 + k_f) far from the ends.</summary>
        [Test]
        public void TiedBeams_AreThoseOfTheirEquation([Values(5e2, 2e3, 2e4)] double foundation)
        {
            const double amplitude = 0.3;    // mm
            SimulationParameters parameters = Bent(240, amplitude, 5e-5, foundation, 4e-8);
            parameters.Contact.ContactStiffness = 1e7;
            Simulation simulation = Simulation.Create(parameters);
            simulation.Step();
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Running), simulation.Reason);
            // y = F sin + A e1(x) + B e2(x) - A e1(L - x) - B e2(L - x), e1 + i e2 = exp((i - 1) b x).
            double wave = 2.0 * Math.PI / Length;
            double both = OfWire + OfVessel;
            double part = amplitude * OfWire * Math.Pow(wave, 4.0) / (both * Math.Pow(wave, 4.0) + foundation);
            Complex rate = new Complex(-1.0, 1.0) * Math.Pow(foundation / (4.0 * both), 0.25);
            Complex At(int order, double x) => Complex.Pow(rate, order) * Complex.Exp(rate * x);
            Complex second = At(2, 0.0) - At(2, Length);
            Complex third = At(3, 0.0) + At(3, Length);
            double right = -OfWire / both * amplitude * Math.Pow(wave, 3.0) + part * Math.Pow(wave, 3.0);
            double determinant = second.Real * third.Imaginary - second.Imaginary * third.Real;
            double a = -second.Imaginary * right / determinant;
            double b = second.Real * right / determinant;
            WallField field = simulation.FieldOf(0)!;
            double most = 0.0;
            double error = 0.0;
            for (double x = 0.0; x < Length; x += 1e-3)
            {
                Complex ends = At(0, x) - At(0, Length - x);
                double expected = part * Math.Sin(wave * x) + a * ends.Real + b * ends.Imaginary;
                double y = field.Moved(new Vector3d(0.0, 0.0, 1e3 * x)).Y;
                error = Math.Max(error, Math.Abs(Math.Abs(y) - Math.Abs(expected)));
                most = Math.Max(most, Math.Abs(expected));
            }
            Assert.That(error, Is.LessThan(1e-3 * most));
        }

        /// <summary>A soft wire in an S of two arcs, R = 40 mm: normal and tangential displacements (um) of a curved
        /// beam with 96 splines each, under the forces of a wire that is tied to it and slides along it,
        /// EI (K'' + K^3/2) for a curvature K at rest.</summary>
        [TestCase(2e3, 145.30, 103.18)]
        [TestCase(1e4, 62.43, 21.89)]
        [Category("Long")]
        public void CurvedVessel_GivesWayAlongAndAcrossItself(double foundation, double across, double along)
        {
            const double clearance = 2e-4;    // mm
            Vector3d[] curve = ArcsOf(40.0, 50.0, 10.0);
            int n = curve.Length - 1;
            SimulationParameters parameters = Bent(n, 0.0, clearance, null, 1e-7);
            parameters.Scene.Walls = new ContactShape[] { new TubeShape(curve,
                Array.ConvertAll(curve, _ => 1e3 * Radius + clearance), true, true) };
            parameters.Scene.Walls[0].Motion = Beam(curve, OfVessel, 28.0, foundation);
            parameters.Material.YoungsModulus = 0.01 * 4.0 * OfWire / (Math.PI * Math.Pow(Radius, 4.0));
            parameters.Scene.GuidewireLength = n * Vector3d.Distance(curve[0], curve[1]);
            parameters.Contact.ContactStiffness = 1e5;
            parameters.Material.Sections = Array.Empty<WireSection>();
            parameters.Scene.Start = new RodStart(curve, RodStart.AlongChords(curve), null, null);
            Simulation simulation = Simulation.Create(parameters);
            simulation.Step();
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Running), simulation.Reason);
            WallField field = simulation.FieldOf(0)!;
            double w = 0.0;
            double u = 0.0;
            for (int i = 1; i < n; i++)
            {
                Vector3d tangent = Vector3d.Normalize(curve[i + 1] - curve[i - 1]);
                Vector3d moved = 1e3 * (field.Moved(curve[i]) - curve[i]);
                double own = Vector3d.Dot(moved, tangent);
                (u, w) = (Math.Max(u, Math.Abs(own)), Math.Max(w, (moved - own * tangent).Length));
            }
            Assert.That(w, Is.EqualTo(across).Within(2e-2 * across));
            Assert.That(u, Is.EqualTo(along).Within(2e-2 * along));
        }

        // Units: straight, an arc of a quarter one way and one the other way, straight, with curvatures that change
        // over a ramp.
        private static Vector3d[] ArcsOf(double radius, double straight, double ramp)
        {
            const double step = 0.25;
            double arc = 0.5 * Math.PI * radius;
            double Up(double s, double at)
            {
                double t = Math.Min(1.0, Math.Max(0.0, (s - at) / ramp + 0.5));
                return t - Math.Sin(2.0 * Math.PI * t) / (2.0 * Math.PI);
            }
            var points = new List<Vector3d> { Vector3d.Zero };
            double angle = 0.0;
            int count = (int)Math.Round((2.0 * arc + 2.0 * straight) / step);
            double size = (2.0 * arc + 2.0 * straight) / count;
            for (int k = 0; k < count; k++)
            {
                double s = (k + 0.5) * size;
                double turn = size / radius * (Up(s, straight) - 2.0 * Up(s, straight + arc)
                    + Up(s, straight + 2.0 * arc));
                angle += 0.5 * turn;
                points.Add(points[k] + size * new Vector3d(0.0, Math.Sin(angle), Math.Cos(angle)));
                angle += 0.5 * turn;
            }
            return points.ToArray();
        }

        [Test]
        public void Restored_ItGoesOnWithTheSameBits([Values] bool moves)
        {
            SimulationParameters parameters = Pushed(2e3, 0.1, moves);
            Simulation simulation = Simulation.Create(parameters);
            Go(simulation, 37);
            Assert.That(Largest(simulation), Is.GreaterThan(0.05), "mm");
            Simulation restored = Simulation.Restore(parameters, simulation.Save());
            Simulation continued = simulation.Continue(parameters);
            Assert.That(Largest(restored), Is.EqualTo(Largest(simulation)));
            Go(simulation, 13);
            Go(restored, 13);
            Go(continued, 13);
            Assert.That(restored.State.Positions, Is.EqualTo(simulation.State.Positions));
            Assert.That(continued.State.Positions, Is.EqualTo(simulation.State.Positions));
            Assert.That(restored.Save(), Is.EqualTo(simulation.Save()));
        }

        /// <summary>With as many splines the vessel goes on from where it is; with others it would be at rest, where it
        /// may cut the wire.</summary>
        [Test]
        public void ContinuedWithAnotherFoundation_ItGoesOnOrSaysWhyNot()
        {
            Simulation simulation = Simulation.Create(Pushed(2e3, 0.1, false));
            Go(simulation, 60);
            Simulation continued = simulation.Continue(Pushed(2.1e3, 0.1, false));
            Go(continued, 1);
            Assert.That(() => simulation.Continue(Pushed(1e4, 0.1, false)), Throws.ArgumentException.With.Message
                .Match("splines cannot become \\d+ during a run: give it their spacing, 0.0\\d+ m"));
            SimulationParameters rigid = Pushed(2e3, 0.1, false);
            rigid.Scene.Walls[0].Motion = null;
            Assert.That(() => simulation.Continue(rigid),
                Throws.ArgumentException.With.Message.Contains("cannot be added or removed"));
        }

        /// <summary>The stiffer its foundation, the nearer it is to a rigid vessel: with its first power under forces
        /// that are distributed, with its power 3/4 under one that acts at a point.</summary>
        [Test]
        public void StiffVessel_TendsToARigidOne()
        {
            var thrusts = new List<double>();
            foreach (double? foundation in new double?[] { null, 1e5, 1e6, 1e7 })
            {
                SimulationParameters parameters = Bent(120, 0.3, 0.04, foundation, 2e-6, 0.01);
                Simulation simulation = Simulation.Create(parameters);
                Go(simulation, 1);
                thrusts.Add(simulation.Contacts!.Forces.Sum(force => force.Length));
            }
            double[] misses = thrusts.Skip(1).Select(thrust => 1.0 - thrust / thrusts[0]).ToArray();
            for (int k = 0; k < 2; k++)
            {
                Assert.That(Math.Log10(misses[k] / misses[k + 1]), Is.InRange(0.75, 1.0), misses[k].ToString("G3"));
            }
        }

        /// <summary>What the hub puts in is in the wire, in the vessel and in its contacts.</summary>
        [Test]
        public void PushedSlowly_TheAccountCloses()
        {
            SimulationParameters parameters = Pushed(2e3, 0.0, false);
            parameters.Drive.DisplacementPerStep *= 0.1;
            parameters.Method.TimeStep *= 0.5;
            parameters.Material.MassDamping = 0.0;
            Simulation simulation = Simulation.Create(parameters);
            simulation.Step();
            double start = Energy(simulation);
            double work = simulation.Hub()!.Work;
            Go(simulation, 350);
            double put = simulation.Hub()!.Work - work;
            Assert.That(put, Is.GreaterThan(1e-5), "J");
            Assert.That(Energy(simulation) - start, Is.EqualTo(put).Within(2e-2 * put), Largest(simulation) + " mm");
        }

        [Test]
        public void Iterations_AreLittleMoreThanOfARigidVessel()
        {
            Simulation rigid = Simulation.Create(Pushed(null, 0.1, false));
            Simulation giving = Simulation.Create(Pushed(2e3, 0.1, false));
            Go(rigid, 80);
            Go(giving, 80);
            Assert.That(giving.Report()!.WallIterations, Is.LessThan(1.3 * rigid.Report()!.WallIterations),
                "of " + rigid.Report()!.WallIterations + ", " + Largest(giving) + " mm");
        }

        // Into an arch of 30 mm radius, out of a sheath.
        private static SimulationParameters Pushed(double? foundation, double friction, bool moves)
        {
            SimulationParameters parameters = WallScenes.Arch(60, 0.05, 20.0, 400.0);
            parameters.Scene.Walls = new ContactShape[] { WallScenes.ArchTube(40) };
            parameters.Scene.Walls[0].FrictionCoefficient = friction;
            if (foundation.HasValue)
            {
                Vector3d[] arch = Enumerable.Range(-20, 101).Select(k => k < 0 ? new Vector3d(0.0, 0.0, 3.0 * k)
                    : k > 60 ? new Vector3d(0.0, 60.0, -3.0 * (k - 60))
                    : 30.0 * new Vector3d(0.0, 1.0 - Math.Cos(Math.PI * k / 60.0), Math.Sin(Math.PI * k / 60.0)))
                    .ToArray();
                WallMotion motion = Beam(arch, OfVessel, 28.0, foundation.Value, true);
                parameters.Scene.Walls[0].Motion = !moves ? motion : new WallMotion(new[] { MotionCycle.Sine(1.0, 0.0,
                    new Vector3d(0.5, 0.2, 0.0), new Vector3d(0.0, 0.0, 0.05), Vector3d.Zero) },
                    Array.Empty<Vector3d[]>(), 1.0, 0.2) { Beam = motion.Beam };
            }
            return parameters;
        }

        private static double Energy(Simulation simulation)
        {
            Vector3d energies = simulation.Energies()!.Value;
            return energies.X + energies.Y + energies.Z;
        }

        private static void Go(Simulation simulation, int steps)
        {
            for (int k = 0; k < steps; k++)
            {
                simulation.Step();
            }
            Assert.That(simulation.Outcome, Is.EqualTo(Outcome.Running), simulation.Reason);
        }

        private static double Largest(Simulation simulation)
        {
            Vector3d[] centreline = simulation.FieldOf(0)?.Centreline() ?? Array.Empty<Vector3d>();
            return centreline.Where((_, k) => k % 2 == 1).Select(one => one.Length).Append(0.0).Max();
        }

        // A wire whose shape at rest is a sine of this amplitude, mm, with free ends in a straight vessel.
        private static SimulationParameters Bent(int n, double amplitude, double clearance, double? foundation,
            double distance, double ofVessel = OfVessel)
        {
            SimulationParameters parameters = WallScenes.Wire(n, Radius);
            double wave = 2.0 * Math.PI / Length;
            parameters.Scene.GuidewireLength = 1e3 * Length;
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.ProximalEnd = ProximalEnd.Free;
            parameters.Scene.Gravity = Vector3d.Zero;
            parameters.Scene.Walls = WallScenes.Tube(-50.0, 350.0, 1e3 * Radius + clearance);
            parameters.Scene.Walls[0].FrictionCoefficient = 0.3;    // keeps it from sliding out of the vessel
            parameters.Material.YoungsModulus = 4.0 * OfWire / (Math.PI * Math.Pow(Radius, 4.0));
            parameters.Material.ShearModulus = 1e3 * parameters.Material.YoungsModulus;    // stays in its plane
            parameters.Material.Sections = Enumerable.Range(0, n).Select(j => new WireSection
            {
                From = 1e3 * Length * j / n, To = 1e3 * Length * (j + 1) / n, NumberRodElements = 1,
                RestCurvature = new Vector3d(1e-3 * amplitude * wave * wave
                    * Math.Sin(wave * Length * (j + 0.5) / n), 0.0, 0.0),
            }).ToArray();
            parameters.Material.MassDamping = 1.0;
            parameters.Drive.Kind = Drive.Hold;
            parameters.Drive.Displacement = 0.0;
            parameters.Contact.ContactDistance = distance;
            parameters.Contact.ContactStiffness = 400.0;
            parameters.Method.TimeStep = 10.0;
            parameters.Method.MaxSimulationSteps = 1000;
            parameters.Method.SolverTolerance = 1e-8;
            if (foundation.HasValue)
            {
                parameters.Scene.Walls[0].Motion = Beam(new[] { Vector3d.Zero, new Vector3d(0.0, 0.0, 1e3 * Length) },
                    ofVessel, 28.0, foundation.Value);
            }
            return parameters;
        }

        private static WallMotion Beam(IReadOnlyList<Vector3d> centreline, double bending, double stretching,
            double foundation, bool isHeld = false)
        {
            return new WallMotion(Array.Empty<MotionCycle>(), Array.Empty<Vector3d[]>(), 1.0, 0.0)
            {
                Beam = new WallBeam(centreline, bending, stretching, foundation,
                    450.0 * Math.Pow(4.0 * bending / foundation, 0.25), 1e-3, (isHeld, isHeld)),
            };
        }

        // A centreline in space, with or without a cycle beside the beam.
        private static WallMotion Waved(double spacing, bool moves)
        {
            Vector3d[] points = Enumerable.Range(0, 501).Select(k => Curve(spacing * k)).ToArray();
            return new WallMotion(moves ? new[] { MotionCycle.Sine(1.0, 0.1, new Vector3d(0.2, 0.1, -0.3),
                new Vector3d(0.3, 0.1, 0.4), new Vector3d(0.5, 0.0, 1.0)) } : Array.Empty<MotionCycle>(),
                Array.Empty<Vector3d[]>(), 1.0, 0.0)
            {
                Beam = new WallBeam(points, 1.0, 100.0, 1.0, 1.2, 1.0, (false, false)),
            };
        }

        private static Vector3d Curve(double s) =>
            new Vector3d(1.5 * Math.Sin(0.5 * s), 1.5 * Math.Cos(0.5 * s), 0.6 * s);

        private static Vector3d[] Displacements(WallBeam beam, System.Random random, double size) =>
            Enumerable.Range(0, beam.Count).Select(_ => size * Point(random)).ToArray();

        private static Vector3d Point(System.Random random) => new Vector3d(2.0 * random.NextDouble() - 1.0,
            2.0 * random.NextDouble() - 1.0, 2.0 * random.NextDouble() - 1.0);
    }
}
