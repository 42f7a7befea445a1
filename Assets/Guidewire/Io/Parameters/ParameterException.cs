using System;

namespace Guidewire.Io
{
    /// <summary>An error in the user's input. The message is one line that names the file or the command
    /// line, the key, the value and what is allowed.</summary>
    public sealed class ParameterException : Exception
    {
        /// <summary>An error whose line is already whole.</summary>
        public ParameterException(string line)
            : base(OneLine(line))
        {
        }

        /// <summary>A value that a key does not allow.</summary>
        /// <param name="source">The file, or "command line".</param>
        /// <param name="key">The parameter's name.</param>
        /// <param name="value">The value as it was written.</param>
        /// <param name="allowed">What is allowed, as a noun phrase.</param>
        public ParameterException(string source, string key, string value, string allowed)
            : base(OneLine(source + ": " + key + " = " + Shorten(value) + " is not allowed: needs " + allowed))
        {
        }

        private static string Shorten(string value) => value.Length <= 80 ? value : value.Substring(0, 77) + "...";

        private static string OneLine(string text) => text.Replace("\r", " ").Replace('\n', ' ');
    }
}
