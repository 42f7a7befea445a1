using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What happens as an instrument slides in another: the force at its hub, its tip, nodes that come in
    /// beyond the outer tip, and the two limits of the outer one's stiffness.</summary>
    public sealed class CoaxialSlidingTests
    {
        private const double Reached = 0.02;  // of an element beyond the tip, at which a node comes in

        [Test]
        [Category("Row")]
        public void StraightWire_IsDrivenOutOfABentCatheter_ByTheReducedStiffness()
        {
            // 1/2 kappa^2 B_c B_w/(B_c + B_w), wherever its tip is.
            foreach (double ratio in new[] { 0.2, 1.0, 5.0 })
            {
                double expected = 0.5 * 1.3 * 1.3 * ratio / (1.0 + ratio);
                double least = double.PositiveInfinity;
                double most = 0.0;
                for (int k = 0; k < 23; k++)
                {
                    double lead = 0.2 + 0.0271 * k;
                    var pair = new CoaxialPair(new[] { new CoaxialPair.Piece(1.0, 1.0, 1.3) }, 10,
                        new[] { new CoaxialPair.Piece(1.1, ratio, 0.0) }, 11, 0.3, lead);
                    pair.Solve(0.0);
                    least = Math.Min(least, pair.Force);
                    most = Math.Max(most, pair.Force);
                }
                foreach (double force in new[] { least, most })
                {
                    Row.Holds("straight wire in a bent catheter, B2/B1 = " + ratio + ", 23 places of its tip: force "
                        + "that drives it out, of kappa² B1 B2/(2 (B1 + B2))", force / expected, 1.0, 1e-4);
                }
            }
        }

        [Test]
        public void HubForceAndTorque_AreTheDifferencesOfTheEnergy()
        {
            // Of the minimum over all shapes, loads among it, by centred differences of two rest shapes.
            foreach (double extension in new[] { -0.23, 0.17 })
            {
                const double d = 1e-4;
                double force = (JTip(10, extension + d).Energy - JTip(10, extension - d).Energy) / (2.0 * d);
                double torque = (JTip(10, extension, 1.2 + d).Energy - JTip(10, extension, 1.2 - d).Energy)
                    / (2.0 * d);
                Case now = JTip(10, extension);
                Assert.That(now.Force, Is.EqualTo(force).Within(1e-6 + 1e-6 * Math.Abs(force)));
                Assert.That(now.Torque, Is.EqualTo(torque).Within(1e-6 + 1e-6 * Math.Abs(torque)));
            }
        }

        [Test]
        [Category("Row")]
        public void BentTip_ThroughABentCatheter_IsWhereAFinerModelHasIt()
        {
            var extensions = new double[14];
            for (int k = 0; k < extensions.Length; k++)
            {
                extensions[k] = -0.30 + 0.0487 * k;   // not where both tips meet, for there the force jumps
            }
            Case[] fine = Array.ConvertAll(extensions, p => JTip(80, p));
            double range = 0.0;
            foreach (Case a in fine)
            {
                foreach (Case b in fine)
                {
                    range = Math.Max(range, Math.Abs(a.Force - b.Force));
                }
            }
            foreach (int n in new[] { 10, 20 })
            {
                double tip = 0.0;
                double force = 0.0;
                for (int k = 0; k < extensions.Length; k++)
                {
                    Case found = JTip(n, extensions[k]);
                    tip = Math.Max(tip, (found.Tip - fine[k].Tip).Length);
                    force = Math.Max(force, Math.Abs(found.Force - fine[k].Force) / range);
                }
                string what = "hook through a bent catheter, n = " + n + " against 80: ";
                Row.Holds(what + "tip, L", tip, 0.0, n == 10 ? 4e-3 : 1e-3);
                Row.Holds(what + "force of the hub, of its range", force, 0.0, n == 10 ? 6e-3 : 1.5e-3);
            }
        }

        [Test]
        [Category("Row")]
        public void NodeThatComesIn_LeavesForceAndTip()
        {
            double[] jumps = { LargestJump(10), LargestJump(20) };
            foreach (double jump in jumps)
            {
                Row.Holds("hook through a bent catheter, a wire node comes in: jump of the hub's force, of the largest",
                    jump, 0.0, 5e-3);
            }
            Assert.That(jumps[0], Is.GreaterThan(3.0 * jumps[1]), "second order");
        }

        // Of the force as a node comes in, over the largest of those forces.
        private static double LargestJump(int n)
        {
            double l = 1.0 / n;
            double largest = 0.0;
            double jump = 0.0;
            for (int beyond = 1; beyond < 0.5 * n; beyond++)
            {
                double extension = beyond * l + Reached * l;
                Case before = JTip(n, extension, 1.2, beyond);
                Case after = JTip(n, extension, 1.2, beyond + 1);
                largest = Math.Max(largest, Math.Abs(before.Force));
                jump = Math.Max(jump, Math.Abs(after.Force - before.Force));
                Assert.That((after.Tip - before.Tip).Length, Is.LessThan(1e-3), "of L");
                TestContext.WriteLine("n = {0}, {1} nodes: force {2:G4}, jump {3:G3}", n, beyond, before.Force,
                    after.Force - before.Force);
            }
            return jump / largest;
        }

        [Test]
        [Category("Row")]
        public void StiffStraightCatheter_IsAGuide()
        {
            // A wire bent by a load beyond a straight guide is driven out by M^2/2B, M the moment at the exit.
            double[] error = { GuideError(10), GuideError(20), GuideError(40) };
            for (int k = 1; k < 3; k++)
            {
                Row.Holds("wire out of a straight guide, elements of L/" + (10 << k) + ": force that drives it back, "
                    + "of M²/2B", 1.0 + error[k], 1.0, 1e-2);
            }
            Assert.That(Math.Log(error[0] / error[1], 2.0), Is.GreaterThan(1.9));
        }

        // Without torsion: of a wire that twists in one that does not the joints' mean angles differ by the square of
        // what it twists from joint to joint.
        [TestCase(0.0, 0.0)]
        [TestCase(2.0, 0.8)]
        [Category("Row")]
        public void CatheterOfNoStiffness_LeavesTheWireAlone(double curvature, double wireCurvature)
        {
            // In the plane of the curvature, where it is bent: it would turn out of it too.
            var force = new Vector3d(curvature == 0.0 ? 0.1 : 0.0, -0.2, 0.05);
            var pair = new CoaxialPair(new[] { new CoaxialPair.Piece(0.6, 1e-9, curvature) }, 6,
                new[] { new CoaxialPair.Piece(1.03, 1.0, wireCurvature) }, 10, 0.3, 0.0, 4) { TipForce = force };
            pair.Solve(0.0);
            var rod = new MaterialRod(10);
            for (int j = 0; j < 10; j++)
            {
                rod.CopyElement(j, pair.Coaxial.Rod, 9);
                rod.Length[j] = pair.Coaxial.Rod.Length[j];
            }
            RodShape alone = Rods.AtRest(rod, new RodSupports { Clamp = ClampRule.HalfElement }, Vector3d.Zero, force,
                Vector3d.Zero);
            Row.Holds("wire of curvature " + wireCurvature + "/L in a catheter of 1e-9 of its stiffness: off the wire "
                + "alone, L", Wires.Distance(alone.X, pair.Shape.X), 0.0, 1e-6);
        }

        // Relative to M^2/2B.
        private static double GuideError(int n)
        {
            var force = new Vector3d(0.6, 0.0, 0.0);
            const double extension = 0.5;   // the element at the exit is as long as any: the largest error
            int beyond = n / 2;
            var pair = new CoaxialPair(new[] { new CoaxialPair.Piece(1.0, 1e7, 0.0) }, n,
                new[] { new CoaxialPair.Piece(2.0, 1.0, 0.0) }, 2 * n, 0.3, 1.0 - extension, beyond)
            {
                TipForce = force,
            };
            pair.Solve(0.0);
            RodShape shape = pair.Shape;
            double moment = Vector3d.Cross(shape.X[shape.ElementCount] - shape.X[n], force).Length;
            return pair.Force / (-0.5 * moment * moment) - 1.0;
        }

        private readonly struct Case
        {
            public readonly double Force;
            public readonly double Torque;
            public readonly double Energy;
            public readonly Vector3d Tip;

            public Case(CoaxialPair pair)
            {
                Force = pair.Force;
                Torque = pair.Torque;
                Energy = pair.Terms.Potential(pair.Shape);
                Tip = pair.Shape.X[pair.Shape.ElementCount];
            }
        }

        // A wire with a hook through a catheter with a bent tip, both of length about 1, its hub turned, a load on the
        // outermost tip; p beyond.
        private static Case JTip(int n, double extension, double turn = 1.2, int beyond = -1)
        {
            double l = 1.0 / n;
            if (beyond < 0)
            {
                beyond = extension > Reached * l ? (int)Math.Floor(extension / l - Reached) + 1 : 0;
            }
            var pair = new CoaxialPair(
                new[] { new CoaxialPair.Piece(0.6, 1.0, 0.0), new CoaxialPair.Piece(0.4, 1.0, 1.5) }, n,
                new[] { new CoaxialPair.Piece(1.27, 0.5, 0.0), new CoaxialPair.Piece(0.23, 0.5, 3.0) }, 3 * n / 2, 0.3,
                0.5 - extension, beyond) { TipForce = new Vector3d(0.1, 0.2, -0.1) };
            pair.Solve(0.5 * turn);
            pair.Solve(turn);
            return new Case(pair);
        }
    }
}
