namespace Guidewire.Core
{
    /// <summary>Contact as part of a rod's energy, for methods that treat walls in that way.</summary>
    internal abstract class ContactTerms
    {
        /// <summary>The terms that act.</summary>
        public abstract EnergyTerm[] All { get; }

        /// <summary>Gives the energy stored in the contacts' normal forces, J.</summary>
        public abstract double StoredEnergy(RodShape shape);

        /// <summary>Energy stored in the elastic displacements of sticking contacts, J.</summary>
        public abstract double FrictionStored { get; }

        /// <summary>Gives the force of the support on node 0, N.</summary>
        public abstract Vector3d SupportForce(RodShape shape);

        /// <summary>Adds minus the force of friction on the nodes.</summary>
        public virtual void AddFriction(RodShape shape, RodVector[] gradient)
        {
        }

        /// <summary>Writes or restores what friction keeps from step to step.</summary>
        public abstract void SerializeFriction(Snapshot snapshot);
    }
}
