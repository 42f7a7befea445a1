using System;
using System.Collections.Generic;
using System.IO;

namespace Guidewire.Io
{
    /// <summary>Finds an instrument's file by its name: among the files that a host has in memory; in the folder
    /// <c>instruments</c> beside the parameter file, then in that of the current folder; then in that of the program,
    /// which is the nearest above the program or above the current folder.</summary>
    public static class InstrumentLibrary
    {
        /// <summary>Under this name AppContext may hold the folder of the program, where that is a library in another
        /// one's process.</summary>
        public const string ProgramFolder = "guidewire.folder";

        /// <summary>Name of the folder, beside a parameter file or in the program's.</summary>
        public const string Folder = "instruments";

        private const string Ending = ".json";

        /// <summary>Gives an instrument and its file.</summary>
        /// <param name="name">Its name: that of the file without its ending.</param>
        /// <param name="source">Who names it: a parameter file, or "command line".</param>
        /// <param name="parameterFile">The run's parameter file, or null.</param>
        /// <param name="held">Files in memory.</param>
        /// <exception cref="ParameterException">There is none of that name, or its file is wrong.</exception>
        internal static (Instrument Instrument, string File) Read(string name, string source, string? parameterFile,
            IReadOnlyDictionary<string, byte[]> held)
        {
            string? nearest = null;
            int best = int.MaxValue;
            foreach ((string known, string file, byte[]? content) in Known(parameterFile, held))
            {
                if (known == name)
                {
                    return (InstrumentReader.Read(file, content), file);
                }
                int distance = Spelling.Distance(known.ToUpperInvariant(), name.ToUpperInvariant());
                if (distance < best)
                {
                    best = distance;
                    nearest = known;
                }
            }
            List<string> folders = Folders(parameterFile);
            throw new ParameterException(source + ": instrument = \"" + name + "\" is not known: " + (nearest == null
                ? "there is no folder '" + Folder + "' with files beside the parameter file or above the program"
                : "did you mean \"" + nearest + "\"?" + (folders.Count == 0 ? ""
                    : " Searched: " + string.Join(", ", folders))));
        }

        /// <summary>Names of all instruments that a run can take, in their order: of two with one name that of the
        /// nearer folder counts.</summary>
        /// <param name="from">The run's parameters.</param>
        /// <param name="areCatheters">Whether only catheters are wanted.</param>
        /// <exception cref="ParameterException">A folder cannot be read.</exception>
        internal static IReadOnlyList<string> Names(ParameterSource from, bool areCatheters)
        {
            var files = new SortedDictionary<string, (string, byte[]?)>(StringComparer.Ordinal);
            foreach ((string name, string file, byte[]? content) in Known(from.Name, from.Files))
            {
                files.TryAdd(name, (file, content));
            }
            var names = new List<string>();
            foreach ((string name, (string file, byte[]? content)) in files)
            {
                if (!areCatheters || IsCatheter(file, content))
                {
                    names.Add(name);
                }
            }
            return names;
        }

        // All that there are, those first that count first.
        private static IEnumerable<(string Name, string File, byte[]? Content)> Known(string? parameterFile,
            IReadOnlyDictionary<string, byte[]> held)
        {
            foreach ((string name, byte[] content) in held)
            {
                if (!MeshFile.IsNamed(name))
                {
                    yield return (name, name + Ending, content);
                }
            }
            foreach (string folder in Folders(parameterFile))
            {
                foreach (string file in FilesOf(folder))
                {
                    yield return (Path.GetFileNameWithoutExtension(file), file, null);
                }
            }
        }

        // A file that is wrong in itself is refused where it is taken.
        private static bool IsCatheter(string file, byte[]? content)
        {
            try
            {
                return InstrumentReader.Read(file, content).InnerRadius > 0.0;
            }
            catch (ParameterException)
            {
                return false;
            }
        }

        private static string[] FilesOf(string folder)
        {
            try
            {
                string[] files = Directory.GetFiles(folder, "*" + Ending);
                Array.Sort(files, StringComparer.Ordinal);
                return files;
            }
            catch (Exception error) when (error is IOException || error is UnauthorizedAccessException)
            {
                throw new ParameterException(folder + ": cannot be read: " + error.Message);
            }
        }

        private static List<string> Folders(string? parameterFile)
        {
            var folders = new List<string>();
            string current = Directory.GetCurrentDirectory();
            string? beside = parameterFile == null ? null : Path.GetDirectoryName(Path.GetFullPath(parameterFile));
            foreach (string place in new[] { beside ?? current, current })
            {
                string own = Path.Combine(place, Folder);
                if (Directory.Exists(own) && !folders.Contains(own))
                {
                    folders.Add(own);
                }
            }
            string program = AppContext.GetData(ProgramFolder) as string ?? AppContext.BaseDirectory;
            foreach (string start in new[] { program, current })
            {
                for (string? above = start; above != null; above = Path.GetDirectoryName(above))
                {
                    string folder = Path.Combine(above, Folder);
                    if (Directory.Exists(folder))
                    {
                        if (!folders.Contains(folder))
                        {
                            folders.Add(folder);
                        }
                        return folders;
                    }
                }
            }
            return folders;
        }
    }
}
