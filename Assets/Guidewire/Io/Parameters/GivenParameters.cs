using System.Collections.Generic;
using System.Linq;
using Guidewire.Core;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>The values given by a file and overrides: by key, or for parts of a key, with their source.</summary>
    internal sealed class GivenParameters
    {
        private const int LongestValue = 80;    // characters that are repeated in a refusal

        private readonly Dictionary<string, (JToken Value, string Source)> _wholes =
            new Dictionary<string, (JToken, string)>();

        private List<(ParameterPath Path, JToken Value, string Source)> _parts =
            new List<(ParameterPath, JToken, string)>();

        private readonly List<(string Key, string Source)> _former = new List<(string, string)>();
        private (string Key, string Source)? _unknown;

        /// <summary>What was given of <see cref="ParameterTable.Former"/>.</summary>
        public IReadOnlyList<(string Key, string Source)> Former => _former;

        /// <summary>Takes what is said of a key or of a part of one; the later word counts. A key that is not known is
        /// kept for <see cref="RefuseUnknown"/>.</summary>
        public void Add(string text, JToken value, string source)
        {
            if (ParameterTable.Former.ContainsKey(text))
            {
                _former.Add((text, source));
                return;
            }
            ParameterPath? path = ParameterPath.Parse(text);
            if (path == null || ParameterTable.Find(path.Key) == null)
            {
                _unknown ??= (text, source);
                return;
            }
            if (path.Depth == 0)
            {
                _wholes[text] = (value, source);
            }
            else
            {
                _parts.Add((path, value, source));
            }
        }

        /// <summary>To be called when all is taken: only then is it known which keys the run's solver takes.</summary>
        /// <exception cref="ParameterException">There was a key that is not known.</exception>
        public void RefuseUnknown()
        {
            if (_unknown is (string key, string source))
            {
                _wholes.TryGetValue(ParameterTable.SolverKey, out var given);
                ParameterHandler.TrySolver(given.Value, out Solver solver);
                throw new ParameterException(source + ": unknown key '" + key + "': "
                    + KeyHint.Of(key, "", solver, "the command keys lists what is allowed"));
            }
        }

        /// <summary>The value of a key and its source; false if it is not given.</summary>
        public bool TryGet(string key, out (JToken Value, string Source) given) => _wholes.TryGetValue(key, out given);

        /// <summary>Whether a key is given.</summary>
        public bool Has(string key) => _wholes.ContainsKey(key);

        /// <summary>Removes the value of a key.</summary>
        public void Remove(string key) => _wholes.Remove(key);

        /// <summary>The source of the value at a path, or of a part of it; empty if none is given.</summary>
        public string SourceOf(string path)
        {
            for (int k = _parts.Count - 1; k >= 0; k--)
            {
                string part = _parts[k].Path.Text;
                if (ParameterPath.IsWithin(path, part) || ParameterPath.IsWithin(part, path))
                {
                    return _parts[k].Source;
                }
            }
            string key = ParameterPath.Parse(path)?.Key ?? path;
            return _wholes.TryGetValue(key, out (JToken Value, string Source) given) ? given.Source : "";
        }

        /// <summary>That what stands at a path does not go with another key.</summary>
        /// <param name="path">A key, or a part of what one holds.</param>
        /// <param name="needed">What it needs, as a noun phrase.</param>
        /// <param name="nobody">Who is named where nobody said anything of it.</param>
        public ParameterException Refusal(string path, string needed, string nobody)
        {
            string key = ParameterPath.Parse(path)!.Key;
            string? value = !TryGet(key, out (JToken Value, string Source) given) ? null
                : (path == key ? given.Value : given.Value.SelectToken(path.Substring(key.Length)))
                    ?.ToString(Formatting.None);
            string source = SourceOf(path);
            return value != null && value.Length <= LongestValue
                ? new ParameterException(source, path, value, needed)
                : new ParameterException((source.Length > 0 ? source : nobody) + ": " + path + " needs " + needed);
        }

        /// <summary>Replaces parts of values, those that hold others first: a part overrides the value that it is
        /// of, wherever the two stand. A value that nobody gave is the default.</summary>
        /// <param name="defaults">The method's.</param>
        /// <exception cref="ParameterException">A part that is not there, that the method does not take, or whose value
        /// is not allowed.</exception>
        public void ApplyParts(RunParameters defaults)
        {
            // A stable order: of two words on the same part the later counts.
            _parts = _parts.OrderBy(part => part.Path.Depth).ToList();
            var laid = new HashSet<string>();
            foreach ((ParameterPath path, JToken _, string source) in _parts)
            {
                if (laid.Add(path.Key))
                {
                    ApplyParts(ParameterTable.Find(path.Key)!, defaults, source);
                }
            }
        }

        private void ApplyParts(ParameterEntry entry, RunParameters defaults, string source)
        {
            JToken whole = (_wholes.TryGetValue(entry.Key, out (JToken Value, string Source) given) ? given.Value
                : entry.Write(defaults)).DeepClone();
            JToken before = whole.DeepClone();
            foreach ((ParameterPath path, JToken value, string own) in _parts)
            {
                if (path.Key == entry.Key)
                {
                    if (!entry.IsTakenBy(defaults.Simulation.Method.Solver))
                    {
                        throw new ParameterException(own, path.Text, value.ToString(Formatting.None),
                            "solver " + entry.MethodWords);
                    }
                    whole = Replace(path, whole, value, own);
                }
            }
            var scratch = new RunParameters(defaults.Simulation.Method.Solver);
            if (!entry.TryRead(scratch, whole) && entry.TryRead(scratch, before))
            {
                throw Refused(entry, before, scratch);
            }
            _wholes[entry.Key] = (whole, given.Source ?? source);
        }

        // The part that is not allowed by itself, or the last one.
        private ParameterException Refused(ParameterEntry entry, JToken before, RunParameters scratch)
        {
            List<(ParameterPath Path, JToken Value, string Source)> own =
                _parts.FindAll(part => part.Path.Key == entry.Key);
            int wrong = own.FindIndex(part =>
                !entry.TryRead(scratch, part.Path.Replace(before.DeepClone(), part.Value)));
            (ParameterPath path, JToken value, string source) = own[wrong < 0 ? own.Count - 1 : wrong];
            if (path.Field.Length > 0 && entry.Fields.Count > 0 && entry.AllowedOf(path.Field) == null)
            {
                return new ParameterException(source + ": unknown key '" + path.Text + "': allowed are "
                    + string.Join(", ", entry.Fields));
            }
            return new ParameterException(source, path.Text, value.ToString(Formatting.None),
                entry.AllowedOf(path.Field) ?? entry.Allowed);
        }

        private static JToken Replace(ParameterPath path, JToken whole, JToken value, string source)
        {
            try
            {
                return path.Replace(whole, value);
            }
            catch (ParameterException error)
            {
                throw new ParameterException(source + ": " + error.Message);
            }
        }
    }
}
