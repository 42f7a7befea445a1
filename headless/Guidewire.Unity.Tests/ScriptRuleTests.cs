using System;
using System.Linq;
using System.Text.RegularExpressions;
using UnityEngine.Serialization;

namespace Guidewire.Unity.Tests
{
    public sealed class ScriptRuleTests
    {
        private static readonly string[] Files = SceneFile.Seen(Stage.Root, "*.cs")
            .Select(file => Path.GetFileNameWithoutExtension(file)).ToArray();

        [Test]
        public void EveryScript_KeepsEveryRule()
        {
            Type[] types = typeof(SimulationLoop).Assembly.GetTypes();
            Assert.That(types.SelectMany(type => ScriptRules.Problems(type, Files)), Is.Empty);
            Assert.That(typeof(Guidewire.Editor.BatchEntry).Assembly.GetTypes()
                .Where(typeof(MonoBehaviour).IsAssignableFrom), Is.Empty, "no object of a player can hold these");
        }

        [Test]
        public void EverySerializedField_HasATooltip_AndNumbersARange()
        {
            IEnumerable<string> problems = new[] { typeof(SimulationLoop), typeof(Hud) }
                .SelectMany(one => one.Assembly.GetTypes()).Where(type => type.DeclaringType == null
                    && (typeof(MonoBehaviour).IsAssignableFrom(type) || type == typeof(KeyAxis)))
                .SelectMany(type => type.GetFields(System.Reflection.BindingFlags.DeclaredOnly
                    | System.Reflection.BindingFlags.Instance | System.Reflection.BindingFlags.NonPublic))
                .Where(field => field.IsDefined(typeof(SerializeField), false))
                .Where(field => ScriptRules.InspectorProblem(field) != null)
                .Select(field => field.DeclaringType!.Name + "." + field.Name + " "
                    + ScriptRules.InspectorProblem(field));
            Assert.That(problems, Is.Empty);
        }

        // Each member but those of Right, and the class itself, which stands in another.
        [Test]
        public void WhatUnityPassesOver_IsNamed()
        {
            string[] problems = ScriptRules.Problems(typeof(Odd), Files).ToArray();
            foreach (string name in typeof(Odd).GetMembers(System.Reflection.BindingFlags.DeclaredOnly
                | System.Reflection.BindingFlags.Instance | System.Reflection.BindingFlags.Static
                | System.Reflection.BindingFlags.NonPublic | System.Reflection.BindingFlags.Public)
                .Select(member => member.Name).Where(name => name.StartsWith("_bad", StringComparison.Ordinal)
                    || name.StartsWith("<BadGetter", StringComparison.Ordinal)))
            {
                Assert.That(problems, Has.Some.StartsWith("Odd." + name + ": "), name);
            }
            Assert.That(problems, Has.Some.StartsWith("Odd must be public").And.Some.StartsWith("Odd.BadProperty: "));
            Assert.That(ScriptRules.Problems(typeof(Right), new[] { "Right" }), Is.EqualTo(
                new[] { "Right must be public, not generic, in no other class, and named as its file" }));
        }

        [Test]
        public void StoredFields_AreThoseOfUnity()
        {
            Assert.That(ScriptRules.Stored(typeof(Right)), Is.EquivalentTo(new[]
            {
                "A", "_a", "_b", "_list", "_names", "_parts", "_any", "Mask", "Curve", "F", "f", "<P>k__BackingField",
                "B",
            }));
        }

        /// <summary>What names methods of the editor's that a command line calls.</summary>
        [TestCase("README.md", 0)]
        [TestCase("docs/unity.md", 2)]
        [TestCase("guidewire/runs/unity_runner.py", 1)]
        public void MethodsThatCommandLinesName_AreThere(string file, int least)
        {
            MatchCollection named = Regex.Matches(File.ReadAllText(Path.Combine(Stage.Root, file)),
                @"\b(Guidewire\.Editor\.\w+)\.(\w+)");
            Assert.That(named.Count, Is.GreaterThanOrEqualTo(least));
            foreach (Match one in named)
            {
                Type? type = typeof(Guidewire.Editor.BatchEntry).Assembly.GetType(one.Groups[1].Value);
                Assert.That(type?.GetMethod(one.Groups[2].Value, Type.EmptyTypes)?.IsStatic, Is.True, one.Value);
            }
        }

#pragma warning disable CS0169, CS0414, CS0649, CA1823, IDE0044, IDE0051, IDE0052, CA1822, CA1852, CS8618
        private class Base : MonoBehaviour
        {
            public int B;
        }

        private sealed class Right : Base
        {
            public int A;
            public readonly int C = 3;
            public LayerMask Mask;
            public AnimationCurve Curve = null!;
            [FormerlySerializedAs("f")] public float F;
            [NonSerialized] public int D;
            [SerializeField, UnityEngine.Range(0, 1)] private float _a, _b = 2f;
            [SerializeField] private List<int> _list = new List<int>();
            [SerializeField] private string[] _names = null!;
            [SerializeField] private Part[] _parts = null!;
            [SerializeReference] private object _any = null!;
            private int _c;
            private Dictionary<int, int> _d = null!;

            [field: SerializeField]
            public int P { get; set; } = 3;

            [Serializable]
            private struct Part
            {
                public int X;
            }
        }

        private sealed class Odd : MonoBehaviour
        {
            [SerializeField] private readonly float _badReadonly = 3f;
            [SerializeField] private static float _badStatic = 3f;
            [SerializeField, NonSerialized] public float _badNonSerialized;
            [SerializeField] private Dictionary<string, int> _badTable;
            [SerializeField] private int[,] _badGrid;
            [SerializeField] private List<int[]> _badArrays;
            [SerializeField] private IReadOnlyList<int> _badInterface;
            [SerializeField] private Plain _badStruct;
            [SerializeField] private Cut _badAbstract;
            [SerializeField] private Vector3d _badVector;
            [SerializeField] private int? _badNumber;
            [SerializeField] private Wide _badWide;
            [SerializeField] private (int A, int B) _badPair;
            [SerializeField] private Action _badAction;
            [Tooltip("x")] private float _badTooltip;

            [SerializeField]
            private float BadProperty { get; set; }

            [field: SerializeField]
            public float BadGetter { get; } = 3f;

            public struct Plain
            {
                public int A;
            }

            [Serializable]
            public abstract class Cut
            {
            }

            public enum Wide : long
            {
                A,
            }
        }
    }
}
