using System;
using System.Collections.Generic;
using System.IO;
using System.Reflection;
using UnityEngine;

// What the package's inspectors, menus and gizmos call of the editor.
namespace UnityEditor
{
    [AttributeUsage(AttributeTargets.Class)]
    public sealed class CustomEditor : Attribute
    {
        public CustomEditor(Type inspectedType)
        {
        }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class CanEditMultipleObjects : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Method)]
    public sealed class DrawGizmo : Attribute
    {
        public DrawGizmo(GizmoType gizmo)
        {
        }
    }

    [Flags]
    public enum GizmoType
    {
        Pickable = 1,
        NotInSelectionHierarchy = 2,
        NonSelected = 32,
        Selected = 4,
        Active = 8,
        InSelectionHierarchy = 16,
    }

    /// <summary>An inspector, as the Inspector window has it.</summary>
    public class Editor : ScriptableObject
    {
        public UnityEngine.Object target => targets[0];

        public UnityEngine.Object[] targets { get; internal set; }

        public SerializedObject serializedObject { get; internal set; }

        public virtual void OnInspectorGUI()
        {
        }

        public void Repaint()
        {
        }

        protected static void DrawPropertiesExcluding(SerializedObject obj, params string[] propertyToExclude)
        {
        }

        internal static T Make<T>(params UnityEngine.Object[] targets)
            where T : Editor, new() => new T { targets = targets, serializedObject = new SerializedObject(targets[0]) };
    }

    /// <summary>Fields of an object that hold lists of texts; what is changed is written at once.</summary>
    public class SerializedObject
    {
        private readonly UnityEngine.Object _target;

        public SerializedObject(UnityEngine.Object obj)
        {
            _target = obj;
        }

        public void Update()
        {
        }

        public bool ApplyModifiedProperties() => true;

        public SerializedProperty FindProperty(string propertyPath)
        {
            FieldInfo field = _target.GetType().GetField(propertyPath, BindingFlags.Instance | BindingFlags.NonPublic);
            return field == null ? null : new SerializedProperty(_target, field, -1);
        }
    }

    public class SerializedProperty
    {
        private readonly UnityEngine.Object _target;
        private readonly FieldInfo _field;
        private readonly int _place;

        internal SerializedProperty(UnityEngine.Object target, FieldInfo field, int place)
        {
            (_target, _field, _place) = (target, field, place);
        }

        public int arraySize => Texts.Count;

        public string stringValue
        {
            get => Texts[_place];
            set => Write(texts => texts[_place] = value);
        }

        public SerializedProperty GetArrayElementAtIndex(int index) => new SerializedProperty(_target, _field, index);

        public void InsertArrayElementAtIndex(int index) => Write(texts => texts.Insert(index, ""));

        public void DeleteArrayElementAtIndex(int index) => Write(texts => texts.RemoveAt(index));

        private List<string> Texts => new List<string>((string[])_field.GetValue(_target));

        private void Write(Action<List<string>> change)
        {
            List<string> texts = Texts;
            change(texts);
            _field.SetValue(_target, texts.ToArray());
        }
    }

    public enum MessageType
    {
        None,
        Info,
        Warning,
        Error,
    }

    /// <summary>Shows what it is told in the engine's list of labels; a test types into a field by its label.</summary>
    public static class EditorGUILayout
    {
        /// <summary>Text to be typed into the field of a label, or the word to be chosen in its list.</summary>
        internal static (string Label, string Text)? Typed;

        public static void BeginHorizontal(params GUILayoutOption[] options)
        {
        }

        public static void EndHorizontal()
        {
        }

        public static void HelpBox(string message, MessageType type) => UnityStubs.Engine.Show(type + ": " + message);

        public static bool PropertyField(SerializedProperty property, bool includeChildren,
            params GUILayoutOption[] options) => false;

        public static bool Foldout(bool foldout, string content, bool toggleOnLabelClick)
        {
            UnityStubs.Engine.Show(content);
            return UnityStubs.Engine.IsClicked(content) ? !foldout : foldout;
        }

        public static string DelayedTextField(GUIContent label, string text, params GUILayoutOption[] options)
        {
            UnityStubs.Engine.Show(label.text + " = " + text + "\n" + label.tooltip);
            return Take(label.text) ?? text;
        }

        public static int Popup(string label, int selectedIndex, string[] displayedOptions,
            params GUILayoutOption[] options)
        {
            UnityStubs.Engine.Show(label + ": " + displayedOptions[selectedIndex]);
            string typed = Take(label);
            return typed == null ? selectedIndex : Array.IndexOf(displayedOptions, typed);
        }

        private static string Take(string label)
        {
            string text = Typed.HasValue && Typed.Value.Label == label ? Typed.Value.Text : null;
            Typed = text == null ? Typed : null;
            return text;
        }
    }

    public static class Selection
    {
        public static UnityEngine.Object activeObject { get; set; }
    }

    public static class Undo
    {
        internal static readonly List<UnityEngine.Object> Created = new List<UnityEngine.Object>();

        public static T AddComponent<T>(GameObject gameObject)
            where T : Component => gameObject.AddComponent<T>();

        public static void RecordObject(UnityEngine.Object objectToUndo, string name)
        {
        }

        public static void RegisterCreatedObjectUndo(UnityEngine.Object objectToUndo, string name) =>
            Created.Add(objectToUndo);
    }

    public class MenuCommand
    {
        public MenuCommand(UnityEngine.Object inContext)
        {
            context = inContext;
        }

        public UnityEngine.Object context;
    }

    public static class GameObjectUtility
    {
        public static void SetParentAndAlign(GameObject child, GameObject parent)
        {
            if (parent != null)
            {
                child.transform.SetParent(parent.transform, false);
                child.layer = parent.layer;
            }
        }
    }

    public static class PrefabUtility
    {
        public static UnityEngine.Object InstantiatePrefab(UnityEngine.Object assetComponentOrGameObject) =>
            UnityStubs.SceneFile.Copy((GameObject)assetComponentOrGameObject);
    }

    public static class ProjectWindowUtil
    {
        internal static (string Path, string Content)? Last;

#if !UNITY_6000_4_OR_NEWER
        public static void CreateAssetWithContent(string filename, string content, Texture2D icon = null) =>
            Last = (filename, content);
#endif

        public static void CreateAssetWithTextContent(string filename, string content, Texture2D icon = null,
            Action<EntityId> onRenameComplete = null) => Last = (filename, content);
    }

    /// <summary>Remembers what it frames.</summary>
    public class SceneView : ScriptableObject
    {
        public static SceneView lastActiveSceneView { get; set; }

        internal Bounds Framed;

        public static void RepaintAll()
        {
        }

        public bool Frame(Bounds bounds, bool instant = true)
        {
            Framed = bounds;
            return true;
        }
    }
}

namespace UnityEditor.PackageManager
{
    public class PackageInfo
    {
        /// <summary>Of the test's package; null where its sources stand below Assets.</summary>
        internal static PackageInfo Installed;

        public string assetPath { get; internal set; }

        public static PackageInfo FindForAssembly(Assembly assembly) => Installed;
    }
}

namespace UnityEditor.Build
{
    public interface IOrderedCallback
    {
        int callbackOrder { get; }
    }

    public interface IUnityLinkerProcessor : IOrderedCallback
    {
        string GenerateAdditionalLinkXmlFile(Reporting.BuildReport report,
            UnityLinker.UnityLinkerBuildPipelineData data);
    }
}

namespace UnityEditor.UnityLinker
{
    public class UnityLinkerBuildPipelineData
    {
    }
}

namespace UnityEngine
{
    public sealed class GUILayoutOption
    {
    }

    public static class GUILayout
    {
        public static bool Button(string text, params GUILayoutOption[] options) => UnityStubs.Engine.IsClicked(text);
    }

    /// <summary>Keeps what was drawn since it was cleared.</summary>
    public static class Gizmos
    {
        internal static readonly List<(string What, Vector3 From, Vector3 To)> Drawn =
            new List<(string What, Vector3 From, Vector3 To)>();

        public static Color color { get; set; }

        public static Matrix4x4 matrix { get; set; } = Matrix4x4.identity;

        public static void DrawLine(Vector3 from, Vector3 to) =>
            Drawn.Add(("line", matrix.MultiplyPoint3x4(from), matrix.MultiplyPoint3x4(to)));

        public static void DrawWireSphere(Vector3 center, float radius)
        {
            Drawn.Add(("sphere", matrix.MultiplyPoint3x4(center),
                matrix.MultiplyPoint3x4(center + radius * Vector3.up)));
        }
    }
}
