using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Checks whether soft walls suit the method, the wire's radius and its weight.</summary>
    public static class SoftWallConflict
    {
        private const double AsRigid = 1e7;    // Pa
        private const double OnePercent = 0.2;    // of the length over which a load spreads: l^2/4 of it is the error
        private const double MostInStep = 1e12;    // Pa, of a wall and its dashpot

        /// <summary>The first value that does not, or null.</summary>
        internal static ParameterConflict? Find(SimulationParameters parameters)
        {
            foreach (ContactShape wall in parameters.Scene.Walls)
            {
                ParameterConflict? problem = wall.Softness == null ? null : Find(parameters, wall, wall.Softness);
                if (problem != null)
                {
                    return problem;
                }
            }
            return null;
        }

        /// <summary>Lines on walls that are as good as rigid, and on elements too long for a wall.</summary>
        public static IEnumerable<string> Warnings(SimulationParameters parameters)
        {
            double[] lengths = ElementLayout.Lengths(parameters, 1.0, out double[] stations);
            foreach (ContactShape wall in parameters.Scene.Walls)
            {
                if (wall.Softness == null)
                {
                    continue;
                }
                double stiffness = wall.Softness.Regions?.Stiffest ?? wall.Softness.Stiffness;
                if (stiffness > AsRigid)
                {
                    yield return WarningTable.SoftStiff.Text(wall.Softness.Name, stiffness);
                }
                double worst = 1.0;
                double length = 0.0;
                for (int j = 0; j < lengths.Length; j++)
                {
                    CrossSection section = CrossSection.At(parameters.Material, 0.5 * (stations[j] + stations[j + 1]));
                    double spread = Math.Sqrt(Math.Sqrt(4.0 * section.BendStiffness1 / stiffness));
                    double own = parameters.Scene.MetresPerUnit * lengths[j];
                    length = own > worst * spread ? own : length;
                    worst = Math.Max(worst, own / spread);
                }
                if (length > 0.0)
                {
                    yield return WarningTable.SoftElements.Text(length, length / worst, wall.Softness.Name,
                        OnePercent * length / worst);
                }
            }
        }

        private static ParameterConflict? Find(SimulationParameters parameters, ContactShape wall, WallSoftness soft)
        {
            if (!MethodTable.Of(parameters.Method.Solver).HasBarriers)
            {
                return Of(soft, "wallStiffness", "solver direct: with the others every wall is rigid");
            }
            double radius = 0.0;
            double density = 0.0;
            Include(parameters.Material, parameters.Scene.GuidewireLength, ref radius, ref density);
            foreach (Catheter catheter in parameters.Scene.Catheters)
            {
                Include(catheter.Material, catheter.Length, ref radius, ref density);
            }
            if (soft.Limit >= radius && wall.MovedOut(soft.Limit / parameters.Scene.MetresPerUnit) == null)
            {
                return Of(soft, "softLimit", string.Format(CultureInfo.InvariantCulture, "a value below the wire's "
                    + "radius, {0:G4} m: only planes and tubes may give way farther", radius));
            }
            double longest = MostInStep / (soft.Regions?.Stiffest ?? soft.Stiffness) * parameters.Method.TimeStep;
            if (soft.RelaxationTime > longest)
            {
                return Of(soft, "relaxationTime", string.Format(CultureInfo.InvariantCulture, "at most {0:G4} s: with "
                    + "this timeStep the wall would not give way in a step", longest));
            }
            double weight = density * parameters.Scene.Gravity.Length;
            double most = soft.Limit > 0.0 ? soft.Limit : soft.MaxOf(radius);
            double softest = Math.Min(soft.Stiffness, soft.Regions?.Softest ?? soft.Stiffness);
            return softest * most > weight ? null
                : Of(soft, softest < soft.Stiffness ? "regions" : "wallStiffness",
                    string.Format(CultureInfo.InvariantCulture, "more than {0:G4} Pa: the "
                    + "weight alone, {1:G4} N/m, would press the wall to its softLimit, {2:G4} m", weight / most,
                    weight, most));
        }

        // The largest radius, m, and the sum of the largest masses per length, kg/m.
        private static void Include(MaterialParameters material, double length, ref double radius, ref double density)
        {
            double heaviest = 0.0;
            foreach (CrossSection piece in new WireProfile(material, length).Pieces)
            {
                radius = Math.Max(radius, piece.Radius);
                heaviest = Math.Max(heaviest, piece.LineDensity);
            }
            density += heaviest;
        }

        private static ParameterConflict Of(WallSoftness soft, string key, string needed) =>
            new ParameterConflict(soft.Name + "." + key, needed);
    }

    /// <summary>Displacements of soft walls at all instruments of a run.</summary>
    public static class SoftWallDisplacements
    {
        /// <summary>Displacements at the elements of the wire and then of each catheter, m; none where all walls are
        /// rigid.</summary>
        public static IEnumerable<Vector3d[]> Of(Simulation run)
        {
            if (run.Contacts == null || run.Contacts.Displacements.Length == 0)
            {
                yield break;
            }
            yield return run.Contacts.Displacements;
            foreach (CoaxialRecord catheter in run.Catheters())
            {
                yield return catheter.WallDisplacements;
            }
        }

        /// <summary>Writes or restores them, and the forces of strands.</summary>
        internal static void Serialize(Simulation run, Snapshot snapshot)
        {
            foreach (Vector3d[] own in Of(run))
            {
                snapshot.Serialize(own);
            }
            snapshot.Serialize(run.Contacts?.StrandForces ?? Array.Empty<Vector3d>());
            foreach (CoaxialRecord catheter in run.Catheters())
            {
                snapshot.Serialize(catheter.StrandForces);
            }
        }
    }
}
