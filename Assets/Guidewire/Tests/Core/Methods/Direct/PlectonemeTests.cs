using System;
using System.Collections.Generic;
using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire under constant tension T whose ends are turned against each other: it goes from a helix to a
    /// loop, touches itself and winds up as a plectoneme.</summary>
    /// <remarks>With x = sqrt(B/T), L = 24 x, GJ = 48 B, the couples in sqrt(BT) at given turns are those of an
    /// independent solution of the boundary-value problem, with contact by forces between pairs of nodes. The plateau
    /// is also that of the uniform two-ply: F a^2/B = (M a/B) sin cos - sin^4/2, M a/B = 2 sin^3 cos/cos(2 angle).
    /// </remarks>
    public sealed class PlectonemeTests
    {
        private const double Scale = 0.01;     // x, m

        [Test]
        public void ThickWire_HasThePeakOfTheReference_AndNoStrandPassesAnother()
        {
            // n = 120: elements of a radius.
            List<(double Turn, double Couple, double End)> curve = Wind(0.2, 120, 0.1, 7.5);
            Assert.That(Largest(curve, 5.0), Is.EqualTo(1.004).Within(0.02 * 1.004));
        }

        [TestCase(0.1, 0.8764, 0.493)]
        [TestCase(0.2, 1.004, 0.728)]
        [Category("Long")]
        public void PeakAndPlateau_AreThoseOfTheReference(double radius, double peak, double plateau)
        {
            List<(double Turn, double Couple, double End)> curve = Wind(radius, 240, 0.05, radius < 0.2 ? 12.0 : 10.4);
            Assert.That(Largest(curve, 5.0), Is.EqualTo(peak).Within(0.01 * peak));
            double from = radius < 0.2 ? 11.0 : 9.9;
            double sum = 0.0;
            List<(double Turn, double Couple, double End)> last = curve.FindAll(point => point.Turn > from);
            last.ForEach(point => sum += point.Couple);
            Assert.That(sum / last.Count, Is.EqualTo(plateau).Within(0.02 * plateau));
        }

        [Test]
        [Category("Long")]
        public void ThinWire_HasTheCouplesOfTheReference()
        {
            List<(double Turn, double Couple, double End)> curve = Wind(0.05, 240, 0.05, 10.0);
            foreach ((double turn, double couple) in new[] { (8.0, 0.810), (9.0, 0.700), (10.0, 0.526) })
            {
                Assert.That(curve.Find(point => point.Turn > turn - 1e-6).Couple,
                    Is.EqualTo(couple).Within(0.03 * couple), "at " + turn);
            }
        }

        [Test]
        [Category("Row")]
        [Category("Long")]
        public void EachTurn_ShortensThePlectonemeByTheTwoPly()
        {
            // Contacts of elements of two radii lock into one another: ends of an interval are off by up to 4 %, a line
            // through many turns is not. With shorter elements nothing keeps the plectoneme in the wire's middle, and a
            // clamp that it comes to takes half of a turn's length.
            List<(double Turn, double Couple, double End)> curve = Wind(0.1, 120, 0.05, 24.0)
                .FindAll(point => point.Turn > 12.0);
            double turn = curve.Average(point => point.Turn);
            double end = curve.Average(point => point.End);
            double perTurn = -2.0 * Math.PI / Scale * curve.Sum(point => (point.Turn - turn) * (point.End - end))
                / curve.Sum(point => (point.Turn - turn) * (point.Turn - turn));
            Row.Holds("shortening of a plectoneme in a turn, in sqrt(B/T)", perTurn, 2.37, 0.02 * 2.37);
        }

        /// <summary>A loop that does not touch itself shortens the wire by 4 sqrt((B/T)(1 - M^2/(4 BT))). It touches at
        /// 1.81 a T, a half the distance at which it does, with which the reference is to be compared.</summary>
        [Test]
        [Category("Row")]
        public void Loop_HasTheLengthOfTheHomoclinicSolution_AndTouchesItselfAtItsCouple()
        {
            const double radius = 0.1;
            double strain = 1.0 / 400.0;
            Simulation run = Simulation.Create(Of(radius, 160, 0.02, 6.2, out double bend, out double tension));
            double couple = double.NaN;
            double length = double.NaN;
            while (run.Outcome == Outcome.Running && !(run.Report()!.Extremes!.StrandForce > 0.0))
            {
                run.Step();
                couple = Math.Abs(run.Hub()!.Torque) / Math.Sqrt(bend * tension);
                Vector3d[] x = run.State.Positions;
                length = 24.0 * (1.0 + strain) - 1e-3 * (x[x.Length - 1].Z - x[0].Z) / Scale;
                if (Math.Abs(couple - 0.5) < 0.01 && run.Hub()!.Turn > 5.0)
                {
                    double exact = 4.0 * Math.Sqrt(1.0 - 0.25 * couple * couple);
                    Row.Holds("shortening of a loop, in sqrt(B/T)", length, exact, 0.01 * exact);
                }
            }
            double touch = 1.81 * HeldLoopTests.MeanRadius(run, radius);
            Row.Holds("couple at which a loop touches itself, in sqrt(BT)", couple, touch, 0.03 * touch);
        }

        [TestCase(0.0)]
        [TestCase(0.2)]
        public void Restored_GoesOnWithTheSameBits(double friction)
        {
            SimulationParameters parameters = Of(0.2, 120, 0.1, 6.0, out _, out _);
            parameters.Contact.SelfFriction = friction;
            Wires.RunAndRestore(parameters, 57);
        }

        // The couple in sqrt(BT) and the distance of the ends, m, after each step.
        private static List<(double Turn, double Couple, double End)> Wind(double radius, int n, double turn,
            double last)
        {
            var curve = new List<(double Turn, double Couple, double End)>();
            Simulation simulation = Simulation.Create(Of(radius, n, turn, last, out double bend, out double tension));
            Wires.Finish(simulation, () => curve.Add((simulation.Hub()!.Turn,
                Math.Abs(simulation.Hub()!.Torque) / Math.Sqrt(bend * tension),
                1e-3 * (simulation.State.Positions[n].Z - simulation.State.Positions[0].Z))));
            Assert.That(simulation.Passages, Is.Zero);
            return curve;
        }

        private static SimulationParameters Of(double radius, int n, double turn, double last, out double bend,
            out double tension)
        {
            double r = radius * Scale;
            double young = 1e9 * Math.Pow(1e-3 / r, 4);
            bend = 0.25 * Math.PI * Math.Pow(r, 4) * young;
            tension = bend / (Scale * Scale);
            return new SimulationParameters
            {
                Method =
                {
                    Solver = Solver.Direct,
                    Integrator = Integrator.ImplicitEuler,
                    TimeStep = 0.05,
                    MaxSimulationSteps = (int)Math.Round(last / turn),
                    DeltaThreshold = 0.0,
                },
                Scene =
                {
                    GuidewireLength = 24e3 * Scale,
                    NumberRodElements = n,
                    GuidewireOffset = 0.0,
                    ProximalEnd = ProximalEnd.Clamped,
                    DistalEnd = DistalEnd.Sliding,
                    AxialForce = tension,
                    Gravity = Vector3d.UnitY,    // 1/1600 of the tension: the side to which the wire buckles
                },
                Drive = { Kind = Drive.Displace, Displacement = 0.0, TwistPerStep = turn },
                Material =
                {
                    WireRadius = r,
                    YoungsModulus = young,
                    ShearModulus = 24.0 * young,
                    Density = 0.02 / (Math.PI * r * r),
                    AxialStiffness = 400.0 * tension,
                },
                Contact = { SelfContact = true },
            };
        }

        private static double Largest(List<(double Turn, double Couple, double End)> curve, double from)
        {
            double largest = 0.0;
            curve.FindAll(point => point.Turn > from).ForEach(point => largest = Math.Max(largest, point.Couple));
            return largest;
        }
    }
}
