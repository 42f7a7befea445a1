using System.IO;
using UnityEditor.Build;
using UnityEditor.Build.Reporting;
using UnityEditor.UnityLinker;

namespace Guidewire.Editor
{
    /// <summary>Keeps Core and Io whole where a player's build strips unused code: keys of parameter files find their
    /// properties by name, which no linker sees. A link.xml would not be read in an installed package.</summary>
    public sealed class LinkerStep : IUnityLinkerProcessor
    {
        private const string Kept = "<linker>\n  <assembly fullname=\"Guidewire.Core\" preserve=\"all\" />\n"
            + "  <assembly fullname=\"Guidewire.Io\" preserve=\"all\" />\n</linker>\n";

        /// <inheritdoc/>
        public int callbackOrder => 0;

        /// <inheritdoc/>
        public string GenerateAdditionalLinkXmlFile(BuildReport report, UnityLinkerBuildPipelineData data)
        {
            string file = Path.GetFullPath(Path.Combine("Temp", "guidewire-link.xml"));
            Directory.CreateDirectory(Path.GetDirectoryName(file)!);
            File.WriteAllText(file, Kept);
            return file;
        }
    }
}
