#if NET8_0_OR_GREATER
using System;

namespace Guidewire.Core
{
    /// <summary>The contacts of a solve among iterations in lanes: which follow at each slot of an iteration, in the
    /// order of the scalar iterations.</summary>
    /// <remarks>A contact of an iteration needs its spheres after the iteration's stretch constraints and after earlier
    /// contacts of the same spheres. A lane at slot p has just finished x_p and still holds x_{p-1}, so a sphere's
    /// contact can follow at its own slot or one later, an element's at that of its second sphere. Spheres first, then
    /// elements in their order always fits; where contacts would have to wait longer, as some of several walls at one
    /// element, they cannot take part.</remarks>
    internal sealed class PipelinedContacts
    {
        private const int Lag = LaneTable.Lag;
        private const int ContactsPerSphere = 2;
        private readonly int _elements;
        private readonly int _period;
        private readonly int _lanes;
        private readonly int[] _ready;      // the slot after which each sphere has had all contacts so far
        private readonly int[] _first;      // the first contact at each slot, or -1
        private readonly int[] _last;
        private readonly int[] _next;       // the contact after each at the same slot, or -1
        private IContactResponse? _rule;

        /// <param name="elements">n.</param>
        /// <param name="period">Slots of an iteration.</param>
        /// <param name="lanes">Number of lanes.</param>
        public PipelinedContacts(int elements, int period, int lanes)
        {
            _elements = elements;
            _period = period;
            _lanes = lanes;
            _ready = new int[elements + 1];
            _first = new int[elements + 1];
            _last = new int[elements + 1];
            _next = new int[ContactsPerSphere * (elements + 1)];
            Lanes = new int[period];
            Held = new double[6 * lanes];
        }

        /// <summary>The lanes that have contacts, one bit each, while lane 0 is at each slot.</summary>
        public int[] Lanes { get; }

        /// <summary>The spheres that lanes have just finished, and those they finished one slot earlier: three times a
        /// number a lane for x, y, z, then three times for the earlier.</summary>
        public double[] Held { get; }

        /// <summary>Finds the slot of each contact; false where some have none.</summary>
        public bool TryPlan(IContactResponse? rule)
        {
            Array.Clear(Lanes, 0, Lanes.Length);
            _rule = rule;
            int count = rule?.ContactCount ?? 0;
            if (count == 0)
            {
                return true;
            }
            if (count > _next.Length)
            {
                return false;
            }
            Array.Fill(_first, -1);
            for (int i = 0; i <= _elements; i++)
            {
                _ready[i] = i;
            }
            for (int k = 0; k < count; k++)
            {
                rule!.SpheresOf(k, out int first, out int last);
                int slot = Math.Max(_ready[first], _ready[last]);
                if (slot > first + 1 || slot > _elements)
                {
                    return false;
                }
                _ready[first] = slot;
                _ready[last] = slot;
                Append(k, slot);
            }
            return true;
        }

        /// <summary>Projects the contacts of all lanes at their slots, in the spheres that are held; false where they
        /// moved none.</summary>
        /// <param name="slot">Where lane 0 is.</param>
        /// <param name="tick">Slots since it started.</param>
        /// <param name="end">The tick after which each lane has no iteration left.</param>
        /// <param name="x">n + 1 positions that may be written over.</param>
        public bool Project(int slot, long tick, double[] end, Vector3d[] x)
        {
            bool movedAny = false;
            for (int lane = 0; lane < _lanes; lane++)
            {
                bool going = tick >= Lag * lane && tick < end[lane];
                if (!going || (Lanes[slot] >> lane & 1) == 0)
                {
                    continue;
                }
                int p = slot - Lag * lane;
                p = p < 0 ? p + _period : p;
                x[p] = new Vector3d(Held[lane], Held[_lanes + lane], Held[2 * _lanes + lane]);
                if (p > 0)
                {
                    x[p - 1] = new Vector3d(
                        Held[3 * _lanes + lane], Held[4 * _lanes + lane], Held[5 * _lanes + lane]);
                }
                bool moved = false;
                for (int k = _first[p]; k >= 0; k = _next[k])
                {
                    moved |= _rule!.Project(k, x);
                }
                if (!moved)
                {
                    continue;
                }
                movedAny = true;
                Hold(lane, 0, x[p]);
                if (p > 0)
                {
                    Hold(lane, 3 * _lanes, x[p - 1]);
                }
            }
            return movedAny;
        }

        private void Append(int k, int slot)
        {
            if (_first[slot] < 0)
            {
                _first[slot] = k;
                for (int lane = 0; lane < _lanes; lane++)
                {
                    Lanes[(slot + Lag * lane) % _period] |= 1 << lane;
                }
            }
            else
            {
                _next[_last[slot]] = k;
            }
            _last[slot] = k;
            _next[k] = -1;
        }

        private void Hold(int lane, int from, in Vector3d sphere)
        {
            Held[from + lane] = sphere.X;
            Held[from + _lanes + lane] = sphere.Y;
            Held[from + 2 * _lanes + lane] = sphere.Z;
        }
    }
}
#endif
