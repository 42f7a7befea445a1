using System;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Marks a field as one of the parameter table's keys. Label, unit, allowed values and help in the
    /// Inspector come from the table, so that they stand once.</summary>
    [AttributeUsage(AttributeTargets.Field)]
    public sealed class ParameterAttribute : PropertyAttribute
    {
        /// <param name="key">The key in the parameter table.</param>
        public ParameterAttribute(string key)
        {
            Key = key;
        }

        /// <summary>The key in the parameter table.</summary>
        public string Key { get; }
    }
}
