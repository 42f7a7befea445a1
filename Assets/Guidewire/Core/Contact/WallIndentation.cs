using System;

namespace Guidewire.Core
{
    /// <summary>How walls that give way are drawn: vertices near a contact go with it, the less the farther away they
    /// are. Only drawn: what a run knows of a wall is how far it is displaced at its contacts.</summary>
    public static class WallIndentation
    {
        private const double Reach = 4.0;    // beyond the wire's surface, of its radius

        /// <summary>Displacements of the walls at the elements of a wire, units; 0 where nothing gives way.</summary>
        /// <param name="contacts">Of the run.</param>
        /// <param name="metresPerUnit">m.</param>
        /// <param name="indentations">Receives them; unchanged where the record has others than these elements.</param>
        public static void Take(ContactRecord contacts, double metresPerUnit, Vector3d[] indentations)
        {
            for (int j = 0; j < indentations.Length && contacts.Displacements.Length == indentations.Length; j++)
            {
                Vector3d force = contacts.ElementForces[j];
                double size = contacts.Displacements[j] / metresPerUnit;
                indentations[j] = force == Vector3d.Zero ? Vector3d.Zero : -size * Vector3d.Normalize(force);
            }
        }

        /// <summary>Moves the vertices of a wall.</summary>
        /// <param name="rest">Where they are without contact, units.</param>
        /// <param name="positions">Of the wire's nodes, units.</param>
        /// <param name="indentations">By element, as <see cref="Take"/> gives them.</param>
        /// <param name="radius">Of the wire, units.</param>
        /// <param name="moved">Receives them.</param>
        /// <returns>Whether any differs from its place at rest.</returns>
        public static bool Move(Vector3d[] rest, Vector3d[] positions, Vector3d[] indentations, double radius,
            Vector3d[] moved)
        {
            Array.Copy(rest, moved, moved.Length);
            bool isAny = false;
            for (int j = 0; j < indentations.Length; j++)
            {
                double size = indentations[j].Length;
                if (size == 0.0)
                {
                    continue;    // most elements touch nothing
                }
                Vector3d outward = (1.0 / size) * indentations[j];
                double reach = (1.0 + Reach) * radius + Vector3d.Distance(positions[j], positions[j + 1]);
                for (int i = 0; i < moved.Length; i++)
                {
                    double part = (rest[i] - positions[j]).LengthSquared < reach * reach
                        ? size * Share(rest[i], positions[j], positions[j + 1], outward, radius) : 0.0;
                    if (part > Vector3d.Distance(rest[i], moved[i]))
                    {
                        moved[i] = rest[i] + (part / size) * indentations[j];
                        isAny = true;
                    }
                }
            }
            return isAny;
        }

        // 1 at the contact itself, 0 away from it and on the other side of the wire.
        private static double Share(in Vector3d x, in Vector3d a, in Vector3d b, in Vector3d outward, double radius)
        {
            Vector3d chord = b - a;
            double s = Math.Min(1.0, Math.Max(0.0, Vector3d.Dot(x - a, chord) / chord.LengthSquared));
            Vector3d from = x - (a + s * chord);
            double distance = from.Length;
            double beyond = Math.Max(0.0, distance - radius) / (Reach * radius);
            double side = distance > 0.0 ? Vector3d.Dot(from, outward) / distance : 0.0;
            double fade = 1.0 - beyond * beyond;
            return beyond < 1.0 && side > 0.0 ? fade * fade * side : 0.0;
        }
    }
}
