using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>Contact as published (thesis 3.1.2); see <see cref="ThesisContactConstraint"/>. Nothing prevents the
    /// wire from passing a wall.</summary>
    internal sealed class ThesisContactResponse : IContactResponse
    {
        private const int ContactsPerSphere = 4;
        private readonly ThesisContactConstraint _contacts;

        /// <param name="state">The wire, with its final masses.</param>
        /// <param name="wallCount">Walls of the scene.</param>
        /// <param name="clearance">r + margin in units.</param>
        /// <param name="gain">k_C, per iteration.</param>
        public ThesisContactResponse(RodState state, int wallCount, double clearance, double gain)
        {
            _contacts = new ThesisContactConstraint(
                state, ContactsPerSphere * wallCount * state.SphereCount, clearance, gain);
        }

        /// <inheritdoc/>
        public int ContactCount => _contacts.Count;

        /// <inheritdoc/>
        public void Start(IContactSearch found, Vector3d[] from, Vector3d[] x)
        {
            _contacts.Clear();
            for (int k = 0; k < found.Contacts.Count; k++)
            {
                ref readonly WireContact contact = ref found.Contacts[k];
                if (contact.IsElement)
                {
                    _contacts.AddElement(contact.Index, contact.Nearest, x);
                }
                else
                {
                    _contacts.AddSphere(contact.Index, contact.Nearest);
                }
            }
        }

        /// <inheritdoc/>
        public void Stop(StructList<WireContact> impacts)
        {
            throw new InvalidOperationException("the published rule has no swept test");
        }

        /// <inheritdoc/>
        public void IterateStops(Vector3d[] x)
        {
        }

        /// <inheritdoc/>
        public void Iterate(Vector3d[] x)
        {
            _contacts.Iterate(x);
        }

        /// <inheritdoc/>
        public void SpheresOf(int k, out int first, out int last)
        {
            first = last = _contacts.SphereOf(k);
        }

        /// <inheritdoc/>
        [MethodImpl(Compiled.AtOnce)]
        public bool Project(int k, Vector3d[] x)
        {
            _contacts.Project(k, x);
            return true;
        }

        /// <inheritdoc/>
        public void AddImpulses(Vector3d[] impulses)
        {
            _contacts.AddImpulses(impulses);
        }
    }
}
