using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
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
