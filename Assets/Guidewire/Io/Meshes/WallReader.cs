using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Makes walls of the keys vessel and obstacles. A vessel is placed by position, scale and rotation;
    /// obstacles have absolute coordinates.</summary>
    internal static class WallReader
    {
        private const double Rounding = 1e-9;    // units

        /// <summary>The key of a mesh's sum.</summary>
        public const string Sha256 = "sha256";

        /// <summary>All walls of a scene.</summary>
        /// <param name="values">Its parameters; a mesh's file name is replaced by the one that was found.</param>
        /// <param name="sourceOf">Who said what stands at a path: a parameter file, or "command line".</param>
        /// <param name="warnings">Gets a line for a wall that goes through itself.</param>
        /// <param name="from">Where the parameters come from, with files in memory.</param>
        /// <exception cref="ParameterException">A wall that cannot be made.</exception>
        public static ContactShape[] Read(
            RunParameters values, Func<string, string> sourceOf, List<string> warnings, ParameterSource from)
        {
            var walls = new List<ContactShape>();
            PatientAxesReader.Read(values, sourceOf, warnings);
            values.Places = null;
            if (values.Vessel != null)
            {
                var fields = new JsonFields(sourceOf, "vessel", values.Vessel);
                ContactShape vessel = Vessel(fields, values, sourceOf("vessel.file"), from);
                vessel.FrictionCoefficient = Friction(fields);
                vessel.Softness = SoftnessReader.Read(fields);
                SoftnessReader.ReadRegions(fields, vessel.Softness, values.Anatomy);
                vessel.Motion = BeamReader.Read(fields, values, vessel,
                    MotionReader.Read(fields, values, sourceOf, vessel, null, from.Mesh?.Motion));
                walls.Add(vessel);
                warnings.AddRange((vessel.Motion?.Cycles ?? Array.Empty<MotionCycle>())
                    .Where(cycle => cycle.Misfit?.Largest > Rounding).Select(cycle => WarningTable.FrameMisfit.Text(
                        cycle.Misfit!.Value.Mean, cycle.Misfit.Value.Largest)));
                values.Places = values.Path == null ? null
                    : new LumenPlaces(values.Path, values.Anatomy!.Ends, vessel);
                WarnOfSelfIntersection(vessel, fields.Text("file"), warnings);
            }
            int count = 0;
            foreach (JToken item in values.Obstacles ?? new JArray())
            {
                var fields = new JsonFields(sourceOf, "obstacles[" + count++ + "]", item);
                ContactShape obstacle = Obstacle(fields);
                obstacle.FrictionCoefficient = Friction(fields);
                obstacle.Softness = SoftnessReader.Read(fields);
                obstacle.Motion = MotionReader.Read(fields, values, sourceOf, obstacle,
                    values.Vessel == null ? null : walls[0].Motion);
                if (values.Vessel != null && walls[0].Motion?.Beam != null && obstacle.Motion != walls[0].Motion)
                {
                    throw fields.Wrong(MotionReader.Key, "\"vessel\" in a vessel with a beam: what is in it gives way "
                        + "with it");
                }
                walls.Add(obstacle);
            }
            return walls.ToArray();
        }

        private static void WarnOfSelfIntersection(ContactShape vessel, string file, List<string> warnings)
        {
            Vector3d position = Vector3d.Zero;
            int count = vessel is MeshShape mesh ? mesh.CountSelfIntersections(out position) : 0;
            if (count > 0)
            {
                warnings.Add(WarningTable.SelfIntersection.Text(file, count, position.X, position.Y, position.Z));
            }
        }

        private static ContactShape Vessel(
            JsonFields fields, RunParameters scene, string fileSource, ParameterSource from)
        {
            var placement = new Placement(scene.Position, Placement.FromEulerDegrees(scene.Rotation), scene.Scale);
            try
            {
                switch (fields.Text("shape"))
                {
                    case "plane":
                        Allow(fields, "point", "normal");
                        return Plane(fields, scene, placement);
                    case "tube":
                        Allow(fields, "knots", "radius", "openStart", "openEnd",
                            "smooth", BeamReader.Key);
                        return Tube(fields, scene, placement);
                    case "mesh":
                        Allow(fields, "file", "metresPerUnit", "openRims",
                            "warp", "anatomy", SoftnessReader.Regions, Sha256, BeamReader.Key);
                        return Mesh(fields, scene, placement, fileSource, from);
                    default:
                        throw fields.Wrong("shape", "one of \"plane\", \"tube\", \"mesh\"");
                }
            }
            catch (ArgumentException error)
            {
                throw fields.Refused(error.Message);
            }
        }

        private static void Allow(JsonFields fields, params string[] own)
        {
            var names = new List<string> { "shape", "frictionCoefficient", MotionReader.Key };
            names.AddRange(own);
            names.AddRange(SoftnessReader.Keys);
            fields.Allow(names.ToArray());
        }

        private static double Friction(JsonFields fields)
        {
            double coefficient = fields.Number("frictionCoefficient", 0.0);
            return coefficient >= 0.0 ? coefficient : throw fields.Wrong("frictionCoefficient", "a number >= 0");
        }

        private static PlaneShape Plane(JsonFields fields, RunParameters scene, in Placement placement)
        {
            // A plane's normal goes with the inverse of the scale.
            Vector3d n = fields.Vector("normal", null);
            var stretched = new Vector3d(n.X / scene.Scale.X, n.Y / scene.Scale.Y, n.Z / scene.Scale.Z);
            Quaterniond turn = Placement.FromEulerDegrees(scene.Rotation);
            return new PlaneShape(
                placement.Apply(fields.Vector("point", Vector3d.Zero)), Quaterniond.Rotate(turn, stretched));
        }

        private static TubeShape Tube(JsonFields fields, RunParameters scene, in Placement placement)
        {
            double size = Math.Abs(scene.Scale.X);
            if (Math.Abs(scene.Scale.Y) != size || Math.Abs(scene.Scale.Z) != size)
            {
                throw fields.Refused("a tube's scale needs three equal factors, so that its section stays circular");
            }
            Vector3d[] knots = fields.Vectors("knots");
            double[] radii = fields.Numbers("radius", knots.Length);
            for (int i = 0; i < knots.Length; i++)
            {
                knots[i] = placement.Apply(knots[i]);
            }
            radii = Array.ConvertAll(radii, radius => size * radius);
            bool openStart = fields.Switch("openStart", true);
            bool openEnd = fields.Switch("openEnd", true);
            var asGiven = new TubeShape(knots, radii, openStart, openEnd);
            if (!fields.Switch("smooth", false))
            {
                return asGiven;
            }
            RoundedCentreline.Round(ref knots, ref radii);
            try
            {
                return new TubeShape(knots, radii, openStart, openEnd);
            }
            catch (ArgumentException)
            {
                throw fields.Refused("smooth = true: near a corner the radius changes too fast for an arc; set it "
                    + "to false, or let the radii change less");
            }
        }

        private static MeshShape Mesh(
            JsonFields fields, RunParameters scene, in Placement placement, string fileSource, ParameterSource from)
        {
            if (scene.Scale.X == 0.0 || scene.Scale.Y == 0.0 || scene.Scale.Z == 0.0)
            {
                throw fields.Refused("scale needs three factors other than 0");
            }
            double metresPerUnit = fields.Positive("metresPerUnit", "m", scene.Simulation.Scene.MetresPerUnit);
            string file = Path.GetFileName(fields.Text("file"));
            if (!from.Files.TryGetValue(file, out byte[]? held))
            {
                file = NamedFile.Find(fields.Text("file"), fileSource);
            }
            if (file.Length == 0)
            {
                throw fields.Wrong("file", "the name of an .obj or .stl file");
            }
            fields.Replace("file", file);
            double scale = metresPerUnit / scene.Simulation.Scene.MetresPerUnit;
            Vector3d[] rims = fields.NamedPoints("openRims");
            if (scene.Anatomy is Anatomy anatomy && rims.Length == 0)
            {
                rims = anatomy.OpenRims;
            }
            LastMesh last = from.Mesh ?? new LastMesh();
            MeshShape wall = last.Read(file, scale, rims, placement, held, Warp(fields));
            // The parameters of a run carry the sum of its vessel: who reads the run sees no other vessel.
            string stated = fields.Text(Sha256);
            if (stated.Length > 0 && stated != last.Sha256)
            {
                throw fields.Refused(file + " has changed since: it is not the vessel that this was made with");
            }
            fields.Replace(Sha256, last.Sha256);
            return wall;
        }

        private static SmoothWarp? Warp(JsonFields fields)
        {
            if (!fields.Has("warp"))
            {
                return null;
            }
            double[] coefficients = fields.Numbers("warp", 9);
            return coefficients.Length == 9 && Array.TrueForAll(coefficients, one => Math.Abs(one) <= 1.0)
                ? new SmoothWarp(coefficients) : throw fields.Wrong("warp", "nine numbers from -1 to 1");
        }

        private static ContactShape Obstacle(JsonFields fields)
        {
            try
            {
                switch (fields.Text("shape"))
                {
                    case "sphere":
                        Allow(fields, "centre", "radius");
                        return ConvexObstacle.Sphere(fields.Vector("centre", null), fields.Number("radius", null));
                    case "capsule":
                        Allow(fields, "from", "to", "radius");
                        return ConvexObstacle.Capsule(
                            fields.Vector("from", null), fields.Vector("to", null), fields.Number("radius", null));
                    case "box":
                        Allow(fields, "centre", "halfSize", "rotation");
                        return ConvexObstacle.Box(
                            fields.Vector("centre", null), fields.Vector("halfSize", null),
                            Placement.FromEulerDegrees(fields.Vector("rotation", Vector3d.Zero)));
                    case "hull":
                        Allow(fields, "points", "radius");
                        return new ConvexObstacle(fields.Vectors("points"), fields.Number("radius", 0.0));
                    case "cylinder":
                        Allow(fields, "point", "axis", "radius");
                        return ConeShape.Cylinder(
                            fields.Vector("point", null), fields.Vector("axis", null), fields.Number("radius", null));
                    case "cone":
                        Allow(fields, "from", "to", "fromRadius", "toRadius");
                        return ConeShape.Cone(fields.Vector("from", null), fields.Vector("to", null),
                            fields.Number("fromRadius", null), fields.Number("toRadius", null));
                    case "plane":
                        Allow(fields, "point", "normal");
                        return new PlaneShape(fields.Vector("point", Vector3d.Zero), fields.Vector("normal", null));
                    default:
                        throw fields.Wrong("shape",
                            "one of \"sphere\", \"capsule\", \"box\", \"hull\", \"cylinder\", \"cone\", \"plane\"");
                }
            }
            catch (ArgumentException error)
            {
                throw fields.Refused(error.Message);
            }
        }
    }

    /// <summary>Reads how the patient lies in the scene: as the key patientAxes says, or else as the vessel's file
    /// does.</summary>
    internal static class PatientAxesReader
    {
        /// <summary>Sets the axes of a scene.</summary>
        /// <param name="values">Its parameters, the vessel's file read.</param>
        /// <param name="sourceOf">Who said what stands at a path.</param>
        /// <param name="warnings">Gets a line where key and file disagree.</param>
        public static void Read(RunParameters values, Func<string, string> sourceOf, List<string> warnings)
        {
            PatientAxes? ofVessel = values.Anatomy?.Axes;
            PatientAxes? axes = PatientAxes.Named(values.PatientAxes) ?? ofVessel;
            values.Simulation.Scene.PatientAxes = axes;
            if (ofVessel != null && !ofVessel.Equals(axes))
            {
                warnings.Add(sourceOf("patientAxes") + ": patientAxes " + values.PatientAxes
                    + " are not those of the vessel as it is placed");
            }
        }
    }
}
