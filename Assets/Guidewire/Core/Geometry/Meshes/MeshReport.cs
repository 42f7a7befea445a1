using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>What was found in a vessel's mesh and what of it was repaired, by count.</summary>
    public sealed class MeshReport
    {
        /// <summary>Vertices after those that are one up to rounding became one.</summary>
        public int Vertices { get; internal set; }

        /// <summary>Triangles that are used.</summary>
        public int Triangles { get; internal set; }

        /// <summary>Vertices that were taken for an earlier one: no farther from it than
        /// <see cref="VertexWeld.RelativeTolerance"/> of the mesh's size.</summary>
        public int WeldedVertices { get; internal set; }

        /// <summary>Triangles left out because two of their corners are one vertex.</summary>
        public int CollapsedTriangles { get; internal set; }

        /// <summary>Triangles left out because they repeat an earlier one.</summary>
        public int RepeatedTriangles { get; internal set; }

        /// <summary>Triangles of no area between three different vertices. They are kept: they close the surface, and
        /// the distance from them is exact.</summary>
        public int FlatTriangles { get; internal set; }

        /// <summary>Triangles turned round so that neighbours agree.</summary>
        public int TurnedTriangles { get; internal set; }

        /// <summary>True when the whole surface was turned, so that its normals point into the lumen.</summary>
        public bool TurnedInward { get; internal set; }

        /// <summary>Open rims, all of them named.</summary>
        public int OpenRims { get; internal set; }

        /// <summary>Volume of the lumen, open rims closed by a fan, units^3.</summary>
        public double Volume { get; internal set; }

        /// <summary>Gives one line with every count.</summary>
        public override string ToString()
        {
            return string.Format(
                CultureInfo.InvariantCulture,
                "{0} triangles, {1} vertices, {2} open rims; welded {3}, collapsed {4}, repeated {5}, flat {6}, "
                + "turned {7}{8}",
                Triangles, Vertices, OpenRims, WeldedVertices, CollapsedTriangles, RepeatedTriangles, FlatTriangles,
                TurnedTriangles, TurnedInward ? ", all turned inward" : "");
        }
    }
}
