using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Where a sheath ends, and what is in it.</summary>
    internal class SheathEnd
    {
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

        /// <summary>Where it leads, a unit vector.</summary>
        public Vector3d Axis { get; }

        /// <summary>How many nodes, from the first on, are in the sheath.</summary>
        public int NodesInside(Vector3d[] x)
        {
            int inside = 0;
            while (inside < x.Length && Outside(x[inside]) < 0.0)
            {
                inside++;
            }
            return inside;
        }

        /// <summary>How far a node is out of the sheath, m; negative inside.</summary>
        public double Outside(in Vector3d node)
        {
            return Vector3d.Dot(node - Exit, Axis);
        }

        /// <summary>Whether the wire has buckled at the exit: a node in the sheath that is farther from its axis than
        /// the lumen is wide there would come out through a wall. Nothing but its frame holds the wire sideways in the
        /// last element before the exit.</summary>
        /// <param name="x">Nodes, m.</param>
        /// <param name="metres">Of a unit of the walls.</param>
        public bool IsBuckled(Vector3d[] x, IReadOnlyList<ContactShape> walls, double metres)
        {
            int inside = NodesInside(x);
            for (int i = 0; i < inside; i++)
            {
                Vector3d atExit = (1.0 / metres) * (x[i] - Outside(x[i]) * Axis);
                foreach (ContactShape wall in walls)
                {
                    if (!wall.Contains(atExit))
                    {
                        return true;
                    }
                }
            }
            return false;
        }
    }
}
