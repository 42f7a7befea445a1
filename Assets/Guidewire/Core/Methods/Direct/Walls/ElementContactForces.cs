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
        private readonly MaterialRod _rod;
        private readonly BarrierEnergy _barrier;
        private readonly double[] _shadow;   // 2 r l, m^2
        private readonly double[] _force;     // N

        /// <summary>Those of a rod's contacts.</summary>
        public ElementContactForces(MaterialRod rod, BarrierEnergy barrier)
        {
            _rod = rod;
            _barrier = barrier;
            _shadow = new double[rod.Capacity];
            _force = new double[rod.Capacity];
            Remesh();
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh()
        {
            for (int j = 0; j < _rod.ElementCount; j++)
            {
                _shadow[j] = 2.0 * _rod.Radius[j] * _rod.Length[j];
            }
        }

        /// <summary>Takes those of a shape, and how far soft walls give way.</summary>
        /// <param name="record">Receives them by element.</param>
        /// <param name="extremes">Receives the largest.</param>
        /// <param name="time">s.</param>
        public void Record(RodShape shape, ContactRecord record, RunExtremes extremes, double time)
        {
            Vector3d[] forces = record.ElementForces;
            Array.Clear(forces, 0, _rod.ElementCount);
            Array.Clear(_force, 0, _rod.ElementCount);
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
            double largest = 0.0;
            double pressure = 0.0;
            for (int j = 0; j < _rod.ElementCount; j++)
            {
                largest = Math.Max(largest, forces[j].Length);
                pressure = Math.Max(pressure, _force[j] / _shadow[j]);
            }
            record.Pressure = pressure;
            extremes.TakeWalls(largest, pressure, time);
            if (record.Displacements.Length > 0)
            {
                double share = TakeDisplacements(shape, record);
                extremes.TakeDisplacements(record.LargestDisplacement, share);
            }
        }

        private void Add(int j, double fraction, in WallContact contact, Vector3d[] forces)
        {
            forces[j] += (fraction * contact.Force) * contact.Normal;
            _force[j] += fraction * contact.Force;
        }

        // Displacements of soft walls; the largest over its wall's limit.
        private double TakeDisplacements(RodShape shape, ContactRecord record)
        {
            Array.Clear(record.Displacements, 0, _rod.ElementCount);
            StructList<WallContact> contacts = _barrier.ContactsOf(shape);
            double sum = 0.0;
            double share = 0.0;
            int count = 0;
            record.LargestDisplacement = 0.0;
            for (int k = 0; k < contacts.Count; k++)
            {
                ref WallContact contact = ref contacts[k];
                double moved = contact.Displacement;
                WallLaw law = _barrier.LawOf(contact.Wall);
                if (!law.IsSoft)
                {
                    continue;
                }
                sum += moved;
                count++;
                share = Math.Max(share, moved / law.DistanceAt(contact));
                record.LargestDisplacement = Math.Max(record.LargestDisplacement, moved);
                for (int j = contact.Element - (contact.IsNode && contact.Position == 0.0 ? 1 : 0);
                    j <= contact.Element; j++)
                {
                    int own = Math.Max(j, 0);
                    if (moved * moved > record.Displacements[own].LengthSquared)
                    {
                        record.Displacements[own] = -moved * contact.Normal;
                    }
                }
            }
            record.MeanDisplacement = count > 0 ? sum / count : 0.0;
            return share;
        }
    }
}
