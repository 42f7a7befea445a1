using System;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace Guidewire.Core
{
    /// <summary>One part of the energy that a rod's shape minimises: its value, its gradient and its second
    /// derivatives by blocks. Derivatives are taken along x_i + dx and q_j exp(dtheta_j), with dtheta along the
    /// element's own axes.</summary>
    /// <remarks>A term may couple x_i, theta_i, x_(i+1) and theta_i, theta_(i+1), so that the matrix stays
    /// block-tridiagonal: stretch, bending, weight, inertia; a sphere's contact touches one A block, an element's
    /// contact x_i and x_(i+1). Terms work on ranges, so that a long rod is assembled and eliminated while its blocks
    /// are in the cache. What only some terms need has a neutral default here. A load without a potential (a couple or
    /// a force that turns with the tip) is entered by its work since <see cref="Anchor"/>.</remarks>
    internal abstract class EnergyTerm
    {
        /// <summary>Whether the value is a true energy, the same on every path to a shape.</summary>
        public virtual bool HasPotential => true;

        /// <summary>Whether the value is energy that rod and loads have; else only its slope counts, a force.</summary>
        public virtual bool StoresEnergy => true;

        /// <summary>Gives the energy in J of the whole rod in this shape.</summary>
        public abstract double Value(RodShape shape);

        /// <summary>Of the value, J, what the shape stores.</summary>
        public virtual double Stored(RodShape shape) => Value(shape);

        /// <summary>Adds the gradient of what belongs to indices from (inclusive) to to (exclusive).</summary>
        /// <param name="measured">Takes what the term finds in passing.</param>
        public abstract void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured);

        /// <summary>Adds the gradient of the whole rod.</summary>
        public void AddGradient(RodShape shape, RodVector[] gradient)
        {
            var measured = default(GradientMeasures);
            AddGradient(shape, gradient, 0, shape.ElementCount + 1, ref measured);
        }

        /// <summary>Adds gradient and second derivatives of what belongs to indices from (inclusive) to to (exclusive).
        /// Only blocks from .. to are touched, the last by what its predecessor leaves on it. Without an override the
        /// second derivatives are 0.</summary>
        public virtual void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            var measured = default(GradientMeasures);
            AddGradient(shape, gradient, from, to, ref measured);
        }

        /// <summary>Adds the second derivatives by the twist angles from (inclusive) to to (exclusive) of an instrument
        /// inside; their gradient is added with that of the rest. Called after <see cref="AddBlocks"/> with the same
        /// indices.</summary>
        public virtual void AddTwistRows(RodShape shape, TwistRow[] rows, int from, int to)
        {
        }

        /// <summary>Adds second derivatives between elements that are not neighbours, as columns. Called before
        /// <see cref="AddBlocks"/>.</summary>
        public virtual void AddColumns(RodShape shape, LowRank columns)
        {
        }

        /// <summary>The value in the shape in which the term was anchored last, J, after it was asked for the value
        /// there.</summary>
        /// <param name="before">That value.</param>
        public virtual double AnchoredValue(double before) => before;

        /// <summary>Takes this shape as the point from which work is counted; nothing to do for a true
        /// energy.</summary>
        public virtual void Anchor(RodShape shape)
        {
        }

        /// <summary>Whether <see cref="AddBlocks"/> is to leave out of the second derivatives what goes with a force
        /// and need not be positive: far from balance such forces need not be there.</summary>
        public virtual void DropGeometricStiffness(bool isOn)
        {
        }

        /// <summary>The rod has other elements, and the term is as it is made.</summary>
        public virtual void Remesh()
        {
        }

        /// <summary>Sets what is prescribed at this time, s: a target that moves, a load that grows. Called before each
        /// stage, and before the forces of each explicit or compliant substep.</summary>
        public virtual void SetTime(double time)
        {
        }

        /// <summary>A step of dt (s) begins in this shape: a term stores of it what it needs until the step's end.
        /// Called by motions with implicit stages.</summary>
        public virtual void BeginStep(RodShape shape, double dt)
        {
        }

        /// <summary>The step that began last is accepted, and ends in this shape.</summary>
        public virtual void EndStep(RodShape shape)
        {
        }

        /// <summary>How far a step may go: the largest fraction, above 0 and at most 1, of <paramref name="scale"/>
        /// times <paramref name="direction"/> that leaves the term's energy finite on the whole path, which is that of
        /// <see cref="RodStep.Apply"/>.</summary>
        public virtual double MaxStep(RodShape shape, RodVector[] direction, double scale) => 1.0;

        /// <summary>Writes into a snapshot, or restores from one, the term's state between steps.</summary>
        public virtual void Serialize(Snapshot snapshot)
        {
        }
    }

    /// <summary>Quantities that the terms measure while they add their gradients, combined over all terms and
    /// ranges.</summary>
    internal struct GradientMeasures
    {
        /// <summary>The largest force in an element, N.</summary>
        public double LargestForce;

        /// <summary>Takes in the largest force that one term found in one range, N.</summary>
        public void IncludeForce(double force) => LargestForce = Math.Max(LargestForce, force);
    }

    /// <summary>The block of one node and the element after it in a symmetric matrix over (x_0, theta_0, x_1, theta_1,
    /// ...): 48 numbers, six lines of cache, column by column of the matrix from its diagonal down.</summary>
    /// <remarks>A = (x, x), B = (theta, x), C = (theta, theta), and against the next node
    /// D = (x+, x), E = (x+, theta), F = (theta+, theta). Row index first; of A and C the lower triangle. The pair
    /// (theta+, x) does not occur: a node's position acts on the elements at its two sides only.</remarks>
    [StructLayout(LayoutKind.Sequential)]
    internal struct RodBlock
    {
        public double A11, A21, A31, B11, B21, B31, D11, D21, D31;
        public double A22, A32, B12, B22, B32, D12, D22, D32;
        public double A33, B13, B23, B33, D13, D23, D33;
        public double C11, C21, C31, E11, E21, E31, F11, F21, F31;
        public double C22, C32, E12, E22, E32, F12, F22, F32;
        public double C33, E13, E23, E33, F13, F23, F33;

        /// <summary>Adds a stiffness h against motions of the point at s of an element, from 0 at its node to 1 at the
        /// next.</summary>
        public static void AddAt(ref RodBlock node, ref RodBlock next, double s, in Symmetric3 h)
        {
            double r = 1.0 - s;
            node.A11 += r * r * h.A11; node.A21 += r * r * h.A21; node.A22 += r * r * h.A22;
            node.A31 += r * r * h.A31; node.A32 += r * r * h.A32; node.A33 += r * r * h.A33;
            next.A11 += s * s * h.A11; next.A21 += s * s * h.A21; next.A22 += s * s * h.A22;
            next.A31 += s * s * h.A31; next.A32 += s * s * h.A32; next.A33 += s * s * h.A33;
            double m = r * s;
            node.D11 += m * h.A11; node.D12 += m * h.A21; node.D13 += m * h.A31;
            node.D21 += m * h.A21; node.D22 += m * h.A22; node.D23 += m * h.A32;
            node.D31 += m * h.A31; node.D32 += m * h.A32; node.D33 += m * h.A33;
        }
    }

    /// <summary>The spring between two frames: its stiffness EI/(w l) about d1 and about d2 and GJ/(w l) about d3 in
    /// N m, and its rotation vector at rest, w l times the rest curvature. w is the joint's weight, 1 away from the
    /// clamps.</summary>
    internal struct Joint
    {
        public double Bend1;
        public double Bend2;
        public double Twist;
        public Vector3d Rest;
    }

    /// <summary>Sums over a list of energy terms: value, gradient, blocks, largest step.</summary>
    internal static class EnergySum
    {
        /// <summary>Gives the sum of the energies, J.</summary>
        /// <param name="magnitude">Sum of their magnitudes, J: what rounding goes with.</param>
        public static double Value(EnergyTerm[] terms, RodShape shape, out double magnitude)
        {
            double sum = 0.0;
            magnitude = 0.0;
            foreach (EnergyTerm term in terms)
            {
                double value = term.Value(shape);
                sum += value;
                magnitude += Math.Abs(value);
            }
            return sum;
        }

        /// <summary>Gives the sum of the terms' energies, J, and each of them.</summary>
        /// <param name="values">Receives the energy of each term, J.</param>
        public static double Value(EnergyTerm[] terms, RodShape shape, double[] values, out double magnitude)
        {
            for (int k = 0; k < terms.Length; k++)
            {
                values[k] = terms[k].Value(shape);
            }
            return Sum(values, out magnitude);
        }

        /// <summary>Gives the sum of the terms' energies, J, after every term was anchored in their shape.</summary>
        public static double AnchoredValue(EnergyTerm[] terms, double[] values, out double magnitude)
        {
            for (int k = 0; k < terms.Length; k++)
            {
                values[k] = terms[k].AnchoredValue(values[k]);
            }
            return Sum(values, out magnitude);
        }

        private static double Sum(double[] values, out double magnitude)
        {
            double sum = 0.0;
            magnitude = 0.0;
            foreach (double value in values)
            {
                sum += value;
                magnitude += Math.Abs(value);
            }
            return sum;
        }

        /// <summary>Every term counts work from this shape on.</summary>
        public static void Anchor(EnergyTerm[] terms, RodShape shape)
        {
            foreach (EnergyTerm term in terms)
            {
                term.Anchor(shape);
            }
        }

        /// <summary>Second derivatives with or without what need not be positive.</summary>
        public static void DropGeometricStiffness(EnergyTerm[] terms, bool isOn)
        {
            foreach (EnergyTerm term in terms)
            {
                term.DropGeometricStiffness(isOn);
            }
        }

        /// <summary>Gives the largest fraction of a step, at most 1, that no term forbids.</summary>
        public static double MaxStep(EnergyTerm[] terms, RodShape shape, RodVector[] direction, double scale)
        {
            double fraction = 1.0;
            foreach (EnergyTerm term in terms)
            {
                fraction = Math.Min(fraction, term.MaxStep(shape, direction, scale));
            }
            return fraction;
        }
    }

    /// <summary>Six numbers of one node and the element after it: X along the world's axes (a displacement in m or a
    /// force in N), T along the element's own axes (a turn in radians or a couple in N m).</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct RodVector
    {
        public double X1, X2, X3;
        public double T1, T2, T3;

        /// <summary>Makes one of both.</summary>
        public RodVector(in Vector3d x, in Vector3d t)
        {
            (X1, X2, X3) = (x.X, x.Y, x.Z);
            (T1, T2, T3) = (t.X, t.Y, t.Z);
        }

        /// <summary>X as a vector.</summary>
        public Vector3d X
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            readonly get => new Vector3d(X1, X2, X3);
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            set => (X1, X2, X3) = (value.X, value.Y, value.Z);
        }

        /// <summary>T as a vector.</summary>
        public readonly Vector3d T => new Vector3d(T1, T2, T3);

        /// <summary>Adds to X.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void AddX(in Vector3d x)
        {
            X1 += x.X;
            X2 += x.Y;
            X3 += x.Z;
        }

        /// <summary>Adds to T.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void AddT(in Vector3d t)
        {
            T1 += t.X;
            T2 += t.Y;
            T3 += t.Z;
        }

        /// <summary>Adds another one times a number.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public void AddScaled(double scale, in RodVector v)
        {
            X1 += scale * v.X1;
            X2 += scale * v.X2;
            X3 += scale * v.X3;
            T1 += scale * v.T1;
            T2 += scale * v.T2;
            T3 += scale * v.T3;
        }

        /// <summary>Takes the scalar product a . b.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static double Dot(in RodVector a, in RodVector b) =>
            a.X1 * b.X1 + a.X2 * b.X2 + a.X3 * b.X3 + a.T1 * b.T1 + a.T2 * b.T2 + a.T3 * b.T3;
    }
}
