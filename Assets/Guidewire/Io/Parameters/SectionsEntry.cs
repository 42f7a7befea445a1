using System;
using System.Collections.Generic;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>A list of wire sections: [{"from": 250, "to": 300, "wireRadius": 2e-4, "restCurvature": [10, 0, 0]},
    /// ...]. </summary>
    internal sealed class SectionsEntry : ParameterEntry
    {
        private readonly Func<RunParameters, IReadOnlyList<WireSection>> _get;
        private readonly Action<RunParameters, IReadOnlyList<WireSection>> _set;

        public SectionsEntry(string key, string help, Func<RunParameters, IReadOnlyList<WireSection>> get,
            Action<RunParameters, IReadOnlyList<WireSection>> set)
            : base(key, "", help)
        {
            _get = get;
            _set = set;
        }

        public override string Allowed =>
            "a list of {\"from\", \"to\" (units, from < to), and any of \"numberRodElements\" (a whole number from 1 to"
            + " 1000000), \"youngsModulus\","
            + " \"shearModulus\" (Pa), \"density\" (kg/m^3), \"wireRadius\" (m), all > 0, \"restCurvature\" (rad/m)}";

        public override JToken Write(RunParameters source)
        {
            var list = new JArray();
            foreach (WireSection section in _get(source))
            {
                var item = new JObject { ["from"] = section.From, ["to"] = section.To };
                if (section.NumberRodElements.HasValue)
                {
                    item["numberRodElements"] = section.NumberRodElements.Value;
                }
                Put(item, "youngsModulus", section.YoungsModulus);
                Put(item, "shearModulus", section.ShearModulus);
                Put(item, "density", section.Density);
                Put(item, "wireRadius", section.WireRadius);
                if (section.RestCurvature.HasValue)
                {
                    Vector3d curvature = section.RestCurvature.Value;
                    item["restCurvature"] = new JArray(curvature.X, curvature.Y, curvature.Z);
                }
                list.Add(item);
            }
            return list;
        }

        internal override bool TryRead(RunParameters target, JToken value)
        {
            if (!(value is JArray list))
            {
                return false;
            }
            var sections = new List<WireSection>();
            foreach (JToken token in list)
            {
                if (!(token is JObject item) || !TrySection(item, out WireSection section))
                {
                    return false;
                }
                sections.Add(section);
            }
            _set(target, sections);
            return true;
        }

        private static bool TrySection(JObject item, out WireSection section)
        {
            section = new WireSection { From = double.NaN, To = double.NaN };
            foreach (JProperty property in item.Properties())
            {
                if (property.Name == "restCurvature")
                {
                    if (!VectorEntry.TryVector(property.Value, out Vector3d curvature))
                    {
                        return false;
                    }
                    section.RestCurvature = curvature;
                    continue;
                }
                if (!NumberEntry.TryNumber(property.Value, out double number)
                    || !TrySet(section, property.Name, number))
                {
                    return false;
                }
            }
            return section.From >= 0.0 && section.To > section.From;
        }

        private static bool TrySet(WireSection section, string name, double number)
        {
            switch (name)
            {
                case "from":
                    section.From = number;
                    return true;
                case "to":
                    section.To = number;
                    return true;
                case "numberRodElements":
                    section.NumberRodElements = (int)Math.Max(0.0, Math.Min(number, 1e6));
                    return number >= 1.0 && section.NumberRodElements == number;
                case "youngsModulus":
                    section.YoungsModulus = number;
                    return number > 0.0;
                case "shearModulus":
                    section.ShearModulus = number;
                    return number > 0.0;
                case "density":
                    section.Density = number;
                    return number > 0.0;
                case "wireRadius":
                    section.WireRadius = number;
                    return number > 0.0;
                default:
                    return false;
            }
        }

        private static void Put(JObject item, string name, double? value)
        {
            if (value.HasValue)
            {
                item[name] = value.Value;
            }
        }
    }
}
