using System;
using System.Collections.Generic;
using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Loops and knots in a wire under constant tension T that touch themselves, against closed forms and an
    /// independent solution with forces between pairs of nodes. Lengths are in x = sqrt(B/T), forces in T, couples in
    /// sqrt(BT).</summary>
    public sealed class HeldLoopTests
    {
        private const double Scale = 0.01;     // x, m
        private const double Tension = 1.0;    // N

        /// <summary>A planar loop of the elastica whose ends are turned against each other by an angle, of which the
        /// loop takes 2 pi. With the couple GJ/L (angle - psi) below 1.81 a T nothing holds it, and it opens. At 4 pi
        /// the contact holds it, at M = 0.3285.</summary>
        [Category("Row")]
        [TestCase(2.0, false)]
        [TestCase(2.6, false)]
        [TestCase(4.0, true)]
        public void PlanarLoop_OpensWhereItsEndsTurnFreely_AndStaysWhereTheyAreHeld(double turns, bool stays)
        {
            Simulation run = Relax(Loop(160, 0.1, turns * Math.PI), out double force);
            double shortening = Shortening(run);
            double couple = run.Hub()!.Torque / (Tension * Scale);
            if (!stays)
            {
                Assert.That(shortening, Is.LessThan(0.05));
                Assert.That(force, Is.Zero);
                Assert.That(couple, Is.EqualTo(0.05 * turns * Math.PI).Within(1e-6), "it is straight and twisted");
                return;
            }
            Row.Holds("shortening of a loop that contact holds, in sqrt(B/T)", shortening, 4.011, 0.04);
            Row.Holds("couple of that loop, in sqrt(BT)", couple, 0.3285, 0.0033);
            Assert.That(force, Is.Positive);
        }

        /// <summary>Of as many elements of one length, an even or an odd number, the loop's strands cross where two
        /// elements meet or in the middle of one.</summary>
        [Test]
        [Category("Row")]
        public void CrossingAtANodeAndInTheMiddle_HaveTheSameForce()
        {
            Relax(Loop(160, 0.1, 4.0 * Math.PI), out double even);
            Relax(Loop(161, 0.1, 4.0 * Math.PI), out double odd);
            Row.Holds("force of a crossing in the middle of an element over that at a node", odd / even, 1.0, 0.01);
        }

        /// <summary>A trefoil that tension pulls tight round itself: with R = e/(2 pi), e the shortening, eps =
        /// sqrt(a/R) and a half the distance of the strands, F R^2/B = (1 + 0.52 eps + 5.2 eps^2)/2.</summary>
        [Test]
        [Category("Row")]
        [Category("Long")]
        public void Trefoil_HasTheForceOfItsSize()
        {
            Simulation run = Relax(Knot(240, 0.06), out _);
            double radius = Shortening(run) / (2.0 * Math.PI);
            double eps = Math.Sqrt(MeanRadius(run, 0.06) / radius);
            double force = radius * radius;
            double reference = 0.5 * (1.0 + 0.52 * eps + 5.2 * eps * eps);
            Row.Holds("F R²/B of a trefoil", force, reference, 0.03 * reference);
        }

        // Until it is at rest; the force between strands, as the sum over what lies before the middle.
        private static Simulation Relax(SimulationParameters parameters, out double force)
        {
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Converged).Or.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(run.Passages, Is.Zero);
            Vector3d sum = Vector3d.Zero;
            Vector3d[] forces = run.Contacts!.StrandForces;
            for (int i = 0; i < forces.Length / 2; i++)
            {
                sum += forces[i];
            }
            force = sum.Length / Tension;
            TestContext.WriteLine("{0} after {1} steps: shortening {2:G6}, force {3:G6}, couple {4:G6}", run.Outcome,
                run.StepCount, Shortening(run), force, run.Hub()!.Torque / (Tension * Scale));
            return run;
        }

        // Of the distance of the ends, less what the tension stretches.
        private static double Shortening(Simulation run)
        {
            Vector3d[] x = run.State.Positions;
            int n = x.Length - 1;
            double length = Enumerable.Range(0, n).Sum(j => Vector3d.Distance(x[j], x[j + 1]));
            return 1e-3 * (length - Vector3d.Distance(x[0], x[n])) / Scale;
        }

        /// <summary>Half the mean distance of all elements from the nearest other strand, where they touch, in x.
        /// </summary>
        public static double MeanRadius(Simulation run, double radius)
        {
            Vector3d[] x = run.State.Positions;
            int n = x.Length - 1;
            var distances = new List<double>();
            double unit = 1e3 * Scale;
            double arc = 1.15 * Math.PI * radius * unit;
            double length = Vector3d.Distance(x[0], x[1]);
            for (int i = 0; i < n; i++)
            {
                double least = double.PositiveInfinity;
                for (int j = 0; j < n; j++)
                {
                    if ((Math.Abs(i - j) - 1) * length > arc)
                    {
                        least = Math.Min(least, Math.Sqrt(ClosestPoints.SegmentSegment(x[i], x[i + 1], x[j], x[j + 1],
                            out _, out _)));
                    }
                }
                if (least < 2.2 * radius * unit)
                {
                    distances.Add(least / unit);
                }
            }
            return 0.5 * distances.Average();
        }

        // At s along the loop, x = -2 sech s and z = s - 2 tanh s; strands pass each other beside the plane.
        private static SimulationParameters Loop(int n, double radius, double turn)
        {
            double length = 0.15 * n;
            var x = new Vector3d[n + 1];
            for (int i = 0; i <= n; i++)
            {
                double s = (i - 0.5 * n) * length / n;
                x[i] = new Vector3d(-2.0 / Math.Cosh(s), 1.3 * radius * s * Math.Exp(-s * s / 4.8),
                    s - 2.0 * Math.Tanh(s));
            }
            return Of(x, length, radius, turn, 0.05 * length);
        }

        // The knot of the polynomials t^3 - 3 t, t^4 - 4 t^2, t^5 - 10 t, whose ends go on along the last of them.
        private static SimulationParameters Knot(int n, double radius)
        {
            const double last = 2.1;
            const double tail = 7.0;
            static Vector3d At(double t) => new Vector3d(0.5 * t * (t * t - 3.0), 0.4 * t * t * (t * t - 4.0),
                0.15 * t * (t * t * t * t - 10.0));
            var curve = new List<Vector3d>();
            for (double s = -tail; s <= tail + 2.0 * last; s += 0.002)
            {
                double t = Math.Max(-last, Math.Min(last, s - last));
                double beyond = s - last - t;
                double left = Math.Exp(-0.5 * beyond * beyond);
                curve.Add(new Vector3d(left * At(t).X, left * At(t).Y, At(t).Z + beyond));
            }
            var arc = new double[curve.Count];
            for (int k = 1; k < arc.Length; k++)
            {
                arc[k] = arc[k - 1] + Vector3d.Distance(curve[k - 1], curve[k]);
            }
            double length = arc[arc.Length - 1];
            var x = new Vector3d[n + 1];
            for (int i = 0, k = 0; i <= n; i++)
            {
                double s = length * i / n;
                while (k < arc.Length - 2 && arc[k + 1] < s)
                {
                    k++;
                }
                x[i] = Vector3d.Lerp(curve[k], curve[k + 1], (s - arc[k]) / (arc[k + 1] - arc[k]));
            }
            return Of(x, length, radius, 0.0, 1e-4);
        }

        // Nodes in x; the wire's elements are not turned against each other but for an even twist up to an angle, less
        // what the shape takes: of 2 pi and whole turns.
        private static SimulationParameters Of(Vector3d[] nodes, double length, double radius, double turn,
            double torsion)
        {
            int n = nodes.Length - 1;
            double r = radius * Scale;
            double bending = Tension * Scale * Scale;
            double young = bending / (0.25 * Math.PI * Math.Pow(r, 4));
            var positions = Array.ConvertAll(nodes, x => 1e3 * Scale * (x - nodes[0]));
            Quaterniond[] orientations = RodStart.AlongChords(positions);
            double taken = torsion > 1e-3 ? 2.0 * Math.PI : 0.0;
            Vector3d last = orientations[n - 1].Director1;
            double holonomy = Math.Atan2(last.Y, last.X);
            for (int j = 0; j < n; j++)
            {
                double at = (j + 0.5) / n;
                orientations[j] *= Quaterniond.FromAxisAngle(Vector3d.UnitZ,
                    (turn - taken) * (1.0 - at) - holonomy * at);
            }
            return new SimulationParameters
            {
                Method =
                {
                    Solver = Solver.Direct,
                    Integrator = Integrator.ImplicitEuler,
                    TimeStep = 0.02,
                    MaxSimulationSteps = 1500,
                },
                Scene =
                {
                    GuidewireLength = 1e3 * Scale * length,
                    NumberRodElements = n,
                    GuidewireOffset = 0.0,
                    ProximalEnd = ProximalEnd.Clamped,
                    DistalEnd = DistalEnd.Sliding,
                    AxialForce = Tension,
                    Start = new RodStart(positions, orientations, null, null),
                },
                Drive = { Kind = Drive.Hold, Displacement = 0.0 },
                Material =
                {
                    WireRadius = r,
                    YoungsModulus = young,
                    ShearModulus = 0.5 * torsion * young,
                    Density = 0.02 / (Math.PI * r * r),
                    ShearFactor = 0.9 / torsion,    // what twists easily does not shear easily
                    AxialStiffness = 3000.0 * Tension,
                    MassDamping = 30.0,
                },
                Contact = { SelfContact = true },
            };
        }
    }
}
