using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Whether a wire and the catheter over it fit one another at their start.</summary>
    internal static class CoaxialStart
    {
        private const string AlikeInBoth = "sections that bend alike in both directions, where two instruments are in"
            + " one another: a strip has no angle to turn by in a lumen";

        /// <summary>What does not go with another one, and what it would need; or null.</summary>
        public static ParameterConflict? FindProblem(SimulationParameters parameters)
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
                    return new ParameterConflict("wireSections", AlikeInBoth);
                }
            }
            if (!(lumen > widest))
            {
                return Of("lumenRadius", "more than {0:G4} m, the wire's own radius where it is thickest (the lumen has"
                    + " {1:G4} m)", widest, lumen);
            }
            foreach (CrossSection piece in new WireProfile(catheter.Material, catheter.Length).Pieces)
            {
                if (!(piece.Radius > lumen))
                {
                    return Of("lumenRadius", "less than {0:G4} m, the catheter's own radius where it is thinnest (the"
                        + " lumen has {1:G4} m)", piece.Radius, lumen);
                }
                if (piece.BendStiffness1 != piece.BendStiffness2)
                {
                    return Of("wireSections", AlikeInBoth);
                }
            }
            double most = scene.GuidewireLength - catheter.Length / catheter.Elements;
            if (catheter.Start > most)
            {
                return most < 0.0
                    ? new ParameterConflict("guidewireLength", Text("more than {0:G6} units: the wire has to reach"
                        + " through the first element of the catheter", scene.GuidewireLength - most))
                    : Of("start", "at most {0:G6} units, so that the wire reaches through the first element of the"
                        + " catheter", most);
            }
            return FindCrossing(parameters, catheter);
        }

        // Of hubs whose motion is known before.
        private static ParameterConflict? FindCrossing(SimulationParameters parameters, Catheter catheter)
        {
            if (parameters.Drive.Steering != null)
            {
                return null;
            }
            double duration = parameters.Method.MaxSimulationSteps * parameters.Method.TimeStep;
            double lead = parameters.Scene.MetresPerUnit * catheter.Start;
            double first = double.NaN;
            double most = lead * (1.0 + 1e-9) + 1e-12;
            const int samples = 1000;
            for (int k = 1; k <= samples; k++)
            {
                double time = duration * k / samples;
                double ahead = Insertion(parameters.Drive, time) - Insertion(catheter.Drive, time);
                if (ahead > most)
                {
                    first = double.IsNaN(first) ? time : first;
                    most = ahead;
                }
            }
            return double.IsNaN(first) ? null : Of("start",
                "at least {0:G6} units, or other drives: at t = {1:G4} s the wire's hub would pass the catheter's",
                Math.Ceiling(1e3 * most / parameters.Scene.MetresPerUnit) / 1e3, first);
        }

        private static double Insertion(DriveParameters drive, double time)
        {
            return drive.Table != null ? drive.Table.Insertion.At(time) - drive.Table.Insertion.At(0.0)
                : drive.Kind == Drive.Hold ? 0.0 : drive.InsertionSpeed * time;
        }

        private static ParameterConflict Of(string key, string needed, params object[] numbers)
        {
            return new ParameterConflict("catheters[0]." + key, Text(needed, numbers));
        }

        private static string Text(string format, params object[] numbers)
        {
            return string.Format(CultureInfo.InvariantCulture, format, numbers);
        }
    }
}
