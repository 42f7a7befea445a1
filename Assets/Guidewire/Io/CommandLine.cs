using System.Collections.Generic;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
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
