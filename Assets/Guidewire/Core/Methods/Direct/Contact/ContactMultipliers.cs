using System;

namespace Guidewire.Core
{
    /// <summary>The stiffness of contacts in Newton's method from estimates of their forces, the multipliers of
    /// primal-dual interior point methods (S. Wright 1997, Primal-Dual Interior-Point Methods): that of the chord from
    /// the gap as it is to the gap at which the barrier's force is the estimate.</summary>
    /// <remarks>The second derivative of a barrier is true at one gap only. Where a gap came out too small, its force
    /// is too large and so is its stiffness, and a Newton step no more than doubles the gap; where it came out too
    /// large, a step would close it altogether. The force with which the linear model of the last step ended is much
    /// nearer to that of the solution than the force at the new gap is. Gradients are not changed, so neither is the
    /// solution.
    ///
    /// All contacts of a node with a wall count as one, and so do those of an element: with the sum of their forces,
    /// at the least of their gaps.</remarks>
    internal sealed class ContactMultipliers
    {
        private int _nodes;
        private readonly StructList<Contact> _contacts = new StructList<Contact>(64);    // of the current shape
        private readonly double[] _estimate;      // N, by wall and node, then element; NaN where there is none
        private readonly StructList<int> _estimated = new StructList<int>(64);    // where there is one
        private readonly Symmetric3[] _own;       // what (x_i, x_i) has besides the second derivative, N/m
        private readonly Symmetric3[] _coupling;  // (x_i+1, x_i)
        private int _held = -1;                   // the node that does not move as walls see it

        /// <summary>Of a wire of this many elements between this many walls.</summary>
        public ContactMultipliers(int elementCount, int wallCount)
        {
            _nodes = elementCount + 1;
            _estimate = new double[wallCount * (_nodes + elementCount)];
            _own = new Symmetric3[_nodes];
            _coupling = new Symmetric3[elementCount];
            Array.Fill(_estimate, double.NaN);
        }

        /// <summary>The wire has so many elements, at most those it was made for, and touches nothing.</summary>
        public void Remesh(int elementCount)
        {
            Forget();
            Clear();
            _nodes = elementCount + 1;
        }

        /// <summary>Whether second derivatives are changed: not where nothing is estimated.</summary>
        public bool HasEstimates => _estimated.Count > 0;

        /// <summary>What the second derivative by node i changes by, N/m.</summary>
        public ref readonly Symmetric3 OwnOf(int i) => ref _own[i];

        /// <summary>Gives that by nodes j + 1 and j, N/m.</summary>
        public ref readonly Symmetric3 CouplingOf(int j) => ref _coupling[j];

        /// <summary>Removes all contacts, but not the estimates.</summary>
        public void Clear()
        {
            if (HasEstimates)
            {
                Restore();
            }
            _contacts.Clear();
            _held = -1;
        }

        /// <summary>Removes the estimates: contacts have their second derivatives.</summary>
        public void Forget()
        {
            if (HasEstimates)
            {
                Restore();
                ForgetEstimates();
            }
        }

        /// <summary>Adds the contact of node i with a wall.</summary>
        /// <param name="w">Which wall.</param>
        /// <param name="i">Which node.</param>
        /// <param name="force">On the wire, N.</param>
        /// <param name="stiffness">By its second derivative, N/m.</param>
        /// <param name="gap">m.</param>
        /// <param name="barrier">Of the gap, but for how stiff it is.</param>
        public void AddNode(int w, int i, in Vector3d force, in Symmetric3 stiffness, double gap, in Barrier barrier)
        {
            bool isLast = i == _nodes - 1;
            double size = force.Length;
            if (size > 0.0)    // not too small for its square
            {
                Vector3d normal = (1.0 / size) * force;
                Add(w * (2 * _nodes - 1) + i, isLast ? i - 1 : i, isLast ? 1.0 : 0.0, size, normal,
                    Vector3d.Dot(normal, stiffness.Times(normal)), gap, barrier);
            }
        }

        /// <summary>Adds the contact of the interior of element j, at s, with a wall.</summary>
        public void AddElement(int w, int j, double s, in Vector3d force, double stiffness, double gap,
            in Barrier barrier)
        {
            double size = force.Length;
            if (size > 0.0)
            {
                Add(w * (2 * _nodes - 1) + _nodes + j, j, s, size, (1.0 / size) * force, stiffness, gap,
                    barrier);
            }
        }

        /// <summary>Node i does not move as walls see it.</summary>
        public void Hold(int i)
        {
            _held = i;
            _own[i] = default;
            _coupling[i] = default;
        }

        /// <summary>Estimates the forces after a step from the current shape, in which nodes move so far, m.</summary>
        public void Estimate(RodVector[] direction)
        {
            ForgetEstimates();
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref Contact contact = ref _contacts[k];
                _estimated.Add(contact.Key);
                _estimate[contact.Key] = contact.Force
                    - contact.Stiffness * Vector3d.Dot(contact.Normal, MoveOf(direction, contact));
            }
        }

        private void Add(int key, int j, double s, double force, in Vector3d normal, double tangent, double gap,
            in Barrier barrier)
        {
            double stiffness = tangent;
            double estimate = _estimate[key];
            if (!double.IsNaN(estimate))
            {
                stiffness *= barrier.ChordStiffness(gap, estimate / force);
                double added = stiffness - tangent;
                double r = 1.0 - s;
                _own[j] += Symmetric3.Outer(added * r * r, normal);
                _own[j + 1] += Symmetric3.Outer(added * s * s, normal);
                _coupling[j] += Symmetric3.Outer(added * r * s, normal);
            }
            _contacts.Add(new Contact
            {
                Key = key,
                Element = j,
                Position = s,
                Normal = normal,
                Force = force,
                Tangent = tangent,
                Stiffness = stiffness,
            });
        }

        // Every contact has its second derivative.
        private void Restore()
        {
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref Contact contact = ref _contacts[k];
                int j = contact.Element;
                contact.Stiffness = contact.Tangent;
                _own[j] = default;
                _own[j + 1] = default;
                _coupling[j] = default;
            }
        }

        private void ForgetEstimates()
        {
            for (int k = 0; k < _estimated.Count; k++)
            {
                _estimate[_estimated[k]] = double.NaN;
            }
            _estimated.Clear();
        }

        private Vector3d MoveOf(RodVector[] direction, in Contact contact)
        {
            int j = contact.Element;
            return (1.0 - contact.Position) * MoveOf(direction, j) + contact.Position * MoveOf(direction, j + 1);
        }

        private Vector3d MoveOf(RodVector[] direction, int i) => i == _held ? Vector3d.Zero : direction[i].X;

        private struct Contact
        {
            public int Key;
            public int Element;
            public double Position;
            public Vector3d Normal;      // of the force
            public double Force;         // N
            public double Tangent;       // by its second derivative, N/m
            public double Stiffness;     // by the estimate
        }
    }
}
