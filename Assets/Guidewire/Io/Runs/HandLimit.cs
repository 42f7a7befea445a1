using System;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>The force beyond which a hub slips in the hand, where the parameters state none: the push at which the
    /// instrument, coiled up in its lumen, is strained by what it bears without yielding.</summary>
    /// <remarks>A shaft of bending stiffness EI under a thrust F lies as a helix on the wall of a lumen whose clearance
    /// from its axis is r, with the pitch p = 2 pi sqrt(2 EI/F) (Lubinski, Althouse and Logan 1962, J Petrol Technol
    /// 14:655). Its curvature r (2 pi/p)^2 = F r/(2 EI) strains the outer fibre, at the radius a, by F r a/(2 EI).
    /// Nitinol and steel of instruments bear about <see cref="Elastic"/>.</remarks>
    internal static class HandLimit
    {
        private const double Elastic = 0.01;    // strain

        // Of an element of a pbd wire, which has no force: half of that which loses a run where it stays. A wire that
        // is pushed freely through an arch has 0.04.
        private const double Slip = 0.1;

        /// <summary>A hand, whose pbd wire slips before it is lost if it is limited.</summary>
        public static Steering Hand(bool isLimited) =>
            new Steering { SlipStrain = isLimited ? Slip : double.PositiveInfinity };

        /// <summary>Sets the hubForceLimit of each hub that has none, where the method takes one.</summary>
        public static void Set(SimulationParameters parameters)
        {
            SceneParameters scene = parameters.Scene;
            if (!MethodTable.Of(parameters.Method.Solver).TakesMaterial || scene.Walls.Length == 0
                || !ParameterTable.Find("hubForceLimit")!.IsTakenBy(parameters.Method.Solver))
            {
                return;
            }
            double clearance = Clearance(parameters) * scene.MetresPerUnit;
            if (clearance == 0.0)
            {
                return;
            }
            parameters.Drive.HubForceLimit = Limit(parameters.Drive, parameters.Material, clearance);
            foreach (Catheter catheter in scene.Catheters)
            {
                catheter.Drive.HubForceLimit = Limit(catheter.Drive, catheter.Material, clearance);
            }
        }

        private static double Limit(DriveParameters drive, MaterialParameters material, double clearance)
        {
            double stiffness = material.YoungsModulus * material.SecondMomentOfArea;
            return !double.IsNaN(drive.HubForceLimit) ? drive.HubForceLimit
                : Math.Min(HubLimit.Grip, 2.0 * stiffness * Elastic / (clearance * material.WireRadius));
        }

        // The widest place of the lumen in which the straight wire lies at the start, units: there it buckles first.
        private static double Clearance(SimulationParameters parameters)
        {
            SceneParameters scene = parameters.Scene;
            double widest = 0.0;
            for (int i = 0; i <= scene.NumberRodElements; i++)
            {
                var node = new Vector3d(0.0, 0.0,
                    scene.GuidewireOffset + scene.GuidewireLength * i / scene.NumberRodElements);
                double least = double.PositiveInfinity;
                foreach (ContactShape wall in scene.Walls)
                {
                    int hint = -1;
                    if (!wall.Contains(node))
                    {
                        least = 0.0;
                    }
                    else if (wall.Nearest(node, node, double.PositiveInfinity, ref hint, out SurfaceContact contact))
                    {
                        least = Math.Min(least, contact.Distance);
                    }
                }
                widest = double.IsInfinity(least) ? widest : Math.Max(widest, least);
            }
            return widest;
        }
    }
}
