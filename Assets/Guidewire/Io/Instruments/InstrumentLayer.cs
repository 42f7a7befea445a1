using System;
using System.Collections.Generic;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Adds the keys of a run's instrument with lower precedence than all other given keys.</summary>
    /// <remarks>An instrument that a file names lies beneath all keys of the file and of the command line. One that the
    /// command line names replaces the wire of the file, but not its length and number of elements, which belong to the
    /// scene: with them stands where the tip starts.</remarks>
    internal static class InstrumentLayer
    {
        /// <summary>The key that names the instrument.</summary>
        public const string Key = "instrument";

        private const string Friction = "frictionCoefficient";

        private static readonly string[] SceneKeys = { "guidewireLength", "numberRodElements" };

        private static readonly string[] WireKeys =
        {
            "wireRadius", "innerRadius", "coreDiameter", "material", "shearFactor", "bendingStiffness",
            "torsionalStiffness", "axialStiffness", "density", "restCurvature", "wireSections",
        };

        // Keys that state the same property in another form.
        private static readonly (string Own, string Other)[] Alternatives =
        {
            ("bendingStiffness", "youngsModulus"),
            ("torsionalStiffness", "shearModulus"),
            ("density", "massPerLength"),
        };

        /// <summary>Expands the instrument, if one is named and the run's solver takes it.</summary>
        /// <param name="given">What the file and the command line say; gets the instrument's keys.</param>
        /// <param name="file">The parameter file, or null.</param>
        /// <param name="held">Files in memory.</param>
        /// <exception cref="ParameterException">There is no such instrument, or its file is wrong.</exception>
        public static void Expand(GivenParameters given, string? file, IReadOnlyDictionary<string, byte[]> held)
        {
            if (!given.TryGet(Key, out (JToken Value, string Source) named) || named.Value.Type != JTokenType.String
                || ((string?)named.Value)!.Length == 0 || !IsTaken(given))
            {
                return;
            }
            bool replacesFile = CommandLineHandler.IsOverride(named.Source);
            if (!replacesFile && IsComplete(given))
            {
                return;    // the effective parameters of a run: it repeats without the instrument's file
            }
            (Instrument instrument, string path) =
                InstrumentLibrary.Read((string)named.Value!, named.Source, file, held);
            JObject keys = InstrumentKeys.Of(
                instrument, Number(given, "guidewireLength"), Number(given, "metresPerUnit") ?? 1e-3,
                Stands(given, "wireRadius", replacesFile) ? Number(given, "wireRadius") : null);
            foreach (string key in SceneKeys)
            {
                if (!given.Has(key))
                {
                    given.Add(key, keys[key]!, path);
                }
            }
            foreach (string key in Array.FindAll(WireKeys, key => TakesKey(given, key)))
            {
                string? other = Array.Find(Alternatives, pair => pair.Own == key).Other;
                if (!Stands(given, key, replacesFile) && (other == null || !Stands(given, other, replacesFile)))
                {
                    given.Add(key, keys[key]!, path);
                    given.Remove(other ?? "");
                }
            }
            TakeFriction(given, instrument.Friction);
        }

        private static bool IsTaken(GivenParameters given) => TakesKey(given, Key);

        // A plateau or a yield stress that is given takes the place of the instrument's material.
        private static bool TakesKey(GivenParameters given, string key)
        {
            if (key == "material" && (given.Has("plateau") || given.Has("yieldStress")))
            {
                return false;
            }
            bool isNamed = given.TryGet(ParameterTable.SolverKey, out (JToken Value, string Source) word);
            return ParameterHandler.TrySolver(isNamed ? word.Value : null, out Solver solver)
                && ParameterTable.Find(key)!.IsTakenBy(solver);
        }

        // Whether what is given of a key counts more than the instrument.
        private static bool Stands(GivenParameters given, string key, bool replacesFile)
        {
            return given.TryGet(key, out (JToken Value, string Source) said)
                && (!replacesFile || CommandLineHandler.IsOverride(said.Source));
        }

        private static bool IsComplete(GivenParameters given)
        {
            foreach (string key in SceneKeys)
            {
                if (!given.Has(key))
                {
                    return false;
                }
            }
            foreach (string key in Array.FindAll(WireKeys, key => TakesKey(given, key)))
            {
                string? other = Array.Find(Alternatives, pair => pair.Own == key).Other;
                if (!given.Has(key) && (other == null || !given.Has(other)))
                {
                    return false;
                }
            }
            foreach (JObject wall in Walls(given))
            {
                if (!wall.ContainsKey(Friction))
                {
                    return false;
                }
            }
            return true;
        }

        private static double? Number(GivenParameters given, string key)
        {
            return given.TryGet(key, out (JToken Value, string Source) said)
                && Kinds.TryNumber(said.Value, out double number) && number > 0.0 ? number : (double?)null;
        }

        // A wall that states no coefficient of friction gets the instrument's.
        private static void TakeFriction(GivenParameters given, double coefficient)
        {
            foreach (string key in new[] { "vessel", "obstacles" })
            {
                if (given.TryGet(key, out (JToken Value, string Source) said))
                {
                    given.Add(key, said.Value.DeepClone(), said.Source);
                }
            }
            foreach (JObject wall in Walls(given))
            {
                if (!wall.ContainsKey(Friction))
                {
                    wall[Friction] = coefficient;
                }
            }
        }

        private static IEnumerable<JObject> Walls(GivenParameters given)
        {
            if (given.TryGet("vessel", out (JToken Value, string Source) vessel) && vessel.Value is JObject wall)
            {
                yield return wall;
            }
            if (given.TryGet("obstacles", out (JToken Value, string Source) obstacles)
                && obstacles.Value is JArray list)
            {
                foreach (JToken item in list)
                {
                    if (item is JObject obstacle)
                    {
                        yield return obstacle;
                    }
                }
            }
        }
    }
}
