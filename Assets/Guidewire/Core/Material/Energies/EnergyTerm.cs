using System;
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
}
