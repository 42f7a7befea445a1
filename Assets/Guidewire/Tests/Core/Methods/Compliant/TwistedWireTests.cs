using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Twisted wires under xpbd: pulls whose directions are wrong have no potential, and first show where a
    /// twist is about to leave its shape.</summary>
    public sealed class TwistedWireTests
    {
        private const double Margin = 0.03;  // of the critical twist: held below it, left above
        private const double Radius = 3e-3;

        [TestCase(1)]
        [TestCase(4)]
        public void Ring_LeavesItsPlane_AtTheTwistOfMichellAndZajac(int sweeps)
        {
            if (sweeps > 1)
            {
                Rods.OnlyInFull("one iteration a substep has the same limit");
            }
            // Closed, straight when free, EI = GJ: 2 pi sqrt(3) EI/GJ.
            const int N = 20;
            double critical = 2.0 * Math.PI * Math.Sqrt(3.0);
            Assert.That(Ring(N, sweeps, (1.0 - Margin) * critical, 1e-3), Is.LessThan(1e-3));
            Assert.That(Ring(N, sweeps, (1.0 + Margin) * critical, 1e-2), Is.GreaterThan(1e-2));
        }

        [Test]
        public void StraightWire_LeavesItsAxis_AtTheCoupleOfGreenhill()
        {
            Rods.OnlyInFull("rings, whose limit is another closed form");
            // Between clamps: M L/EI = 8.9868, tan(M/2) = M/2. The ends do not come closer, so that beyond it the wire
            // only leans on its own tension: (a/L)^2 EA is of the order of what the couple is above its limit.
            const int N = 24;
            double critical = 8.9868 * Rods.Young / (2.0 * Rods.Shear);
            Assert.That(Straight(N, (1.0 - Margin) * critical, 1e-4), Is.LessThan(1e-4));
            Assert.That(Straight(N, (1.0 + Margin) * critical, 1e-3), Is.GreaterThan(1e-3));
        }

        private static double Ring(int n, int sweeps, double twist, double enough)
        {
            SimulationParameters parameters = Damped(n, sweeps, twist);
            parameters.Material.ShearModulus = 0.5 * Rods.Young;
            parameters.Scene.StartShape = StartShape.Ring;
            RodState ring = Simulation.Create(parameters).State;
            for (int i = 0; i <= n; i++)
            {
                double around = 2.0 * Math.PI * i / n;
                double push = 0.03 * Math.Sin(around) * Math.Sin(around) * Math.Sin(2.0 * around);
                ring.Positions[i] += new Vector3d(push, 0.0, 0.0);
            }
            return Farthest(parameters, ring, FromPlane, enough);
        }

        private static double Straight(int n, double twist, double enough)
        {
            SimulationParameters parameters = Damped(n, 2, twist);
            RodState wire = Simulation.Create(parameters).State;
            for (int i = 1; i < n; i++)
            {
                wire.Positions[i] += new Vector3d(0.003 * Math.Pow(Math.Sin(Math.PI * i / n), 2), 0.0, 0.0);
            }
            return Farthest(parameters, wire, FromAxis, enough);
        }

        // Over the whole run, or until it is farther than enough: a ring that has left its plane passes through itself
        // and comes back with fewer turns.
        private static double Farthest(SimulationParameters parameters, RodState start, Func<RodState, double> away,
            double enough)
        {
            parameters.Scene.Start = new RodStart(start.Positions, start.Orientations, start.Velocities,
                start.AngularVelocities)
            {
                ProximalFrame = Quaterniond.Identity,
                DistalFrame = Quaterniond.Identity,
            };
            Simulation run = Simulation.Create(parameters);
            double farthest = 0.0;
            while (run.Outcome == Outcome.Running && farthest <= enough)
            {
                run.Step();
                farthest = Math.Max(farthest, away(run.State));
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished).Or.EqualTo(Outcome.Running), run.Reason);
            return farthest;
        }

        private static SimulationParameters Damped(int n, int sweeps, double twist)
        {
            double sound = Rods.Length / n / Math.Sqrt(Rods.Young / Rods.Density);
            SimulationParameters parameters = Rods.Clamped(n, Solver.Xpbd, 4e-5, 2000);
            parameters.Method.ConstraintSolverSteps = sweeps;
            parameters.Material.MassDamping = 3e-3 / parameters.Method.TimeStep;
            parameters.Material.WireRadius = Radius;
            parameters.Method.Substeps =
                (int)Math.Ceiling(parameters.Method.TimeStep / (0.35 * Math.Sqrt(sweeps) * sound));
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            parameters.Material.ClampRule = ClampRule.HalfElement;
            parameters.Scene.DistalRotation = twist;
            parameters.Scene.DistalRampTime = 0.02;
            return parameters;
        }

        // Root mean square distance from the plane x = (b, y, z) . (1, y, z) that fits best, over L.
        private static double FromPlane(RodState state)
        {
            double a21 = 0.0, a22 = 0.0, a31 = 0.0, a32 = 0.0, a33 = 0.0;
            Vector3d right = Vector3d.Zero;
            foreach (Vector3d x in state.Positions)
            {
                a21 += x.Y;
                a22 += x.Y * x.Y;
                a31 += x.Z;
                a32 += x.Y * x.Z;
                a33 += x.Z * x.Z;
                right += x.X * new Vector3d(1.0, x.Y, x.Z);
            }
            Vector3d plane = new Symmetric3(state.SphereCount, a21, a22, a31, a32, a33).Solve(right);
            double sum = 0.0;
            foreach (Vector3d x in state.Positions)
            {
                double away = x.X - Vector3d.Dot(plane, new Vector3d(1.0, x.Y, x.Z));
                sum += away * away;
            }
            return Math.Sqrt(sum / state.SphereCount) / (1e3 * Rods.Length);
        }

        private static double FromAxis(RodState state)
        {
            double largest = 0.0;
            foreach (Vector3d x in state.Positions)
            {
                largest = Math.Max(largest, Math.Sqrt(x.X * x.X + x.Y * x.Y));
            }
            return largest / (1e3 * Rods.Length);
        }
    }
}
