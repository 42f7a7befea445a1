using System.Runtime.CompilerServices;
using System;

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
}
