using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Spin of an instrument inside another one: torsional waves, and what damps them.</summary>
    public sealed class InnerSpinTests
    {
        private const int Elements = 8;
        private const double Inertia = 2e-9;   // I of the pair's instruments, kg m

        // A straight instrument, held at its hub, in one that does not yield: elements of l are turned by sin(pi s/2L)
        // at their middles, the first on a spring of half an element; this is a mode of that chain, of omega^2 =
        // 4 GJ/(I l^2) sin^2(pi l/4L). With a drag c and a damping a of I it goes as exp(-g t) (cos w t + g/w sin w t),
        // g = (c/I + a)/2, w^2 = omega^2 - g^2.
        [TestCase(Integrator.ImplicitEuler, 1)]
        [TestCase(Integrator.Bdf2, 2)]
        [TestCase(Integrator.Trbdf2, 2)]
        [TestCase(Integrator.Esdirk3, 3)]
        [TestCase(Integrator.Esdirk4, 4)]
        public void InnerInstrument_SwingsAsATorsionalWave(Integrator integrator, int order)
        {
            foreach ((double drag, double damping) in new[] { (0.0, 0.0), (4e-6, 0.0), (0.0, 3e3) })
            {
                double[] error = { Error(integrator, 100, drag, damping), Error(integrator, 200, drag, damping) };
                TestContext.WriteLine("{0}, drag {1}, damping {2}: {3:G3} {4:G3}", integrator, drag, damping, error[0],
                    error[1]);
                Assert.That(error[1], Is.LessThan(order == 1 ? 0.02 : 2e-3));
                // What the drag of an instrument that yields a little adds is 1e-8.
                Assert.That(error[1], Is.LessThan(error[0] / Math.Pow(2.0, order - 0.2) + 1e-8), "order");
            }
        }

        // Of the tip's angle after 0.3 of a period in so many steps a period, over its start.
        private static double Error(Integrator integrator, int steps, double drag, double damping)
        {
            const double start = 0.3;
            const double nu = 0.3;
            const double l = 1.0 / Elements;
            var pair = new CoaxialPair(new[] { new CoaxialPair.Piece(1.0, 1e7, 0.0) }, Elements,
                new[] { new CoaxialPair.Piece(1.0, 1.0, 0.0) }, Elements, nu, 0.0);
            pair.Coaxial.Rod.MassDamping = damping;
            Array.Fill(pair.Coaxial.LumenDrag, drag * l);
            for (int j = 0; j < Elements; j++)
            {
                pair.Shape.Twist[j] = start * Math.Sin(0.5 * Math.PI * (j + 0.5) * l);
            }
            double tip = pair.Shape.Twist[Elements - 1];
            double omega = 2.0 / l * Math.Sqrt(1.0 / (1.0 + nu) / Inertia) * Math.Sin(0.25 * Math.PI * l);
            double g = 0.5 * (drag / Inertia + damping);
            double w = Math.Sqrt(omega * omega - g * g);
            double dt = 2.0 * Math.PI / omega / steps;
            var motion = new RodDynamics(pair.Terms, Rods.Schedule(), pair.Shape, DirectSetup.Scheme(integrator), 1e-11,
                50);
            motion.Begin(new Vector3d[Elements + 1], new Vector3d[Elements], false);
            int count = 3 * steps / 10;
            Rods.Step(motion, dt, count);
            double t = count * dt;
            double expected = tip * Math.Exp(-g * t) * (Math.Cos(w * t) + g / w * Math.Sin(w * t));
            return Math.Abs(motion.Shape.Twist[Elements - 1] - expected) / tip;
        }
    }
}
