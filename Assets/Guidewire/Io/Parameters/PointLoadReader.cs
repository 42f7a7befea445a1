using System;
using Guidewire.Core;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Reads the key pointLoads: a list of objects with a length along the wire and a force.</summary>
    internal static class PointLoadReader
    {
        private const string Needed = "an object {\"at\" (units), \"force\" [x, y, z] (N)}";

        /// <summary>Sets the loads of a scene.</summary>
        /// <param name="values">Its parameters.</param>
        /// <param name="sourceOf">Who said what stands at a path.</param>
        /// <exception cref="ParameterException">An item that is no load.</exception>
        public static void Read(RunParameters values, Func<string, string> sourceOf)
        {
            if (!(values.PointLoads is JArray items))
            {
                return;
            }
            var loads = new PointLoad[items.Count];
            for (int k = 0; k < loads.Length; k++)
            {
                string key = "pointLoads[" + k + "]";
                if (!(items[k] is JObject))
                {
                    throw new ParameterException(sourceOf(key), key, items[k].ToString(Formatting.None), Needed);
                }
                var fields = new JsonFields(sourceOf, key, items[k]);
                fields.Allow("at", "force");
                double at = fields.Number("at", null);
                loads[k] = new PointLoad(at >= 0.0 ? at : throw fields.Wrong("at", "a number >= 0 (units)"),
                    fields.Vector("force", null));
            }
            values.Simulation.Scene.PointLoads = loads;
        }
    }
}
