using System;
using System.Linq;
using System.Runtime.InteropServices;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What is computed of four elements at once has the bits that plain numbers give one by one. A range of
    /// one element is always computed by plain numbers. Angles: all joints in lanes, some, none.</summary>
    public sealed class LaneTermTests
    {
        private const int N = 37;   // not a multiple of four
        private const double StageLength = 0.8;

        public static readonly string[] TermNames = { "stretch", "stiffened stretch", "bend-twist",
            "stiffened bend-twist", "inertia" };

        private static readonly double[] Angles = { 0.05, 0.2, 0.9 };

        [Test]
        public void Blocks_HaveTheBitsOfPlainNumbers([ValueSource(nameof(TermNames))] string name,
            [ValueSource(nameof(Angles))] double angle)
        {
            var blocks = new RodBlock[N + 2];
            var gradient = new RodVector[N + 2];
            Create(name, angle, out RodShape shape).AddBlocks(shape, blocks, gradient, 0, N + 1);
            var plainBlocks = new RodBlock[N + 2];
            var plainGradient = new RodVector[N + 2];
            EnergyTerm plain = Create(name, angle, out _);
            for (int i = 0; i <= N; i++)
            {
                plain.AddBlocks(shape, plainBlocks, plainGradient, i, i + 1);
            }
            Assert.That(Bits(blocks), Is.EqualTo(Bits(plainBlocks)));
            AssertSame(gradient, plainGradient);
            Assert.That(blocks[N / 2].C11, Is.Not.Zero);
        }

        [Test]
        public void Gradient_HasTheBitsOfPlainNumbers([ValueSource(nameof(TermNames))] string name,
            [ValueSource(nameof(Angles))] double angle)
        {
            EnergyTerm term = Create(name, angle, out RodShape shape);
            var gradient = new RodVector[N + 2];
            var measured = default(GradientMeasures);
            term.AddGradient(shape, gradient, 0, N + 1, ref measured);
            AssertSame(gradient, PlainGradient(Create(name, angle, out _), shape, out GradientMeasures plain));
            Assert.That(measured.LargestForce, Is.EqualTo(plain.LargestForce));
            Assert.That(gradient[N / 2].T1, Is.Not.Zero);
        }

        [TestCaseSource(nameof(Angles))]
        public void Value_IsTheSumOfPlainNumbers(double angle)
        {
            MaterialRod rod = Rods.Wire(N);
            var supports = new RodSupports { Distal = DistalEnd.Clamped };
            Joint[] joints = rod.Joints(supports);
            RodShape shape = Rods.Random(rod, angle, 0.1, 5);
            var stretch = new StretchEnergy(rod);
            double stretched = 0.0;
            double bent = 0.0;
            for (int j = 0; j < N; j++)
            {
                Vector3d n = stretch.Stress(shape, j, out Vector3d p);
                stretched += 0.5 * rod.Length[j] * (n.X * p.X + n.Y * p.Y + n.Z * (p.Z - 1.0));
                bent += j == 0 ? 0.0
                    : default(RotationVectorLaw).Value(joints[j], shape.Q[j - 1].Conjugate * shape.Q[j]);
            }
            Assert.That(stretch.Value(shape), Is.EqualTo(stretched));
            var bending = new BendTwistEnergy<RotationVectorLaw>(joints, false, false);
            Assert.That(bending.Value(shape), Is.EqualTo(bent));
        }

        [TestCaseSource(nameof(Angles))]
        public void TurnsAndCouples_HaveTheBitsOfPlainNumbers(double angle)
        {
            MaterialRod rod = Rods.Wire(N);
            rod.BendStiffness2[9] *= 1.5;
            Joint[] joints = rod.Joints(new RodSupports { Distal = DistalEnd.Clamped });
            RodShape shape = Rods.Random(rod, angle, 0.1, 5);
            var law = default(RotationVectorLaw);
            var turns = new Vector3d[N + 1];
            var couples = new Vector3d[N + 1];
            var bending = new BendTwistEnergy<RotationVectorLaw>(joints, false, true);
            for (int round = 0; round < 2; round++)    // the second time with what the first has left
            {
                bending.Measure(shape, turns);
                bending.Couples(shape, couples);
            }
            Assert.That(turns[0], Is.EqualTo(Vector3d.Zero));
            Assert.That(couples[0], Is.EqualTo(Vector3d.Zero));
            for (int k = 1; k <= N; k++)
            {
                Quaterniond after = k == N ? shape.DistalFrame : shape.Q[k];
                RodVector onBefore = default;
                RodVector onAfter = default;
                Quaterniond relative = shape.Q[k - 1].Conjugate * after;
                law.AddGradient(joints[k], relative, ref onBefore, ref onAfter);
                Assert.That(turns[k], Is.EqualTo(law.Measure(relative)), "joint " + k);
                Assert.That(couples[k], Is.EqualTo(Quaterniond.Rotate(after,
                    new Vector3d(onAfter.T1, onAfter.T2, onAfter.T3))), "joint " + k);
            }
        }

        [TestCaseSource(nameof(Angles))]
        public void WorkOfTheCouples_IsTheSumOfPlainNumbers(double angle)
        {
            InertiaEnergy inertia = Inertia(Rods.Wire(N), angle, out RodShape start);
            RodVector[] couple = PlainGradient(inertia, start, out _);
            inertia.Anchor(start);
            RodShape shape = Turned(start, angle, 7);
            double work = 0.0;
            for (int j = 0; j < N; j++)
            {
                Vector3d turn = RotationVector.Log(start.Q[j].Conjugate * shape.Q[j]);
                Vector3d i = new RodMass(Rods.Wire(N), MassRule.Consistent).Rotary[j];
                double perTurn = 1.0 / (StageLength * StageLength) + inertia.TurnDamping / StageLength;
                work += Vector3d.Dot(new Vector3d(couple[j].T1, couple[j].T2, couple[j].T3), turn) + 0.5 * perTurn
                    * (i.X * turn.X * turn.X + i.Y * turn.Y * turn.Y + i.Z * turn.Z * turn.Z);
            }
            Array.Copy(shape.X, inertia.FreePositions, N + 1);
            Assert.That(inertia.Value(shape), Is.EqualTo(work), "the nodes are where they go without forces");
        }

        [TestCaseSource(nameof(Angles))]
        public void CouplesThatAreRemembered_AreTheSame(double angle)
        {
            InertiaEnergy inertia = Inertia(Rods.Wire(N), angle, out RodShape shape);
            InertiaEnergy plain = Inertia(Rods.Wire(N), angle, out _);
            inertia.RemembersCouples = true;
            for (int k = 0; k < 3; k++)
            {
                var gradient = new RodVector[N + 2];
                inertia.AddGradient(shape, gradient);
                AssertSame(gradient, PlainGradient(plain, shape, out _));
                shape.Q[5 + k] = shape.Q[5 + k] * RotationVector.Exp(new Vector3d(0.01, 0.02, -0.03));
            }
        }

        [TestCaseSource(nameof(Angles))]
        public void Move_HasTheBitsOfPlainNumbers(double angle)
        {
            MaterialRod rod = Rods.Wire(N);
            RodShape shape = Rods.Random(rod, angle, 0.1, 3);
            RodVector[] direction = Direction(angle);
            var moved = new RodShape(N);
            RodStep.Apply(rod, new RodSupports(), shape, direction, 0.7, moved);
            var plain = new RodShape(N);
            Vector3d old = shape.X[0];
            Vector3d x = moved.X[0];
            plain.X[0] = x;
            for (int j = 0; j < N; j++)
            {
                RodStep.MoveElement(shape, direction, 0.7, plain, j, ref old, ref x);
            }
            AssertSame(moved, plain, 0, N);
            RodStep.Apply(rod, new RodSupports(), shape, direction, 0.7, shape);
            AssertSame(shape, plain, 0, N);
        }

        [TestCaseSource(nameof(Angles))]
        public void StraightMove_HasTheBitsOfPlainNumbers(double angle)
        {
            RodShape shape = Rods.Random(Rods.Wire(N), angle, 0.1, 3);
            RodVector[] direction = Direction(angle);
            var moved = new RodShape(N);
            RodStep.ApplyStraight(shape, direction, 0.7, moved);
            for (int j = 0; j < N; j++)
            {
                var one = new RodShape(1);
                Array.Copy(shape.X, j, one.X, 0, 2);
                one.Q[0] = shape.Q[j];
                var plain = new RodShape(1);
                RodStep.ApplyStraight(one, new[] { direction[j], direction[j + 1] }, 0.7, plain);
                AssertSame(moved, plain, j, 1);
            }
        }

        [Test]
        public void Elimination_HasTheBitsOfPlainNumbers([ValueSource(nameof(Angles))] double angle,
            [Values(1e-3, 1.0)] double stageLength)
        {
            // 37 blocks are taken in two pieces; a long stage at large angles has negative pivots.
            MaterialRod rod = Rods.Wire(N);
            var supports = new RodSupports { Proximal = ProximalEnd.Free };
            InertiaEnergy inertia = Inertia(rod, angle, out RodShape shape);
            inertia.StageLength = stageLength;
            var terms = new EnergyTerm[]
            {
                new StretchEnergy(rod), new BendTwistEnergy<RotationVectorLaw>(rod.Joints(supports), false, false),
                inertia,
            };
            var system = new BlockTridiagonal(rod, supports);
            var y = new RodVector[system.VectorCount];
            int negative = system.Factorise(terms, shape, new RodVector[system.VectorCount], y, 0.0);

            var blocks = new RodBlock[N + 2];
            var gradient = new RodVector[N + 2];
            var plain = new RodVector[N + 2];
            int plainNegative = 0;
            foreach ((int from, int to) in new[] { (0, 32), (32, N + 1) })
            {
                foreach (EnergyTerm term in terms)
                {
                    term.AddBlocks(shape, blocks, gradient, from, to);
                }
                if (to == N + 1)
                {
                    HoldPlaceHolder(blocks, gradient);
                }
                for (int i = from; i < to; i++)
                {
                    RodVector g = gradient[i];
                    plain[i].X1 -= g.X1;
                    plain[i].X2 -= g.X2;
                    plain[i].X3 -= g.X3;
                    plain[i].T1 -= g.T1;
                    plain[i].T2 -= g.T2;
                    plain[i].T3 -= g.T3;
                }
                for (int i = from; i < to; i++)
                {
                    plainNegative += BlockElimination.Eliminate(ref blocks[i], ref blocks[i + 1], ref plain[i],
                        ref plain[i + 1]);
                }
            }
            Assert.That(negative, Is.EqualTo(plainNegative));
            AssertSame(y, plain);
            system.Back(y);
            Back(blocks, plain);
            AssertSame(y, plain);
            var kept = new RodVector[N + 2];
            var plainKept = new RodVector[N + 2];
            Array.Copy(Direction(angle), kept, N + 1);
            kept[N].T1 = kept[N].T2 = kept[N].T3 = 0.0;
            Array.Copy(kept, plainKept, N + 2);
            system.Solve(kept);
            for (int i = 0; i <= N; i++)
            {
                BlockElimination.Forward(blocks[i], ref plainKept[i], ref plainKept[i + 1]);
            }
            Back(blocks, plainKept);
            AssertSame(kept, plainKept);
        }

        // The last theta belongs to no element.
        private static void HoldPlaceHolder(RodBlock[] blocks, RodVector[] gradient)
        {
            ref RodBlock b = ref blocks[N - 1];
            b.F11 = b.F12 = b.F13 = b.F21 = b.F22 = b.F23 = b.F31 = b.F32 = b.F33 = 0.0;
            blocks[N].C11 = blocks[N].C22 = blocks[N].C33 = 1.0;
            gradient[N].T1 = gradient[N].T2 = gradient[N].T3 = 0.0;
        }

        private static void Back(RodBlock[] blocks, RodVector[] y)
        {
            y[N + 1] = default;
            for (int i = N; i >= 0; i--)
            {
                BlockElimination.Backward(blocks[i], ref y[i], y[i + 1]);
            }
        }

        private static EnergyTerm Create(string name, double angle, out RodShape shape)
        {
            MaterialRod rod = Rods.Wire(N);
            rod.BendStiffness2[9] *= 1.5;
            for (int j = 0; j < N; j++)
            {
                rod.Length[j] *= 1.0 + 0.01 * j;
                rod.RestCurvature[j] = new Vector3d(0.2, -0.4, 0.3);
            }
            var supports = new RodSupports { Distal = DistalEnd.Clamped, Clamp = ClampRule.HalfElement };
            EnergyTerm term = Inertia(rod, angle, out shape);
            if (name.EndsWith("stretch", StringComparison.Ordinal))
            {
                term = new StretchEnergy(rod);
            }
            else if (name.EndsWith("bend-twist", StringComparison.Ordinal))
            {
                term = new BendTwistEnergy<RotationVectorLaw>(rod.Joints(supports), true, true);
            }
            term.DropGeometricStiffness(name.StartsWith("stiffened", StringComparison.Ordinal));
            return term;
        }

        private static InertiaEnergy Inertia(MaterialRod rod, double angle, out RodShape shape)
        {
            var inertia = new InertiaEnergy(new RodMass(rod, MassRule.Consistent))
            {
                StageLength = StageLength,
                TurnDamping = 0.3,
            };
            RodShape start = Rods.Random(rod, 0.5, 0.1, 5);
            inertia.BeginStep(start, 1.0);
            inertia.FreePositions[2] = new Vector3d(0.1, 0.2, 0.3);
            inertia.SpinHistory[1] = new Vector3d(0.4, -0.2, 0.1);
            inertia.TurnHistory[3] = new Vector3d(0.1, -0.2, 0.1);
            shape = Rods.Random(rod, angle, 0.1, 5);
            for (int j = 0; j < N; j++)
            {
                inertia.Start[j] = shape.Q[j];
            }
            shape = Turned(shape, angle, 6);
            return inertia;
        }

        // About each element's own axes, by up to the angle.
        private static RodShape Turned(RodShape shape, double angle, int seed)
        {
            var random = new Random(seed);
            RodShape turned = Rods.Copy(shape);
            for (int j = 0; j < N; j++)
            {
                turned.Q[j] = Quaterniond.Normalize(
                    shape.Q[j] * RotationVector.Exp((0.3 * angle) * Wires.Any(random)));
            }
            return turned;
        }

        private static RodVector[] Direction(double angle)
        {
            var random = new Random(4);
            var direction = new RodVector[N + 2];
            for (int j = 0; j <= N; j++)
            {
                Vector3d t = angle * Wires.Any(random);
                Vector3d x = 0.01 * Wires.Any(random);
                direction[j] = new RodVector { X1 = x.X, X2 = x.Y, X3 = x.Z, T1 = t.X, T2 = t.Y, T3 = t.Z };
            }
            return direction;
        }

        private static RodVector[] PlainGradient(EnergyTerm term, RodShape shape, out GradientMeasures measured)
        {
            var gradient = new RodVector[N + 2];
            measured = default;
            for (int i = 0; i <= N; i++)
            {
                term.AddGradient(shape, gradient, i, i + 1, ref measured);
            }
            return gradient;
        }

        private static void AssertSame(RodVector[] actual, RodVector[] expected) =>
            Assert.That(Bits(actual), Is.EqualTo(Bits(expected)));

        private static void AssertSame(RodShape actual, RodShape expected, int first, int count)
        {
            Assert.That(actual.X.Skip(first).Take(count + 1), Is.EqualTo(expected.X));
            Assert.That(actual.Q.Skip(first).Take(count), Is.EqualTo(expected.Q));
        }

        private static long[] Bits<T>(T[] values)
            where T : struct
        {
            var bits = new long[values.Length * Marshal.SizeOf<T>() / sizeof(long)];
            GCHandle pinned = GCHandle.Alloc(values, GCHandleType.Pinned);
            try
            {
                Marshal.Copy(pinned.AddrOfPinnedObject(), bits, 0, bits.Length);
            }
            finally
            {
                pinned.Free();
            }
            return bits;
        }
    }
}
