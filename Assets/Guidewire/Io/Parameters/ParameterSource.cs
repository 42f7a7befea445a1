using System;
using System.Collections.Generic;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Where the parameters of a run come from, beside its overrides: a file, or its replacement in a host
    /// program, such as an asset and the meshes of a scene.</summary>
    public sealed class ParameterSource
    {
        private static readonly Dictionary<string, byte[]> None = new Dictionary<string, byte[]>();

        private readonly JObject? _content;

        private ParameterSource(string? name, JObject? content, LastMesh? mesh)
        {
            Name = name;
            _content = content;
            Mesh = mesh;
        }

        /// <summary>The file, or what error lines call it; null for the defaults alone. Files that it names are looked
        /// for in its folder.</summary>
        public string? Name { get; }

        /// <summary>Walls in addition to those of the keys, in units of the wire.</summary>
        public ContactShape[] Walls { get; private set; } = Array.Empty<ContactShape>();

        /// <summary>Files that the host has in memory: instruments by their names, meshes by those of their files
        /// without a folder. They count before files on disk.</summary>
        public IReadOnlyDictionary<string, byte[]> Files { get; private set; } = None;

        /// <summary>What errors name as the source of overrides.</summary>
        internal string OverridesFrom { get; private set; } = CommandLineHandler.Source;

        /// <summary>Keeps the vessel's mesh for the next run; null where nothing does.</summary>
        internal LastMesh? Mesh { get; }

        /// <summary>Gives a file on disk.</summary>
        /// <param name="file">Its name; null for the defaults.</param>
        /// <param name="mesh">Keeps the vessel's mesh where one run follows another.</param>
        public static ParameterSource OfFile(string? file, LastMesh? mesh = null) =>
            new ParameterSource(file, null, mesh);

        /// <summary>The file of a request; its overrides are those that the request sets.</summary>
        /// <param name="file">Its name; null for the defaults.</param>
        /// <param name="mesh">Keeps the vessel's mesh where one run follows another.</param>
        public static ParameterSource OfRequest(string? file, LastMesh? mesh)
        {
            return new ParameterSource(file, null, mesh)
            {
                OverridesFrom = CommandLineHandler.RequestSource,
            };
        }

        /// <summary>Gives the text of a parameter file.</summary>
        /// <param name="name">What error lines call it.</param>
        /// <param name="text">A flat JSON object.</param>
        /// <exception cref="ParameterException">It is no JSON object.</exception>
        public static ParameterSource OfText(string name, string text) =>
            new ParameterSource(name, JsonText.ParseObject(text, name), null);

        /// <summary>The same with walls beside those that the keys state, and with files in memory.</summary>
        /// <param name="walls">See <see cref="Walls"/>.</param>
        /// <param name="files">See <see cref="Files"/>; null: none.</param>
        public ParameterSource With(ContactShape[] walls, IReadOnlyDictionary<string, byte[]>? files = null)
        {
            return new ParameterSource(Name, _content, Mesh)
            {
                OverridesFrom = OverridesFrom,
                Walls = walls,
                Files = files ?? None,
            };
        }

        /// <summary>Gives its keys and values; null without any.</summary>
        /// <exception cref="ParameterException">The file cannot be read.</exception>
        internal JObject? Read() =>
            (JObject?)_content?.DeepClone() ?? (Name == null ? null : JsonText.ReadObject(Name));
    }

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
