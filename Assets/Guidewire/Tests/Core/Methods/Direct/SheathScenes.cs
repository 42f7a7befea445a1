using System;
using System.Collections.Generic;

namespace Guidewire.Core.Tests
{
    /// <summary>Scenes of a wire that is fed into a vessel from a sheath.</summary>
    internal static class SheathScenes
    {
        /// <summary>Of the hub, m/s.</summary>
        public const double Speed = 0.02;

        /// <summary>Of the wire, m.</summary>
        public const double Radius = 0.18e-3;

        /// <summary>Radius of the vessel, mm.</summary>
        public const double Lumen = 2.0;

        /// <summary>A nitinol wire whose last 30 mm are bent by 45 degrees, its tip so far (mm) out of a sheath that
        /// ends at z = 0.</summary>
        public static SimulationParameters Sheathed(int n, double length, double tip)
        {
            SimulationParameters parameters = WallScenes.Wire(n, Radius);
            parameters.Scene.GuidewireLength = 1e3 * length;
            parameters.Scene.GuidewireOffset = tip - 1e3 * length;
            parameters.Scene.Sheath = new Sheath { Exit = Vector3d.Zero };
            parameters.Scene.Walls = new ContactShape[] { Vessel(0.0) };
            parameters.Drive.Kind = Drive.Displace;
            parameters.Material.MassDamping = 20.0;
            parameters.Material.Sections = new[]
            {
                new WireSection
                {
                    From = 1e3 * length - 30.0, To = 1e3 * length, YoungsModulus = 20e9,
                    RestCurvature = new Vector3d(-0.25 * Math.PI / 0.03, 0.0, 0.0),
                },
            };
            parameters.Method.TimeStep = 5e-3;
            return parameters;
        }

        /// <summary>A straight wire of 300 mm in steps of 10 ms, its tip 5 mm out of a sheath that ends at z = 0, in a
        /// tube from here (mm) to z = 600 mm.</summary>
        public static SimulationParameters Straight(int n, double tubeStart)
        {
            SimulationParameters parameters = WallScenes.Wire(n, Radius);
            parameters.Scene.GuidewireLength = 300.0;
            parameters.Scene.GuidewireOffset = -295.0;
            parameters.Scene.Sheath = new Sheath { Exit = Vector3d.Zero };
            parameters.Scene.Walls = WallScenes.Tube(tubeStart, 600.0, 4.0);
            parameters.Drive.Kind = Drive.Displace;
            parameters.Material.MassDamping = 20.0;
            parameters.Method.TimeStep = 0.01;
            return parameters;
        }

        /// <summary>Straight along z, then a bend of 70 degrees; in front, where asked for, a tight tube of this
        /// radius, mm.</summary>
        public static TubeShape Vessel(double tight)
        {
            const double Bend = 40.0;
            var knots = new List<Vector3d>();
            var radii = new List<double>();
            if (tight > 0.0)
            {
                knots.AddRange(new[] { new Vector3d(0.0, 0.0, -600.0), Vector3d.Zero, new Vector3d(0.0, 0.0, 6.0) });
                radii.AddRange(new[] { tight, tight, Lumen });
            }
            else
            {
                knots.Add(new Vector3d(0.0, 0.0, -12.0));
                radii.Add(Lumen);
            }
            const double End = 70.0 * Math.PI / 180.0;
            for (int k = 0; k <= 20; k++)
            {
                double angle = End * k / 20.0;
                knots.Add(new Vector3d(0.0, Bend * (1.0 - Math.Cos(angle)), 120.0 + Bend * Math.Sin(angle)));
                radii.Add(Lumen);
            }
            knots.Add(knots[knots.Count - 1] + 200.0 * new Vector3d(0.0, Math.Sin(End), Math.Cos(End)));
            radii.Add(Lumen);
            return new TubeShape(knots.ToArray(), radii.ToArray(), true, true);
        }
    }
}
