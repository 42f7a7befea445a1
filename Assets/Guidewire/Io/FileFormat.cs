using Guidewire.Core;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>The version of the file formats: parameter files, results of runs, saved states of sessions. Files and
    /// runs of every version up to this one are read, saved states of this one alone. What has no number is of version
    /// 1.</summary>
    public static class FileFormat
    {
        /// <summary>The version that is written.</summary>
        public const int Version = 2;

        /// <summary>The member of parameter files that states it.</summary>
        public const string Key = "formatVersion";

        /// <summary>Refuses what is newer than this program.</summary>
        /// <param name="stated">The version as a file states it; null where it does not.</param>
        /// <param name="source">The file.</param>
        /// <exception cref="ParameterException">It is newer, or is no version.</exception>
        internal static void Check(JToken? stated, string source)
        {
            // An integer beyond 64 bits is no long.
            if (stated != null && !((stated as JValue)?.Value is long number && number >= 1 && number <= Version))
            {
                throw new ParameterException(source + ": " + Key + " = "
                    + stated.ToString(Formatting.None) + " is not allowed: guidewire "
                    + ProgramVersion.Number + " reads versions 1 to " + Version);
            }
        }
    }
}
