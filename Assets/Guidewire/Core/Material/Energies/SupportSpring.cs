using System;

namespace Guidewire.Core
{
    /// <summary>A stiff spring between node 0 and the place where its support has it, 1/2 k |x_0 - p|^2: between walls
    /// the support's motion is then part of the energy that a step minimises.</summary>
    /// <remarks>k = 10 EA/l of the first element: a push that would buckle the wire moves node 0 off its place by less
    /// than a ten thousandth of the wire's radius. A hub that gives way at an axial force F has the same energy up to F
    /// and a straight line beyond: 1/2 k d^2 - 1/2 (k |d_a| - F)^2/k, d_a along the axis.</remarks>
    internal sealed class SupportSpring : EnergyTerm
    {
        private const double OverAxialSpring = 10.0;
        private readonly double _stiffness;  // N/m
        private readonly double _limit;      // N

        /// <summary>The spring of a rod, without force.</summary>
        /// <param name="limit">The axial force at which the hub gives way, N; 0: it never does.</param>
        public SupportSpring(MaterialRod rod, double limit)
        {
            _stiffness = OverAxialSpring * rod.StretchStiffness[0] / rod.Length[0];
            _limit = limit > 0.0 ? limit : double.PositiveInfinity;
        }

        /// <summary>The hub's axis, a unit vector, along which it gives way.</summary>
        public Vector3d Axis { get; set; }

        /// <summary>p, m.</summary>
        public Vector3d Place { get; set; }

        /// <summary>Force of the support on node 0, N.</summary>
        public Vector3d Force(RodShape shape)
        {
            Vector3d force = _stiffness * (Place - shape.X[0]);
            double excess = Excess(shape);
            return excess == 0.0 ? force : force - excess * Axis;
        }

        /// <summary>Takes the place back, once a step is done, to where the axial force is no more than the
        /// hub's.</summary>
        /// <returns>By how much along the axis, m.</returns>
        public double TakeSlip(RodShape shape)
        {
            double slip = Excess(shape) / _stiffness;
            Place -= slip * Axis;
            return slip;
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double excess = Excess(shape);
            return 0.5 * (_stiffness * (shape.X[0] - Place).LengthSquared - excess * excess / _stiffness);
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
                if (Excess(shape) != 0.0)
                {
                    blocks[0].A11 -= _stiffness * Axis.X * Axis.X;
                    blocks[0].A21 -= _stiffness * Axis.Y * Axis.X;
                    blocks[0].A22 -= _stiffness * Axis.Y * Axis.Y;
                    blocks[0].A31 -= _stiffness * Axis.Z * Axis.X;
                    blocks[0].A32 -= _stiffness * Axis.Z * Axis.Y;
                    blocks[0].A33 -= _stiffness * Axis.Z * Axis.Z;
                }
            }
        }

        // What the axial force would have beyond the limit, N, with its sign.
        private double Excess(RodShape shape)
        {
            double force = _stiffness * Vector3d.Dot(Place - shape.X[0], Axis);
            return Math.Abs(force) > _limit ? force - Math.Sign(force) * _limit : 0.0;
        }

        /// <inheritdoc/>
        public override void Exchange(Snapshot snapshot)
        {
            Place = snapshot.Exchange(Place);
        }
    }
}
