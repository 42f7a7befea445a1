using System.IO;
using System.Reflection;

namespace Guidewire.UnityCheck
{
    /// <summary>The libraries that sources are compiled against; where they lie was written down by the
    /// build.</summary>
    internal static class Libraries
    {
        private static readonly Lazy<MetadataReference[]> LazyStandard = new Lazy<MetadataReference[]>(() =>
            Directory.GetFiles(Given("Standard"), "*.dll").OrderBy(path => path, StringComparer.Ordinal)
                .Select(path => (MetadataReference)MetadataReference.CreateFromFile(path)).ToArray());

        private static readonly Dictionary<string, MetadataReference> Loaded =
            new Dictionary<string, MetadataReference>();

        private static readonly string[] FrameworkNames = { "mscorlib", "System", "System.Core", "System.Numerics" };

        private static readonly Lazy<Compilation> LazyFramework = new Lazy<Compilation>(() =>
            CSharpCompilation.Create("Framework", references: FrameworkNames
                .Select(name => MetadataReference.CreateFromFile(Path.Combine(Given("Framework"), name + ".dll")))));

        /// <summary>.NET Standard 2.1, which players and most assemblies of the editor get.</summary>
        public static IReadOnlyList<MetadataReference> Standard => LazyStandard.Value;

        /// <summary>The stand-in for Unity's own assemblies.</summary>
        public static MetadataReference UnityStubs => Find("UnityStubs")!;

        /// <summary>.NET Framework 4.7.2, next to the profile that editor-only assemblies may be compiled
        /// for.</summary>
        public static Compilation Framework => LazyFramework.Value;

        /// <summary>A library by its file's name; null where it is none of a package's.</summary>
        public static MetadataReference? Find(string name)
        {
            if (!Loaded.TryGetValue(name, out MetadataReference? found))
            {
                string? path = Values().FirstOrDefault(given => given.Key == name)?.Value;
                if (path == null)
                {
                    return null;
                }
                found = MetadataReference.CreateFromFile(path);
                Loaded[name] = found;
            }
            return found;
        }

        private static string Given(string key)
        {
            return Values().First(given => given.Key == key).Value!;
        }

        private static IEnumerable<AssemblyMetadataAttribute> Values()
        {
            return typeof(Libraries).Assembly.GetCustomAttributes<AssemblyMetadataAttribute>();
        }
    }
}
