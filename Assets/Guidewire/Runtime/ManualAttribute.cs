using System.IO;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Gives a component the help button that opens its section of the package's manual, which lies in the
    /// package itself.</summary>
    internal sealed class ManualAttribute : HelpURLAttribute
    {
        private const string Page = "Documentation~/index.md";

        /// <param name="section">A heading as in an address.</param>
        public ManualAttribute(string section)
            : base("file://" + Find() + "#" + section)
        {
        }

        // Asked for in the editor alone, which resolves the first for an installed package; else it lies below Assets.
        private static string Find()
        {
            string installed = Path.GetFullPath("Packages/org.guidewire.simulation/" + Page);
            return File.Exists(installed) ? installed : Path.GetFullPath("Assets/Guidewire/" + Page);
        }
    }
}
