using System.Collections.Generic;

namespace UnityEngine
{
    public static class Time
    {
        private static float Delta;

        public static float deltaTime
        {
            get => UnityStubs.Engine.OnMainThread(Delta);
            internal set => Delta = value;
        }

        public static float time { get; internal set; }

        public static float fixedDeltaTime { get; set; } = 0.02f;
    }

    public static class Application
    {
        private static string Data = "";

        public static string dataPath
        {
            get => UnityStubs.Engine.OnMainThread(Data);
            internal set => Data = value;
        }

        public static bool isBatchMode { get; internal set; }

        public static RuntimePlatform platform { get; internal set; } = RuntimePlatform.LinuxEditor;

        public static bool isEditor { get; internal set; } = true;

        public static bool isPlaying { get; internal set; }

        public static bool runInBackground { get; set; }

        public static int targetFrameRate { get; set; } = -1;

        public static void Quit(int exitCode) => UnityStubs.Engine.ExitCode = exitCode;
    }

    public enum RuntimePlatform
    {
        OSXEditor = 0,
        WindowsPlayer = 2,
        WindowsEditor = 7,
        Android = 11,
        LinuxPlayer = 13,
        LinuxEditor = 16,
        WebGLPlayer = 17,
    }

    public enum LogType
    {
        Error,
        Assert,
        Warning,
        Log,
        Exception,
    }

    public static class Debug
    {
        public static void Log(object message) => UnityStubs.Engine.Write(LogType.Log, message);

        public static void LogWarning(object message) => UnityStubs.Engine.Write(LogType.Warning, message);

        public static void LogWarning(object message, Object context) => LogWarning(message);

        public static void LogError(object message) => UnityStubs.Engine.Write(LogType.Error, message);
    }

    public enum KeyCode
    {
        None = 0,
        Space = 32,
        A = 97,
        B = 98,
        C = 99,
        D = 100,
        E = 101,
        F = 102,
        G = 103,
        H = 104,
        I = 105,
        J = 106,
        K = 107,
        L = 108,
        M = 109,
        N = 110,
        O = 111,
        P = 112,
        Q = 113,
        R = 114,
        S = 115,
        T = 116,
        U = 117,
        V = 118,
        W = 119,
        X = 120,
        Y = 121,
        Z = 122,
        UpArrow = 273,
        DownArrow = 274,
        RightArrow = 275,
        LeftArrow = 276,
    }

    public static class Input
    {
        internal static readonly HashSet<KeyCode> Held = new HashSet<KeyCode>();
        internal static readonly HashSet<KeyCode> Down = new HashSet<KeyCode>();
        internal static readonly HashSet<int> Buttons = new HashSet<int>();

        /// <summary>Whether input is left to the Input System package, as the Player settings may say.</summary>
        internal static bool IsRefused;

        private static Vector3 Position;
        private static Vector2 Scroll;

        public static Vector3 mousePosition
        {
            get => Allowed(Position);
            internal set => Position = value;
        }

        public static Vector2 mouseScrollDelta
        {
            get => Allowed(Scroll);
            internal set => Scroll = value;
        }

        public static bool GetKey(KeyCode key) => Allowed(Held.Contains(key));

        public static bool GetKeyDown(KeyCode key) => Allowed(Down.Contains(key));

        public static bool GetMouseButton(int button) => Allowed(Buttons.Contains(button));

        private static T Allowed<T>(T value)
        {
            return IsRefused ? throw new System.InvalidOperationException("input is the Input System package's")
                : value;
        }
    }

    public sealed class GUIContent
    {
        public static GUIContent none = new GUIContent("");

        public GUIContent(string text)
            : this(text, "")
        {
        }

        public GUIContent(string text, string tooltip)
        {
            this.text = text;
            this.tooltip = tooltip;
        }

        public string text { get; set; }

        public string tooltip { get; set; }
    }

    public static class GUI
    {
        public static Matrix4x4 matrix { get; set; } = Matrix4x4.identity;

        public static void Box(Rect position, GUIContent content)
        {
        }

        public static void Label(Rect position, string text) => UnityStubs.Engine.Show(text);

        public static bool Button(Rect position, string text) => UnityStubs.Engine.IsClicked(text);
    }
}
