using System;
using System.Collections.Generic;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>A list of wire sections: [{"from": 250, "to": 300, "wireRadius": 2e-4, "restCurvature": [10, 0, 0]},
    /// ...].</summary>
    internal sealed class SectionsEntry : ValueEntry<IReadOnlyList<WireSection>>
    {
        // The keys of a section that are positive numbers.
        private static readonly Number[] Numbers =
        {
            new Number("youngsModulus", "Pa"),
            new Number("shearModulus", "Pa"),
            new Number("density", "kg/m^3"),
            new Number("wireRadius", "m"),
            new Number("innerRadius", "m") { MayBeZero = true },
            new Number("coreDiameter", "m"),
            new Number("shearFactor", ""),
            new Number("axialStiffness", "EA, N"),
            new Number("shearStiffness", "GA, N"),
            new Number("bendingStiffness1", "EI about d1, N m^2"),
            new Number("bendingStiffness2", "EI about d2, N m^2"),
            new Number("torsionalStiffness", "GJ, N m^2"),
            new Number("massPerLength", "kg/m"),
            new Number("rotaryInertia", "rho I about d1 and d2 alike, kg m"),
            new Number("yieldStress", "Pa"),
            new Number("hardening", "Pa") { MayBeZero = true },
            new Number("attenuation", "of X-rays beyond that of the density, 1/mm"),
        };

        private static ParameterEntry Materials => ParameterTable.Find("material")!;

        public SectionsEntry(string key, string help)
            : base(key, "", help)
        {
        }

        public override string Allowed
        {
            get
            {
                var words = new List<string>();
                foreach (Number number in Numbers)
                {
                    words.Add("\"" + number.Key + "\"" + (number.Unit.Length > 0 ? " (" + number.Unit + ")" : "")
                        + (number.MayBeZero ? " >= 0" : ""));
                }
                return "a list of {\"from\", \"to\" (units, from < to), and any of \"numberRodElements\" (a whole"
                    + " number from 1 to 1000000), \"restCurvature\" (rad/m), \"material\" (a word), "
                    + "\"plateau\", and, > 0, "
                    + string.Join(", ", words) + "}";
            }
        }

        internal override IReadOnlyList<string> Fields
        {
            get
            {
                var names = new List<string> { "from", "to", "numberRodElements", "restCurvature", "material",
                    "plateau" };
                names.AddRange(Array.ConvertAll(Numbers, number => number.Key));
                return names;
            }
        }

        internal override JToken Write(RunParameters source)
        {
            var list = new JArray();
            foreach (WireSection section in Get(source))
            {
                var item = new JObject { ["from"] = section.From, ["to"] = section.To };
                if (section.NumberRodElements.HasValue)
                {
                    item["numberRodElements"] = section.NumberRodElements.Value;
                }
                foreach (Number number in Numbers)
                {
                    Put(item, number.Key, NamedProperty.Get<double?>(section, NamedProperty.Of(number.Key)));
                }
                if (section.RestCurvature.HasValue)
                {
                    Vector3d curvature = section.RestCurvature.Value;
                    item["restCurvature"] = new JArray(curvature.X, curvature.Y, curvature.Z);
                }
                if (section.Material.HasValue)
                {
                    item["material"] = ChoiceEntry<CoreMaterial>.Word(section.Material.Value.ToString());
                }
                if (section.Plateau != null)
                {
                    item["plateau"] = PlateauEntry.Write(section.Plateau);
                }
                list.Add(item);
            }
            return list;
        }

        internal override string? AllowedOf(string field)
        {
            switch (field)
            {
                case "from":
                case "to":
                    return "a number >= 0 (units), from < to";
                case "numberRodElements":
                    return "a whole number from 1 to 1000000";
                case "restCurvature":
                    return "three numbers [x, y, z] (rad/m)";
                case "material":
                    return Materials.Allowed;
                case "plateau":
                    return PlateauEntry.Form;
                default:
                    return Array.Find(Numbers, entry => entry.Key == field)?.Allowed;
            }
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
            Set(target, sections);
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
                if (property.Name == "material")
                {
                    var read = new RunParameters(Solver.Direct);
                    if (!Materials.TryRead(read, property.Value))
                    {
                        return false;
                    }
                    section.Material = read.Simulation.Material.Material;
                    continue;
                }
                if (property.Name == "plateau")
                {
                    if (!PlateauEntry.TryPlateau(property.Value, out Plateau plateau))
                    {
                        return false;
                    }
                    section.Plateau = plateau;
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
                default:
                    Number? known = Array.Find(Numbers, entry => entry.Key == name);
                    if (known != null)
                    {
                        NamedProperty.Set<double?>(section, NamedProperty.Of(name), number);
                    }
                    return known != null && (number > 0.0 || (number == 0.0 && known.MayBeZero));
            }
        }

        private static void Put(JObject item, string name, double? value)
        {
            if (value.HasValue)
            {
                item[name] = value.Value;
            }
        }

        private sealed class Number
        {
            public Number(string key, string unit)
            {
                Key = key;
                Unit = unit;
            }

            public string Key { get; }

            public string Unit { get; }

            public bool MayBeZero { get; set; }

            public string Allowed =>
                "a number " + (MayBeZero ? ">= 0" : "> 0") + (Unit.Length > 0 ? " (" + Unit + ")" : "");
        }
    }
}
