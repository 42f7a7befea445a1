using System;
using System.Collections.Generic;
using System.Linq;
using Guidewire.Io;
using Guidewire.Runtime;
using UnityEditor;
using UnityEngine;

namespace Guidewire.Editor
{
    /// <summary>The Inspector of a loop: problems of its start before Play, its instruments, the keys that its solver
    /// takes with their values, and buttons while it runs. What is changed is an override of the parameter
    /// file.</summary>
    [CustomEditor(typeof(SimulationLoop))]
    [CanEditMultipleObjects]
    public sealed class LoopInspector : UnityEditor.Editor
    {
        private const string Overrides = "_overrides";

        private readonly HashSet<string> _open = new HashSet<string>();    // groups of keys

        /// <summary>The tooltip of a key: help, what is allowed with its unit, and the default.</summary>
        public static string Tooltip(string key)
        {
            ParameterEntry? entry = ParameterTable.Find(key);
            return entry == null ? "not in the parameter table"
                : entry.Help + "\n" + entry.Allowed + "; default " + entry.Defaults;
        }

        /// <inheritdoc/>
        public override void OnInspectorGUI()
        {
            serializedObject.Update();
            var loop = (SimulationLoop)target;
            if (targets.Length > 1)
            {
                DrawPropertiesExcluding(serializedObject, "m_Script");
                serializedObject.ApplyModifiedProperties();
                return;
            }
            StartCheck check = StartCheck.Of(loop);
            DrawProblems(loop, check);
            if (Application.isPlaying)
            {
                DrawButtons(loop);
            }
            DrawPropertiesExcluding(serializedObject, "m_Script", Overrides);
            DrawInstruments(check.Last);
            DrawKeys(loop, check.Last);
            EditorGUILayout.PropertyField(serializedObject.FindProperty(Overrides), true);
            serializedObject.ApplyModifiedProperties();
            if (check.IsAtWork)
            {
                Repaint();
            }
        }

        private static void DrawProblems(SimulationLoop loop, StartCheck check)
        {
            string problem = Application.isPlaying ? loop.Problem : check.Last.Problem;
            if (problem.Length > 0)
            {
                EditorGUILayout.HelpBox(problem, MessageType.Error);
            }
            if (check.Last.Warnings.Length > 0)
            {
                EditorGUILayout.HelpBox(check.Last.Warnings, MessageType.Warning);
            }
            if (check.Last.Hint.Length > 0)
            {
                EditorGUILayout.HelpBox(check.Last.Hint, MessageType.Info);
            }
            if (loop.Progress.Length > 0 || check.IsAtWork)
            {
                EditorGUILayout.HelpBox(loop.Progress.Length > 0 ? loop.Progress : "opening", MessageType.Info);
            }
        }

        private static void DrawButtons(SimulationLoop loop)
        {
            EditorGUILayout.BeginHorizontal();
            if (GUILayout.Button("Restart"))
            {
                loop.Load();
            }
            if (GUILayout.Button(loop.IsPaused ? "Go on" : "Pause"))
            {
                loop.IsPaused = !loop.IsPaused;
            }
            if (GUILayout.Button("Step"))
            {
                loop.IsPaused = true;
                loop.Step();
            }
            EditorGUILayout.EndHorizontal();
        }

        private void DrawInstruments(StartCheck.Found found)
        {
            for (int k = 0; k < found.Instruments.Count; k++)
            {
                (string name, IReadOnlyList<string> choices) = found.Instruments[k];
                if (choices.Count > 0)
                {
                    string[] words = choices.Prepend("(numbers of the parameters)").ToArray();
                    int now = Math.Max(0, Array.IndexOf(words, name));
                    int chosen = EditorGUILayout.Popup(k == 0 ? "Wire" : "Catheter " + k, now, words);
                    if (chosen != now)
                    {
                        SetOverride(SimulationSession.KeyOf(k), chosen == 0 ? null : words[chosen]);
                    }
                }
            }
        }

        private void DrawKeys(SimulationLoop loop, StartCheck.Found found)
        {
            string last = "";
            foreach ((string group, ParameterEntry entry, string value) in found.Keys)
            {
                if (group != last)
                {
                    last = group;
                    bool isOpen = EditorGUILayout.Foldout(_open.Contains(group), "Parameters: " + group, true);
                    _ = isOpen ? _open.Add(group) : _open.Remove(group);
                }
                if (_open.Contains(group))
                {
                    var label = new GUIContent(entry.Unit.Length == 0 ? entry.Key : entry.Key + " (" + entry.Unit + ")",
                        Tooltip(entry.Key));
                    string changed = EditorGUILayout.DelayedTextField(label, value);
                    if (changed != value)
                    {
                        SetOverride(entry.Key, changed.Length == 0 ? null : changed);
                        if (Application.isPlaying && changed.Length > 0)
                        {
                            loop.Set(entry.Key, changed);
                        }
                    }
                }
            }
        }

        // Null: as the file has it.
        private void SetOverride(string key, string? value)
        {
            SerializedProperty list = serializedObject.FindProperty(Overrides);
            int place = -1;
            for (int i = 0; i < list.arraySize; i++)
            {
                bool isIt = list.GetArrayElementAtIndex(i).stringValue.StartsWith(key + "=", StringComparison.Ordinal);
                place = isIt ? i : place;
            }
            if (value == null && place >= 0)
            {
                list.DeleteArrayElementAtIndex(place);
            }
            else if (value != null)
            {
                if (place < 0)
                {
                    place = list.arraySize;
                    list.InsertArrayElementAtIndex(place);
                }
                list.GetArrayElementAtIndex(place).stringValue = key + "=" + value;
            }
        }
    }
}
