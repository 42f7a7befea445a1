using System;
using System.Collections.Generic;
using System.Linq;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Contrast agent in the vessel of a session. Blood enters by the widest open end and leaves by all
    /// others.</summary>
    public sealed class SessionContrast
    {
        private readonly VesselTree _tree;
        private readonly double _millimetres;   // of a unit

        private SessionContrast(VesselTree tree, double millimetres)
        {
            _tree = tree;
            _millimetres = millimetres;
            Flow = new ContrastFlow(tree, new BloodFlow());
        }

        /// <summary>The agent and the blood, lengths in mm.</summary>
        public ContrastFlow Flow { get; private set; }

        /// <summary>Begins anew with blood that flows otherwise.</summary>
        /// <exception cref="ArgumentException">A value of the flow out of its range.</exception>
        public void Begin(BloodFlow flow) => Flow = new ContrastFlow(_tree, flow);

        /// <summary>Begins an injection at a point of the lumen.</summary>
        /// <param name="point">Units; null: the inlet of the blood.</param>
        /// <param name="amount">ml.</param>
        /// <param name="rate">ml/s.</param>
        /// <exception cref="ArgumentException">A value out of its range.</exception>
        public void Inject(Vector3d? point, double amount, double rate) =>
            Flow.Inject(point is Vector3d place ? Flow.CellOf(_millimetres * place) : 0, amount, rate);

        /// <summary>That of a vessel, or null where it has no centreline.</summary>
        internal static SessionContrast? Of(Anatomy? anatomy, double millimetres)
        {
            VesselEnd[] open = anatomy == null ? Array.Empty<VesselEnd>()
                : anatomy.Ends.Where(end => end.Point >= 0 && end.Point < anatomy.Points.Length).ToArray();
            if (anatomy == null || anatomy.Points.Length < 2 || open.Length == 0)
            {
                return null;
            }
            VesselEnd inlet = open.OrderByDescending(end => end.Radius).First();
            // From the inlet on, each point after the one before it.
            List<int>[] neighbours = anatomy.Neighbours();
            var order = new List<int> { inlet.Point };
            var before = new List<int> { -1 };
            var isFound = new bool[anatomy.Points.Length];
            isFound[inlet.Point] = true;
            for (int k = 0; k < order.Count; k++)
            {
                foreach (int next in neighbours[order[k]].Where(next => !isFound[next]))
                {
                    isFound[next] = true;
                    order.Add(next);
                    before.Add(k);
                }
            }
            double[] radii = Radii(anatomy, order, before);
            return new SessionContrast(new VesselTree(
                order.ConvertAll(k => millimetres * anatomy.Points[k]).ToArray(),
                Array.ConvertAll(radii, radius => millimetres * radius), before.ToArray()), millimetres);
        }

        // Spheres within an end are smaller than the lumen there.
        private static double[] Radii(Anatomy anatomy, List<int> order, List<int> before)
        {
            double[] radii = order.ConvertAll(k => anatomy.Radii[k]).ToArray();
            double widest = radii.Max();
            foreach (VesselEnd end in anatomy.Ends)
            {
                int last = order.IndexOf(end.Point);
                for (int k = last; k >= 0 && Vector3d.Distance(anatomy.Points[order[k]], end.Centre) < 1.5 * end.Radius;
                    k = before[k])
                {
                    radii[k] = Math.Max(radii[k], Math.Min(end.Radius, widest));
                }
            }
            for (int k = 1; k < radii.Length && before[k] == k - 1
                && Vector3d.Distance(anatomy.Points[order[k]], anatomy.Points[order[0]]) < 1.5 * radii[0]; k++)
            {
                radii[k] = Math.Max(radii[k], radii[0]);
            }
            return Array.ConvertAll(radii, radius => Math.Max(radius, 1e-3 * widest));
        }
    }
}
