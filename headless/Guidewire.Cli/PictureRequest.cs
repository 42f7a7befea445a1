using System;
using Guidewire.Core;
using Guidewire.Io;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Cli
{
    /// <summary>Reads which picture of a session is requested.</summary>
    internal static class PictureRequest
    {
        private const string Point = "[x, y, z], each a number from -1e9 to 1e9 (units)";

        private static readonly (string Word, VesselContrast Contrast)[] Vessels =
        {
            ("none", VesselContrast.None), ("contrast", VesselContrast.Contrast), ("roadmap", VesselContrast.RoadMap),
            ("injected", VesselContrast.Injected),
        };

        /// <summary>The view that members of an object stand for; what it leaves out or has as null is as by
        /// default.</summary>
        /// <exception cref="ParameterException">A member that is not known, or a value that is not allowed.</exception>
        public static PictureView Read(JObject json)
        {
            var view = new PictureView();
            foreach (JProperty member in json.Properties())
            {
                if (member.Value.Type != JTokenType.Null)
                {
                    SetField(view, member.Name, member.Value);
                }
            }
            return view;
        }

        private static void SetField(PictureView view, string name, JToken value)
        {
            FluoroscopySettings settings = view.Settings;
            switch (name)
            {
                case "lao":
                    view.LeftOblique = Number(name, value, -360.0, 360.0, "a number from -360 to 360 (degrees)");
                    break;
                case "cranial":
                    view.Cranial = Number(name, value, -90.0, 90.0, "a number from -90 to 90 (degrees)");
                    break;
                case "centre":
                    view.Centre = value is JArray { Count: 3 } centre
                        ? new Vector3d(Coordinate(centre, 0), Coordinate(centre, 1), Coordinate(centre, 2))
                        : throw Wrong(name, value, Point);
                    break;
                case "fieldOfView":
                    view.FieldOfView = Number(name, value, double.Epsilon, 1e6, "a number > 0 and <= 1e6 (mm)");
                    break;
                case "pixels":
                    double pixels = Number(name, value, 1.0, CArm.MaxPixels, "a whole number from 1 to "
                        + CArm.MaxPixels);
                    view.Pixels = value.Type == JTokenType.Integer ? (int)pixels
                        : throw Wrong(name, value, "a whole number from 1 to " + CArm.MaxPixels);
                    break;
                case "vessel":
                    int word = Array.FindIndex(Vessels, pair => value.Type == JTokenType.String
                        && pair.Word == (string?)value);
                    settings.Vessel = word >= 0 ? Vessels[word].Contrast
                        : throw Wrong(name, value, "one of \"none\", \"contrast\", \"roadmap\", \"injected\"");
                    break;
                case "contrast":
                    settings.Contrast = Number(name, value, 0.0, 1e6, "a number from 0 to 1e6 (1/mm)");
                    break;
                case "attenuation":
                    view.Attenuation = Number(name, value, 0.0, 1e6, "a number from 0 to 1e6 (1/mm)");
                    break;
                case "background":
                    settings.Background = Number(name, value, 1e-6, 1.0, "a number from 1e-6 to 1");
                    break;
                case "noise":
                    settings.Noise = Number(name, value, 0.0, 1.0, "a number from 0 to 1");
                    break;
                case "seed":
                    settings.Seed = value.Type == JTokenType.Integer
                        ? (uint)Number(name, value, 0.0, uint.MaxValue, "a whole number from 0 to 4294967295")
                        : throw Wrong(name, value, "a whole number from 0 to 4294967295");
                    break;
                case "blur":
                    settings.Blur = Number(name, value, 0.0, 1e3, "a number from 0 to 1000 (mm)");
                    break;
                default:
                    throw new ParameterException("request: view has no " + name);
            }
        }

        private static double Coordinate(JArray point, int axis) => Number("centre", point[axis], -1e9, 1e9, Point);

        private static double Number(string name, JToken value, double low, double high, string allowed)
        {
            bool isNumber = value.Type == JTokenType.Integer || value.Type == JTokenType.Float;
            return isNumber && (double)value >= low && (double)value <= high ? (double)value
                : throw Wrong(name, value, allowed);
        }

        private static ParameterException Wrong(string name, JToken value, string allowed) =>
            new ParameterException("request", name, value.ToString(Formatting.None), allowed);
    }
}
