using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Contact of the direct solver, as a term of the rod's energy.</summary>
    internal static class DirectContact
    {
        /// <summary>What walls add to the energy; null without walls. Only the direct solver adds such terms.</summary>
        public static WallTerms? Walls(this RodTerms terms) => (WallTerms?)terms.Contact;
    }

    /// <summary>The terms of walls in a wire's energy: their barriers, their friction, and the spring on which node 0
    /// then
    /// follows its support.</summary>
    internal sealed class WallTerms : ContactTerms
    {
        private readonly Func<string?>? _advice;
        private readonly VesselEnergy? _vessel;

        /// <summary>Makes those of a rod.</summary>
        /// <param name="friction">Null where no wall has friction.</param>
        /// <param name="holdsStart">Whether a support holds node 0.</param>
        /// <param name="advice">See <see cref="Advice"/>.</param>
        /// <param name="self">Contact of the wire with itself, with or without friction; null where it has
        /// none.</param>
        public WallTerms(BarrierEnergy barrier, FrictionEnergy? friction, SupportSpring spring, bool holdsStart,
            Func<string?>? advice = null, (SelfContact Contact, SelfFriction? Friction)? self = null)
        {
            _advice = advice;
            Barrier = barrier;
            Friction = friction;
            Spring = spring;
            HoldsStart = holdsStart;
            Self = self?.Contact;
            SelfFriction = self?.Friction;
            var all = new List<EnergyTerm> { barrier };
            if (friction != null)
            {
                all.Add(friction);
            }
            if (holdsStart)
            {
                all.Add(spring);
            }
            if (Self != null)
            {
                all.Add(Self);
            }
            if (SelfFriction != null)
            {
                all.Add(SelfFriction);
            }
            if (barrier.Fields.Beam is WallBeam beam)
            {
                _vessel = new VesselEnergy(beam);
                all.Add(_vessel);
            }
            All = all.ToArray();
        }

        /// <summary>Takes what friction and delays have left to a rod between the same walls: another one, or this
        /// one before its elements were others.</summary>
        /// <param name="node">What each node was there, -1 where it comes in.</param>
        public void CarryOver(WallTerms former, int[] node, int elementCount)
        {
            Barrier.Fields.Follow(former.Barrier.Fields);
            if (former.Friction != null)
            {
                Friction?.Anchors.CarryOver(former.Friction.Anchors, node, elementCount);
            }
            if (former.SelfFriction != null)
            {
                SelfFriction?.CarryOver(former.SelfFriction, node, elementCount);
            }
            if (former.Barrier.Lag != null)
            {
                Barrier.Lag?.CarryOver(former.Barrier.Lag, node, elementCount);
            }
        }

        /// <summary>What to change about the barrier where a step has no solution, in one phrase, or null.</summary>
        public string? Advice => _advice?.Invoke();

        /// <summary>The barriers of contact.</summary>
        public BarrierEnergy Barrier { get; }

        /// <summary>Friction; null where no wall has friction.</summary>
        public FrictionEnergy? Friction { get; }

        /// <summary>Contact of the wire with itself; null where it has none.</summary>
        public SelfContact? Self { get; }

        /// <summary>Friction between the wire's strands; null where it has none.</summary>
        public SelfFriction? SelfFriction { get; }

        /// <summary>Whether any contact has friction.</summary>
        public bool HasFriction => Friction != null || SelfFriction != null;

        /// <summary>Whether the wire touches anything in the shape last evaluated.</summary>
        public bool Touches => Barrier.Touches || Self?.Touches == true;

        /// <summary>What friction has turned into heat so far, J.</summary>
        public double Dissipated => (Friction?.Anchors.Dissipated ?? 0.0) + (SelfFriction?.Dissipated ?? 0.0);

        /// <summary>Friction takes over normal forces and normals from a shape.</summary>
        public void Lag(RodShape shape)
        {
            Friction?.Lag(shape);
            SelfFriction?.Lag(shape);
        }

        /// <summary>Contacts leave out the part of their second derivatives that is proportional to their
        /// force.</summary>
        public void DropGeometricStiffness(bool isOn)
        {
            Barrier.DropGeometricStiffness(isOn);
            Self?.DropGeometricStiffness(isOn);
        }

        /// <summary>The spring; without effect where nothing holds node 0.</summary>
        public SupportSpring Spring { get; }

        /// <inheritdoc/>
        public override int VesselCount => Barrier.Fields.Beam?.Count ?? 0;

        /// <summary>Whether a support holds node 0.</summary>
        public bool HoldsStart { get; }

        /// <inheritdoc/>
        public override EnergyTerm[] All { get; }

        /// <inheritdoc/>
        public override double FrictionStored => (Friction == null ? 0.0 : Friction.Anchors.StoredEnergy)
            + (SelfFriction?.StoredEnergy ?? 0.0);

        /// <inheritdoc/>
        public override void AddFriction(RodShape shape, RodVector[] gradient)
        {
            var measured = default(GradientMeasures);
            Friction?.AddGradient(shape, gradient, 0, shape.ElementCount + 1, ref measured);
            SelfFriction?.AddGradient(shape, gradient, 0, shape.ElementCount + 1, ref measured);
        }

        /// <inheritdoc/>
        public override double StoredEnergy(RodShape shape) => Barrier.Stored(shape) + (Self?.Value(shape) ?? 0.0)
            + (_vessel?.Value(shape) ?? 0.0);

        /// <inheritdoc/>
        public override Vector3d SupportForce(RodShape shape) => HoldsStart ? Spring.Force(shape) : Vector3d.Zero;

        /// <summary>A reader between as many walls, of which one has friction, takes over what such a writer has; and
        /// how far walls lag behind, where both have such walls and as many elements.</summary>
        public override void Serialize(Snapshot snapshot)
        {
            if (!snapshot.IsStep)
            {
                string key = Friction == null ? "no friction" : "friction at " + Friction.Anchors.Count;
                snapshot.Section(SelfFriction == null ? key : key + " and of the wire on itself", SerializeHistory);
                return;
            }
            SerializeHistory(snapshot);
            if (Barrier.Fields.Carrier >= 0)
            {
                Barrier.SetTime(snapshot.Serialize(Barrier.Fields.Time));
            }
        }

        private void SerializeHistory(Snapshot snapshot)
        {
            Friction?.Anchors.Serialize(snapshot);
            SelfFriction?.SerializeHistory(snapshot);
            WallLag.Serialize(Barrier.Lag, snapshot);
        }

        /// <summary>Adds minus the force of the wire's strands on one another.</summary>
        public void AddStrandGradient(RodShape shape, RodVector[] gradient)
        {
            var measured = default(GradientMeasures);
            Self?.AddGradient(shape, gradient, 0, shape.ElementCount + 1, ref measured);
            SelfFriction?.AddGradient(shape, gradient, 0, shape.ElementCount + 1, ref measured);
        }

        /// <summary>Adds minus the force of the walls on the wire.</summary>
        public void AddWallGradient(RodShape shape, RodVector[] gradient)
        {
            var measured = default(GradientMeasures);
            Barrier.AddGradient(shape, gradient, 0, shape.ElementCount + 1, ref measured);
            Friction?.AddGradient(shape, gradient, 0, shape.ElementCount + 1, ref measured);
        }
    }

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
