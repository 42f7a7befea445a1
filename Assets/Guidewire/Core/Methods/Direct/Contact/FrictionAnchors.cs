using System;

namespace Guidewire.Core
{
    /// <summary>The state of friction between steps: by wall and node, and by wall and element that edges of the wall
    /// meet, the elastic force F along the wall, the stiffness k with which it has grown, and so the elastic
    /// displacement F/k between the wire's surface and its anchor on the wall.</summary>
    /// <remarks>Kept by what the wire consists of, not by features of a wall: these come and go as a wire moves over a
    /// mesh. A contact that has ended has k = 0.</remarks>
    internal sealed class FrictionAnchors
    {
        private readonly int _walls;
        private int _nodes;
        private Anchor[] _anchors;                // of each wall the nodes', then the elements'
        private Anchor[] _spare;                  // for those of a wire whose elements change

        /// <summary>Of a wire that touches nothing.</summary>
        /// <param name="capacity">The most elements that it will have.</param>
        public FrictionAnchors(int wallCount, int elementCount, int capacity = 0)
        {
            _walls = wallCount;
            _nodes = elementCount + 1;
            _anchors = new Anchor[wallCount * (2 * Math.Max(elementCount, capacity) + 1)];
            _spare = new Anchor[_anchors.Length];
        }

        /// <summary>Where anchors are kept.</summary>
        public int Count => _walls * (2 * _nodes - 1);

        /// <summary>What friction has turned into heat so far, J.</summary>
        public double Dissipated { get; set; }

        /// <summary>The anchor at an index.</summary>
        public ref Anchor this[int index] => ref _anchors[index];

        /// <summary>Energy of all elastic displacements, sum of F^2/(2 k), J.</summary>
        public double StoredEnergy
        {
            get
            {
                double sum = 0.0;
                for (int k = 0; k < Count; k++)
                {
                    sum += _anchors[k].StoredEnergy;
                }
                return sum;
            }
        }

        /// <summary>Where the anchor of a contact is kept.</summary>
        public int IndexOf(in WallContact contact)
        {
            int of = contact.IsNode ? contact.Element + (contact.Position == 1.0 ? 1 : 0) : _nodes + contact.Element;
            return contact.Wall * (2 * _nodes - 1) + of;
        }

        /// <summary>Takes over the anchors of another wire between the same walls or of this one, where nodes have
        /// come in or gone.</summary>
        /// <param name="node">What each node was in the other one, -1 where it comes in; an element was that which
        /// ended at the same node.</param>
        /// <param name="elementCount">At most those that this is made for.</param>
        public void CarryOver(FrictionAnchors other, int[] node, int elementCount)
        {
            Dissipated = other.Dissipated;
            Anchor[] was = other._anchors;
            int nodes = other._nodes;
            if (other == this)
            {
                (_anchors, _spare) = (_spare, _anchors);
            }
            _nodes = elementCount + 1;
            for (int w = 0; w < _walls; w++)
            {
                int own = w * (2 * _nodes - 1);
                int others = w * (2 * nodes - 1);
                for (int i = 0; i < _nodes; i++)
                {
                    _anchors[own + i] = node[i] >= 0 ? was[others + node[i]] : default;
                    if (i > 0)
                    {
                        _anchors[own + _nodes + i - 1] = node[i] > 0 ? was[others + nodes + node[i] - 1] : default;
                    }
                }
            }
        }

        /// <summary>Writes or restores all of it.</summary>
        public void Serialize(Snapshot snapshot)
        {
            Dissipated = snapshot.Serialize(Dissipated);
            for (int k = 0; k < Count; k++)
            {
                snapshot.Serialize(ref _anchors[k].Force);
                snapshot.Serialize(ref _anchors[k].Stiffness);
            }
        }

        /// <summary>An elastic force along a wall.</summary>
        internal struct Anchor
        {
            /// <summary>F, of the wire on the wall, N.</summary>
            public Vector3d Force;

            /// <summary>k, N/m; 0 without contact.</summary>
            public double Stiffness;

            /// <summary>F^2/(2 k), J.</summary>
            public readonly double StoredEnergy => Stiffness > 0.0 ? 0.5 * Force.LengthSquared / Stiffness : 0.0;
        }
    }
}
