using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Whether a wire and the catheter over it fit one another at their start.</summary>
    internal static class CoaxialStart
    {
        /// <summary>What would be needed, in one phrase; or null.</summary>
        public static string? FindProblem(SimulationParameters parameters)
        {
            SceneParameters scene = parameters.Scene;
            Catheter catheter = scene.Catheters[0];
            double lumen = catheter.Material.InnerRadius;
            double widest = 0.0;
            foreach (CrossSection piece in new WireProfile(parameters.Material, scene.GuidewireLength).Pieces)
            {
                widest = Math.Max(widest, piece.Radius);
                if (piece.BendStiffness1 != piece.BendStiffness2)
                {
                    return "a wire that bends alike in both directions: a strip has no angle to turn by in a lumen";
                }
            }
            if (!(lumen > widest))
            {
                return Text("a lumenRadius of more than the radius of the wire inside, {0:G4} m (it is {1:G4} m)",
                    widest, lumen);
            }
            foreach (CrossSection piece in new WireProfile(catheter.Material, catheter.Length).Pieces)
            {
                if (!(piece.Radius > lumen))
                {
                    return Text("a lumenRadius of less than the wireRadius, {0:G4} m (it is {1:G4} m)", piece.Radius,
                        lumen);
                }
                if (piece.BendStiffness1 != piece.BendStiffness2)
                {
                    return "a catheter that bends alike in both directions";
                }
            }
            double element = catheter.Length / catheter.Elements;
            double most = scene.GuidewireLength - element;
            if (catheter.Start > most)
            {
                return Text("a start of at most {0:G6} units, so that the wire reaches through the first of its"
                    + " elements (it is {1:G6})", most, catheter.Start);
            }
            return FindCrossing(parameters, catheter);
        }

        // Of hubs whose motion is known before.
        private static string? FindCrossing(SimulationParameters parameters, Catheter catheter)
        {
            if (parameters.Drive.Steering != null)
            {
                return null;
            }
            double duration = parameters.Method.MaxSimulationSteps * parameters.Method.TimeStep;
            double lead = parameters.Scene.MetresPerUnit * catheter.Start;
            const int samples = 1000;
            for (int k = 1; k <= samples; k++)
            {
                double time = duration * k / samples;
                double wire = Insertion(parameters.Drive, time);
                double other = Insertion(catheter.Drive, time);
                if (wire - other > lead * (1.0 + 1e-9) + 1e-12)
                {
                    return Text("hubs that do not cross: at t = {0:G4} s the wire's has gone {1:G4} m farther than the"
                        + " catheter's, which starts " + lead.ToString("G4", CultureInfo.InvariantCulture)
                        + " m ahead of it", time, wire - other);
                }
            }
            return null;
        }

        private static double Insertion(DriveParameters drive, double time)
        {
            return drive.Table != null ? drive.Table.Insertion.At(time) - drive.Table.Insertion.At(0.0)
                : drive.Kind == Drive.Hold ? 0.0 : drive.InsertionSpeed * time;
        }

        private static string Text(string format, double first, double second)
        {
            return string.Format(CultureInfo.InvariantCulture, format, first, second);
        }
    }
}
