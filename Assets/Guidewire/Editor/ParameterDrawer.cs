using Guidewire.Io;
using Guidewire.Runtime;
using UnityEditor;
using UnityEngine;

namespace Guidewire.Editor
{
    /// <summary>Draws a parameter in the Inspector with label and tooltip from the parameter table. A value out of
    /// range is not corrected silently: the loop stops and says what is allowed.</summary>
    [CustomPropertyDrawer(typeof(ParameterAttribute))]
    public sealed class ParameterDrawer : PropertyDrawer
    {
        /// <summary>The tooltip of a key: help, what is allowed with its unit, and the default.</summary>
        public static string Tooltip(string key)
        {
            ParameterEntry? entry = ParameterTable.Find(key);
            return entry == null ? "not in the parameter table"
                : entry.Help + "\n" + entry.Allowed + "; default " + entry.Defaults;
        }

        /// <inheritdoc/>
        public override void OnGUI(Rect position, SerializedProperty property, GUIContent label)
        {
            string key = ((ParameterAttribute)attribute).Key;
            EditorGUI.PropertyField(position, property, new GUIContent(key, Tooltip(key)));
        }
    }
}
