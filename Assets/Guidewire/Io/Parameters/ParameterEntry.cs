using System;
using System.Collections.Generic;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>One key of the parameter table: its name, unit, help and, by its type, how it is read, checked and
    /// written. Everything that names a parameter comes from here: parsing, error lines, command line, help, README and
    /// the Inspector's tooltips.</summary>
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

        /// <summary>What it means, in one phrase.</summary>
        public string Help { get; }

        /// <summary>What is allowed, as a noun phrase with the unit.</summary>
        public abstract string Allowed { get; }

        /// <summary>The words to choose from; empty where the value is not one of a few words.</summary>
        public virtual IReadOnlyList<string> Choices => Array.Empty<string>();

        /// <summary>Whether the value only says where results go: such a key does not enter the parameter
        /// hash.</summary>
        public bool IsOutputPath { get; internal set; }

        /// <summary>The value in a set of parameters, as JSON.</summary>
        public abstract JToken Write(RunParameters source);

        /// <summary>The default, as JSON text.</summary>
        public string Default => Write(new RunParameters()).ToString(Formatting.None);

        /// <summary>Takes over a value; false where the value is not allowed.</summary>
        internal abstract bool TryRead(RunParameters target, JToken value);

        /// <summary>The JSON value that a text on the command line stands for, or null where it stands for
        /// none.</summary>
        internal virtual JToken? FromText(string text)
        {
            if (StrictJson.FindError(text) != null)
            {
                return null;
            }
            return JsonText.Parse(text);
        }

        /// <summary>"a number &gt; 0 (s)": the noun with the unit behind it.</summary>
        private protected string WithUnit(string noun)
        {
            return Unit.Length == 0 ? noun : noun + " (" + Unit + ")";
        }
    }
}
