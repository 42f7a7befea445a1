using System;

namespace Guidewire.Core
{
    /// <summary>Estimates of the normal forces (Lagrange multipliers) of all contacts during Newton's method: those to
    /// which the linearised contact law of the last step has led. Near an estimate f that differs from the force
    /// -b'(g) of the gap, the stiffness of the chord from the one to the other replaces b''(g), as in a primal-dual
    /// interior point method (Nocedal and Wright, Numerical Optimization, 2006, chapter 19).</summary>
    /// <remarks>With b'' a gap that is far too small only doubles in an iteration, and the force of a contact that ends
    /// only falls to a quarter. The gradient stays that of the energy: a stiffness above 0 changes the direction of a
    /// step, and not where Newton's method ends. Near the solution estimates and forces agree, and b'' counts.
    /// A step that is cut leaves no estimates: what it met was not in its linear law.</remarks>
    internal sealed class ContactMultipliers
    {
        private const double NearlySame = 0.1;    // relative difference up to which b'' counts
        private const double Softest = 0.25;      // of b'': a gap that is nearly closed opens to some four times itself
        private readonly Barrier _barrier;
        private readonly int _nodes;
        private readonly Linear[] _law;           // by wall: its nodes, then its elements

        /// <summary>No estimates yet.</summary>
        public ContactMultipliers(in Barrier barrier, int wallCount, int elementCount)
        {
            _barrier = barrier;
            _nodes = elementCount + 1;
            _law = new Linear[wallCount * (_nodes + elementCount)];
        }

        /// <summary>Whether there are estimates.</summary>
        public bool AreKnown { get; private set; }

        /// <summary>Whether a chord has counted in the present shape.</summary>
        public bool HaveCounted { get; private set; }

        /// <summary>Another shape becomes the present one.</summary>
        public void BeginShape()
        {
            HaveCounted = false;
        }

        /// <summary>Where wall w and node i are kept.</summary>
        public int AtNode(int w, int i)
        {
            return w * (2 * _nodes - 1) + i;
        }

        /// <summary>Where wall w and the interior of element j are kept.</summary>
        public int AtElement(int w, int j)
        {
            return w * (2 * _nodes - 1) + _nodes + j;
        }

        /// <summary>There are no estimates any more.</summary>
        public void Forget()
        {
            AreKnown = false;
            HaveCounted = false;
        }

        /// <summary>The estimate over the present force at a node; 1 where there is none.</summary>
        /// <param name="points">What touches, in units.</param>
        /// <param name="units">Per metre.</param>
        /// <param name="radius">m.</param>
        public double Ratio(int at, StructList<ContactPoint> points, double units, double radius)
        {
            double force = 0.0;
            for (int k = 0; k < points.Count && AreKnown; k++)
            {
                _barrier.At(points[k].Contact.Distance / units - radius, out double slope, out _);
                force -= points[k].Weight * slope;
            }
            return force > 0.0 ? _law[at].Estimate / force : 1.0;
        }

        /// <summary>The same in the interior of an element.</summary>
        public double Ratio(int at, StructList<EdgeContact> edges, double units, double radius)
        {
            double force = 0.0;
            for (int k = 0; k < edges.Count && AreKnown; k++)
            {
                _barrier.At(edges[k].Distance / units - radius, out double slope, out _);
                force -= edges[k].Weight * slope;
            }
            return force > 0.0 ? _law[at].Estimate / force : 1.0;
        }

        /// <summary>The stiffness of a gap, N/m.</summary>
        /// <param name="slope">b', N.</param>
        /// <param name="curvature">b'', N/m.</param>
        /// <param name="ratio">Of the estimate of its force to the force.</param>
        public double Stiffness(double gap, double slope, double curvature, double ratio)
        {
            if (Math.Abs(ratio - 1.0) < NearlySame)
            {
                return curvature;
            }
            double chord = _barrier.ChordStiffness(gap, -slope, -slope * ratio);
            if (!(chord > 0.0 && chord <= double.MaxValue))
            {
                return curvature;
            }
            HaveCounted = true;
            return Math.Max(chord, Softest * curvature);
        }

        /// <summary>Takes the contacts at a place, in the shape from which the next step starts.</summary>
        /// <param name="force">Sum of the normal forces, N.</param>
        /// <param name="first">By which the sum falls with a displacement of the node, or of the element's first, N/m.
        /// </param>
        /// <param name="second">The same with that of the element's second node.</param>
        public void Set(int at, double force, in Vector3d first, in Vector3d second)
        {
            _law[at].Force = force;
            _law[at].First = first;
            _law[at].Second = second;
        }

        /// <summary>Takes a whole step along a direction: the estimates become those of the linear law there, 0 where nothing
        /// touched.</summary>
        /// <param name="contacts">In the shape where the step starts.</param>
        public void Advance(StructList<WallContact> contacts, RodVector[] direction)
        {
            for (int at = 0; at < _law.Length; at++)
            {
                _law[at].Estimate = 0.0;
            }
            for (int k = 0; k < contacts.Count; k++)
            {
                ref WallContact contact = ref contacts[k];
                int j = contact.Element;
                int i = contact.IsNode && contact.Position == 1.0 ? j + 1 : j;
                ref Linear law = ref _law[contact.IsNode ? AtNode(contact.Wall, i) : AtElement(contact.Wall, j)];
                double change = Dot(law.First, direction[i])
                    + (contact.IsNode ? 0.0 : Dot(law.Second, direction[j + 1]));
                law.Estimate = Math.Max(0.0, law.Force - change);
            }
            AreKnown = true;
        }

        private static double Dot(in Vector3d a, in RodVector b)
        {
            return a.X * b.X1 + a.Y * b.X2 + a.Z * b.X3;
        }

        // The sum of the normal forces at a place, its derivatives, and its estimate.
        private struct Linear
        {
            public double Force;
            public Vector3d First;
            public Vector3d Second;
            public double Estimate;
        }
    }
}
