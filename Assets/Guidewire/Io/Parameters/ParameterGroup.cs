using System;
using System.Collections.Generic;
using Guidewire.Core;

namespace Guidewire.Io
{
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
}
