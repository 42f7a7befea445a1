using System;
using System.Globalization;
using System.Text.RegularExpressions;

namespace Guidewire.Core
{
    /// <summary>A kind of warning: its line, what that means, and whether the result of a run with it can be
    /// trusted.</summary>
    public sealed class WarningKind
    {
        // "*name*" or "*name:format*"
        private static readonly Regex Placeholder = new Regex(@"\*(?<name>[^:*]+)(:(?<format>[^*]+))?\*");

        private readonly string _line;

        /// <param name="name">Unique, in one word.</param>
        /// <param name="line">With placeholders: *name*, or *name:format* with a .NET format.</param>
        /// <param name="meaning">Markdown.</param>
        internal WarningKind(string name, WarningPlace place, bool isReliable, string line, string meaning)
        {
            Name = name;
            Place = place;
            IsReliable = isReliable;
            _line = line;
            Meaning = meaning;
        }

        /// <summary>Its name, in one word.</summary>
        public string Name { get; }

        /// <summary>Where it is told.</summary>
        public WarningPlace Place { get; }

        /// <summary>Whether the result of a run with this warning can be trusted.</summary>
        public bool IsReliable { get; }

        /// <summary>What it means, in Markdown.</summary>
        public string Meaning { get; }

        /// <summary>The line with names in place of its values, such as *k*.</summary>
        public string Line => Placeholder.Replace(_line, "*${name}*");

        /// <summary>Gives the line of one run.</summary>
        /// <param name="values">One for each placeholder, in order.</param>
        /// <exception cref="ArgumentException">There are more or fewer.</exception>
        public string Text(params object[] values)
        {
            int next = 0;
            string text = Placeholder.Replace(_line, match =>
            {
                object value = next < values.Length ? values[next] : throw Miscounted(values);
                next++;
                string format = match.Groups["format"].Value;
                return value is IFormattable number
                    ? number.ToString(format.Length == 0 ? null : format, CultureInfo.InvariantCulture)
                    : value.ToString()!;
            });
            return next == values.Length ? text : throw Miscounted(values);
        }

        internal RunWarning With(params object[] values) => new RunWarning(this, Text(values));

        private ArgumentException Miscounted(object[] values) =>
            new ArgumentException(Name + " does not have " + values.Length + " values");
    }

    /// <summary>Where a warning is told.</summary>
    public enum WarningPlace
    {
        /// <summary>Before the first step: it is about the parameters.</summary>
        Start,

        /// <summary>After the reason of a completed run, with ", but".</summary>
        Reason,

        /// <summary>The warning stands at the end of the run, on a line of its own.</summary>
        End,
    }

    /// <summary>A warning of one run.</summary>
    internal readonly struct RunWarning
    {
        /// <param name="text">Its line.</param>
        public RunWarning(WarningKind kind, string text)
        {
            Kind = kind;
            Text = text;
        }

        /// <summary>What it warns of.</summary>
        public WarningKind Kind { get; }

        /// <summary>The warning's line.</summary>
        public string Text { get; }

        /// <inheritdoc/>
        public override string ToString() => Text;
    }

    /// <summary>When a hub that moved less than it was asked makes a run unreliable.</summary>
    internal static class Shortfall
    {
        private const double OfAsked = 1e-3;
        private const double OfLength = 1e-6;    // of the wire: the give of a hub that rests

        /// <summary>Whether a shortfall counts; all in one unit of length.</summary>
        /// <param name="shortfall">What is missing; negative where the hub went farther than asked.</param>
        /// <param name="asked">The motion that was asked, there and back both counted.</param>
        /// <param name="length">Of the wire.</param>
        public static bool Counts(double shortfall, double asked, double length) =>
            Math.Abs(shortfall) > Math.Max(OfAsked * asked, OfLength * length);
    }
}
