namespace Guidewire.Core
{
    /// <summary>The end of a sheath, and the nodes and elements in it.</summary>
    internal sealed class SheathEnd
    {
        /// <summary>Fraction of its bending compliance that a piece in a sheath retains.</summary>
        public const double RetainedBend = 1e-8;

        /// <summary>An end.</summary>
        /// <param name="exit">m.</param>
        /// <param name="axis">Where it leads, a unit vector.</param>
        public SheathEnd(in Vector3d exit, in Vector3d axis)
        {
            Exit = exit;
            Axis = axis;
        }

        /// <summary>Where the sheath ends, m.</summary>
        public Vector3d Exit { get; }

        /// <summary>The direction in which the sheath leads, a unit vector.</summary>
        public Vector3d Axis { get; }

        /// <summary>How many nodes of a shape, from the first on, are in the sheath.</summary>
        public int NodesInside(RodShape shape)
        {
            Vector3d[] x = shape.X;
            int inside = 0;
            while (inside <= shape.ElementCount && Outside(x[inside]) < 0.0)
            {
                inside++;
            }
            return inside;
        }

        /// <summary>Gives the distance of a node beyond the exit of the sheath, m; negative inside.</summary>
        public double Outside(in Vector3d node) => Vector3d.Dot(node - Exit, Axis);

        /// <summary>Gives the point of the sheath's axis beside a node, m.</summary>
        public Vector3d OnAxis(in Vector3d node) => Exit + Outside(node) * Axis;
    }
}
