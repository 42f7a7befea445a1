using System;
using System.Runtime.CompilerServices;
#if NET8_0_OR_GREATER
using System.Runtime.Intrinsics;
using System.Runtime.Intrinsics.X86;
#endif

namespace Guidewire.Core
{
    /// <summary>Moves a shape along a Newton direction so that strains, not positions, change linearly: q exp(a
    /// dtheta), the element's chord p + a dp with dp the direction's own change of p, positions summed up from node
    /// 0.</summary>
    /// <remarks>Moving positions along straight lines would stretch a turning element in second order, by EA times the
    /// angle squared, and a line search would have to creep. To first order both are the same step. Where the distal
    /// end is held, what the sum misses of its position, of second order too, is spread over the rod.</remarks>
    internal static class RodStep
    {
        /// <summary>Sets <paramref name="to"/>, which may be <paramref name="shape"/> itself, to
        /// <paramref name="shape"/> moved by <paramref name="scale"/> times <paramref name="direction"/>.</summary>
        public static void Apply(MaterialRod rod, RodSupports supports, RodShape shape, RodVector[] direction,
            double scale, RodShape to)
        {
            int n = rod.ElementCount;
            to.ProximalFrame = shape.ProximalFrame;
            to.DistalFrame = shape.DistalFrame;
            Vector3d x = shape.X[0] + Move(direction[0], scale);
            Vector3d old = shape.X[0];
            to.X[0] = x;
            int j = 0;
            while (j < n)
            {
                int stop = Math.Min(j + 4, n);
                if (stop == j + 4 && StepLanes.Apply(shape, direction, scale, to, j, ref old, ref x))
                {
                    j = stop;
                }
                for (; j < stop; j++)
                {
                    MoveElement(shape, direction, scale, to, j, ref old, ref x);
                }
            }
            ApplyBeyond(shape, direction, scale, to);
            if (supports.Distal != DistalEnd.Free)
            {
                Close(supports, to, old + Move(direction[n], scale));
            }
        }

        /// <summary>Moves element j and the node after it, as part of <see cref="Apply"/>.</summary>
        /// <param name="old">In and out: the last node before the step, m.</param>
        /// <param name="x">In and out: the last node after it.</param>
        public static void MoveElement(RodShape shape, RodVector[] direction, double scale, RodShape to, int j,
            ref Vector3d old, ref Vector3d x)
        {
            RodVector d = direction[j];
            Vector3d turn = scale * d.T;
            Vector3d nextOld = shape.X[j + 1];
            Quaterniond q = shape.Q[j];
            Quaterniond inverse = q.Conjugate;
            Vector3d chord = Quaterniond.Rotate(inverse, nextOld - old);
            Vector3d changed = chord
                + Quaterniond.Rotate(inverse, Move(direction[j + 1], scale) - Move(d, scale))
                + Vector3d.Cross(chord, turn);
            q = q * RotationVector.Exp(turn);
            q = (1.5 - 0.5 * q.LengthSquared) * q;
            to.Q[j] = q;
            x += Quaterniond.Rotate(q, changed);
            to.X[j + 1] = x;
            old = nextOld;
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector3d Move(in RodVector d, double scale) => scale * d.X;

        /// <summary>The same with positions on straight lines, on which gaps to walls are bounded
        /// (<see cref="BarrierEnergy"/>).</summary>
        public static void ApplyStraight(RodShape shape, RodVector[] direction, double scale, RodShape to)
        {
            int n = shape.ElementCount;
            to.ProximalFrame = shape.ProximalFrame;
            to.DistalFrame = shape.DistalFrame;
            int j = 0;
            while (j < n)
            {
                int stop = Math.Min(j + 4, n);
                if (stop == j + 4 && StepLanes.ApplyStraight(shape, direction, scale, to, j))
                {
                    j = stop;
                }
                for (; j < stop; j++)
                {
                    RodVector d = direction[j];
                    to.X[j] = shape.X[j] + Move(d, scale);
                    Quaterniond q = shape.Q[j]
                        * RotationVector.Exp(scale * d.T);
                    to.Q[j] = (1.5 - 0.5 * q.LengthSquared) * q;
                }
            }
            to.X[n] = shape.X[n] + Move(direction[n], scale);
            ApplyBeyond(shape, direction, scale, to);
        }

        // The angles stand behind the n + 2 vectors of nodes and elements (BlockTridiagonal), and displacements of a
        // vessel behind them.
        private static void ApplyBeyond(RodShape shape, RodVector[] direction, double scale, RodShape to)
        {
            int n = shape.ElementCount;
            for (int j = 0; j < shape.TwistCount; j++)
            {
                double turn = j < n ? direction[n + 2 + j].T3 : direction[2 + j].T2;
                to.Twist[j] = shape.Twist[j] + scale * turn;
            }
            to.TakeVessel(shape);
            for (int k = 0; k < to.Vessel.Length; k++)
            {
                to.Vessel[k] += scale * direction[shape.VesselStart + k].X;
            }
        }

        /// <summary>Rotates the elements of a shape and chains them end to end from node 0, each with the strain
        /// that it has along its own axes.</summary>
        /// <param name="orientations">The elements' new orientations.</param>
        /// <param name="start">New position of node 0.</param>
        /// <param name="end">Where the last node is held, if it is.</param>
        public static void PlaceElements(RodSupports supports, RodShape shape, Quaterniond[] orientations,
            in Vector3d start, in Vector3d end)
        {
            Vector3d x = start;
            Vector3d old = shape.X[0];
            shape.X[0] = x;
            for (int j = 0; j < shape.ElementCount; j++)
            {
                Quaterniond q = orientations[j];
                Vector3d next = shape.X[j + 1];
                x += Quaterniond.Rotate(q, Quaterniond.Rotate(shape.Q[j].Conjugate, next - old));
                shape.Q[j] = q;
                shape.X[j + 1] = x;
                old = next;
            }
            if (supports.Distal != DistalEnd.Free)
            {
                Close(supports, shape, end);
            }
        }

        /// <summary>Spreads over the rod what the last node misses of the position where it is held.</summary>
        private static void Close(RodSupports supports, RodShape shape, in Vector3d end)
        {
            int n = shape.ElementCount;
            Vector3d miss = end - shape.X[n];
            if (supports.Distal == DistalEnd.Sliding)
            {
                miss -= Vector3d.Dot(miss, supports.SlidingAxis) * supports.SlidingAxis;
            }
            for (int i = 1; i <= n; i++)
            {
                shape.X[i] += ((double)i / n) * miss;
            }
        }

        /// <summary>Gives the size of a direction: the largest turn of an element in radians or shift of a node over
        /// L.</summary>
        /// <param name="relative">The largest difference between the turns of two successive elements, radians.</param>
        /// <param name="count">Vectors of the direction that count.</param>
        public static double Size(RodVector[] direction, int elementCount, double length, out double relative,
            int count = int.MaxValue)
        {
            double turn = 0.0;
            double shift = 0.0;
            double difference = 0.0;
            for (int j = 0; j <= elementCount; j++)
            {
                RodVector d = direction[j];
                shift = Math.Max(shift, d.X1 * d.X1 + d.X2 * d.X2 + d.X3 * d.X3);
                turn = Math.Max(turn, d.T1 * d.T1 + d.T2 * d.T2 + d.T3 * d.T3);
                if (j > 0 && j < elementCount)
                {
                    RodVector e = direction[j - 1];
                    double a = d.T1 - e.T1;
                    double b = d.T2 - e.T2;
                    double c = d.T3 - e.T3;
                    difference = Math.Max(difference, a * a + b * b + c * c);
                }
            }
            for (int j = elementCount + 2; j < Math.Min(count, direction.Length); j++)
            {
                shift = Math.Max(shift, direction[j].X.LengthSquared);
                turn = Math.Max(turn, direction[j].T3 * direction[j].T3);
                turn = Math.Max(turn, direction[j].T2 * direction[j].T2);
            }
            relative = Math.Sqrt(difference);
            return Math.Max(Math.Sqrt(turn), Math.Sqrt(shift) / length);
        }
    }

    /// <summary><see cref="RodStep"/> for four successive elements at once, with its formulas in its order: the same
    /// bits. False where nothing is done, because a rotation exceeds the range of the series or the processor lacks
    /// such registers.</summary>
    internal static class StepLanes
    {
#if NET8_0_OR_GREATER
        private const int Stride = 6;   // numbers of a RodVector
#endif

        /// <summary>Moves elements j to j+3 and the nodes after them so that strains change linearly.</summary>
        /// <param name="old">In and out: the last node before the step, m.</param>
        /// <param name="x">In and out: the last node after it.</param>
        public static bool Apply(RodShape shape, RodVector[] direction, double scale, RodShape to, int j,
            ref Vector3d old, ref Vector3d x)
        {
#if NET8_0_OR_GREATER
            if (!TryLoad(direction, scale, j, out Vector3d4 move, out Vector3d4 turn, out Quaterniond4 rotation))
            {
                return false;
            }
            Vector3d4 nextMove = Next(move, scale, direction[j + 4]);
            Vector3d4 nextOld = Vector3d4.Load(ref shape.X[j + 1]);
            Vector3d4 chord = nextOld - Before(nextOld, old);
            old = shape.X[j + 4];
            Quaterniond4 q = Quaterniond4.Load(ref shape.Q[j]);
            Quaterniond4 inverse = q.Conjugate;
            Vector3d4 straight = Quaterniond4.Rotate(inverse, chord);
            Vector3d4 changed = straight + Quaterniond4.Rotate(inverse, nextMove - move)
                + Vector3d4.Cross(straight, turn);
            q = Quaterniond4.NearlyNormalized(q * rotation);
            q.Store(ref to.Q[j]);
            Vector3d4 along = Quaterniond4.Rotate(q, changed);
            double px = x.X, py = x.Y, pz = x.Z;
            for (int k = 0; k < 4; k++)
            {
                px += along.X.GetElement(k);
                py += along.Y.GetElement(k);
                pz += along.Z.GetElement(k);
                to.X[j + 1 + k] = new Vector3d(px, py, pz);
            }
            x = new Vector3d(px, py, pz);
            return true;
#else
            return false;
#endif
        }

        /// <summary>Moves nodes and elements j to j+3 on straight lines.</summary>
        public static bool ApplyStraight(RodShape shape, RodVector[] direction, double scale, RodShape to, int j)
        {
#if NET8_0_OR_GREATER
            if (!TryLoad(direction, scale, j, out Vector3d4 move, out _, out Quaterniond4 rotation))
            {
                return false;
            }
            (Vector3d4.Load(ref shape.X[j]) + move).Store(ref to.X[j]);
            Quaterniond4.NearlyNormalized(Quaterniond4.Load(ref shape.Q[j]) * rotation).Store(ref to.Q[j]);
            return true;
#else
            return false;
#endif
        }

#if NET8_0_OR_GREATER
        // Moves of nodes j to j+3, turns of elements j to j+3 as vectors and as rotations.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static bool TryLoad(RodVector[] direction, double scale, int j, out Vector3d4 move, out Vector3d4 turn,
            out Quaterniond4 rotation)
        {
            if (!Rows4.IsSupported)
            {
                move = default;
                turn = default;
                rotation = default;
                return false;
            }
            Vector256<double> s = Vector256.Create(scale);
            Rows4.Load(ref direction[j].X1, Stride, out Vector256<double> x1, out Vector256<double> x2,
                out Vector256<double> x3, out Vector256<double> t1);
            Rows4.Load(ref direction[j].T2, Stride, out Vector256<double> t2, out Vector256<double> t3);
            move = s * new Vector3d4(x1, x2, x3);
            turn = s * new Vector3d4(t1, t2, t3);
            return RotationVector4.TryExp(turn, out rotation);
        }

        // Each lane's vector in the lane after it, the entering one in lane 0.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector3d4 Before(Vector3d4 v, in Vector3d entering) =>
            new Vector3d4(Before(v.X, entering.X), Before(v.Y, entering.Y), Before(v.Z, entering.Z));

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector256<double> Before(Vector256<double> v, double entering) =>
            Avx.Blend(Avx2.Permute4x64(v, 0b10_01_00_00), Vector256.Create(entering), 0b0001);

        // Each lane's move in the lane before it, that of the direction in lane 3.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector3d4 Next(Vector3d4 v, double scale, in RodVector last) =>
            new Vector3d4(Next(v.X, scale * last.X1), Next(v.Y, scale * last.X2), Next(v.Z, scale * last.X3));

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static Vector256<double> Next(Vector256<double> v, double entering) =>
            Avx.Blend(Avx2.Permute4x64(v, 0b11_11_10_01), Vector256.Create(entering), 0b1000);
#endif
    }

    /// <summary>Sums over whole vectors of a rod.</summary>
    internal static class RodVectors
    {
        /// <summary>Takes the scalar product a . b, of the first vectors or of all.</summary>
        public static double Dot(RodVector[] a, RodVector[] b, int count = int.MaxValue)
        {
            double sum = 0.0;
            for (int i = 0; i < Math.Min(count, a.Length); i++)
            {
                sum += RodVector.Dot(a[i], b[i]);
            }
            return sum;
        }

        /// <summary>Gives the largest sum of the forces on nodes 0 to k, over all k.</summary>
        /// <param name="count">Vectors that count.</param>
        /// <param name="couples">Sum of the magnitudes of all components of the couples.</param>
        public static double LargestPartialForce(RodVector[] v, int count, out double couples)
        {
            double x = 0.0;
            double y = 0.0;
            double z = 0.0;
            double largest = 0.0;
            couples = 0.0;
            for (int i = 0; i < count; i++)
            {
                x += v[i].X1;
                y += v[i].X2;
                z += v[i].X3;
                largest = Math.Max(largest, x * x + y * y + z * z);
                couples += Math.Abs(v[i].T1) + Math.Abs(v[i].T2) + Math.Abs(v[i].T3);
            }
            return Math.Sqrt(largest);
        }

        /// <summary>Adds: to += scale v.</summary>
        public static void AddScaled(RodVector[] to, double scale, RodVector[] v)
        {
            for (int i = 0; i < to.Length; i++)
            {
                to[i].AddScaled(scale, v[i]);
            }
        }

        /// <summary>Multiplies in place: v *= scale.</summary>
        public static void Scale(RodVector[] v, double scale)
        {
            for (int i = 0; i < v.Length; i++)
            {
                v[i].X1 *= scale;
                v[i].X2 *= scale;
                v[i].X3 *= scale;
                v[i].T1 *= scale;
                v[i].T2 *= scale;
                v[i].T3 *= scale;
            }
        }

        /// <summary>Gives the largest force of all nodes, or couple of all elements over a length.</summary>
        public static double Largest(RodVector[] v, double length)
        {
            double largest = 0.0;
            for (int i = 0; i < v.Length; i++)
            {
                double x = v[i].X1 * v[i].X1 + v[i].X2 * v[i].X2 + v[i].X3 * v[i].X3;
                double t = v[i].T1 * v[i].T1 + v[i].T2 * v[i].T2 + v[i].T3 * v[i].T3;
                largest = Math.Max(largest, Math.Max(x, t / (length * length)));
            }
            return Math.Sqrt(largest);
        }

        /// <summary>A fixed vector without symmetry, so that no mode of a rod is orthogonal to it.</summary>
        public static void SetWithoutSymmetry(RodVector[] v, double length)
        {
            for (int i = 0; i < v.Length; i++)
            {
                double a = Math.Sin(12.9898 * i + 1.0);
                v[i] = new RodVector
                {
                    X1 = a * length, X2 = (0.5 - a * a) * length, X3 = 0.3 * a * length,
                    T1 = Math.Sin(78.233 * i), T2 = Math.Cos(37.719 * i), T3 = 0.7 + a,
                };
            }
            v[v.Length - 1] = default;
        }
    }
}
