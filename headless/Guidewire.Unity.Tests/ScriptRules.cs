using System;
using System.Linq;
using System.Reflection;

namespace Guidewire.Unity.Tests
{
    /// <summary>What compiles and does not work in Unity: fields that it does not store, scripts that no
    /// object can hold.</summary>
    internal static class ScriptRules
    {
        private const BindingFlags Declared = BindingFlags.Instance | BindingFlags.Static | BindingFlags.Public
            | BindingFlags.NonPublic | BindingFlags.DeclaredOnly;

        /// <summary>Attributes that ask for a place in the Inspector, beside those that derive from
        /// PropertyAttribute.</summary>
        private static readonly HashSet<string> Inspector = new HashSet<string>
        {
            "SerializeField", "ContextMenuItem", "FormerlySerializedAsAttribute", "InspectorNameAttribute",
        };

        /// <summary>What is wrong with a type.</summary>
        /// <param name="type">A behaviour, or any class or struct beside them.</param>
        /// <param name="files">Names of the sources, without their endings.</param>
        public static IEnumerable<string> Problems(Type type, IReadOnlyCollection<string> files)
        {
            if (IsMadeByUnity(type) && !type.IsAbstract
                && (type.IsNested || !type.IsPublic || type.IsGenericType || !files.Contains(type.Name)))
            {
                yield return type.Name + " must be public, not generic, in no other class, and named as its file";
            }
            foreach (MemberInfo member in type.GetMembers(Declared))
            {
                string? problem = member is FieldInfo || member is PropertyInfo ? FieldProblem(type, member) : null;
                if (problem != null)
                {
                    yield return type.Name + "." + member.Name + ": " + problem;
                }
            }
        }

        /// <summary>The names under which a scene may hold fields of a type, former ones included.</summary>
        public static IEnumerable<string> Stored(Type? type)
        {
            for (; type != null && type.Assembly != typeof(MonoBehaviour).Assembly; type = type.BaseType)
            {
                foreach (FieldInfo field in type.GetFields(Declared).Where(IsStored))
                {
                    if (Refusal(field) == null)
                    {
                        yield return field.Name;
                        foreach (var former in field
                            .GetCustomAttributes<UnityEngine.Serialization.FormerlySerializedAsAttribute>())
                        {
                            yield return former.oldName;
                        }
                    }
                }
            }
        }

        /// <summary>Whether a field keeps its value where scripts are compiled anew in Play: private ones do, too.
        /// </summary>
        public static bool SurvivesReload(FieldInfo field)
        {
            return !field.IsDefined(typeof(NonSerializedAttribute)) && !field.IsStatic && !field.IsInitOnly
                && Refusal(field) == null;
        }

        /// <summary>What a field lacks for whoever sees it in the Inspector; null where nothing.</summary>
        public static string? InspectorProblem(FieldInfo field)
        {
            bool isNumber = field.FieldType == typeof(float) || field.FieldType == typeof(int);
            return !field.IsDefined(typeof(TooltipAttribute)) ? "has no tooltip"
                : isNumber && !field.IsDefined(typeof(UnityEngine.RangeAttribute))
                    && !field.IsDefined(typeof(MinAttribute)) ? "has no range" : null;
        }

        private static bool IsMadeByUnity(Type type) =>
            typeof(MonoBehaviour).IsAssignableFrom(type) || typeof(ScriptableObject).IsAssignableFrom(type);

        private static string? FieldProblem(Type type, MemberInfo member)
        {
            if (!member.GetCustomAttributes().Any(one => one is UnityEngine.PropertyAttribute
                || Inspector.Contains(one.GetType().Name)))
            {
                return null;
            }
            return !IsMadeByUnity(type) && !type.IsDefined(typeof(SerializableAttribute)) ? "its class is not stored"
                : !(member is FieldInfo field) ? "a property is not stored; its field is with [field: SerializeField]"
                : !IsStored(field) ? "is static, constant, readonly, [NonSerialized] or not [SerializeField]"
                : Refusal(field);
        }

        /// <summary>Whether Unity stores a field, its type left aside.</summary>
        private static bool IsStored(FieldInfo field)
        {
            bool isAsked = field.IsDefined(typeof(SerializeField)) || field.IsDefined(typeof(SerializeReference));
            return (isAsked || field.IsPublic) && !field.IsDefined(typeof(NonSerializedAttribute)) && !field.IsStatic
                && !field.IsInitOnly;
        }

        /// <summary>Why Unity does not store a field of this type; null where it does.</summary>
        private static string? Refusal(FieldInfo field)
        {
            Type whole = field.FieldType;
            Type type = whole.IsSZArray ? whole.GetElementType()!
                : IsList(whole) ? whole.GetGenericArguments()[0] : whole;
            if (field.IsDefined(typeof(SerializeReference)) || type == typeof(string)
                || (type.Namespace ?? "").StartsWith("UnityEngine", StringComparison.Ordinal)
                || typeof(UnityEngine.Object).IsAssignableFrom(type))
            {
                return null;
            }
            if (type.IsEnum || type.IsPrimitive)
            {
                bool isWide = type.IsEnum && Convert.GetTypeCode(Activator.CreateInstance(type)) >= TypeCode.Int64;
                return isWide ? type.Name + " has 64 bits" : null;
            }
            bool isOwn = type.FullName != null && !type.FullName.StartsWith("System.", StringComparison.Ordinal);
            return type.IsArray || IsList(type) ? "arrays and lists of one dimension only"
                : !isOwn || type.IsInterface || type.IsAbstract || typeof(Delegate).IsAssignableFrom(type)
                    || !type.IsDefined(typeof(SerializableAttribute)) ? type.Name + " is no type that Unity stores"
                : null;
        }

        private static bool IsList(Type type) =>
            type.IsGenericType && type.GetGenericTypeDefinition() == typeof(List<>);
    }
}
