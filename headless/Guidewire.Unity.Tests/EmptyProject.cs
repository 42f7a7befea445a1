using System.Text.RegularExpressions;

namespace Guidewire.Unity.Tests
{
    /// <summary>A project of somebody else that has the package below Packages, and nothing in Assets until a sample is
    /// imported.</summary>
    internal sealed class EmptyProject
    {
        private static readonly string Own = Path.Combine(Stage.Root, "Assets", "Guidewire");

        /// <summary>Makes it in a folder of its own.</summary>
        public EmptyProject(string name)
        {
            Root = Path.Combine(TestContext.CurrentContext.WorkDirectory, name);
            Delete();
            Directory.CreateDirectory(Path.Combine(Root, "Assets"));
            string package = Path.Combine(Root, "Packages", "org.guidewire.simulation");
            foreach (string part in new[] { "Runtime", "Prefabs" })
            {
                Copy(Path.Combine(Own, part), Path.Combine(package, part));
            }
            File.Copy(Path.Combine(Own, "package.json"), Path.Combine(package, "package.json"));
        }

        /// <summary>Folder that holds Assets.</summary>
        public string Root { get; }

        /// <summary>Copies a sample as the Package Manager does: with its metas, to
        /// Samples/PACKAGE/VERSION/NAME.</summary>
        /// <returns>Its folder, from <see cref="Root"/>.</returns>
        public string Import(string name)
        {
            string described = File.ReadAllText(Path.Combine(Own, "package.json"));
            string version = Regex.Match(described, "\"version\": \"(.*)\"").Groups[1].Value;
            string path = Regex.Match(described,
                "\"displayName\": \"" + name + "\",\\s+\"description\": .*\\s+\"path\": \"(.*)\"").Groups[1].Value;
            string folder = "Assets/Samples/Guidewire/" + version + "/" + name;
            Copy(Path.Combine(Own, path), Path.Combine(Root, folder));
            return folder;
        }

        /// <summary>Removes it.</summary>
        public void Delete()
        {
            if (Directory.Exists(Root))
            {
                Directory.Delete(Root, true);
            }
        }

        private static void Copy(string from, string to)
        {
            Directory.CreateDirectory(to);
            foreach (string file in Directory.GetFiles(from))
            {
                File.Copy(file, Path.Combine(to, Path.GetFileName(file)));
            }
            foreach (string folder in Directory.GetDirectories(from))
            {
                Copy(folder, Path.Combine(to, Path.GetFileName(folder)));
            }
        }
    }
}
