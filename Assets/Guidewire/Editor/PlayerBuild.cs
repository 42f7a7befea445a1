using System;
using System.IO;
using System.Linq;
using Guidewire.Io;
using UnityEditor;
using UnityEditor.Build.Reporting;
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
}
