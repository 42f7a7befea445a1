using UnityEditor;

namespace Guidewire.Editor
{
    /// <summary>Makes a text file in the Project window, where the user names it.</summary>
    internal static class TextFile
    {
        /// <summary>Makes one in the folder that is selected.</summary>
        public static void Create(string name, string text) =>
#if UNITY_6000_4_OR_NEWER
            ProjectWindowUtil.CreateAssetWithTextContent(name, text);
#else
            ProjectWindowUtil.CreateAssetWithContent(name, text);
#endif
    }
}
