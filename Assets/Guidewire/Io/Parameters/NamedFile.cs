using System.IO;

namespace Guidewire.Io
{
    /// <summary>A file that a parameter names.</summary>
    internal static class NamedFile
    {
        /// <summary>Its full name: beside the parameter file that names it, or, where nothing is there or the command
        /// line names it, from the current folder.</summary>
        /// <param name="file">The name as it was given; an empty one stays empty.</param>
        /// <param name="source">The parameter file, or "command line".</param>
        public static string Find(string file, string source)
        {
            string beside = Path.Combine(Path.GetDirectoryName(source) ?? "", file);
            bool isThere = File.Exists(beside) || Directory.Exists(beside);
            return file.Length == 0 ? file
                : Path.GetFullPath(source != CommandLineHandler.Source && isThere ? beside : file);
        }
    }
}
