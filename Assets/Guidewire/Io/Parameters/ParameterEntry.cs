using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using Guidewire.Core;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>One key of the parameter table: its name, unit, help, the methods that take it and, by its type, how it
    /// is read, checked and written. Everything that names a parameter comes from here: parsing, error lines, command
    /// line, help, docs and the Inspector's tooltips.</summary>
    public abstract class ParameterEntry
    {
        private protected ParameterEntry(string key, string unit, string help)
        {
            Key = key;
            Unit = unit;
            Help = help;
        }

        /// <summary>The name in files and, after a dash, on the command line.</summary>
        public string Key { get; }

        /// <summary>The unit, or an empty text for a number without one.</summary>
        public string Unit { get; }

        /// <summary>The unit where the wire is a material, if that is another one; else null.</summary>
        public string? MaterialUnit { get; private set; }

        /// <summary>What it means, in one phrase.</summary>
        public string Help { get; }

        /// <summary>The methods that take it. To the others it says nothing: it is refused on the command line, and
        /// passed over, with a line that says so, in a file.</summary>
        public IReadOnlyList<Solver> Methods { get; private set; } = Array.Empty<Solver>();

        /// <summary>Whether a method that does not take the key refuses it in a file too, if it has an effect: a run
        /// without its wall or load would simulate something else.</summary>
        public bool IsRefusedElsewhere { get; private set; }

        /// <summary>The keys that say it for the other methods, or null.</summary>
        public string? Instead { get; private set; }

        /// <summary>What is allowed, as a noun phrase with the unit.</summary>
        public abstract string Allowed { get; }

        /// <summary>The words to choose from; empty where the value is not one of a few words.</summary>
        public abstract IReadOnlyList<string> Choices { get; }

        /// <summary>Whether the value only says where results go: such a key does not enter the parameter
        /// hash.</summary>
        public bool IsOutputPath { get; private set; }

        /// <summary>The methods that take it, as they follow "solver": "pbd, xpbd or direct".</summary>
        public string MethodWords
        {
            get
            {
                var words = new List<string>();
                foreach (Solver method in Methods)
                {
                    words.Add(Kinds.Word(method.ToString()));
                }
                string last = words[words.Count - 1];
                words.RemoveAt(words.Count - 1);
                return words.Count == 0 ? last : string.Join(", ", words) + " or " + last;
            }
        }

        /// <summary>The default with each method that takes the key, as JSON text: "10.0", or "10.0; with xpbd or
        /// direct 0.0" where methods differ.</summary>
        public string Defaults
        {
            get
            {
                if (Key == ParameterTable.SolverKey)
                {
                    return Default(new RunParameters(Solver.Pbd).Simulation.Method.Solver);
                }
                var text = new List<string>();
                var methods = new List<List<string>>();
                foreach (Solver method in Methods)
                {
                    string value = Default(method);
                    int index = text.IndexOf(value);
                    if (index < 0)
                    {
                        index = text.Count;
                        text.Add(value);
                        methods.Add(new List<string>());
                    }
                    methods[index].Add(Kinds.Word(method.ToString()));
                }
                for (int k = 1; k < text.Count; k++)
                {
                    text[k] = "with " + string.Join(" or ", methods[k]) + " " + text[k];
                }
                return string.Join("; ", text);
            }
        }

        /// <summary>Whether a method takes the key.</summary>
        public bool IsTakenBy(Solver method)
        {
            foreach (Solver taker in Methods)
            {
                if (taker == method)
                {
                    return true;
                }
            }
            return false;
        }

        /// <summary>Gives the default with this method, as JSON text.</summary>
        public string Default(Solver method) => Write(new RunParameters(method)).ToString(Formatting.None);

        /// <summary>Names the unit where the wire is a material.</summary>
        internal ParameterEntry OfMaterial(string unit)
        {
            MaterialUnit = unit;
            return this;
        }

        /// <summary>Names the keys that say it for the other methods.</summary>
        internal ParameterEntry Replacing(string instead)
        {
            Instead = instead;
            return this;
        }

        /// <summary>Says that the value only says where results go.</summary>
        internal ParameterEntry AsOutputPath()
        {
            IsOutputPath = true;
            return this;
        }

        /// <summary>Names the methods that take the key.</summary>
        internal ParameterEntry With(IReadOnlyList<Solver> methods)
        {
            Methods = methods;
            return this;
        }

        /// <summary>Names the methods that take the key; the others refuse it in a file too.</summary>
        internal ParameterEntry OnlyWith(IReadOnlyList<Solver> methods)
        {
            Methods = methods;
            IsRefusedElsewhere = true;
            return this;
        }

        /// <summary>Gives the entry, once, what its group knows.</summary>
        /// <param name="values">The object among the parameters whose properties the group's keys are.</param>
        /// <param name="methods">The methods that take keys which name none of their own.</param>
        internal void JoinGroup(Func<RunParameters, object> values, IReadOnlyList<Solver> methods)
        {
            GroupOf = values;
            Methods = Methods.Count > 0 ? Methods : methods;
        }

        /// <summary>The value in a set of parameters, as JSON.</summary>
        internal abstract JToken Write(RunParameters source);

        /// <summary>Takes over a value; false where the value is not allowed.</summary>
        internal abstract bool TryRead(RunParameters target, JToken value);

        /// <summary>The fields of an object that it holds; empty where a reader of its own knows them.</summary>
        internal abstract IReadOnlyList<string> Fields { get; }

        /// <summary>What a field of an object that it holds allows; null where there is no such field, or a reader of
        /// its own knows.</summary>
        internal abstract string? AllowedOf(string field);

        /// <summary>The present word for a word of older files; null for any other value.</summary>
        internal abstract string? NewerWord(JToken value);

        /// <summary>The JSON value that a text on the command line stands for, or null where it stands for
        /// none.</summary>
        internal abstract JToken? FromText(string text);

        /// <summary>The object among the parameters whose properties the group's keys are.</summary>
        private protected Func<RunParameters, object> GroupOf { get; private set; } = parameters => parameters;

        /// <summary>Gives "a number &gt; 0 (s)": the noun with the unit behind it.</summary>
        private protected string WithUnit(string noun)
        {
            string unit = Unit + (MaterialUnit == null ? "" : "; with a material " + MaterialUnit);
            return unit.Length == 0 ? noun : noun + " (" + unit + ")";
        }
    }

    /// <summary>Keys that belong together: a part of the parameter table, with a type of its own in Core.</summary>
    public sealed class ParameterGroup
    {
        internal ParameterGroup(string name, string about, Func<RunParameters, object> values,
            IReadOnlyList<ParameterEntry> entries, IReadOnlyList<Solver>? methods = null)
        {
            Name = name;
            About = about;
            Entries = entries;
            foreach (ParameterEntry entry in entries)
            {
                entry.JoinGroup(values, methods ?? Takers.All);
            }
        }

        /// <summary>The group's name, one word.</summary>
        public string Name { get; }

        /// <summary>What its keys are about, in one phrase.</summary>
        public string About { get; }

        /// <summary>The keys in the order of the help text.</summary>
        public IReadOnlyList<ParameterEntry> Entries { get; }
    }

    /// <summary>A key that holds one value: the property of the same name in the parameters of the key's group or,
    /// where these have none of that name and type, in RunParameters.</summary>
    internal sealed class ValueEntry<T> : ParameterEntry
    {
        private readonly Kind<T> _kind;
        private string _property;
        private Func<RunParameters, T>? _getter;
        private Action<RunParameters, T>? _setter;

        /// <summary>A key of this kind.</summary>
        public ValueEntry(string key, string unit, Kind<T> kind, string help)
            : base(key, unit, help)
        {
            _kind = kind;
            _property = NamedProperty.Of(key);
        }

        /// <inheritdoc/>
        public override string Allowed => WithUnit(_kind.Allowed);

        /// <inheritdoc/>
        public override IReadOnlyList<string> Choices => _kind.Choices;

        /// <inheritdoc/>
        internal override IReadOnlyList<string> Fields => _kind.Fields;

        /// <summary>Names the property that holds the value.</summary>
        public ValueEntry<T> In(string property)
        {
            _property = property;
            return this;
        }

        /// <summary>Says how the value is read and taken over where that takes more than a property.</summary>
        public ValueEntry<T> By(Func<RunParameters, T> getter, Action<RunParameters, T> setter)
        {
            (_getter, _setter) = (getter, setter);
            return this;
        }

        /// <inheritdoc/>
        internal override JToken Write(RunParameters source) => _kind.Write(_getter != null ? _getter(source)
            : NamedProperty.Get<T>(Owner(source), _property));

        /// <inheritdoc/>
        internal override bool TryRead(RunParameters target, JToken value)
        {
            if (!_kind.TryRead(value, out T read))
            {
                return false;
            }
            if (_setter != null)
            {
                _setter(target, read);
            }
            else
            {
                NamedProperty.Set(Owner(target), _property, read);
            }
            return true;
        }

        /// <inheritdoc/>
        internal override string? AllowedOf(string field) => _kind.AllowedOf(field);

        /// <inheritdoc/>
        internal override string? NewerWord(JToken value) => _kind.NewerWord(value);

        /// <inheritdoc/>
        internal override JToken? FromText(string text) =>
            _kind.FromText != null ? _kind.FromText(text) : JsonText.Given(text);

        private object Owner(RunParameters parameters)
        {
            object group = GroupOf(parameters);
            return NamedProperty.IsOf<T>(group, _property) ? group : parameters;
        }
    }

    /// <summary>Properties that keys name: guidewireLength is GuidewireLength.</summary>
    /// <remarks>Accessors are looked up by name, which no linker sees. So the classes whose properties keys are stand
    /// here for .NET's, and a step of Unity's builds keeps both assemblies whole.</remarks>
    internal static class NamedProperty
    {
        /// <summary>Gives the property's name.</summary>
        [DynamicDependency(DynamicallyAccessedMemberTypes.PublicProperties, typeof(MethodParameters))]
        [DynamicDependency(DynamicallyAccessedMemberTypes.PublicProperties, typeof(SceneParameters))]
        [DynamicDependency(DynamicallyAccessedMemberTypes.PublicProperties, typeof(PbdParameters))]
        [DynamicDependency(DynamicallyAccessedMemberTypes.PublicProperties, typeof(MaterialParameters))]
        [DynamicDependency(DynamicallyAccessedMemberTypes.PublicProperties, typeof(ContactParameters))]
        [DynamicDependency(DynamicallyAccessedMemberTypes.PublicProperties, typeof(DriveParameters))]
        [DynamicDependency(DynamicallyAccessedMemberTypes.PublicProperties, typeof(WireSection))]
        [DynamicDependency(DynamicallyAccessedMemberTypes.PublicProperties
            | DynamicallyAccessedMemberTypes.NonPublicProperties, typeof(RunParameters))]
        public static string Of(string key) => char.ToUpperInvariant(key[0]) + key.Substring(1);

        /// <summary>Whether an object has a property of this name and type.</summary>
        public static bool IsOf<T>(object owner, string name) =>
            owner.GetType().GetProperty(name)?.PropertyType == typeof(T);

        /// <summary>Gives the property's value.</summary>
        /// <exception cref="ArgumentException">There is no such property.</exception>
        public static T Get<T>(object owner, string name) =>
            ((Func<T>)Delegate.CreateDelegate(typeof(Func<T>), owner, "get_" + name))();

        /// <summary>Sets the property's value.</summary>
        /// <exception cref="ArgumentException">There is no such property.</exception>
        public static void Set<T>(object owner, string name, T value) =>
            ((Action<T>)Delegate.CreateDelegate(typeof(Action<T>), owner, "set_" + name))(value);
    }
}
