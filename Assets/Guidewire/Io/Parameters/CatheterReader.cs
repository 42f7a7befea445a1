using System;
using System.Collections.Generic;
using Guidewire.Core;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Reads the key catheters: a list of objects, each with the keys of an instrument of its own.</summary>
    internal static class CatheterReader
    {
        /// <summary>The key.</summary>
        public const string Key = "catheters";

        private const double MaxFriction = 2.0;   // it enters as exp(mu angle)
        private const string InstrumentFile = ".json: ";

        // What a catheter calls it, and what the wire does.
        private static readonly (string Own, string Wire)[] Names =
        {
            ("length", "guidewireLength"),
            ("elements", "numberRodElements"),
            ("lumenRadius", "innerRadius"),
        };

        private static readonly string[] Shared =
        {
            "instrument", "wireRadius", "coreDiameter", "youngsModulus", "shearModulus", "density", "shearFactor",
            "bendingStiffness", "torsionalStiffness", "axialStiffness", "massPerLength", "material", "plateau",
            "yieldStress", "hardening", "fibres", "shaped", "restCurvature", "wireSections", "insertionSpeed",
            "rotationSpeed", "driveFile", "slipSpeed", "tipForce", "distributedForce", "pointLoads",
        };

        private static readonly string[] Needed = { "length", "wireRadius", "lumenRadius" };    // or an instrument

        // What the wire says for all.
        private static readonly string[] FromScene = { "metresPerUnit", "timeStep", "maxSimulationSteps" };

        /// <summary>Sets the catheters of a scene.</summary>
        /// <param name="values">Its parameters.</param>
        /// <param name="sourceOf">Who said what stands at a path.</param>
        /// <param name="warnings">Takes what is allowed but most likely not meant.</param>
        /// <param name="held">Files in memory.</param>
        /// <exception cref="ParameterException">An object that is no catheter.</exception>
        public static void Read(RunParameters values, Func<string, string> sourceOf, List<string> warnings,
            IReadOnlyDictionary<string, byte[]> held)
        {
            var catheters = new List<Catheter>();
            var list = (JArray)(values.Catheters?.DeepClone() ?? new JArray());
            values.Catheters = values.Catheters == null ? null : list;
            for (int k = 0; k < list.Count; k++)
            {
                string where = Key + "[" + k + "]";
                if (!(list[k] is JObject item))
                {
                    throw new ParameterException(sourceOf(where), where, list[k].ToString(Formatting.None),
                        "an object {\"length\", \"wireRadius\", \"lumenRadius\", ...}");
                }
                catheters.Add(Read(values, item, sourceOf, where, warnings, held));
            }
            values.Simulation.Scene.Catheters = catheters;
        }

        private static Catheter Read(RunParameters values, JObject item, Func<string, string> sourceOf, string where,
            List<string> warnings, IReadOnlyDictionary<string, byte[]> held)
        {
            string whole = sourceOf(where);
            var given = new List<(string Key, JToken Value, string Source)>
            {
                ("solver", "direct", whole),
                ("drive", "displace", whole),
                ("proximalEnd", "clamped", whole),
            };
            foreach (string key in FromScene)
            {
                given.Add((key, ParameterTable.Find(key)!.Write(values), whole));
            }
            double start = 0.0;
            double friction = double.NaN;
            double lumenFriction = 0.0;
            var limit = new RunParameters(Solver.Direct);
            foreach (JProperty property in item.Properties())
            {
                int at = Array.FindIndex(Names, name => name.Own == property.Name);
                string source = sourceOf(where + "." + property.Name);
                if (property.Name == "start")
                {
                    start = NotNegative(property, source, where, " (units)");
                }
                else if (property.Name == "frictionCoefficient")
                {
                    friction = NotNegative(property, source, where, "");
                }
                else if (property.Name == "lumenFriction")
                {
                    lumenFriction = NotNegative(property, source, where, "");
                    if (lumenFriction > MaxFriction)
                    {
                        throw new ParameterException(source, where + "." + property.Name,
                            property.Value.ToString(Formatting.None), "a coefficient of friction from 0 to 2");
                    }
                }
                else if (property.Name == "hubForceLimit")
                {
                    ParameterEntry entry = ParameterTable.Find("hubForceLimit")!;
                    if (!entry.TryRead(limit, property.Value))
                    {
                        throw new ParameterException(source, where + "." + property.Name,
                            property.Value.ToString(Formatting.None), entry.Allowed);
                    }
                }
                else if (at >= 0 || Array.IndexOf(Shared, property.Name) >= 0)
                {
                    given.Add((at >= 0 ? Names[at].Wire : property.Name, property.Value, source));
                }
                else
                {
                    throw new ParameterException(source + ": unknown key '" + where + "." + property.Name
                        + "': allowed are start, frictionCoefficient, lumenFriction, hubForceLimit, "
                        + string.Join(", ", Array.ConvertAll(Names, name => name.Own)) + ", "
                        + string.Join(", ", Shared));
                }
            }
            foreach (string name in Needed)
            {
                if (item[name] == null && item["instrument"] == null)
                {
                    throw new ParameterException(whole + ": " + where + " needs " + name + ", or an instrument");
                }
            }
            ParameterHandler handler = Load(given, where, held);
            warnings.AddRange(handler.Warnings);
            SimulationParameters own = handler.Values.Simulation;
            if (own.Material.InnerRadius == 0.0 && item["lumenRadius"] == null)
            {
                throw new ParameterException(sourceOf(where + ".instrument"), where + ".instrument",
                    item["instrument"]!.ToString(Formatting.None), "a catheter: this instrument has no lumen");
            }
            if (item["driveFile"] != null)
            {
                item["driveFile"] = handler.Values.DriveFile;
            }
            own.Drive.HubForceLimit = limit.Simulation.Drive.HubForceLimit;
            values.CatheterHashes += handler.Hash + "\n";
            return new Catheter
            {
                Length = own.Scene.GuidewireLength,
                Elements = own.Scene.NumberRodElements,
                Start = start,
                FrictionCoefficient = friction,
                LumenFriction = lumenFriction,
                TipForce = own.Scene.TipForce,
                DistributedForce = own.Scene.DistributedForce,
                PointLoads = own.Scene.PointLoads,
                Material = own.Material,
                Drive = own.Drive,
            };
        }

        // The file of an instrument, whose keys have it as their source.
        private static string InFile(string line)
        {
            int end = line.IndexOf(InstrumentFile, StringComparison.Ordinal);
            return end < 0 ? "" : line.Substring(0, end + InstrumentFile.Length - 2);
        }

        private static double NotNegative(JProperty property, string source, string where, string unit)
        {
            return Kinds.TryNumber(property.Value, out double number) && number >= 0.0
                && number <= double.MaxValue ? number
                : throw new ParameterException(source, where + "." + property.Name,
                    property.Value.ToString(Formatting.None), "a number >= 0" + unit);
        }

        // An error names the catheter, and its keys by their names in a catheter.
        private static ParameterHandler Load(List<(string Key, JToken Value, string Source)> given, string where,
            IReadOnlyDictionary<string, byte[]> held)
        {
            try
            {
                return ParameterHandler.Load(given, held);
            }
            catch (ParameterException error)
            {
                string line = error.Message;
                string source = given.Find(
                    item => line.StartsWith(item.Source + ": ", StringComparison.Ordinal)).Source ?? InFile(line);
                line = source.Length > 0 ? line.Substring(source.Length + 2) : line;
                foreach ((string own, string wire) in Names)
                {
                    line = line.Replace(wire, own);
                }
                throw new ParameterException((source.Length > 0 ? source + ": " : "") + where + "." + line);
            }
        }
    }

    /// <summary>Reads the key sheath: an object with an exit and a direction, either of which may be missing.</summary>
    internal static class SheathReader
    {
        /// <summary>Sets the sheath of a scene.</summary>
        /// <param name="values">Its parameters.</param>
        /// <param name="sourceOf">Who said what stands at a path.</param>
        /// <exception cref="ParameterException">An object that is no sheath.</exception>
        public static void Read(RunParameters values, Func<string, string> sourceOf)
        {
            if (values.Sheath == null)
            {
                return;
            }
            var fields = new JsonFields(sourceOf, "sheath", values.Sheath);
            if (values.Sheath["lumenFriction"] != null)
            {
                // Where nothing bends exp(mu angle) is 1. There are two forces M/a at the exit, a = sqrt(12 d B/M).
                throw fields.Wrong("lumenFriction", "no value: along a straight sheath nothing presses on its wall, "
                    + "and at its exit the bent wire presses by a force that follows from the play, which a sheath "
                    + "does not state");
            }
            fields.Allow("exit", "direction");
            var sheath = new Sheath();
            if (values.Sheath["exit"] != null)
            {
                sheath.Exit = fields.Vector("exit", null);
            }
            if (values.Sheath["direction"] != null)
            {
                sheath.Direction = fields.Vector("direction", null);
                if (sheath.Direction.Value.LengthSquared == 0.0)
                {
                    throw fields.Wrong("direction", "three numbers [x, y, z], not all 0");
                }
            }
            values.Simulation.Scene.Sheath = sheath;
        }
    }

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
