using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using Guidewire.Core;
using Guidewire.Io;

namespace Guidewire.Runtime
{
    /// <summary>What of a run does not change from step to step: made by the thread that steps, when the run is opened
    /// and after each change.</summary>
    public sealed class RunDescription
    {
        // Keys with a few words each that a wire can be switched between while it goes on.
        private static readonly string[] Switchable = { "solver", "integrator", "sweepOrder", "elementContact" };

        private readonly List<string> _titles = new List<string>();
        private readonly List<string> _choices = new List<string>();
        private readonly List<(string Key, string Label)> _switches = new List<(string Key, string Label)>();
        private readonly List<IReadOnlyList<string>> _names = new List<IReadOnlyList<string>>();

        /// <param name="walls">Their meshes.</param>
        internal RunDescription(SimulationSession session, WallMesh[] walls)
        {
            Walls = walls;
            Parameters = session.Parameters;
            IsSteered = session.IsSteered;
            for (int k = 0; k < session.InstrumentCount; k++)
            {
                _titles.Add(session.TitleOf(k));
                _names.Add(session.ChoicesOf(k));
                _choices.Add(_names[k].Count == 0 ? "" : string.Format(CultureInfo.InvariantCulture,
                    "{0}: {1} (1 of {2})", k == 0 ? "wire" : "catheter", session.TitleOf(k), _names[k].Count));
            }
            Warnings = session.Warnings;
            foreach (string key in Switchable)
            {
                _switches.Add((key, key + ": " + session.Text(key)));
            }
        }

        /// <summary>The effective parameters; nobody writes to them.</summary>
        public SimulationParameters Parameters { get; }

        /// <summary>Whether the hand moves the hubs.</summary>
        public bool IsSteered { get; }

        /// <summary>The walls, for a picture.</summary>
        internal WallMesh[] Walls { get; }

        /// <summary>What is allowed but most likely not meant, one line each.</summary>
        public IReadOnlyList<string> Warnings { get; }

        /// <summary>Overrides with each name that can replace an instrument's, the one after the present name
        /// first.</summary>
        /// <param name="instrument">0 the wire, k catheter k.</param>
        /// <param name="overrides">Those that count now, KEY=VALUE each.</param>
        internal IReadOnlyList<string[]> NextOf(int instrument, string[] overrides)
        {
            IReadOnlyList<string> names = _names[instrument];
            string key = SimulationSession.KeyOf(instrument) + "=";
            string[] others = Array.FindAll(overrides, one => !one.StartsWith(key, StringComparison.Ordinal));
            int first = 0;
            for (int k = 0; k < names.Count; k++)
            {
                first = names[k] == Titles[instrument] ? k + 1 : first;
            }
            var choices = new List<string[]>();
            for (int k = 0; k < names.Count; k++)
            {
                choices.Add(others.Append(key + names[(first + k) % names.Count]).ToArray());
            }
            return choices;
        }

        /// <summary>What each instrument is called, the wire first.</summary>
        public IReadOnlyList<string> Titles => _titles;

        /// <summary>The names for a button that takes the next of its kind; empty where there is none.</summary>
        public IReadOnlyList<string> Choices => _choices;

        /// <summary>Keys that can be switched while the wire goes on, and what each has.</summary>
        public IReadOnlyList<(string Key, string Label)> Switches => _switches;
    }
}
