using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Every energy against differences of its own value, and against what no energy of a rod may
    /// feel.</summary>
    public sealed class EnergyDerivativeTests
    {
        private const int N = 4;

        public static readonly string[] TermNames = { "stretch", "rotationVector", "darboux", "inertia", "plane",
            "damping" };

        [Test]
        public void Gradient_IsTheDifferenceOfTheEnergy([ValueSource(nameof(TermNames))] string name,
            [Values(0.02, 0.9)] double angle)
        {
            EnergyTerm term = Create(name, angle, out RodShape shape);
            EnergySlopes.AssertGradient(DenseMatrix.From(Gradient(term, shape), N + 1), Unknowns,
                (i, s) => term.Value(Moved(shape, i, s)));
        }

        [Test]
        public void Blocks_AreTheDifferencesOfTheGradient([ValueSource(nameof(TermNames))] string name,
            [Values(0.02, 0.9)] double angle)
        {
            EnergyTerm term = Create(name, angle, out RodShape shape);
            var blocks = new RodBlock[N + 2];
            term.AddBlocks(shape, blocks, new RodVector[N + 2], 0, N + 1);
            EnergySlopes.AssertBlocks(DenseMatrix.From(blocks, N + 1), Unknowns,
                (i, s, k, t) => term.Value(Moved(shape, i, s, k, t)));
        }

        [Test]
        public void GradientAlone_IsThatOfTheBlocks([ValueSource(nameof(TermNames))] string name)
        {
            EnergyTerm term = Create(name, 0.7, out RodShape shape);
            var gradient = new RodVector[N + 2];
            term.AddBlocks(shape, new RodBlock[N + 2], gradient, 0, N + 1);
            double[] withBlocks = DenseMatrix.From(gradient, N + 1);
            double[] alone = DenseMatrix.From(Gradient(term, shape), N + 1);
            for (int i = 0; i < alone.Length; i++)
            {
                Assert.That(alone[i], Is.EqualTo(withBlocks[i]).Within(1e-14 * (1.0 + Math.Abs(alone[i]))));
            }
        }

        [TestCase("stretch")]
        [TestCase("rotationVector")]
        [TestCase("darboux")]
        public void Energy_IsBlindToARigidMotion(string name)
        {
            EnergyTerm term = Create(name, 0.8, out RodShape shape);
            RodShape moved = Rods.Copy(shape);
            Quaterniond turn = Quaterniond.FromAxisAngle(Vector3d.Normalize(new Vector3d(0.3, -1.0, 2.0)), 2.3);
            for (int i = 0; i <= N; i++)
            {
                moved.X[i] = Quaterniond.Rotate(turn, shape.X[i]) + new Vector3d(0.1, 0.2, -0.3);
            }
            for (int j = 0; j < N; j++)
            {
                moved.Q[j] = turn * shape.Q[j];
            }
            moved.ProximalFrame = turn * shape.ProximalFrame;
            moved.DistalFrame = turn * shape.DistalFrame;
            Assert.That(term.Value(moved), Is.EqualTo(term.Value(shape)).Within(1e-12 * term.Value(shape)));
        }

        /// <summary>Of a bent, twisted and strained wire between clamps, as a motion states them before its first
        /// step.</summary>
        [Category("Row")]
        [TestCase(BendLaw.RotationVector)]
        [TestCase(BendLaw.Darboux)]
        public void ForcesAndCouplesOfClamps_AreTheDifferencesOfTheEnergy(BendLaw law)
        {
            MaterialRod rod = Uneven(N);
            RodShape shape = Rods.Random(rod, 0.9, 0.3, 5);
            var supports = new RodSupports { Distal = DistalEnd.Clamped, Clamp = ClampRule.HalfElement, Bend = law };
            RodDynamics motion = MotionTests.Start(rod, supports, Rods.Schedule(null, shape), shape,
                Integrator.Esdirk3, 1e-6);
            Holds("force of the proximal clamp", motion.ReactionAt(0), (moved, s) => moved.X[0] += s);
            Holds("force of the distal clamp", motion.ReactionAt(N), (moved, s) => moved.X[N] += s);
            Holds("couple of the proximal clamp", motion.Reactions.ProximalCouple,
                (moved, s) => moved.ProximalFrame = RotationVector.Exp(s) * moved.ProximalFrame);
            Holds("couple of the distal clamp", motion.Reactions.DistalCouple,
                (moved, s) => moved.DistalFrame = RotationVector.Exp(s) * moved.DistalFrame);

            void Holds(string what, Vector3d stated, Action<RodShape, Vector3d> move)
            {
                double Slope(Vector3d e) => EnergySlopes.FineDifference(1e-3, s =>
                {
                    RodShape moved = Rods.Copy(shape);
                    move(moved, s * e);
                    return motion.Terms.ElasticEnergy(moved);
                });
                var slope = new Vector3d(Slope(Vector3d.UnitX), Slope(Vector3d.UnitY), Slope(Vector3d.UnitZ));
                Row.Holds(what + ", " + law + ": off the difference of the energy",
                    Vector3d.Distance(stated, slope) / slope.Length, 0.0, 1e-6);
            }
        }

        [Category("Row")]
        [TestCase(1e-6)]
        [TestCase(0.3)]
        [TestCase(1.7)]
        [TestCase(3.1)]
        public void Joint_AnswersWithItsLaw(double angle)
        {
            // Closed forms: K angle for the rotation vector, K sin(angle) for the Darboux vector (2/l) Im(conj(q) q').
            var joint = new Joint { Bend1 = 0.7, Bend2 = 1.1, Twist = 0.4 };
            for (int axis = 0; axis < 3; axis++)
            {
                Vector3d e = axis == 0 ? Vector3d.UnitX : axis == 1 ? Vector3d.UnitY : Vector3d.UnitZ;
                double stiffness = axis == 2 ? joint.Twist : axis == 1 ? joint.Bend2 : joint.Bend1;
                Quaterniond relative = Quaterniond.FromAxisAngle(e, angle);
                RodVector a = default;
                RodVector b = default;
                default(RotationVectorLaw).AddGradient(joint, relative, ref a, ref b);
                Row.Holds("one joint, rotation vector: couple K θ, of K θ", Along(b, e) / (stiffness * angle), 1.0,
                    1e-6);
                Assert.That(Along(a, e), Is.EqualTo(-stiffness * angle).Within(1e-6 * stiffness * angle));
                b = default;
                default(DarbouxLaw).AddGradient(joint, relative, ref a, ref b);
                Row.Holds("one joint, Darboux: couple K sin θ, of K θ", Along(b, e) / (stiffness * angle),
                    Math.Sin(angle) / angle, 1e-6);
            }
        }

        private const int Unknowns = 6 * N + 3;

        private static double Along(in RodVector v, in Vector3d e) => v.T1 * e.X + v.T2 * e.Y + v.T3 * e.Z;

        private static EnergyTerm Create(string name, double angle, out RodShape shape)
        {
            // Stiffnesses of one size, so that an error in any block shows.
            MaterialRod rod = Uneven(N);
            var supports = new RodSupports { Distal = DistalEnd.Clamped, Clamp = ClampRule.HalfElement };
            shape = Rods.Random(rod, angle, 0.3, 5);
            switch (name)
            {
                case "stretch":
                    return new StretchEnergy(rod);
                case "rotationVector":
                    return new BendTwistEnergy<RotationVectorLaw>(rod.Joints(supports), true, true);
                case "darboux":
                    return new BendTwistEnergy<DarbouxLaw>(rod.Joints(supports), true, true);
                case "plane":
                    return Plane(rod, shape);
                case "damping":
                    rod.MassDamping = 0.3;
                    rod.MaterialDamping = 0.7;
                    var damping = new RodDamping(new RodTerms(rod, supports), 1);
                    damping.Begin(Rods.Random(rod, 0.5 * angle, 0.2, 6), new Vector3d[rod.ElementCount + 1],
                        new Vector3d[rod.ElementCount], Vector3d.Zero, Vector3d.Zero);
                    damping.BeginStage(new[] { 0.8 }, 1.0);
                    return damping;
                default:
                    var inertia = new InertiaEnergy(new RodMass(rod, MassRule.Consistent)) { StageLength = 0.8 };
                    inertia.BeginStep(shape, 1.0);
                    inertia.FreePositions[2] = new Vector3d(0.1, 0.2, 0.3);
                    inertia.SpinHistory[1] = new Vector3d(0.4, -0.2, 0.1);
                    inertia.Anchor(shape);
                    return inertia;
            }
        }

        private static MaterialRod Uneven(int count)
        {
            var rod = new MaterialRod(count);
            for (int j = 0; j < count; j++)
            {
                rod.Length[j] = 0.5 + 0.1 * j;
                rod.StretchStiffness[j] = 3.0 + j;
                rod.ShearStiffness[j] = 1.3;
                rod.BendStiffness1[j] = 0.5;
                rod.BendStiffness2[j] = j % 2 == 0 ? 0.5 : 0.9;
                rod.TwistStiffness[j] = 0.3;
                rod.LineDensity[j] = 1.1;
                rod.RotaryInertia1[j] = 0.4;
                rod.RotaryInertia2[j] = 0.4;
                rod.RestCurvature[j] = new Vector3d(0.2, -0.4, 0.3);
            }
            return rod;
        }

        /// <summary>The guide of a plane without its springs on turns, which have no value: no bending stiffness, no
        /// springs. </summary>
        private static PlaneGuide Plane(MaterialRod rod, RodShape shape)
        {
            var stiff = new MaterialRod(rod.ElementCount);
            for (int j = 0; j < rod.ElementCount; j++)
            {
                stiff.Length[j] = rod.Length[j];
                stiff.ShearStiffness[j] = rod.ShearStiffness[j];
            }
            return new PlaneGuide(stiff, Vector3d.Normalize(new Vector3d(1.0, 2.0, 2.0)), shape.X[0]);
        }

        private static RodVector[] Gradient(EnergyTerm term, RodShape shape)
        {
            var gradient = new RodVector[N + 2];
            term.AddGradient(shape, gradient);
            return gradient;
        }

        private static RodShape Moved(RodShape shape, int i, double s, int k = 0, double t = 0.0)
        {
            RodShape moved = Rods.Copy(shape);
            var turn = new Vector3d[N];
            Shift(moved, turn, i, s);
            Shift(moved, turn, k, t);
            for (int j = 0; j < N; j++)
            {
                moved.Q[j] = moved.Q[j] * RotationVector.Exp(turn[j]);
            }
            return moved;
        }

        private static void Shift(RodShape shape, Vector3d[] turn, int i, double s)
        {
            Vector3d e = i % 3 == 0 ? Vector3d.UnitX : i % 3 == 1 ? Vector3d.UnitY : Vector3d.UnitZ;
            if (i % 6 < 3)
            {
                shape.X[i / 6] += s * e;
            }
            else
            {
                turn[i / 6] += s * e;
            }
        }
    }
}
