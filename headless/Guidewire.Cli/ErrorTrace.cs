using System;
using System.Globalization;
using System.IO;

namespace Guidewire.Cli
{
    /// <summary>Keeps the trace of an error of the program itself.</summary>
    internal static class ErrorTrace
    {
        /// <summary>Writes the trace into the run's folder, or where that is not possible into the temporary
        /// folder.</summary>
        /// <returns>One line that says where.</returns>
        public static string Write(Exception error, string? folder)
        {
            string name = string.Format(CultureInfo.InvariantCulture, "guidewire-error-{0:yyyyMMdd-HHmmss}-{1}.txt",
                DateTime.UtcNow, Environment.ProcessId);
            foreach (string place in new[] { folder ?? Directory.GetCurrentDirectory(), Path.GetTempPath() })
            {
                try
                {
                    string path = Path.Combine(place, name);
                    File.WriteAllText(path, error.ToString());
                    return "internal error (" + error.Message.Replace('\n', ' ') + "): please report " + path;
                }
                catch (Exception failure) when (failure is IOException || failure is UnauthorizedAccessException)
                {
                    continue;    // the next place
                }
            }
            return "internal error, and no place to write its trace: " + error.ToString().Replace('\n', ' ');
        }
    }
}
