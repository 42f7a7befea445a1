using System;
using System.Globalization;
using Guidewire.Core;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Reads the keys inlet and target: places the wire, and its sheath, at an end of the vessel.</summary>
    internal static class InletReader
    {
        // A point names an end from so many of its radii.
        private const double Nearness = 3.0;

        /// <summary>Sets the start of the wire, the drive's direction and the exit of the sheath.</summary>
        /// <param name="values">The parameters; those that the inlet decides are changed.</param>
        /// <param name="given">What the user said.</param>
        /// <exception cref="ParameterException">There is no such end, or no anatomy that has ends.</exception>
        public static void Read(RunParameters values, GivenParameters given)
        {
            values.Anatomy = AnatomyReader.Read(values, given.SourceOf);
            if (values.Inlet == null && values.Target == null)
            {
                return;
            }
            string key = values.Inlet == null ? "target" : "inlet";
            string? needed = values.Inlet == null ? "an inlet"
                : values.Anatomy == null ? "vessel.anatomy, the file that the command anatomy writes beside a mesh"
                : values.StartFile.Length > 0 && values.Simulation.Scene.Start?.Hub == null
                    ? "no startFile without a \"hub\": it says where the wire starts"
                : values.Simulation.Scene.StartShape != StartShape.Straight ? "startShape \"straight\"" : null;
            if (needed != null)
            {
                throw Wrong(given, key, (values.Inlet ?? values.Target)!, needed);
            }
            Anatomy anatomy = values.Anatomy!;
            VesselEnd inlet = End(values.Inlet!, anatomy, out double distance)
                ?? throw Wrong(given, "inlet", values.Inlet!, "one of the vessel's ends, " + anatomy.List());
            if (distance > Nearness * inlet.Radius)
            {
                throw Wrong(given, "inlet", values.Inlet!, string.Format(CultureInfo.InvariantCulture,
                    "a point within {0:G3} units of one of the vessel's ends, {1}", Nearness * inlet.Radius,
                    anatomy.List()));
            }
            values.Path = new CentrelinePath(anatomy, inlet);
            if (values.Target != null)
            {
                int target = Target(values.Target, anatomy, values.Path, out string name, out double reach);
                if (target < 0)
                {
                    throw Wrong(given, "target", values.Target, "a point of the lumen, a branch, one of "
                        + string.Join(", ", anatomy.BranchNames) + ", or an end, one of " + anatomy.List());
                }
                values.Path.SetTarget(target, name, reach);
            }
            StartAt(inlet, values, given);
        }

        private static void StartAt(VesselEnd inlet, RunParameters values, GivenParameters given)
        {
            SceneParameters scene = values.Simulation.Scene;
            scene.StartAxis = new StartAxis(inlet.Centre, inlet.Direction);
            values.Simulation.Drive.DisplacementDirection = inlet.Direction;
            double depth = inlet.Radius;
            if (scene.Sheath != null && scene.Sheath.Exit == null)
            {
                scene.Sheath.Exit = inlet.Centre + depth * inlet.Direction;
            }
            if (given.Has("guidewireOffset"))
            {
                return;
            }
            double exit = scene.Sheath?.Exit is Vector3d point
                ? Vector3d.Dot(point - inlet.Centre, inlet.Direction) : depth;
            // In a sheath the tip begins a radius out of it, so that it does not depend on the elements; a solver needs
            // one of them. Without a sheath the whole wire begins inside of the inlet.
            scene.GuidewireOffset = scene.Sheath == null ? depth
                : exit + Math.Max(depth, ElementLayout.LastLength(values.Simulation)) - scene.GuidewireLength;
        }

        private static VesselEnd? End(JToken value, Anatomy anatomy, out double distance)
        {
            distance = 0.0;
            if (Kinds.TryVector(value, out Vector3d point))
            {
                VesselEnd nearest = anatomy.Nearest(point);
                distance = Vector3d.Distance(nearest.Centre, point);
                return nearest;
            }
            if (Kinds.TryNumber(value, out double number))
            {
                foreach (VesselEnd end in anatomy.Ends)
                {
                    if (end.Number == number)
                    {
                        return end;
                    }
                }
                return null;
            }
            return anatomy.Find((string)value!);
        }

        private static int Target(JToken value, Anatomy anatomy, CentrelinePath path, out string name,
            out double reach)
        {
            name = value.Type == JTokenType.String ? (string)value! : value.ToString(Formatting.None);
            VesselEnd? end = null;
            int target;
            if (Kinds.TryVector(value, out Vector3d point))
            {
                int near = path.Locate(point);
                // The lumen may be wider than its sphere, up to half as much again.
                target = Vector3d.Distance(anatomy.Points[near], point) <= 1.5 * anatomy.Radii[near] ? near : -1;
            }
            else
            {
                end = End(value, anatomy, out _);
                name = end?.Name ?? name;
                target = end?.Point ?? (value.Type == JTokenType.String ? path.Within((string)value!) : -1);
            }
            reach = target < 0 ? 0.0 : Math.Max(end?.Radius ?? 0.0, anatomy.Radii[target]);
            return target;
        }

        private static ParameterException Wrong(GivenParameters given, string key, JToken value, string needed) =>
            new ParameterException(given.SourceOf(key), key, value.ToString(Formatting.None), needed);
    }
}
