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
}
