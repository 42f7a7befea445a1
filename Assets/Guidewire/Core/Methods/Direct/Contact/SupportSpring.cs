using System;

namespace Guidewire.Core
{
    /// <summary>A stiff spring between node 0 and the position of its support p, 1/2 k |x_0 - p|^2: between walls the
    /// support's motion is then part of the energy that a step minimises.</summary>
    /// <remarks>k = 10 EA/l of the first element: a force that would buckle the wire displaces node 0 by less than a
    /// ten thousandth of the wire's radius. A hub that slips at an axial force F has the same energy up to F and a
    /// straight line beyond: 1/2 k d^2 - 1/2 (|k d_a + b| - F)^2/k, d_a along the axis, b what the hub exerts
    /// besides. It slips by no more than a hand follows in a step, s; beyond that it is held again:
    /// 1/2 k d^2 - s (|k d_a + b| - F) + 1/2 k s^2.</remarks>
    internal sealed class SupportSpring : EnergyTerm
    {
        private const double OverAxialSpring = 10.0;
        private double _stiffness;           // N/m
        private double _axial;               // N/m
        private double _before;              // from the hub to node 0, at rest, m

        /// <summary>Makes the spring of a rod, without force.</summary>
        /// <param name="limit">The axial force at which the hub slips.</param>
        public SupportSpring(MaterialRod rod, in HubLimit limit)
        {
            Limit = limit;
            Hold(rod);
        }

        /// <summary>Holds a rod.</summary>
        /// <param name="all">EA of all at the hub over that of the rod.</param>
        public void Hold(MaterialRod rod, double all = 1.0)
        {
            _stiffness = all * OverAxialSpring * rod.StretchStiffness[0] / rod.Length[0];
            SetBefore(0.0, 0.0);
        }

        /// <summary>Sets what is between the hub and node 0 along the axis.</summary>
        /// <param name="length">At rest, m.</param>
        /// <param name="compliance">m/N.</param>
        public void SetBefore(double length, double compliance)
        {
            _axial = compliance > 0.0 ? 1.0 / (1.0 / _stiffness + compliance) : _stiffness;
            _before = length;
        }

        /// <summary>The axial force at which the hub slips.</summary>
        public HubLimit Limit { get; }

        /// <summary>How far the hub may slip back from its position, m.</summary>
        public double MostBack { get; set; } = double.PositiveInfinity;

        /// <summary>The same forward.</summary>
        public double MostForward { get; set; } = double.PositiveInfinity;

        /// <summary>The hub's axis, a unit vector, along which it slips.</summary>
        public Vector3d Axis { get; set; }

        /// <summary>b, the force that the hub exerts along the axis besides that of the spring, N.</summary>
        public double ReleaseForce { get; set; }

        /// <summary>p of the hub, m.</summary>
        public Vector3d Position { get; set; }

        /// <summary>Gives the force of the support on node 0, N.</summary>
        public Vector3d Force(RodShape shape)
        {
            Vector3d behind = Behind(shape);
            Vector3d force = _stiffness * behind;
            double less = _axial == _stiffness ? 0.0 : (_stiffness - _axial) * Vector3d.Dot(behind, Axis);
            less += Excess(shape);
            return less == 0.0 ? force : force - less * Axis;
        }

        /// <summary>Distance of node 0 behind its support on a spring that is soft along the axis, m; 0 on a stiff
        /// one.</summary>
        public Vector3d LagOf(RodShape shape) =>
            _axial == _stiffness ? Vector3d.Zero : Vector3d.Dot(Position - shape.X[0], Axis) * Axis;

        /// <summary>Where the hub has the wire, m: node 0, or the end of what is before it, as long as it is under the
        /// force.</summary>
        public Vector3d HeldPosition(RodShape shape) =>
            Position - (Vector3d.Dot(Force(shape), Axis) / _stiffness) * Axis;

        /// <summary>By how much along the axis, m, the support would have to move back for the axial force to be no
        /// more than the hub's.</summary>
        public double SlipOf(RodShape shape) => Excess(shape) / _axial;

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            Vector3d behind = Behind(shape);
            double value = _stiffness * behind.LengthSquared;
            if (_axial != _stiffness)
            {
                double along = Vector3d.Dot(behind, Axis);
                value -= (_stiffness - _axial) * along * along;
            }
            double excess = Excess(shape);
            return 0.5 * (value - excess * (2.0 * Limit.Excess(AxialForce(shape)) - excess) / _axial);
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            if (from == 0)
            {
                Vector3d force = Force(shape);
                gradient[0].AddX(-force);
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            base.AddBlocks(shape, blocks, gradient, from, to);
            if (from == 0)
            {
                blocks[0].A11 += _stiffness;
                blocks[0].A22 += _stiffness;
                blocks[0].A33 += _stiffness;
                double excess = Excess(shape);
                double less = excess != 0.0 && excess == Limit.Excess(AxialForce(shape)) ? _stiffness
                    : _stiffness - _axial;
                if (less != 0.0)
                {
                    blocks[0].A11 -= less * Axis.X * Axis.X;
                    blocks[0].A21 -= less * Axis.Y * Axis.X;
                    blocks[0].A22 -= less * Axis.Y * Axis.Y;
                    blocks[0].A31 -= less * Axis.Z * Axis.X;
                    blocks[0].A32 -= less * Axis.Z * Axis.Y;
                    blocks[0].A33 -= less * Axis.Z * Axis.Z;
                }
            }
        }

        // What node 0 is behind where it would be without force, m.
        private Vector3d Behind(RodShape shape) =>
            _before == 0.0 ? Position - shape.X[0] : Position + _before * Axis - shape.X[0];

        // Of a hub that does not slip, N.
        private double AxialForce(RodShape shape) => _axial * Vector3d.Dot(Behind(shape), Axis) + ReleaseForce;

        // Excess of the axial force over the limit, N, with its sign, as far as the hub slips.
        private double Excess(RodShape shape)
        {
            double excess = Limit.Excess(AxialForce(shape));
            return excess == 0.0 ? 0.0 : Math.Min(Math.Max(excess, -_axial * MostForward), _axial * MostBack);
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            Position = snapshot.Serialize(Position);
            ReleaseForce = snapshot.Serialize(ReleaseForce);
        }
    }
}
