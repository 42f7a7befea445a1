using System;
using System.Collections.Generic;
using UnityEngine;

namespace UnityEditor
{
    [AttributeUsage(AttributeTargets.Class)]
    public sealed class InitializeOnLoadAttribute : Attribute
    {
    }

    public static class AssemblyReloadEvents
    {
        public delegate void AssemblyReloadCallback();

        public static event AssemblyReloadCallback beforeAssemblyReload;

        internal static void Raise() => beforeAssemblyReload?.Invoke();
    }

    public static class EditorApplication
    {
        public delegate void CallbackFunction();

        public static CallbackFunction delayCall;

        internal static void CallDelayed()
        {
            CallbackFunction calls = delayCall;
            delayCall = null;
            calls?.Invoke();
        }

        public static void Exit(int returnValue) => UnityStubs.Engine.ExitCode = returnValue;
    }

    [AttributeUsage(AttributeTargets.Method)]
    public sealed class MenuItem : Attribute
    {
        public MenuItem(string itemName)
        {
            menuItem = itemName;
        }

        public MenuItem(string itemName, bool isValidateFunction, int priority)
        {
            (menuItem, this.priority) = (itemName, priority);
        }

        public string menuItem;

        public int priority = 1000;
    }

    public enum BuildTarget
    {
        StandaloneWindows64 = 19,
        StandaloneLinux64 = 24,
    }

    public enum BuildTargetGroup
    {
        Unknown = 0,
        Standalone = 1,
    }

    public struct BuildPlayerOptions
    {
        public string[] scenes { get; set; }

        public string locationPathName { get; set; }

        public BuildTarget target { get; set; }

        public BuildTargetGroup targetGroup { get; set; }
    }

    public sealed class EditorBuildSettingsScene
    {
        public EditorBuildSettingsScene(string path, bool enabled)
        {
            this.path = path;
            this.enabled = enabled;
        }

        public string path { get; set; }

        public bool enabled { get; set; }
    }

    public static class EditorBuildSettings
    {
        public static EditorBuildSettingsScene[] scenes { get; set; } = Array.Empty<EditorBuildSettingsScene>();
    }

    public static class BuildPipeline
    {
        /// <summary>What a test wants a build to come to; null where Unity returns no report at all.</summary>
        internal static Build.Reporting.BuildResult? Next;

        internal static BuildPlayerOptions Last;

        public static Build.Reporting.BuildReport BuildPlayer(BuildPlayerOptions buildPlayerOptions)
        {
            Last = buildPlayerOptions;
            return Next is Build.Reporting.BuildResult result
                ? new Build.Reporting.BuildReport { summary = new Build.Reporting.BuildSummary { result = result } }
                : null;
        }
    }
}

namespace UnityEditor.Build.Reporting
{
    public enum BuildResult
    {
        Unknown,
        Succeeded,
        Failed,
        Cancelled,
    }

    public struct BuildSummary
    {
        public BuildResult result { get; internal set; }

        public int totalErrors { get; internal set; }
    }

    public sealed class BuildReport : UnityEngine.Object
    {
        public BuildSummary summary { get; internal set; }
    }
}
