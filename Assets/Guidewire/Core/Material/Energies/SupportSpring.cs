namespace Guidewire.Core
{
    /// <summary>A stiff spring between node 0 and the place where its support has it, 1/2 k |x_0 - p|^2: between walls
    /// the support's motion is then part of the energy that a step minimises.</summary>
    /// <remarks>k = 10 EA/l of the first element: a push that would buckle the wire moves node 0 off its place by less
    /// than a ten thousandth of the wire's radius.</remarks>
    internal sealed class SupportSpring : EnergyTerm
    {
        private const double OverAxialSpring = 10.0;
        private readonly double _stiffness;  // N/m

        /// <summary>The spring of a rod, without force.</summary>
        public SupportSpring(MaterialRod rod)
        {
            _stiffness = OverAxialSpring * rod.StretchStiffness[0] / rod.Length[0];
        }

        /// <summary>p, m.</summary>
        public Vector3d Place { get; set; }

        /// <summary>Force of the support on node 0, N.</summary>
        public Vector3d Force(RodShape shape)
        {
            return _stiffness * (Place - shape.X[0]);
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            return 0.5 * _stiffness * (shape.X[0] - Place).LengthSquared;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            if (from == 0)
            {
                Vector3d force = Force(shape);
                gradient[0].X1 -= force.X;
                gradient[0].X2 -= force.Y;
                gradient[0].X3 -= force.Z;
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            var measured = default(GradientMeasures);
            AddGradient(shape, gradient, from, to, ref measured);
            if (from == 0)
            {
                blocks[0].A11 += _stiffness;
                blocks[0].A22 += _stiffness;
                blocks[0].A33 += _stiffness;
            }
        }

        /// <inheritdoc/>
        public override void Exchange(Snapshot snapshot)
        {
            Place = snapshot.Exchange(Place);
        }
    }
}
