using System;

namespace Guidewire.Io
{
    /// <summary>Properties that keys name: guidewireLength is GuidewireLength. Accessors are looked up by name, so a
    /// build that strips unused code has to keep them (Assets/Guidewire/link.xml).</summary>
    internal static class NamedProperty
    {
        /// <summary>The property's name.</summary>
        public static string Of(string key)
        {
            return char.ToUpperInvariant(key[0]) + key.Substring(1);
        }

        /// <summary>Whether an object has a property of this name and type.</summary>
        public static bool IsOf<T>(object owner, string name)
        {
            return owner.GetType().GetProperty(name)?.PropertyType == typeof(T);
        }

        /// <summary>Its value.</summary>
        /// <exception cref="ArgumentException">There is no such property.</exception>
        public static T Get<T>(object owner, string name)
        {
            return ((Func<T>)Delegate.CreateDelegate(typeof(Func<T>), owner, "get_" + name))();
        }

        /// <summary>Sets it.</summary>
        /// <exception cref="ArgumentException">There is no such property.</exception>
        public static void Set<T>(object owner, string name, T value)
        {
            ((Action<T>)Delegate.CreateDelegate(typeof(Action<T>), owner, "set_" + name))(value);
        }
    }
}
