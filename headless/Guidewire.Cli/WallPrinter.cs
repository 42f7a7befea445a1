using System;
using System.Collections.Generic;
using System.Globalization;
using System.Text;
using Guidewire.Core;
using Guidewire.Io;
using Newtonsoft.Json.Linq;

namespace Guidewire.Cli
{
    /// <summary>The walls of a scene as triangles, for who draws them.</summary>
    internal static class WallPrinter
    {
        /// <summary>A JSON list with an object a wall, the vessel first where there is one: "vertices", [x, y, z] each,
        /// and "triangles", three indices each; seen from the wire they run counter-clockwise.</summary>
        /// <param name="arguments"><c>--walls FILE X Y Z REACH</c>.</param>
        /// <exception cref="ParameterException">Other arguments, or a file that is no parameter file.</exception>
        public static string Print(string[] arguments)
        {
            var numbers = new double[4];
            bool isUnderstood = arguments.Length == 6;
            for (int i = 0; isUnderstood && i < numbers.Length; i++)
            {
                isUnderstood = double.TryParse(arguments[i + 2], NumberStyles.Float, CultureInfo.InvariantCulture,
                    out numbers[i]) && !double.IsInfinity(numbers[i]) && !double.IsNaN(numbers[i]);
            }
            if (!isUnderstood || !(numbers[3] > 0.0))
            {
                throw new ParameterException(CommandLineHandler.Source
                    + ": --walls needs a parameter file, three numbers and a number above 0");
            }
            ParameterHandler handler = ParameterHandler.Load(arguments[1], Array.Empty<KeyValuePair<string, JToken>>());
            var middle = new Vector3d(numbers[0], numbers[1], numbers[2]);
            var walls = new List<string>();
            foreach (ContactShape wall in handler.Values.Simulation.Scene.Walls)
            {
                walls.Add(Text(WallSurface.Create(wall, middle, numbers[3])));
            }
            return "[" + string.Join(",", walls) + "]";
        }

        private static string Text(WallSurface surface)
        {
            var text = new StringBuilder("{\"vertices\":[");
            for (int i = 0; i < surface.Vertices.Count; i++)
            {
                Vector3d v = surface.Vertices[i];
                text.Append(i == 0 ? "" : ",").AppendFormat(CultureInfo.InvariantCulture, "[{0:R},{1:R},{2:R}]", v.X, v.Y,
                    v.Z);
            }
            text.Append("],\"triangles\":[");
            for (int t = 0; t < surface.Triangles.Count; t += 3)
            {
                text.Append(t == 0 ? "" : ",").AppendFormat(CultureInfo.InvariantCulture, "[{0},{1},{2}]",
                    surface.Triangles[t], surface.Triangles[t + 1], surface.Triangles[t + 2]);
            }
            return text.Append("]}").ToString();
        }
    }
}
