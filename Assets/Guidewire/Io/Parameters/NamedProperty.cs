using System;
using System.Diagnostics.CodeAnalysis;
using Guidewire.Core;

namespace Guidewire.Io
{
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
