using System;
using System.IO;
using System.Linq;
using Guidewire.Io;
using Guidewire.Runtime;
using UnityEditor;
using UnityEditor.Build;
using UnityEditor.Build.Reporting;
using UnityEditor.UnityLinker;
using UnityEngine;

namespace Guidewire.Editor
{
    /// <summary>Builds players: <c>-executeMethod Guidewire.Editor.PlayerBuild.Linux</c> or <c>.Windows</c>, or the
    /// menu. Parameter files and instruments go beside the program, where the project has folders of them.</summary>
    public static class PlayerBuild
    {
        /// <summary>Builds Build/Linux/Guidewire.x86_64; in batch mode it ends the editor with 0, or 70 where the build
        /// failed.</summary>
        [MenuItem("Tools/Guidewire/Build player for Linux")]
        public static void Linux() => Run(BuildTarget.StandaloneLinux64, "Build/Linux/Guidewire.x86_64");

        /// <summary>Builds Build/Windows/Guidewire.exe.</summary>
        [MenuItem("Tools/Guidewire/Build player for Windows")]
        public static void Windows() => Run(BuildTarget.StandaloneWindows64, "Build/Windows/Guidewire.exe");

        private static void Run(BuildTarget target, string path)
        {
            int code;
            try
            {
                code = Build(target, path) ? 0 : ExitCodes.Internal;
            }
            catch (Exception error)
            {
                Debug.LogError("guidewire: internal error: " + error);
                code = ExitCodes.Internal;
            }
            if (Application.isBatchMode)
            {
                EditorApplication.Exit(code);
            }
        }

        private static bool Build(BuildTarget target, string path)
        {
            var options = new BuildPlayerOptions
            {
                scenes = EditorBuildSettings.scenes.Where(scene => scene.enabled).Select(scene => scene.path).ToArray(),
                target = target,
                targetGroup = BuildTargetGroup.Standalone,
                locationPathName = path,
            };
            BuildReport? report = BuildPipeline.BuildPlayer(options);
            if (report == null)    // Unity gives none where it does not even begin
            {
                Debug.LogError("guidewire: no player was built -> " + path);
                return false;
            }
            BuildSummary summary = report.summary;
            Debug.Log("guidewire: build " + summary.result + ", " + summary.totalErrors + " errors -> " + path);
            if (summary.result != BuildResult.Succeeded)
            {
                return false;
            }
            string folder = Path.GetDirectoryName(path)!;
            CopyAll("params", folder);
            CopyAll("instruments", folder);
            return true;
        }

        private static void CopyAll(string source, string target)
        {
            foreach (string file in Directory.Exists(source)
                ? Directory.GetFiles(source, "*", SearchOption.AllDirectories) : Array.Empty<string>())
            {
                string copy = Path.Combine(target, file);
                Directory.CreateDirectory(Path.GetDirectoryName(copy)!);
                File.Copy(file, copy, true);
            }
        }
    }

    /// <summary>Batch mode of the editor: <c>-executeMethod Guidewire.Editor.BatchEntry.Run ... -guidewire -parameters
    /// FILE -out DIR</c>. Without play mode, which would reload the domain and lose the run.</summary>
    public static class BatchEntry
    {
        /// <summary>Does one run and ends the editor with its exit code.</summary>
        public static void Run() => EditorApplication.Exit(BatchRun.Execute(Environment.GetCommandLineArgs()));
    }

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
