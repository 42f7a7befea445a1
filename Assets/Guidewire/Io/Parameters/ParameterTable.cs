using System.Collections.Generic;
using System.Text;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Every key that a parameter file or the command line may hold, once.</summary>
    public static class ParameterTable
    {
        /// <summary>The key that decides which others count.</summary>
        internal const string SolverKey = "solver";

        /// <summary>What older files may hold and is no longer a key, and what counts in its place.</summary>
        internal static readonly IReadOnlyDictionary<string, string> Former = new Dictionary<string, string>
        {
            ["frictionSpeed"] = "contacts stick at any speed, elastically up to elasticSlip",
        };

        private static readonly Dictionary<string, ParameterEntry> ByKey = new Dictionary<string, ParameterEntry>();

        static ParameterTable()
        {
            var entries = new List<ParameterEntry>();
            foreach (ParameterGroup group in Groups)
            {
                entries.AddRange(group.Entries);
            }
            foreach (ParameterEntry entry in entries)
            {
                ByKey.Add(entry.Key, entry);
            }
            Entries = entries;
        }

        /// <summary>The groups in the order of the help text.</summary>
        public static IReadOnlyList<ParameterGroup> Groups { get; } = new[]
        {
            MethodEntries.Group, SceneEntries.Group, DriveEntries.Group, PbdEntries.Group, MaterialEntries.Group,
            ContactEntries.Group, LogEntries.Group,
        };

        /// <summary>All keys, group by group.</summary>
        public static IReadOnlyList<ParameterEntry> Entries { get; }

        /// <summary>Gives the entry of a key, or null.</summary>
        public static ParameterEntry? Find(string key) =>
            ByKey.TryGetValue(key, out ParameterEntry? entry) ? entry : null;

        /// <summary>The table as Markdown, a part for each group, as docs/parameters.md shows it.</summary>
        public static string ToMarkdown()
        {
            var text = new StringBuilder();
            foreach (ParameterGroup group in Groups)
            {
                text.Append(text.Length == 0 ? "" : "\n").Append("## ").Append(group.Name).Append(": ")
                    .Append(group.About).Append("\n\n| key | allowed | default | solver | meaning |\n")
                    .Append("|---|---|---|---|---|\n");
                foreach (ParameterEntry entry in group.Entries)
                {
                    text.Append("| `").Append(entry.Key).Append("` | ").Append(entry.Allowed).Append(" | `")
                        .Append(entry.Defaults).Append("` | ")
                        .Append(entry.Methods.Count == Takers.All.Count ? "all" : entry.MethodWords).Append(" | ")
                        .Append(entry.Help).Append(" |\n");
                }
            }
            return text.ToString();
        }
    }
}
