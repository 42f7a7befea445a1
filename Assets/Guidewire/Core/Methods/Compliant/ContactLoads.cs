using System;

namespace Guidewire.Core
{
    /// <summary>The contact forces on a wire with compliance at the end of the last substep, for the search for a
    /// nearby rest shape: constant forces, each with a stiff spring along its normal.</summary>
    /// <remarks>The spring is the contact's own, or where that is rigid 10 EA/l of the stiffest element, as that on
    /// which <see cref="SupportSpring"/> holds a node. Friction is a force alone.</remarks>
    internal sealed class ContactLoads : EnergyTerm
    {
        private const double OverAxialSpring = 10.0;

        private readonly CompliantContacts _contacts;
        private readonly double _stiffness;    // N/m
        private readonly double _perSquare;    // 1/h^2

        /// <summary>Forces of these contacts.</summary>
        /// <param name="stiffness">Of a contact, N/m; 0 for rigid ones.</param>
        /// <param name="substep">h, s.</param>
        public ContactLoads(CompliantContacts contacts, MaterialRod rod, double stiffness, double substep)
        {
            _contacts = contacts;
            _perSquare = 1.0 / (substep * substep);
            _stiffness = stiffness;
            for (int j = 0; stiffness == 0.0 && j < rod.ElementCount; j++)
            {
                _stiffness = Math.Max(_stiffness, OverAxialSpring * rod.StretchStiffness[j] / rod.Length[j]);
            }
        }

        /// <summary>Says that the term stores no energy, because only its slopes count.</summary>
        public override bool StoresEnergy => false;

        /// <inheritdoc/>
        public override double Value(RodShape shape) => 0.0;

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            for (int k = 0; k < _contacts.Count; k++)
            {
                CompliantContacts.Contact contact = _contacts[k];
                if (contact.NormalImpulse > 0.0 && contact.Element >= from && contact.Element < to)
                {
                    Add(contact, shape, gradient);
                }
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            for (int k = 0; k < _contacts.Count; k++)
            {
                CompliantContacts.Contact contact = _contacts[k];
                int j = contact.Element;
                if (contact.NormalImpulse > 0.0 && j >= from && j < to)
                {
                    Add(contact, shape, gradient);
                    RodBlock.AddAt(ref blocks[j], ref blocks[j + 1], contact.Position,
                        Symmetric3.Outer(_stiffness, contact.Normal));
                }
            }
        }

        private void Add(in CompliantContacts.Contact contact, RodShape shape, RodVector[] gradient)
        {
            int j = contact.Element;
            Vector3d force = _perSquare * (contact.NormalImpulse * contact.Normal + contact.FrictionImpulse);
            gradient[j].AddX(-((1.0 - contact.Position) * force));
            gradient[j + 1].AddX(-(contact.Position * force));
            Vector3d couple = _perSquare * contact.Couple(shape.Q[j]);
            gradient[j].AddT(-couple);
        }
    }
}
