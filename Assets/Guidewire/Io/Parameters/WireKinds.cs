using System;
using System.Collections.Generic;
using System.Reflection;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>The kinds of values that are parts of a wire: sections, plateaus and shaped tips.</summary>
    internal static class WireKinds
    {
        private const string PlateauForm =
            "{\"upper\", \"lower\" (Pa, 0 < lower <= upper), \"strain\" (0 < strain < 1)}";
        private const string Ends = "a number >= 0 (units), from < to";

        // The numbers of a section that are not places: name, unit, whether it may be 0.
        private static readonly (string Name, string Unit, bool MayBeZero)[] Numbers =
        {
            ("youngsModulus", "Pa", false),
            ("shearModulus", "Pa", false),
            ("density", "kg/m^3", false),
            ("wireRadius", "m", false),
            ("innerRadius", "m", true),
            ("coreDiameter", "m", false),
            ("shearFactor", "", false),
            ("axialStiffness", "EA, N", false),
            ("shearStiffness", "GA, N", false),
            ("bendingStiffness1", "EI about d1, N m^2", false),
            ("bendingStiffness2", "EI about d2, N m^2", false),
            ("torsionalStiffness", "GJ, N m^2", false),
            ("massPerLength", "kg/m", false),
            ("rotaryInertia", "rho I about d1 and d2 alike, kg m", false),
            ("yieldStress", "Pa", false),
            ("hardening", "Pa", true),
            ("attenuation", "of X-rays beyond that of the density, 1/mm", false),
        };

        /// <summary>A plateau {"upper": 500e6, "lower": 250e6, "strain": 0.05}.</summary>
        public static Kind<Plateau> Plateau { get; } = new Fields<Plateau>()
            .Add("upper", "a number > 0 (Pa)", Kinds.Number(NumberRange.Positive), p => p.Upper, (p, v) => p.Upper = v)
            .Add("lower", "a number > 0 (Pa)", Kinds.Number(NumberRange.Positive), p => p.Lower, (p, v) => p.Lower = v)
            .Add("strain", "a number > 0", Kinds.Number(NumberRange.Positive), p => p.Strain, (p, v) => p.Strain = v)
            .Of(PlateauForm, p => p.Lower > 0.0 && p.Lower <= p.Upper && p.Strain > 0.0 && p.Strain < 1.0);

        /// <summary>A bend over a mandrel {"from": 290, "to": 295, "radius": 2}, or with the angle that
        /// remains.</summary>
        public static Kind<Shaping> Shaped { get; } = new Fields<Shaping>("from", "to")
            .Add("from", Ends, Kinds.Number(NumberRange.NotNegative), s => s.From, (s, v) => s.From = v)
            .Add("to", Ends, Kinds.Number(NumberRange.NotNegative), s => s.To, (s, v) => s.To = v)
            .Add("radius", "a number > 0 (units)", Kinds.Number(NumberRange.Positive), s => s.Radius,
                (s, v) => s.Radius = v)
            .Add("angle", "a number (rad), not 0", Kinds.Number(NumberRange.Any), s => s.Angle, (s, v) => s.Angle = v)
            .Of("{\"from\", \"to\" (units, from < to), and \"radius\" of the mandrel (units, > 0) or \"angle\" that "
                + "remains (rad, not 0)}", s => s.To > s.From && s.Radius.HasValue != s.Angle.HasValue
                && s.Angle != 0.0);

        /// <summary>A list of wire sections: [{"from": 250, "to": 300, "wireRadius": 2e-4, "restCurvature": [10, 0,
        /// 0]}, ...].</summary>
        public static Kind<IReadOnlyList<WireSection>> Sections { get; } = MakeSections();

        private static Kind<IReadOnlyList<WireSection>> MakeSections()
        {
            Kind<CoreMaterial> material = Kinds.Choice<CoreMaterial>();
            Fields<WireSection> fields = new Fields<WireSection>("from", "to")
                .Add("from", Ends, Kinds.Number(NumberRange.NotNegative), s => s.From, (s, v) => s.From = v)
                .Add("to", Ends, Kinds.Number(NumberRange.NotNegative), s => s.To, (s, v) => s.To = v)
                .Add("numberRodElements", "a whole number from 1 to 1000000", Kinds.Whole(1, 1_000_000),
                    s => s.NumberRodElements, (s, v) => s.NumberRodElements = v);
            var words = new List<string>();
            foreach ((string name, string unit, bool mayBeZero) in Numbers)
            {
                PropertyInfo property = typeof(WireSection).GetProperty(NamedProperty.Of(name))!;
                var get = (Func<WireSection, double?>)Delegate.CreateDelegate(typeof(Func<WireSection, double?>),
                    property.GetMethod!);
                var set = (Action<WireSection, double?>)Delegate.CreateDelegate(typeof(Action<WireSection, double?>),
                    property.SetMethod!);
                string inUnit = unit.Length > 0 ? " (" + unit + ")" : "";
                NumberRange range = mayBeZero ? NumberRange.NotNegative : NumberRange.Positive;
                fields.Add(name, "a number" + range.Text + inUnit, Kinds.Number(range), s => get(s),
                    (s, v) => set(s, v));
                words.Add("\"" + name + "\"" + inUnit + (mayBeZero ? " >= 0" : ""));
            }
            fields.Add("restCurvature", "three numbers [x, y, z] (rad/m)", Kinds.Vector(true), s => s.RestCurvature,
                    (s, v) => s.RestCurvature = v)
                .Add("material", material.Allowed, material, s => s.Material, (s, v) => s.Material = v)
                .Add("plateau", PlateauForm, Plateau, s => s.Plateau, (s, v) => s.Plateau = v);
            Kind<WireSection> one = fields.Of("", s => s.To > s.From);
            return new Kind<IReadOnlyList<WireSection>>("a list of {\"from\", \"to\" (units, from < to), and any of "
                + "\"numberRodElements\" (a whole number from 1 to 1000000), \"restCurvature\" (rad/m), \"material\" "
                + "(a word), \"plateau\", and, > 0, " + string.Join(", ", words) + "}",
                (JToken token, out IReadOnlyList<WireSection> value) =>
            {
                var sections = new List<WireSection>();
                value = sections;
                foreach (JToken item in token as JArray ?? new JArray())
                {
                    if (!one.TryRead(item, out WireSection section))
                    {
                        return false;
                    }
                    sections.Add(section);
                }
                return token is JArray;
            }, sections => new JArray(new List<WireSection>(sections).ConvertAll(one.Write)))
            {
                Fields = fields.Names,
                AllowedOf = fields.AllowedOf,
            };
        }
    }
}
