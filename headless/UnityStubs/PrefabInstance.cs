using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Reflection;
using System.Text.RegularExpressions;
using UnityEngine;

namespace UnityStubs
{
    /// <summary>An instance of a prefab in a scene or in another prefab, as its document describes it: a variant is a
    /// prefab that holds one. What is not as in the source stands in it by path.</summary>
    internal sealed class PrefabInstance
    {
        private static readonly Regex Change = new Regex(@"- target: \{fileID: (-?\d+), guid: \w+, type: 3\}\s+"
            + @"propertyPath: (\S+)\s+value: ?(.*)\s+objectReference: (\{.*\})");
        private static readonly Regex Element = new Regex(@"^(\w+)\.Array\.(?:size|data\[(\d+)\])$");

        private readonly List<(long Target, string Path, string Value)> _changes =
            new List<(long Target, string Path, string Value)>();
        private readonly long[] _removed;

        public PrefabInstance(string text)
        {
            Source = Regex.Match(text, @"m_SourcePrefab: \{fileID: 100100000, guid: (\w+)").Groups[1].Value;
            Parent = Number(Regex.Match(text, @"m_TransformParent: \{fileID: (-?\d+)").Groups[1].Value);
            foreach (Match change in Change.Matches(text))
            {
                string reference = change.Groups[4].Value;
                _changes.Add((Number(change.Groups[1].Value), change.Groups[2].Value,
                    reference == "{fileID: 0}" ? change.Groups[3].Value : reference));
            }
            string removed = Regex.Match(text, @"m_RemovedComponents:((?:\s+- \{.*\})*)").Groups[1].Value;
            _removed = Regex.Matches(removed, @"fileID: (-?\d+)").Select(one => Number(one.Groups[1].Value)).ToArray();
        }

        /// <summary>GUID of the prefab.</summary>
        public string Source { get; }

        /// <summary>The transform that it hangs below; 0: none.</summary>
        public long Parent { get; }

        /// <summary>Its outermost object.</summary>
        public GameObject Root { get; private set; }

        /// <summary>What an object of the prefab is called where the instance stands.</summary>
        public static long IdOf(long source, long instance)
        {
            return (source ^ instance) & long.MaxValue;
        }

        /// <summary>Makes of a copy of the prefab what the instance is.</summary>
        /// <param name="objects">Of the copy, by their ids in the prefab.</param>
        /// <param name="read">Reads a value of a type.</param>
        /// <param name="fieldOf">The field of a name.</param>
        public void Apply(Dictionary<long, UnityEngine.Object> objects, Func<Type, string, object> read,
            Func<object, string, FieldInfo> fieldOf)
        {
            Root = objects.Values.OfType<GameObject>().First(one => one.transform.parent is null);
            foreach ((long target, string path, string value) in _changes)
            {
                Set(objects[target], path, value, read, fieldOf);
            }
            foreach (long removed in _removed)
            {
                UnityEngine.Object.DestroyImmediate(objects[removed]);
                objects.Remove(removed);
            }
        }

        private static void Set(UnityEngine.Object target, string path, string value, Func<Type, string, object> read,
            Func<object, string, FieldInfo> fieldOf)
        {
            Match element = Element.Match(path);
            if (path == "m_Name")
            {
                target.name = value;
            }
            else if (path == "m_Enabled")
            {
                ((MonoBehaviour)target).enabled = value == "1";
            }
            else if (target is Transform transform)
            {
                Move(transform, path.Split('.'), float.Parse(value, CultureInfo.InvariantCulture));
            }
            else if (!element.Success)
            {
                FieldInfo field = fieldOf(target, path);
                field?.SetValue(target, read(field.FieldType, value));
            }
            else
            {
                FieldInfo field = fieldOf(target, element.Groups[1].Value);
                var array = (Array)field.GetValue(target);
                Type type = field.FieldType.GetElementType();
                if (element.Groups[2].Success)
                {
                    array.SetValue(read(type, value), (int)Number(element.Groups[2].Value));
                    return;
                }
                var resized = Array.CreateInstance(type, (int)Number(value));
                Array.Copy(array, resized, Math.Min(array.Length, resized.Length));
                field.SetValue(target, resized);
            }
        }

        private static void Move(Transform transform, string[] path, float value)
        {
            bool isScale = path[0] == "m_LocalScale";
            if (!isScale && path[0] != "m_LocalPosition")
            {
                throw new NotSupportedException(path[0]);
            }
            Vector3 vector = isScale ? transform.localScale : transform.localPosition;
            (vector.x, vector.y, vector.z) = (path[1] == "x" ? value : vector.x, path[1] == "y" ? value : vector.y,
                path[1] == "z" ? value : vector.z);
            (transform.localScale, transform.localPosition) = isScale ? (vector, transform.localPosition)
                : (transform.localScale, vector);
        }

        private static long Number(string text)
        {
            return text.Length == 0 ? 0 : long.Parse(text, CultureInfo.InvariantCulture);
        }
    }
}
