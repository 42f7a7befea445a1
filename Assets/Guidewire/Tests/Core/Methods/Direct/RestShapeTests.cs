using System;
using System.Globalization;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Rest shapes against the elastica, closed forms and a published benchmark: by the direct method at once,
    /// by those without statics as the end of a damped motion.</summary>
    [Category("Row")]
    public sealed class RestShapeTests
    {
        private const double Gate = 3e-3;  // of L, along the whole shape

        // F L^2/EI at the tip, or w L^3/EI of the weight.
        [Test]
        public void Load_BendsTheWholeShape([Values(Solver.Direct, Solver.Explicit, Solver.Xpbd)] Solver solver,
            [Values("tip 0.1", "tip 1", "tip 2", "tip 10", "tip 100", "weight 0.456", "weight 2.851")] string load)
        {
            if (solver == Solver.Xpbd || (solver == Solver.Explicit && load != "weight 2.851"))
            {
                Rods.OnlyInFull("one load of explicit; xpbd's rest shape is in ClaimTests");
            }
            // The elastica integrated here, independently: theta' = kappa, kappa' = -k cos(theta)/L^2, times what is
            // beyond s of a weight, kappa(L) = 0 and not before, by bisection on kappa(0) over fourth-order Runge-Kutta
            // steps.
            const int Steps = 4800;
            double k = double.Parse(load.Split(new[] { ' ' })[1], CultureInfo.InvariantCulture);
            bool isWeight = load[0] == 'w';
            double curvature = Bisection.Limit(0.0, 20.0, first => Elastica(k, isWeight, first, Steps, null) <= 0.0);
            var points = new Vector3d[Steps + 1];
            Elastica(k, isWeight, curvature, Steps, points);
            foreach (int n in Counts(solver))
            {
                SimulationParameters parameters = Settled(solver, n, CantileverRate(Thickness(solver)));
                double force = k * Rods.BendForce * Math.Pow(parameters.Material.WireRadius / Rods.Radius, 4);
                parameters.Scene.DistributedForce = isWeight ? force / Rods.Length * Vector3d.UnitY : Vector3d.Zero;
                parameters.Scene.TipForce = isWeight ? Vector3d.Zero : force * Vector3d.UnitY;
                Vector3d[] x = AtRest(parameters).Positions;
                double worst = 0.0;
                for (int i = 0; i <= n; i++)
                {
                    worst = Math.Max(worst, Vector3d.Distance(x[i] / (1e3 * Rods.Length), points[i * (Steps / n)]));
                }
                Row.Holds("elastica, " + load + ", n = " + n + ", " + solver + ": worst node, L", worst, 0.0, Gate);
            }
        }

        [TestCase(0.5)]
        [TestCase(1.0)]
        [TestCase(2.0)]
        [TestCase(4.0)]
        public void EndMoment_BendsAnArc(double halfTurns)
        {
            // theta = M L/EI; the couple turns the wire about -x, so it rises into +y. Half-element clamp: every angle
            // is exact; the tip misses by the chords' (kappa l)^2/24.
            const int N = 30;
            double theta = halfTurns * Math.PI;
            RodShape shape = Rods.AtRest(Rods.Wire(N), new RodSupports { Clamp = ClampRule.HalfElement }, Vector3d.Zero,
                Vector3d.Zero, new Vector3d(-theta * Rods.BendStiffness / Rods.Length, 0.0, 0.0));
            for (int j = 0; j < N; j++)
            {
                Quaterniond expected = Quaterniond.FromAxisAngle(-Vector3d.UnitX, theta * (j + 0.5) / N);
                double miss = RotationVector.Log(expected.Conjugate * shape.Q[j]).Length;
                Assert.That(miss, Is.LessThan(1e-9), "element " + j);
            }
            double chord = theta / N * (theta / N) / 24.0;
            Vector3d tip = Arc(theta, Rods.Length);
            double error = Vector3d.Distance(shape.X[N], tip) / Rods.Length;
            Assert.That(error, Is.LessThan(1.1 * chord + 1e-9));
        }

        // By the sine law the tip is off by an error of second order.
        [TestCase(Solver.Direct, ClampRule.HalfElement, BendLaw.RotationVector, 20)]
        [TestCase(Solver.Direct, ClampRule.HalfElement, BendLaw.RotationVector, 30)]
        [TestCase(Solver.Direct, ClampRule.HalfElement, BendLaw.RotationVector, 160)]
        [TestCase(Solver.Direct, ClampRule.FourthOrder, BendLaw.RotationVector, 30)]
        [TestCase(Solver.Explicit, ClampRule.HalfElement, BendLaw.RotationVector, 30)]
        [TestCase(Solver.Direct, ClampRule.HalfElement, BendLaw.Darboux, 90)]
        [TestCase(Solver.Explicit, ClampRule.HalfElement, BendLaw.Darboux, 90, Category = "Long")]
        public void EndMoment_BringsTheTipToThatOfTheArc(Solver solver, ClampRule clamp, BendLaw law, int n)
        {
            foreach (double halfTurns in new[] { 0.5, 1.0, 2.0 })
            {
                // A couple neither stretches nor shears: any thickness will do.
                double radius = solver == Solver.Direct ? Rods.Radius : 5e-3;
                SimulationParameters parameters = Settled(solver, n, CantileverRate(radius));
                parameters.Material.WireRadius = radius;
                parameters.Material.ClampRule = clamp;
                parameters.Material.BendLaw = law;
                double theta = halfTurns * Math.PI;
                double couple = theta * Rods.BendStiffness * Math.Pow(radius / Rods.Radius, 4) / Rods.Length;
                parameters.Scene.TipMoment = -couple * Vector3d.UnitX;
                Vector3d tip = 1e-3 * AtRest(parameters).Positions[n];
                Row.Holds("couple M L/EI = " + halfTurns + " π, n = " + n + ", " + solver + ", " + clamp + ", " + law
                    + ": tip, L", Vector3d.Distance(tip, Arc(theta, Rods.Length)) / Rods.Length, 0.0, 1e-3);
            }
        }

        [Test]
        public void EndMoment_WithTheDarbouxLaw_IsOfOrderTwo([Values(0.5, 1.0, 2.0)] double halfTurns)
        {
            Row.Holds("couple M L/EI = " + halfTurns + " π, Darboux: order in n", Math.Log(
                DarbouxError(45, halfTurns * Math.PI) / DarbouxError(90, halfTurns * Math.PI), 2.0), 2.0, 0.1);
        }

        [Test]
        public void CoupleBeyondTheDarbouxLaw_Fails()
        {
            // K sin(angle) carries no more than K = EI/l.
            const int N = 10;
            MaterialRod rod = Rods.Wire(N);
            var rodTerms = new RodTerms(rod,
                new RodSupports { Bend = BendLaw.Darboux, Clamp = ClampRule.HalfElement });
            rodTerms.Followers.Moment.Moment = new Vector3d(1.1 * Rods.BendStiffness * N / Rods.Length, 0.0, 0.0);
            EquilibriumResult result = new RodStatics(rodTerms).Solve(Rods.Straight(rod), 1e-10, 300);
            Assert.That(result.Converged, Is.False);
            Assert.That(result.Reason, Is.Not.Empty);
        }

        [Test]
        public void TurnedEnd_TwistsEvenly([Values(Solver.Direct, Solver.Explicit, Solver.Xpbd)] Solver solver)
        {
            // Torque GJ phi/L, angle linear along the wire; the slowest motion is half a wave of twist.
            const int N = 30;
            const double Turn = 0.5 * Math.PI;
            double rate = Math.PI / Rods.Length * Math.Sqrt(Rods.Shear / Rods.Density);
            SimulationParameters parameters = Settled(solver, N, rate);
            parameters.Material.ClampRule = ClampRule.HalfElement;
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            parameters.Scene.DistalRotation = Turn;
            parameters.Scene.DistalRampTime = solver == Solver.Direct ? 0.0 : 0.3 / rate;
            double worst = 0.0;
            RodState state = AtRest(parameters);
            for (int j = 0; j < N; j++)
            {
                double turned = RotationVector.Log(state.Orientations[j]).Z;
                worst = Math.Max(worst, Math.Abs(turned / Turn - (j + 0.5) / N));
            }
            // Even, it carries one torque.
            Row.Holds("one end turned by 90°, n = 30, " + solver + ": worst element's turn, of 90°", worst, 0.0,
                solver == Solver.Direct ? 1e-6 : 1e-3);
        }

        [Test]
        public void TurnedEnd_IsTurnedByItsTorque()
        {
            SimulationParameters parameters = Settled(Solver.Direct, 30, 1.0);
            parameters.Scene.DistalEnd = DistalEnd.Clamped;
            parameters.Scene.DistalRotation = 0.5 * Math.PI;
            SolverReport report = Wires.Run(parameters).Report()!;
            double torque = 0.5 * Math.PI * Rods.TwistStiffness / Rods.Length;
            Row.Holds("one end turned by 90°: torque, GJ φ/L", report.DistalMoment!.Value.Z / torque, 1.0, 1e-3);
            Assert.That(report.ProximalMoment!.Value.Z, Is.EqualTo(-torque).Within(1e-3 * torque));
        }

        [TestCase(Solver.Direct)]
        [TestCase(Solver.Explicit, Category = "Long")]
        [TestCase(Solver.Xpbd, Category = "Long")]
        public void FortyFiveDegreeBend_IsThePublishedOne(Solver solver)
        {
            // Bathe and Bolourchi 1979: arc of radius 100 over 45 degrees, unit square section, E = 1e7, nu = 0, load
            // 600 out of its plane; tip at (15.685, 47.150, 53.475) with J = 1/6. A round wire of r^2 = 1/3 and
            // E = 3e7/pi, G = E/2 has these stiffnesses.
            const double R = 100.0;
            const double Young = 3e7 / Math.PI;
            double length = R * Math.PI / 4.0;
            // Ours: across the bend y, along z, load x.
            var published = new Vector3d(53.475, 15.685, 47.150);
            foreach (int n in Counts(solver))
            {
                SimulationParameters parameters = Settled(solver, n, 3.516 / (length * length) * Math.Sqrt(1e7 / 12.0));
                parameters.Scene.MetresPerUnit = 1.0;
                parameters.Scene.GuidewireLength = length;
                parameters.Material.WireRadius = Math.Sqrt(1.0 / 3.0);
                parameters.Material.YoungsModulus = Young;
                parameters.Material.ShearModulus = 0.5 * Young;
                parameters.Material.ShearFactor = 1.0;
                parameters.Material.Density = 1.0;
                parameters.Material.RestCurvature = new Vector3d(-1.0 / R, 0.0, 0.0);
                parameters.Scene.TipForce = new Vector3d(600.0, 0.0, 0.0);
                Row.Holds("45° bend, load 600 across its plane, n = " + n + ", " + solver + ": tip, of its place",
                    Vector3d.Distance(AtRest(parameters).Positions[n], published) / published.Length, 0.0, 1e-2);
            }
        }

        /// <summary>Out of one plane: a force (0.5, -1, 0) EI/L^2 in fixed axes and a couple (0.5, 0.3, 0.8) EI/L along
        /// the tip's own, which has no potential.</summary>
        [TestCase(Solver.Direct, 0.5)]
        [TestCase(Solver.Direct, 1.0)]
        [TestCase(Solver.Direct, 2.0)]
        [TestCase(Solver.Explicit, 1.0, Category = "Long")]
        public void ForceAndCoupleInSpace_BringTheTipToThatOfTheRod(Solver solver, double factor)
        {
            SimulationParameters parameters = Settled(solver, 30, CantileverRate(Thickness(solver)));
            double thicker = Math.Pow(parameters.Material.WireRadius / Rods.Radius, 4);
            Vector3d force = factor * Rods.BendForce * new Vector3d(0.5, -1.0, 0.0);
            Vector3d couple = factor * Rods.BendForce * Rods.Length * new Vector3d(0.5, 0.3, 0.8);
            parameters.Scene.TipForce = thicker * force;
            parameters.Scene.TipMoment = thicker * couple;
            Vector3d tip = 1e-3 * AtRest(parameters).Positions[30];
            Row.Holds("force and couple in space, times " + factor + ", n = 30, " + solver + ": tip, L",
                Vector3d.Distance(tip, TipInSpace(force, couple)) / Rods.Length, 0.0, Gate);
        }

        /// <summary>r' = d3, R' = R [B^-1 R^T m], m' = -r' x f from the clamp on by the midpoint rule, the clamp's m
        /// by Newton's steps so that R^T m is the couple at the tip, under growing parts of both loads.</summary>
        private static Vector3d TipInSpace(Vector3d force, Vector3d couple)
        {
            const double H = 1e-6 * Rods.BendForce * Rods.Length;
            Vector3d tip = Vector3d.Zero;
            Vector3d start = Vector3d.Zero;
            for (int k = 1; k <= 60; k++)
            {
                double part = Math.Min(1.0, 0.02 * k);
                Vector3d left = Left(start, part);
                Vector3d a = (Left(start + H * Vector3d.UnitX, part) - left) / H;
                Vector3d b = (Left(start + H * Vector3d.UnitY, part) - left) / H;
                Vector3d c = (Left(start + H * Vector3d.UnitZ, part) - left) / H;
                start -= new Vector3d(Vector3d.Dot(left, Vector3d.Cross(b, c)),
                    Vector3d.Dot(a, Vector3d.Cross(left, c)), Vector3d.Dot(a, Vector3d.Cross(b, left)))
                    / Vector3d.Dot(a, Vector3d.Cross(b, c));
            }
            Assert.That(Left(start, 1.0).Length, Is.LessThan(1e-9 * couple.Length));
            return tip;

            Vector3d Left(Vector3d m, double part)
            {
                const int Steps = 500;
                const double Ds = Rods.Length / Steps;
                Quaterniond q = Quaterniond.Identity;
                tip = Vector3d.Zero;
                for (int i = 0; i < Steps; i++)
                {
                    Quaterniond middle = q * RotationVector.Exp(0.5 * Ds * Turn(q, m));
                    Vector3d half = m - 0.5 * Ds * Vector3d.Cross(q.Director3, part * force);
                    q *= RotationVector.Exp(Ds * Turn(middle, half));
                    m -= Ds * Vector3d.Cross(middle.Director3, part * force);
                    tip += Ds * middle.Director3;
                }
                return Quaterniond.Rotate(q.Conjugate, m) - part * couple;
            }

            static Vector3d Turn(Quaterniond q, Vector3d m)
            {
                Vector3d own = Quaterniond.Rotate(q.Conjugate, m);
                return new Vector3d(own.X / Rods.BendStiffness, own.Y / Rods.BendStiffness,
                    own.Z / Rods.TwistStiffness);
            }
        }

        [Test]
        public void BentTip_KeepsItsBendWithoutLoad()
        {
            const int N = 40;
            MaterialRod rod = Rods.Wire(N);
            for (int j = 30; j < N; j++)
            {
                rod.SetRound(j, 0.2e-3, 20e9, 8e9, Rods.Density);
                rod.RestCurvature[j] = new Vector3d(-20.0, 0.0, 0.0);
            }
            RodShape shape = Rods.AtRest(rod, new RodSupports(), Vector3d.Zero, Vector3d.Zero, Vector3d.Zero);
            // The joint at the border stands for half an element of either piece.
            double angle = 20.0 * (Rods.Length / N) * (10.0 - 0.5);
            Assert.That(-RotationVector.Log(shape.Q[N - 1]).X, Is.EqualTo(angle).Within(1e-9));
            Assert.That(shape.X[30].Y, Is.EqualTo(0.0).Within(1e-12));
        }

        private static double DarbouxError(int n, double theta)
        {
            RodShape shape = Rods.AtRest(Rods.Wire(n),
                new RodSupports { Clamp = ClampRule.HalfElement, Bend = BendLaw.Darboux }, Vector3d.Zero, Vector3d.Zero,
                new Vector3d(-theta * Rods.BendStiffness / Rods.Length, 0.0, 0.0));
            return Vector3d.Distance(shape.X[n], Arc(theta, Rods.Length)) / Rods.Length;
        }

        private static int[] Counts(Solver solver) =>
            solver == Solver.Direct ? new[] { 20, 30, 40, 80, 160 } : new[] { 30 };

        // What shears less is thinner, and takes shorter steps.
        private static double Thickness(Solver solver) => solver == Solver.Direct ? Rods.Radius : 1e-3;

        // Of the wire's first mode, rad/s.
        private static double CantileverRate(double radius) =>
            3.516 / (Rods.Length * Rods.Length) * 0.5 * radius * Math.Sqrt(Rods.Young / Rods.Density);

        /// <summary>A rest shape at once, or a motion under critical damping of the slowest mode until of that
        /// 15 exp(-14) are left.</summary>
        /// <param name="rate">Of that mode, rad/s.</param>
        private static SimulationParameters Settled(Solver solver, int n, double rate)
        {
            bool isDirect = solver == Solver.Direct;
            SimulationParameters parameters = Rods.Clamped(n, solver, isDirect ? 1e-3 : 0.04 / rate,
                isDirect ? 0 : 350);
            parameters.Scene.InitialState = isDirect ? InitialState.Equilibrium : parameters.Scene.InitialState;
            parameters.Material.MassDamping = isDirect ? 0.0 : 2.0 * rate;
            parameters.Material.WireRadius = Thickness(solver);
            parameters.Method.ConstraintSolverSteps = solver == Solver.Xpbd ? 3 : 1;
            return parameters;
        }

        // Substeps of half the stable one of explicit steps, whose limit sweeps of xpbd do not have but converge at.
        private static RodState AtRest(SimulationParameters parameters)
        {
            Solver solver = parameters.Method.Solver;
            if (solver != Solver.Direct)
            {
                parameters.Method.Solver = Solver.Explicit;
                double stable = Simulation.Create(parameters).Report()!.StableSubstep;
                parameters.Method.Solver = solver;
                parameters.Method.Substeps = (int)Math.Ceiling(parameters.Method.TimeStep
                    / (solver == Solver.Xpbd ? 2.0 * stable : 0.7 * stable));
            }
            Simulation run = Wires.Run(parameters);
            Assert.That(run.Outcome, Is.EqualTo(solver == Solver.Direct ? Outcome.Converged : Outcome.Finished),
                run.Reason);
            return run.State;
        }

        /// <summary>End of an arc that starts along z and rises into y.</summary>
        private static Vector3d Arc(double theta, double length)
        {
            double radius = length / theta;
            return new Vector3d(0.0, radius * (1.0 - Math.Cos(theta)), radius * Math.Sin(theta));
        }

        /// <summary>The least curvature on the way, of unit length; writes (0, w, z) where points are asked
        /// for.</summary>
        private static double Elastica(double k, bool isWeight, double startCurvature, int steps, Vector3d[]? points)
        {
            double h = 1.0 / steps;
            double theta = 0.0;
            double kappa = startCurvature;
            double least = kappa;
            double y = 0.0;
            double z = 0.0;
            for (int i = 0; i < steps; i++)
            {
                double at = k * (isWeight ? 1.0 - i * h : 1.0);
                double half = isWeight ? at - 0.5 * k * h : k;
                double after = isWeight ? at - k * h : k;
                double a1 = kappa;
                double b1 = -at * Math.Cos(theta);
                double a2 = kappa + 0.5 * h * b1;
                double b2 = -half * Math.Cos(theta + 0.5 * h * a1);
                double a3 = kappa + 0.5 * h * b2;
                double b3 = -half * Math.Cos(theta + 0.5 * h * a2);
                double a4 = kappa + h * b3;
                double b4 = -after * Math.Cos(theta + h * a3);
                double middle = theta + 0.5 * h * a2;
                double next = theta + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
                y += h / 6.0 * (Math.Sin(theta) + 4.0 * Math.Sin(middle) + Math.Sin(next));
                z += h / 6.0 * (Math.Cos(theta) + 4.0 * Math.Cos(middle) + Math.Cos(next));
                theta = next;
                kappa += h / 6.0 * (b1 + 2.0 * b2 + 2.0 * b3 + b4);
                least = Math.Min(least, kappa);
                if (points != null)
                {
                    points[i + 1] = new Vector3d(0.0, y, z);
                }
            }
            return least;
        }
    }
}
