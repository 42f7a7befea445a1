using System;
using System.Collections.Generic;
using System.Text.RegularExpressions;

namespace UnityEngine
{
    /// <summary>Unity's attribute goes on anything; what it cannot store it passes over without a word.</summary>
    public sealed class SerializeField : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class AddComponentMenu : Attribute
    {
        public AddComponentMenu(string menuName)
        {
        }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public class HelpURLAttribute : Attribute
    {
        public HelpURLAttribute(string url)
        {
            URL = url;
        }

        public virtual string URL { get; }
    }

    [AttributeUsage(AttributeTargets.Class, AllowMultiple = true)]
    public sealed class RequireComponent : Attribute
    {
        public RequireComponent(Type requiredComponent)
        {
            m_Type0 = requiredComponent;
        }

        public Type m_Type0;
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class DefaultExecutionOrder : Attribute
    {
        public DefaultExecutionOrder(int order)
        {
            this.order = order;
        }

        public int order { get; }
    }

    public abstract class PropertyAttribute : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class TooltipAttribute : PropertyAttribute
    {
        public readonly string tooltip;

        public TooltipAttribute(string tooltip)
        {
            this.tooltip = tooltip;
        }
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class HeaderAttribute : PropertyAttribute
    {
        public readonly string header;

        public HeaderAttribute(string header)
        {
            this.header = header;
        }
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class RangeAttribute : PropertyAttribute
    {
        public readonly float min;
        public readonly float max;

        public RangeAttribute(float min, float max)
        {
            this.min = min;
            this.max = max;
        }
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class MinAttribute : PropertyAttribute
    {
        public readonly float min;

        public MinAttribute(float min)
        {
            this.min = min;
        }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class ExecuteAlways : Attribute
    {
    }

    public enum RuntimeInitializeLoadType
    {
        AfterSceneLoad,
        BeforeSceneLoad,
        AfterAssembliesLoaded,
        BeforeSplashScreen,
        SubsystemRegistration,
    }

    [AttributeUsage(AttributeTargets.Method)]
    public sealed class RuntimeInitializeOnLoadMethodAttribute : Attribute
    {
        public RuntimeInitializeOnLoadMethodAttribute(RuntimeInitializeLoadType loadType)
        {
            this.loadType = loadType;
        }

        public RuntimeInitializeLoadType loadType { get; }
    }
}

namespace UnityEngine.Serialization
{
    /// <summary>Names a field that a file still holds under another name.</summary>
    [AttributeUsage(AttributeTargets.Field, AllowMultiple = true)]
    public sealed class FormerlySerializedAsAttribute : Attribute
    {
        public FormerlySerializedAsAttribute(string oldName)
        {
            this.oldName = oldName;
        }

        public string oldName { get; }
    }
}

namespace UnityEngine.TestTools
{
    /// <summary>A test that yields frames. NUnit does not know it; the stub engine's tests run it frame by
    /// frame.</summary>
    [AttributeUsage(AttributeTargets.Method)]
    public sealed class UnityTestAttribute : Attribute
    {
    }

    /// <summary>What Unity's test runner makes of the log: a test fails on an error that nobody expected, and on a line
    /// that was expected and did not come.</summary>
    public static class LogAssert
    {
        private static readonly List<(LogType Type, Regex Message)> Expected = new List<(LogType, Regex)>();
        private static readonly List<string> Unexpected = new List<string>();

        /// <summary>The next lines of this type are held against this text until one matches.</summary>
        public static void Expect(LogType type, Regex message) => Expected.Add((type, message));

        /// <summary>Forgets what was expected and what came: a test begins.</summary>
        internal static void Begin()
        {
            Expected.Clear();
            Unexpected.Clear();
        }

        internal static void Take(LogType type, string text)
        {
            int place = Expected.FindIndex(line => line.Type == type && line.Message.IsMatch(text));
            if (place >= 0)
            {
                Expected.RemoveAt(place);
            }
            else if (type == LogType.Error || type == LogType.Assert || type == LogType.Exception)
            {
                Unexpected.Add(text);
            }
        }

        /// <summary>Why a test that ends now fails; empty where it does not.</summary>
        internal static string Problem()
        {
            string missing = string.Join(", ", Expected.ConvertAll(line => line.Type + " '" + line.Message + "'"));
            return (Unexpected.Count > 0 ? "unhandled log: " + string.Join(" | ", Unexpected) : "")
                + (missing.Length > 0 ? "expected log did not appear: " + missing : "");
        }
    }
}
