using System;

namespace Guidewire.Core
{
    /// <summary>Contacts as published (thesis 3.1.2): at the predicted state, every sphere and every rod element whose
    /// core is within a sphere's radius of the wall. Passages are not prevented, and distances at the start of a
    /// displacement are not known.</summary>
    internal sealed class ThesisContactSearch : IContactSearch
    {
        private readonly int[] _elementHint;
        private readonly int[] _sphereHint;

        /// <param name="walls">Walls of the scene.</param>
        /// <param name="elementCount">n.</param>
        /// <param name="radius">r in units.</param>
        public ThesisContactSearch(ContactShape[] walls, int elementCount, double radius)
        {
            Walls = walls;
            Radius = radius;
            _elementHint = new int[walls.Length * elementCount];
            _sphereHint = new int[walls.Length * (elementCount + 1)];
            Array.Fill(_elementHint, -1);
            Array.Fill(_sphereHint, -1);
            Contacts = new StructList<WireContact>(_elementHint.Length + _sphereHint.Length);
        }

        /// <inheritdoc/>
        public ContactShape[] Walls { get; }

        /// <inheritdoc/>
        public double Radius { get; }

        /// <inheritdoc/>
        public bool GuardsSpheres => false;

        /// <inheritdoc/>
        public bool GuardsElements => false;

        /// <inheritdoc/>
        public StructList<WireContact> Contacts { get; }

        /// <inheritdoc/>
        public StructList<WireContact> Impacts { get; } = new StructList<WireContact>(1);

        /// <inheritdoc/>
        public void Find(Vector3d[] from, Vector3d[] to)
        {
            Contacts.Clear();
            int n = to.Length - 1;
            for (int w = 0; w < Walls.Length; w++)
            {
                for (int i = 0; i <= n; i++)
                {
                    if (Walls[w].Nearest(
                        to[i], to[i], Radius, ref _sphereHint[w * (n + 1) + i], out SurfaceContact contact))
                    {
                        Contacts.Add(new WireContact(w, i, false, contact));
                    }
                }
                for (int j = 0; j < n; j++)
                {
                    if (Walls[w].Nearest(
                        to[j], to[j + 1], Radius, ref _elementHint[w * n + j], out SurfaceContact contact))
                    {
                        Contacts.Add(new WireContact(w, j, true, contact));
                    }
                }
            }
        }

        /// <inheritdoc/>
        public double ClearanceOf(int w, int j) => double.NegativeInfinity;
    }
}
