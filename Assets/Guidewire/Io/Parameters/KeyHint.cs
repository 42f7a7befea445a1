using System;
using System.Collections.Generic;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Suggests what an unknown key most likely meant: a key of similar spelling, or the name used
    /// here.</summary>
    public static class KeyHint
    {
        // What it may be called elsewhere, and the keys for it, of which a solver takes one.
        private static readonly Dictionary<string, string[]> Synonyms =
            new Dictionary<string, string[]>(StringComparer.OrdinalIgnoreCase)
            {
                ["endTime"] = new[] { "maxSimulationSteps" },
                ["simulationTime"] = new[] { "maxSimulationSteps" },
                ["steps"] = new[] { "maxSimulationSteps" },
                ["dt"] = new[] { "timeStep" },
                ["length"] = new[] { "guidewireLength" },
                ["wireLength"] = new[] { "guidewireLength" },
                ["elements"] = new[] { "numberRodElements" },
                ["radius"] = new[] { "wireRadius", "sphereRadius" },
                ["mass"] = new[] { "density", "totalMass" },
            };

        private const string Note = "a text for readers goes under the key 'note', in any object";

        private static readonly Dictionary<string, string> Absent =
            new Dictionary<string, string>(StringComparer.OrdinalIgnoreCase)
            {
                ["selfCollision"] = "it is 'selfContact'",
                [JsonText.NoteKey] = "a note needs to be one text",
                ["comment"] = Note,
                ["_comment"] = Note,
                ["comments"] = Note,
                ["description"] = Note,
                ["//"] = Note,
            };

        /// <summary>The end of a line on a key that is not known.</summary>
        /// <param name="text">As it was given, perhaps of a part of a key.</param>
        /// <param name="dash">What stands before keys there: a dash on the command line, else nothing.</param>
        /// <param name="solver">The run's; null where it is not known yet.</param>
        /// <param name="otherwise">What to say where nothing is near.</param>
        public static string Of(string text, string dash, Solver? solver, string otherwise)
        {
            string key = ParameterPath.Parse(text)?.Key ?? text;
            string part = text.Substring(key.Length);
            if (Absent.TryGetValue(key, out string? why))
            {
                return why;
            }
            if (Synonyms.TryGetValue(key, out string[]? names))
            {
                foreach (string name in names)
                {
                    if (IsTaken(ParameterTable.Find(name)!, solver))
                    {
                        return name == "maxSimulationSteps"
                            ? "a run lasts '" + dash + name + "' steps of '" + dash + "timeStep'"
                            : "did you mean '" + dash + name + part + "'?";
                    }
                }
            }
            string? nearest = Nearest(key, solver);
            return nearest == null ? otherwise : "did you mean '" + dash + nearest + part + "'?";
        }

        // At most one letter in four may be wrong: words of one length have more than that in common by chance.
        private static string? Nearest(string key, Solver? solver)
        {
            string? best = null;
            int bestDistance = 1 + Math.Max(1, key.Length / 4);
            foreach (ParameterEntry entry in ParameterTable.Entries)
            {
                int distance = Spelling.Distance(key.ToUpperInvariant(), entry.Key.ToUpperInvariant());
                if (distance < bestDistance && IsTaken(entry, solver))
                {
                    best = entry.Key;
                    bestDistance = distance;
                }
            }
            return best;
        }

        private static bool IsTaken(ParameterEntry entry, Solver? solver) =>
            solver == null || entry.IsTakenBy(solver.Value);
    }

    /// <summary>How far two words are apart.</summary>
    internal static class Spelling
    {
        /// <summary>Gives Levenshtein's distance: insertions, deletions and replacements that turn one word into the
        /// other.
        /// </summary>
        public static int Distance(string a, string b)
        {
            var previous = new int[b.Length + 1];
            var current = new int[b.Length + 1];
            for (int j = 0; j <= b.Length; j++)
            {
                previous[j] = j;
            }
            for (int i = 1; i <= a.Length; i++)
            {
                current[0] = i;
                for (int j = 1; j <= b.Length; j++)
                {
                    int replace = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
                    current[j] = Math.Min(replace, Math.Min(previous[j], current[j - 1]) + 1);
                }
                int[] swap = previous;
                previous = current;
                current = swap;
            }
            return previous[b.Length];
        }
    }
}
