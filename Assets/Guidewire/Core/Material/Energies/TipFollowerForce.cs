namespace Guidewire.Core
{
    /// <summary>A force on the last node that turns with the last element: constant along the element's own axes.
    /// </summary>
    /// <remarks>F = R f has no potential, not even in a plane: its work depends on the path. It enters by its work on
    /// the straight path since the anchor, -1/2 (F_anchor + F) . (x - x_anchor), whose second derivative at the anchor
    /// is the symmetric half of the true tangent, d(-F)/dtheta = R [f]: half of it on (x, theta), half on (theta, x).
    /// The other half, R [f]/2 less its transpose, belongs to no energy: rest shapes add it exactly (<see
    /// cref="FollowerTangent"/>); the stages of a motion leave it out of the matrix, since Newton's method evaluates
    /// the force anew in each iterate and ends by the residual force.</remarks>
    internal sealed class TipFollowerForce : EnergyTerm
    {
        private Vector3d _anchorPosition;
        private Vector3d _anchorForce;

        /// <summary>f along the axes of the last element, N.</summary>
        public Vector3d Force { get; set; }

        /// <summary>Whether the force changes in time, so that it is one also where it is 0 now.</summary>
        public bool Varies { get; set; }

        /// <summary>True of no force.</summary>
        public override bool HasPotential => Force == Vector3d.Zero && !Varies;

        /// <summary>Gives 0: no work yet.</summary>
        public override double AnchoredValue(double before) => 0.0;

        /// <inheritdoc/>
        public override void Anchor(RodShape shape)
        {
            _anchorPosition = shape.X[shape.ElementCount];
            _anchorForce = Along(shape);
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            if (Force == Vector3d.Zero)
            {
                return 0.0;
            }
            return -0.5 * Vector3d.Dot(_anchorForce + Along(shape), shape.X[shape.ElementCount] - _anchorPosition);
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            int end = shape.ElementCount;
            if (from <= end && end < to && Force != Vector3d.Zero)
            {
                Vector3d force = Along(shape);
                gradient[end].AddX(-force);
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            base.AddBlocks(shape, blocks, gradient, from, to);
            int last = shape.ElementCount - 1;
            if (from <= last && last < to && Force != Vector3d.Zero)
            {
                HalfTangent(shape, out Vector3d first, out Vector3d second, out Vector3d third);
                ref RodBlock b = ref blocks[last];
                b.E11 += first.X; b.E21 += first.Y; b.E31 += first.Z;
                b.E12 += second.X; b.E22 += second.Y; b.E32 += second.Z;
                b.E13 += third.X; b.E23 += third.Y; b.E33 += third.Z;
            }
        }

        /// <summary>Gives the columns of R [f]/2: R (f x e_k)/2.</summary>
        public void HalfTangent(RodShape shape, out Vector3d first, out Vector3d second, out Vector3d third)
        {
            Quaterniond q = shape.Q[shape.ElementCount - 1];
            first = Quaterniond.Rotate(q, 0.5 * Vector3d.Cross(Force, Vector3d.UnitX));
            second = Quaterniond.Rotate(q, 0.5 * Vector3d.Cross(Force, Vector3d.UnitY));
            third = Quaterniond.Rotate(q, 0.5 * Vector3d.Cross(Force, Vector3d.UnitZ));
        }

        private Vector3d Along(RodShape shape) => Quaterniond.Rotate(shape.Q[shape.ElementCount - 1], Force);
    }
}
