using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Default distance and stiffness of the barrier, from wire, walls and drive.</summary>
    /// <remarks>The distance g0 is a tenth of the wire's radius, or a twentieth of what the drive moves in a step where
    /// that is more: a wire that moves farther than 20 g0 in a step would jump past its barriers. It is at most half of
    /// the clearance where the walls are narrowest and still wider than the wire, because two barriers that overlap
    /// would hold the wire back; in a mesh at most 0.3 of the radius, because the number of triangles tested grows with
    /// its square; and at least a hundredth of the radius.
    ///
    /// The stiffness is F/g0 with F of the size of the forces that walls exert: EI/(90 r)^2, of a wire that bends
    /// between supports 45 diameters apart, or EI k/l, of an element of rest curvature k that supports hold straight;
    /// of the element for which it is largest. Contacts then have gaps of about half of g0. Stiffer ones act only near
    /// g0, where the force rises abruptly; softer ones close their gaps to nothing. For a straight wire it does not
    /// depend on the division into elements, as EI/l^3 would.</remarks>
    internal static class BarrierDefaults
    {
        /// <summary>Largest displacement of the drive in one step, in g0.</summary>
        public const double MaxMove = 20.0;

        private const double OfRadius = 0.1;
        private const double MinOfRadius = 0.01;
        private const double InMesh = 0.3;
        private const double OfClearance = 0.5;
        private const double Span = 90.0;           // times the radius, between supports of a wire
        private const double MinOfRule = 0.01;    // below, gaps close to nothing
        private const double MaxOfRule = 1e8;
        private const double MaxDistance = 2.0;    // times the rule's: it leaves no clearance

        /// <summary>What to change about a barrier with which a step has no solution, in one phrase, or null where the
        /// barrier is as good as that of the rule.</summary>
        /// <param name="given">The given one.</param>
        /// <param name="ruled">That of the rule.</param>
        public static string? Advice(in Barrier given, in Barrier ruled)
        {
            if (given.Distance < MinOfRule * ruled.Distance)
            {
                return string.Format(CultureInfo.InvariantCulture, "contactDistance = {0:G3} m is too short for the "
                    + "wire and its motion in a step; {1:G3} m is the default", given.Distance, ruled.Distance);
            }
            if (given.Distance > MaxDistance * ruled.Distance)
            {
                return string.Format(CultureInfo.InvariantCulture, "contactDistance = {0:G3} m is too long for the "
                    + "wire and its walls; {1:G3} m is the default", given.Distance, ruled.Distance);
            }
            if (given.Stiffness < MinOfRule * ruled.Stiffness)
            {
                return string.Format(CultureInfo.InvariantCulture, "contactStiffness = {0:G3} N/m is too soft for the "
                    + "wire; {1:G3} N/m is the default", given.Stiffness, ruled.Stiffness);
            }
            return given.Stiffness <= MaxOfRule * ruled.Stiffness ? null : string.Format(
                CultureInfo.InvariantCulture, "contactStiffness = {0:G3} N/m is so large that rounding hides the "
                    + "wire's stiffness; {1:G3} N/m is the default", given.Stiffness, ruled.Stiffness);
        }

        /// <summary>The barrier of a rod between walls.</summary>
        /// <param name="contact">Values other than 0 take precedence.</param>
        /// <param name="walls">In units.</param>
        /// <param name="metresPerUnit">m.</param>
        /// <param name="move">Largest displacement of the drive in a step, m.</param>
        public static Barrier Of(MaterialRod rod, ContactParameters contact, ContactShape[] walls,
            double metresPerUnit, double move)
        {
            double thinnest = double.PositiveInfinity;
            double thickest = 0.0;
            double force = 0.0;
            for (int j = 0; j < rod.ElementCount; j++)
            {
                thinnest = Math.Min(thinnest, rod.Radius[j]);
                thickest = Math.Max(thickest, rod.Radius[j]);
                double bend = Math.Max(rod.BendStiffness1[j], rod.BendStiffness2[j]);
                double span = Span * rod.Radius[j];
                force = Math.Max(force, bend / (span * span));
                Vector3d rest = rod.RestCurvature[j];
                double curvature = Math.Sqrt(rest.X * rest.X + rest.Y * rest.Y);
                force = Math.Max(force, bend * curvature / rod.Length[j]);
            }
            double distance = contact.ContactDistance;
            if (distance == 0.0)
            {
                distance = Math.Max(OfRadius * thinnest, move / MaxMove);
                foreach (ContactShape wall in walls)
                {
                    if (wall.Softness != null)
                    {
                        continue;    // its barriers have a distance of their own
                    }
                    distance = wall.IsSurface ? Math.Min(distance, InMesh * thinnest) : distance;
                    double narrowest = metresPerUnit * wall.NarrowestRadius(
                        thickest / metresPerUnit, (thickest + distance / OfClearance) / metresPerUnit);
                    distance = Math.Min(distance, OfClearance * (narrowest - thickest));
                }
                distance = Math.Max(distance, MinOfRadius * thinnest);
            }
            return new Barrier(distance, contact.ContactStiffness > 0.0 ? contact.ContactStiffness : force / distance);
        }
    }
}
