using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Checks whether a wire and the catheters over it fit one another at the start.</summary>
    internal static class CoaxialStart
    {
        private const string EqualInBothDirections = "sections of equal bending stiffness in both directions, where "
            + "two instruments are in one another: in a lumen a strip cannot turn by an angle";

        /// <summary>What does not go with another one, and what it would need; or null.</summary>
        public static ParameterConflict? FindProblem(SimulationParameters parameters)
        {
            SceneParameters scene = parameters.Scene;
            IReadOnlyList<Catheter> catheters = scene.Catheters;
            double widest = 0.0;
            foreach (CrossSection piece in new WireProfile(parameters.Material, scene.GuidewireLength).Pieces)
            {
                widest = Math.Max(widest, piece.Radius);
                if (piece.BendStiffness1 != piece.BendStiffness2)
                {
                    return new ParameterConflict("wireSections", EqualInBothDirections);
                }
            }
            for (int k = catheters.Count - 1; k >= 0; k--)
            {
                ParameterConflict? problem = FindProblem(catheters, k, ref widest) ?? FindProblemOfTips(scene, k);
                if (problem != null)
                {
                    return problem;
                }
            }
            return FindCrossing(parameters);
        }

        // widest: what is inside, and then what this one is, m.
        private static ParameterConflict? FindProblem(IReadOnlyList<Catheter> catheters, int k, ref double widest)
        {
            Catheter catheter = catheters[k];
            double lumen = catheter.Material.InnerRadius;
            double outer = widest;
            if (!(lumen > widest))
            {
                string inside = k == catheters.Count - 1 ? "the wire's" : "the inner catheter's";
                return Of(k, "lumenRadius", "more than {0:G4} m, " + inside + " own largest radius (the "
                    + "lumen has {1:G4} m)", widest, lumen);
            }
            var profile = new WireProfile(catheter.Material, catheter.Length);
            for (int p = 0; p < profile.Pieces.Length; p++)
            {
                CrossSection piece = profile.Pieces[p];
                double from = profile.Borders[p];
                double to = profile.Borders[p + 1];
                double own = CrossSection.LumenAt(catheter.Material, 0.5 * (from + to));
                if (!(own > widest))
                {
                    return Of(k, "wireSections", "an innerRadius of more than {0:G4} m everywhere, the largest radius"
                        + " of what is inside (it is {1:G4} m from {2:G4} to {3:G4} units)", widest, own, from, to);
                }
                if (!(piece.Radius > lumen))
                {
                    return Of(k, "lumenRadius", "less than {0:G4} m, the catheter's own radius where it is thinnest"
                        + " (the lumen has {1:G4} m)", piece.Radius, lumen);
                }
                if (piece.BendStiffness1 != piece.BendStiffness2)
                {
                    return Of(k, "wireSections", EqualInBothDirections);
                }
                outer = Math.Max(outer, piece.Radius);
            }
            widest = outer;
            return null;
        }

        // Of what is inside, in the first element of the outermost catheter.
        private static ParameterConflict? FindProblemOfTips(SceneParameters scene, int k)
        {
            Catheter outermost = scene.Catheters[0];
            Catheter own = scene.Catheters[k];
            double element = outermost.Length / outermost.Elements;
            if (k == 0)
            {
                double most = scene.GuidewireLength - element;
                return own.Start <= most ? null : most < 0.0
                    ? new ParameterConflict("guidewireLength", Text("more than {0:G6} units: the wire has to "
                        + "extend through the first element of the catheter", element))
                    : Of(k, "start", "at most {0:G6} units, so that the wire extends through the first element of the "
                        + "catheter", most);
            }
            if (own.Start > outermost.Start)
            {
                return Of(k, "start", "at most {0:G6} units, that of the catheter around it", outermost.Start);
            }
            double least = outermost.Start + element - own.Length;
            return own.Start >= least ? null : Of(k, "start", "at least {0:G6} units, so that it extends through the "
                + "first element of the catheter around it", least);
        }

        // Of hubs whose motion is known before: each with the next one around it, where one is held fast. One that is
        // driven is carried along.
        private static ParameterConflict? FindCrossing(SimulationParameters parameters)
        {
            int count = parameters.Scene.Catheters.Count;
            ParameterConflict? problem = null;
            for (int k = 0; k < count && problem == null && parameters.Drive.Steering == null; k++)
            {
                problem = FindCrossing(parameters, k);
            }
            return problem;
        }

        private static ParameterConflict? FindCrossing(SimulationParameters parameters, int k)
        {
            IReadOnlyList<Catheter> catheters = parameters.Scene.Catheters;
            Catheter catheter = catheters[k];
            bool isAroundWire = k == catheters.Count - 1;
            DriveParameters inside = isAroundWire ? parameters.Drive : catheters[k + 1].Drive;
            if (!IsFixed(inside) && !IsFixed(catheter.Drive))
            {
                return null;
            }
            double start = isAroundWire ? 0.0 : catheters[k + 1].Start;
            double duration = parameters.Method.MaxSimulationSteps * parameters.Method.TimeStep;
            double lead = parameters.Scene.MetresPerUnit * (catheter.Start - start) + InsertionAtStart(parameters, k)
                - InsertionAtStart(parameters, isAroundWire ? -1 : k + 1);
            double first = double.NaN;
            double most = lead * (1.0 + 1e-9) + 1e-12;
            const int samples = 1000;
            for (int i = 1; i <= samples; i++)
            {
                double time = duration * i / samples;
                double ahead = Insertion(inside, time) - Insertion(catheter.Drive, time);
                if (ahead > most)
                {
                    first = double.IsNaN(first) ? time : first;
                    most = ahead;
                }
            }
            return double.IsNaN(first) ? null : Of(k, "start",
                "at least {0:G6} units, or other drives: at t = {1:G4} s "
                + (isAroundWire ? "the wire's hub" : "the inner catheter's hub") + " would pass "
                + (catheters.Count == 1 ? "the catheter's" : isAroundWire ? "the inner catheter's" : "the outer one's"),
                start + Math.Ceiling(1e3 * most / parameters.Scene.MetresPerUnit) / 1e3, first);
        }

        // How far a hub has come before the run, m; -1: the wire's.
        private static double InsertionAtStart(SimulationParameters parameters, int catheter)
        {
            RodStart? start = parameters.Scene.Start;
            RodStart? own = start == null || catheter < 0 ? start
                : catheter < start.Catheters.Count ? start.Catheters[catheter] : null;
            return own?.Hub?.Insertion ?? 0.0;
        }

        private static bool IsFixed(DriveParameters drive) => drive.Table == null && drive.Kind == Drive.Hold;

        private static double Insertion(DriveParameters drive, double time)
        {
            return drive.Table != null ? drive.Table.Insertion.At(time) - drive.Table.Insertion.At(0.0)
                : drive.Kind == Drive.Hold ? 0.0 : drive.InsertionSpeed * time;
        }

        private static ParameterConflict Of(int catheter, string key, string needed, params object[] numbers) =>
            new ParameterConflict("catheters[" + catheter + "]." + key, Text(needed, numbers));

        private static string Text(string format, params object[] numbers) =>
            string.Format(CultureInfo.InvariantCulture, format, numbers);
    }
}
