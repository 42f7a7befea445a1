using System;

namespace Guidewire.Core
{
    /// <summary>Normal force of the walls on each element of a wire. A force on a node between two elements is shared
    /// by both; a force on an end belongs to its element.</summary>
    /// <remarks>Pressure is the sum of an element's normal forces, regardless of their directions, over its length and
    /// its diameter: what it would be if it were spread over the element's shadow. So it does not depend on n where a
    /// wire lies along a wall; at a single contact point, such as the tip, it grows with n.</remarks>
    internal sealed class ElementContactForces
    {
        private readonly BarrierEnergy _barrier;
        private readonly double[] _shadow;   // 2 r l, m^2
        private readonly double[] _force;     // N

        /// <summary>Those of a rod's contacts.</summary>
        public ElementContactForces(MaterialRod rod, BarrierEnergy barrier)
        {
            _barrier = barrier;
            _shadow = new double[rod.ElementCount];
            _force = new double[rod.ElementCount];
            for (int j = 0; j < _shadow.Length; j++)
            {
                _shadow[j] = 2.0 * rod.Radius[j] * rod.Length[j];
            }
        }

        /// <summary>Largest force on an element, N.</summary>
        public double LargestForce { get; private set; }

        /// <summary>Largest pressure, Pa.</summary>
        public double LargestPressure { get; private set; }

        /// <summary>Takes those of a shape.</summary>
        /// <param name="forces">Receives the force on each element, N.</param>
        public void Take(RodShape shape, Vector3d[] forces)
        {
            Array.Clear(forces, 0, forces.Length);
            Array.Clear(_force, 0, _force.Length);
            StructList<WallContact> contacts = _barrier.ContactsOf(shape);
            for (int k = 0; k < contacts.Count; k++)
            {
                WallContact contact = contacts[k];
                int j = contact.Element;
                bool isShared = contact.Position == 0.0 && j > 0;
                Add(j, isShared ? 0.5 : 1.0, contact, forces);
                if (isShared)
                {
                    Add(j - 1, 0.5, contact, forces);
                }
            }
            LargestForce = 0.0;
            LargestPressure = 0.0;
            for (int j = 0; j < forces.Length; j++)
            {
                LargestForce = Math.Max(LargestForce, forces[j].Length);
                LargestPressure = Math.Max(LargestPressure, _force[j] / _shadow[j]);
            }
        }

        private void Add(int j, double fraction, in WallContact contact, Vector3d[] forces)
        {
            forces[j] += (fraction * contact.Force) * contact.Normal;
            _force[j] += fraction * contact.Force;
        }
    }
}
