using System.IO;

namespace Guidewire.Io
{
    /// <summary>A file that a parameter names.</summary>
    internal static class NamedFile
    {
        /// <summary>Its full name: beside the parameter file that names it, or from the current folder, where the
        /// command line names it or where it is only there.</summary>
        /// <param name="file">The name as it was given; an empty one stays empty.</param>
        /// <param name="source">The parameter file, or what counts instead.</param>
        public static string Find(string file, string source)
        {
            string beside = Path.Combine(Path.GetDirectoryName(source) ?? "", file);
            bool isBeside = !CommandLineHandler.IsOverride(source) && (IsThere(beside) || !IsThere(file));
            return file.Length == 0 ? file : Path.GetFullPath(isBeside ? beside : file);
        }

        private static bool IsThere(string file) => File.Exists(file) || Directory.Exists(file);
    }
}
