using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Whether a wire and the catheters over it fit one another at their start.</summary>
    internal static class CoaxialStart
    {
        /// <summary>What would be needed, in one phrase; or null.</summary>
        public static string? FindProblem(SimulationParameters parameters)
        {
            SceneParameters scene = parameters.Scene;
            IReadOnlyList<Catheter> catheters = scene.Catheters;
            double widest = 0.0;
            foreach (CrossSection piece in new WireProfile(parameters.Material, scene.GuidewireLength).Pieces)
            {
                widest = Math.Max(widest, piece.Radius);
                if (piece.BendStiffness1 != piece.BendStiffness2)
                {
                    return "a wire that bends alike in both directions: a strip has no angle to turn by in a lumen";
                }
            }
            for (int k = catheters.Count - 1; k >= 0; k--)
            {
                bool isAroundWire = k == catheters.Count - 1;
                string? problem = FindProblem(catheters[k], isAroundWire ? "the wire" : "the catheter", ref widest)
                    ?? FindProblemOfTips(scene, catheters, k);
                if (problem != null)
                {
                    return catheters.Count == 1 ? problem : "in its item " + k + " " + problem;
                }
            }
            return FindCrossing(parameters);
        }

        // widest: what is inside, and then what this one is, m.
        private static string? FindProblem(Catheter catheter, string inside, ref double widest)
        {
            double lumen = catheter.Material.InnerRadius;
            if (!(lumen > widest))
            {
                return Text("a lumenRadius of more than the radius of " + inside + " inside, {0:G4} m (it is {1:G4} m)",
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
                widest = Math.Max(widest, piece.Radius);
            }
            return null;
        }

        // Of what is inside, in the first element of the outermost catheter.
        private static string? FindProblemOfTips(SceneParameters scene, IReadOnlyList<Catheter> catheters, int k)
        {
            Catheter outermost = catheters[0];
            double element = outermost.Length / outermost.Elements;
            if (k == 0)
            {
                double most = scene.GuidewireLength - element;
                return outermost.Start > most
                    ? Text("a start of at most {0:G6} units, so that the wire reaches through the first of its"
                        + " elements (it is {1:G6})", most, outermost.Start) : null;
            }
            Catheter own = catheters[k];
            if (own.Start > outermost.Start)
            {
                return Text("a start of at most that of the catheter around it, {0:G6} units (it is {1:G6})",
                    outermost.Start, own.Start);
            }
            double least = outermost.Start + element - own.Length;
            return own.Start < least
                ? Text("a start of at least {0:G6} units, so that it reaches through the first element of the catheter"
                    + " around it (it is {1:G6})", least, own.Start) : null;
        }

        // Of hubs whose motion is known before: each with the next one around it.
        private static string? FindCrossing(SimulationParameters parameters)
        {
            IReadOnlyList<Catheter> catheters = parameters.Scene.Catheters;
            string? problem = null;
            for (int k = 0; k < catheters.Count && problem == null && parameters.Drive.Steering == null; k++)
            {
                bool isAroundWire = k == catheters.Count - 1;
                problem = FindCrossing(parameters, catheters[k],
                    isAroundWire ? parameters.Drive : catheters[k + 1].Drive,
                    catheters[k].Start - (isAroundWire ? 0.0 : catheters[k + 1].Start),
                    isAroundWire ? "the wire's" : "the inner catheter's",
                    catheters.Count == 1 ? "the catheter's" : isAroundWire ? "the inner catheter's"
                        : "the outer catheter's");
            }
            return problem;
        }

        // start: how far the catheter's hub is ahead of the other one, units.
        private static string? FindCrossing(SimulationParameters parameters, Catheter catheter, DriveParameters inside,
            double start, string innerName, string outerName)
        {
            double duration = parameters.Method.MaxSimulationSteps * parameters.Method.TimeStep;
            double lead = parameters.Scene.MetresPerUnit * start;
            const int samples = 1000;
            for (int k = 1; k <= samples; k++)
            {
                double time = duration * k / samples;
                double inner = Insertion(inside, time);
                double outer = Insertion(catheter.Drive, time);
                if (inner - outer > lead * (1.0 + 1e-9) + 1e-12)
                {
                    return Text("hubs that do not cross: at t = {0:G4} s " + innerName
                        + " has gone {1:G4} m farther than " + outerName + ", which starts "
                        + lead.ToString("G4", CultureInfo.InvariantCulture)
                        + " m ahead of it", time, inner - outer);
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
