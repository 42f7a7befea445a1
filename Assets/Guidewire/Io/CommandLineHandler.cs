using System;
using System.Collections.Generic;
using System.Globalization;
using System.Text;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Reads the arguments of a run (thesis 3.2.4); the console program and Unity's batch mode share
    /// it.</summary>
    public static class CommandLineHandler
    {
        /// <summary>What errors name as their source.</summary>
        public const string Source = "command line";

        /// <summary>What errors name as the source of parameters that a request or a session sets.</summary>
        public const string RequestSource = "set";

        /// <summary>Whether a source counts instead of files.</summary>
        internal static bool IsOverride(string source) => source == Source || source == RequestSource;

        /// <summary>Reads <c>-parameters FILE -out DIR -repeat K -force -KEY VALUE ...</c>.</summary>
        /// <param name="arguments">The arguments.</param>
        /// <param name="logFileIsOurs">Whether the thesis's <c>-logFile DIR</c> stands for <c>-out</c>; in Unity it is
        /// Unity's own.</param>
        /// <exception cref="ParameterException">An unknown key, a value that is missing or not allowed.</exception>
        public static CommandLine Read(IReadOnlyList<string> arguments, bool logFileIsOurs)
        {
            var line = new CommandLine();
            for (int i = 0; i < arguments.Count; i += 2)
            {
                string argument = arguments[i];
                // With two dashes it is of an option in which people write keys without any, such as --set KEY=VALUE.
                string dash = argument.StartsWith("--", StringComparison.Ordinal) ? "" : "-";
                string key = dash.Length == 0 ? argument.Substring(2)
                    : argument.StartsWith("-", StringComparison.Ordinal) ? argument.Substring(1) : "";
                if (key.Length == 0)
                {
                    throw new ParameterException(Source + ": '" + argument + "' stands where a key is expected: "
                        + "-parameters FILE, -out DIR or -KEY VALUE");
                }
                if (key == "force")
                {
                    line.Force = true;
                    i--;    // it has no value
                    continue;
                }
                ParameterPath? path = ParameterPath.Parse(key);
                ParameterEntry? entry = path == null ? null : ParameterTable.Find(path.Key);
                bool isOut = key == "out" || (logFileIsOurs && key == "logFile");
                if (entry == null && !isOut && key != "parameters" && key != "repeat")
                {
                    throw new ParameterException(Source + ": unknown key '" + dash + key + "': "
                        + KeyHint.Of(key, dash, SolverOf(arguments), "--help lists what is allowed"));
                }
                if (i + 1 >= arguments.Count)
                {
                    throw new ParameterException(Source + ": " + dash + key + " needs a value: "
                        + (entry?.Allowed ?? (key == "repeat" ? "a whole number from 0" : "a path")));
                }
                string value = arguments[i + 1];
                if (entry != null)
                {
                    JToken token = (path!.Depth == 0 ? entry.FromText(value) : PartFromText(value))
                        ?? throw new ParameterException(Source, key, value, entry.Allowed);
                    line.Overrides.Add(new KeyValuePair<string, JToken>(key, token));
                }
                else if (isOut)
                {
                    line.Out = value;
                }
                else if (key == "parameters")
                {
                    line.ParameterFile = value;
                }
                else if (int.TryParse(value, NumberStyles.None, CultureInfo.InvariantCulture, out int repeat))
                {
                    line.Repeat = repeat;
                }
                else
                {
                    throw new ParameterException(Source, key, value, "a whole number from 0");
                }
            }
            return line;
        }

        // The solver that arguments name; null where they name none.
        private static Solver? SolverOf(IReadOnlyList<string> arguments)
        {
            for (int i = 0; i + 1 < arguments.Count; i++)
            {
                if (arguments[i].TrimStart('-') == ParameterTable.SolverKey && ParameterHandler.TrySolver(
                    new JValue(arguments[i + 1]), out Solver solver))
                {
                    return solver;
                }
            }
            return null;
        }

        // What a part may hold its entry does not say: what is no JSON is a text, such as the name of a mesh's file.
        private static JToken PartFromText(string text) =>
            StrictJson.FindError(text) == null ? JsonText.Parse(text) : new JValue(text);

        /// <summary>Reads parameters that stand as KEY=VALUE, as in an Inspector's list.</summary>
        /// <exception cref="ParameterException">An unknown key, a value that is missing or not allowed.</exception>
        internal static List<KeyValuePair<string, JToken>> ReadAssignments(IEnumerable<string> assignments)
        {
            var arguments = new List<string>();
            foreach (string assignment in assignments)
            {
                int equals = assignment.IndexOf('=');
                if (equals < 1)
                {
                    throw new ParameterException("'" + assignment + "' is not KEY=VALUE");
                }
                arguments.Add("-" + assignment.Substring(0, equals).Trim());
                arguments.Add(assignment.Substring(equals + 1).Trim());
            }
            return Read(arguments, logFileIsOurs: false).Overrides;
        }

        /// <summary>The help text of a program that takes these arguments.</summary>
        /// <param name="usage">The program's own usage lines.</param>
        public static string Help(string usage)
        {
            var text = new StringBuilder(usage);
            text.Append("\nA run:\n"
                + "  -parameters FILE   JSON file with the parameters; without it the defaults apply\n"
                + "  -out DIR           folder of the results (positions.json, parameters.json, summary.json)\n"
                + "  -force             replaces a complete run in that folder as soon as the new one is "
                + "complete\n  -repeat K          the run is a timed one, repeat number K\n"
                + "  -KEY VALUE         any parameter, instead of the file's, or a part of one: vessel.radius,\n"
                + "                     obstacles[0].radius, wireSections[-1].youngsModulus (-1: the last)\n\n"
                + "Parameters:\n");
            foreach (ParameterGroup group in ParameterTable.Groups)
            {
                text.Append('\n').Append(group.Name).Append(": ").Append(group.About).Append('\n');
                foreach (ParameterEntry entry in group.Entries)
                {
                    text.Append("  -").Append(entry.Key).Append(": ").Append(entry.Help).Append("\n      ")
                        .Append(entry.Allowed).Append("; default ").Append(entry.Defaults)
                        .Append(entry.Methods.Count == Takers.All.Count ? "" : "; solver " + entry.MethodWords)
                        .Append('\n');
                }
            }
            text.Append("\nExit codes: 0 converged or finished, 2 bad arguments or parameters, 4 diverged, 5 failed,\n"
                + "70 internal error, 130 interrupted\n");
            return text.ToString();
        }
    }

    /// <summary>A parsed command line.</summary>
    public sealed class CommandLine
    {
        /// <summary>The parameter file, or null for the defaults.</summary>
        public string? ParameterFile { get; internal set; }

        /// <summary>The folder of the results, or null where the parameter file names it.</summary>
        public string? Out { get; internal set; }

        /// <summary>Number of a timed repeat, or null for a run that is not timed.</summary>
        public int? Repeat { get; internal set; }

        /// <summary>Whether a complete run that the folder holds may be replaced.</summary>
        public bool Force { get; internal set; }

        /// <summary>Parameters that count instead of the file's, in the order given.</summary>
        internal List<KeyValuePair<string, JToken>> Overrides { get; } =
            new List<KeyValuePair<string, JToken>>();
    }
}
