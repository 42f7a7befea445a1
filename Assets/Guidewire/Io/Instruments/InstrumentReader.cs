using System;
using System.Collections.Generic;
using System.Globalization;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Reads an instrument's file (docs/instruments.md). A file that leaves out the source of a number, or a
    /// number whose unit is not known or measures something else, is refused in one line.</summary>
    internal static class InstrumentReader
    {
        private static readonly string[] Kinds = { "guidewire", "catheter" };
        private static readonly string[] Profiles = { "uniform", "linear" };
        private static readonly string[] Stiffnesses =
        {
            "bendingStiffness", "flexuralModulus", "supportForce", "coreModulus",
        };

        private const double Largest = 100.0;   // m, of any length: beyond it a unit is wrong
        private const double FreeTip = 0.01;    // m, the usual free length in a test of the tip load

        /// <summary>Gives the instrument of a file.</summary>
        /// <param name="file">Its name.</param>
        /// <param name="content">What stands in it; null: it is read.</param>
        /// <exception cref="ParameterException">It cannot be read, or holds no instrument.</exception>
        public static Instrument Read(string file, byte[]? content)
        {
            JObject read = content == null ? JsonText.ReadObject(file)
                : JsonText.ParseObject(PlainFile.Decode(content), file);
            var fields = new InstrumentFields(file, "", read, "title", "kind", "diameter", "innerDiameter", "length",
                "coreDiameter", "coreModulus", "material", "bendingStiffness", "flexuralModulus", "supportForce",
                "torsionalRatio", "density", "friction", "distalSections", "tipLoad", "tipLength", "tip", "radiopaque");
            fields.Text("title");
            bool isHollow = fields.Word("kind", Kinds) == "catheter";
            if (isHollow != fields.Has("innerDiameter"))
            {
                throw fields.Wrong("innerDiameter", isHollow ? "the inner diameter of the catheter"
                    : "no such member for a guidewire");
            }
            var instrument = new Instrument
            {
                Radius = 0.5 * fields.Quantity("diameter", Dimension.Length),
                InnerRadius = isHollow ? 0.5 * fields.Quantity("innerDiameter", Dimension.Length) : 0.0,
                Length = fields.Quantity("length", Dimension.Length),
                TorsionalRatio = fields.Quantity("torsionalRatio", Dimension.Number),
                Density = fields.Quantity("density", Dimension.Density),
                Friction = fields.Quantity("friction", Dimension.Number, mayBeZero: true),
            };
            if (instrument.InnerRadius >= instrument.Radius)
            {
                throw fields.Wrong("innerDiameter", "less than the diameter");
            }
            if (instrument.Length > Largest)
            {
                throw fields.Wrong("length", "100 m at most");
            }
            instrument.CoreDiameter = ReadCore(fields, instrument);
            if (fields.Has("material"))
            {
                InstrumentFields material = fields.Object("material", "value", "basis", "source");
                material.CheckOrigin();
                instrument.Material = material.Word("value", ParameterTable.Find("material")!.Choices!);
            }
            instrument.BendingStiffness = ReadStiffness(fields, instrument);
            ReadSections(fields, instrument);
            ReadTip(fields, instrument);
            ReadMarkers(fields, instrument);
            return instrument;
        }

        private static void ReadMarkers(InstrumentFields fields, Instrument instrument)
        {
            foreach (InstrumentFields marker in fields.List("radiopaque", "fromTip", "length", "platinum", "basis",
                "source"))
            {
                marker.CheckOrigin();
                var read = new Marker
                {
                    FromTip = marker.Bare("fromTip", Dimension.Length, mayBeZero: true),
                    Length = marker.Bare("length", Dimension.Length),
                    Thickness = marker.Bare("platinum", Dimension.Length),
                };
                if (read.FromTip + read.Length > instrument.Length)
                {
                    throw marker.Wrong("length", "a marker within the instrument's length");
                }
                if (read.Thickness > instrument.Radius - instrument.InnerRadius)
                {
                    throw marker.Wrong("platinum", "at most the thickness of the wall, "
                        + Millimetres(instrument.Radius - instrument.InnerRadius) + " mm");
                }
                instrument.Markers.Add(read);
            }
        }

        private static double? ReadCore(InstrumentFields fields, Instrument instrument)
        {
            if (!fields.Has("coreDiameter"))
            {
                return null;
            }
            double core = fields.Quantity("coreDiameter", Dimension.Length);
            return core <= 2.0 * instrument.Radius ? core : throw fields.Wrong("coreDiameter", "at most the diameter");
        }

        // A flexural modulus is that of the solid or hollow section of the given diameters, EI = E pi (d^4 - a^4)/64,
        // and the core's that of the core alone. A support force bends a span on two supports: EI = F s^3/(48 u).
        private static double ReadStiffness(InstrumentFields fields, Instrument instrument)
        {
            string[] given = Array.FindAll(Stiffnesses, fields.Has);
            if (given.Length != 1)
            {
                throw fields.Wrong(given.Length == 0 ? Stiffnesses[0] : given[1],
                    "one of " + string.Join(", ", Stiffnesses));
            }
            switch (given[0])
            {
                case "bendingStiffness":
                    return fields.Quantity(given[0], Dimension.Stiffness);
                case "supportForce":
                    InstrumentFields test = fields.Object(given[0], "value", "span", "deflection", "basis", "source");
                    test.CheckOrigin();
                    return test.Bare("value", Dimension.Force) * Math.Pow(test.Bare("span", Dimension.Length), 3.0)
                        / (48.0 * test.Bare("deflection", Dimension.Length));
                case "coreModulus":
                    return fields.Quantity(given[0], Dimension.Modulus) * SecondMoment(0.5 * (instrument.CoreDiameter
                        ?? throw fields.Wrong("coreDiameter", "the diameter of the core whose coreModulus is given")),
                        0.0);
                default:
                    return fields.Quantity(given[0], Dimension.Modulus)
                        * SecondMoment(instrument.Radius, instrument.InnerRadius);
            }
        }

        private static double SecondMoment(double radius, double inner) =>
            0.25 * Math.PI * (Math.Pow(radius, 4.0) - Math.Pow(inner, 4.0));

        // A tip load P is that at which the last 10 mm, clamped at one end and free at the other, buckle:
        // P = pi^2 EI/(4 l^2). The tip of this EI follows the distal sections, of which the last may taper to it.
        private static double? ReadTipStiffness(InstrumentFields fields, double shaft)
        {
            if (!fields.Has("tipLoad"))
            {
                return fields.Has("tipLength")
                    ? throw fields.Wrong("tipLoad", "the load of the tip with this tipLength")
                    : (double?)null;
            }
            double stiffness = 4.0 * fields.Quantity("tipLoad", Dimension.Force) * FreeTip * FreeTip
                / (Math.PI * Math.PI);
            return stiffness <= shaft ? stiffness : throw fields.Wrong("tipLoad",
                "a load with which the tip is no stiffer than the shaft");
        }

        private static void ReadSections(InstrumentFields fields, Instrument instrument)
        {
            double? tip = ReadTipStiffness(fields, instrument.BendingStiffness);
            foreach (InstrumentFields section in fields.List("distalSections", "length", "bendingStiffness",
                "coreDiameter", "profile"))
            {
                instrument.Sections.Add(new DistalSection
                {
                    Length = section.Quantity("length", Dimension.Length),
                    BendingStiffness = tip.HasValue && !section.Has("bendingStiffness") ? tip.Value
                        : section.Quantity("bendingStiffness", Dimension.Stiffness),
                    CoreDiameter = ReadCore(section, instrument),
                    IsTapered = section.Word("profile", Profiles) == "linear",
                });
            }
            if (tip.HasValue)
            {
                double length = fields.Quantity("tipLength", Dimension.Length);
                instrument.Sections.Add(new DistalSection { Length = length, BendingStiffness = tip.Value });
            }
            if (instrument.DistalLength > instrument.Length)
            {
                throw fields.Wrong("length", "at least the " + Millimetres(instrument.DistalLength)
                    + " mm of the distalSections" + (tip.HasValue ? " and the tip" : ""));
            }
        }

        private static void ReadTip(InstrumentFields fields, Instrument instrument)
        {
            InstrumentFields tip = fields.Object("tip", "shape", "bends", "basis", "source");
            string shape = tip.Text("shape");
            tip.CheckOrigin();
            double length = 0.0;
            foreach (InstrumentFields bend in tip.List("bends", "angle", "side", "radius", "straight"))
            {
                bool isOpposite = bend.Has("side") && bend.Word("side", new[] { "same", "opposite" }) == "opposite";
                double angle = bend.Bare("angle", Dimension.Angle);
                double radius = bend.Bare("radius", Dimension.Length);
                if (radius < instrument.Radius)
                {
                    throw bend.Wrong("radius", "at least the instrument's own radius");
                }
                var arc = new TipBend
                {
                    Angle = isOpposite ? -angle : angle,
                    Radius = radius,
                    Straight = bend.Bare("straight", Dimension.Length, mayBeZero: true),
                };
                length += arc.ArcLength + arc.Straight;
                instrument.Bends.Add(arc);
            }
            if (length > instrument.Length)
            {
                throw tip.Wrong("bends", "bends within the instrument's length; they are " + Millimetres(length)
                    + " mm long");
            }
            string? needed = FindMismatch(shape, instrument.Bends);
            if (needed != null)
            {
                throw tip.Wrong("shape", needed);
            }
        }

        // What the clinical word says must be what the bends are.
        private static string? FindMismatch(string shape, List<TipBend> bends)
        {
            string[] words = shape.Split(' ');
            if (words[0] == "straight")
            {
                return bends.Count == 0 ? null : "no bends for \"straight\"";
            }
            if (bends.Count == 0)
            {
                return "bends, or \"straight\"";
            }
            string size = shape.Substring(words[0].Length).Trim();
            if (words[0] == "angled")
            {
                string? error = UnitTable.FindError(size, Dimension.Angle, out double angle);
                return error == null && bends.Count == 1 && Math.Abs(bends[0].Angle - angle) < 1e-6 ? null
                    : "\"angled 45 deg\" with one bend of that angle";
            }
            if (words[0] == "J")
            {
                string? error = UnitTable.FindError(size, Dimension.Length, out double radius);
                return error == null && bends.Count == 1 && Math.Abs(bends[0].Radius - radius) < 1e-9 ? null
                    : "\"J 3 mm\" with one bend of that radius";
            }
            return null;
        }

        private static string Millimetres(double length) => (1e3 * length).ToString("G6", CultureInfo.InvariantCulture);
    }

    /// <summary>The members of one object of an instrument's file. Each number is {"value", "basis", "source"}: a text
    /// with its unit, whether it was measured, derived or assumed, and where it is from. Each error is one line that
    /// names file, member, value and what is allowed.</summary>
    internal sealed class InstrumentFields
    {
        private static readonly string[] Bases = { "measured", "derived", "assumed" };

        private readonly string _file;
        private readonly string _path;
        private readonly JObject _object;

        /// <param name="file">The instrument's file.</param>
        /// <param name="path">Where the object stands in it; empty for the whole file.</param>
        /// <param name="value">The object.</param>
        /// <param name="names">The members that it may have.</param>
        /// <exception cref="ParameterException">It is no object, or has a member that is not known.</exception>
        public InstrumentFields(string file, string path, JToken value, params string[] names)
        {
            _file = file;
            _path = path;
            _object = value as JObject ?? throw new ParameterException(
                file, path, value.ToString(Formatting.None), "an object {" + string.Join(", ", names) + "}");
            foreach (JProperty property in _object.Properties())
            {
                if (Array.IndexOf(names, property.Name) < 0)
                {
                    throw new ParameterException(file + ": unknown member '" + At(property.Name) + "': allowed are "
                        + string.Join(", ", names));
                }
            }
        }

        /// <summary>Whether there is a member of this name.</summary>
        public bool Has(string name) => _object.ContainsKey(name);

        /// <summary>A text that must be there and say something.</summary>
        public string Text(string name)
        {
            JToken? value = _object[name];
            string? text = value?.Type == JTokenType.String ? ((string?)value)!.Trim() : null;
            return string.IsNullOrEmpty(text) ? throw Wrong(name, "a text in double quotes") : text!;
        }

        /// <summary>One of a few words.</summary>
        public string Word(string name, IReadOnlyList<string> words)
        {
            string text = Text(name);
            foreach (string word in words)
            {
                if (word == text)
                {
                    return text;
                }
            }
            throw Wrong(name, "one of \"" + string.Join("\", \"", words) + "\"");
        }

        /// <summary>Gives a number above zero with its unit, basis and source, in SI.</summary>
        /// <param name="name">The member.</param>
        /// <param name="dimension">What it measures.</param>
        /// <param name="mayBeZero">Whether 0 is allowed.</param>
        public double Quantity(string name, Dimension dimension, bool mayBeZero = false)
        {
            var fields = new InstrumentFields(_file, At(name), _object[name] ?? throw Wrong(name,
                "{\"value\", \"basis\", \"source\"}"), "value", "basis", "source", "coating");
            string? error = UnitTable.FindError(fields.Text("value"), dimension, out double value);
            if (error == null && !(value > 0.0 || (mayBeZero && value == 0.0)))
            {
                error = mayBeZero ? "a value of 0 or more" : "a value above 0";
            }
            if (error != null)
            {
                throw fields.Wrong("value", error);
            }
            fields.CheckOrigin();
            return value;
        }

        /// <summary>A number with its unit where one basis and one source stand for the whole object, in SI.</summary>
        public double Bare(string name, Dimension dimension, bool mayBeZero = false)
        {
            string? error = UnitTable.FindError(Text(name), dimension, out double value);
            return error == null && (value > 0.0 || (mayBeZero && value == 0.0)) ? value
                : throw Wrong(name, error ?? (mayBeZero ? "a value of 0 or more" : "a value above 0"));
        }

        /// <summary>The objects of a list; none where it is missing.</summary>
        public List<InstrumentFields> List(string name, params string[] names)
        {
            var items = new List<InstrumentFields>();
            if (_object[name] is JToken value)
            {
                foreach (JToken item in value as JArray ?? throw Wrong(name, "a list of objects"))
                {
                    items.Add(new InstrumentFields(_file, At(name) + "[" + items.Count + "]", item, names));
                }
            }
            return items;
        }

        /// <summary>An object that must be there.</summary>
        public InstrumentFields Object(string name, params string[] names)
        {
            return new InstrumentFields(_file, At(name), _object[name]
                ?? throw Wrong(name, "an object {" + string.Join(", ", names) + "}"), names);
        }

        /// <summary>Checks that basis and source are given.</summary>
        public void CheckOrigin()
        {
            Word("basis", Bases);
            Text("source");
        }

        /// <summary>The line for a member whose value is not allowed.</summary>
        public ParameterException Wrong(string name, string allowed)
        {
            return new ParameterException(
                _file, At(name), _object[name]?.ToString(Formatting.None) ?? "(missing)", allowed);
        }

        private string At(string name) => _path.Length == 0 ? name : _path + "." + name;
    }
}
