using System;
using System.Collections.Generic;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Makes keys of the parameter table, each of a kind.</summary>
    internal static class Key
    {
        public static ValueEntry<double> Number(string key, string unit, NumberRange range, string help) =>
            new ValueEntry<double>(key, unit, Kinds.Number(range), help);

        public static ValueEntry<double?> OptionalNumber(string key, string unit, NumberRange range, string help) =>
            new ValueEntry<double?>(key, unit, Kinds.OptionalNumber(range), help);

        public static ValueEntry<double> NumberOr(string key, string unit, NumberRange range, string word,
            string help) => new ValueEntry<double>(key, unit, Kinds.NumberOr(range, word), help);

        public static ValueEntry<int> Whole(string key, string unit, int minimum, int maximum, string help) =>
            new ValueEntry<int>(key, unit, Kinds.Whole(minimum, maximum), help);

        public static ValueEntry<Vector3d> Vector(string key, string unit, bool mayBeZero, string help) =>
            new ValueEntry<Vector3d>(key, unit, Kinds.Vector(mayBeZero), help);

        public static ValueEntry<bool> Switch(string key, string help) => Of(Kinds.Switch, key, help);

        public static ValueEntry<bool?> OptionalSwitch(string key, string help) =>
            Of(Kinds.OptionalSwitch, key, help);

        public static ValueEntry<string> Text(string key, string help) => Of(Kinds.Text, key, help);

        public static ValueEntry<string> Axes(string key, string help) => Of(Kinds.Axes, key, help);

        public static ValueEntry<JToken?> End(string key, string help) => Of(Kinds.End, key, help);

        public static ValueEntry<JToken?> Json(string key, JTokenType type, string allowed, string help) =>
            Of(Kinds.Json(type, allowed), key, help);

        public static ValueEntry<T> Choice<T>(string key, string help, params (string Old, string New)[] older)
            where T : struct, Enum => Of(Kinds.Choice<T>(older), key, help);

        public static ValueEntry<T> Of<T>(Kind<T> kind, string key, string help) =>
            new ValueEntry<T>(key, "", kind, help);
    }

    /// <summary>The methods that take a key.</summary>
    internal static class Takers
    {
        /// <summary>Every method.</summary>
        public static IReadOnlyList<Solver> All { get; } = Where(method => true);

        /// <summary>Those whose wire has a stiffness per iteration.</summary>
        public static IReadOnlyList<Solver> Pbd { get; } = Where(method => !method.TakesMaterial);

        /// <summary>Those whose wire is a material.</summary>
        public static IReadOnlyList<Solver> Material { get; } = Where(method => method.TakesMaterial);

        /// <summary>Those that meet walls.</summary>
        public static IReadOnlyList<Solver> Walls { get; } = Where(method => method.MeetsWalls);

        /// <summary>Gives these methods.</summary>
        public static IReadOnlyList<Solver> Only(params Solver[] methods) => methods;

        private static List<Solver> Where(Predicate<MethodTraits> takes)
        {
            var methods = new List<Solver>();
            foreach (MethodTraits method in MethodTable.All)
            {
                if (takes(method))
                {
                    methods.Add(method.Solver);
                }
            }
            return methods;
        }
    }
}
