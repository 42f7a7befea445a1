using System;
using System.Collections.Generic;
using System.IO;
using System.Threading;
using Guidewire.Core;
using Guidewire.Io;

namespace Guidewire.Runtime
{
    /// <summary>All that is needed to open a run, taken from the scene: opening itself needs nothing of Unity, and may
    /// be done by any thread.</summary>
    internal sealed class RunOpening
    {
        private readonly string _name;
        private readonly string? _text;            // of a parameter file; null: it is read
        private readonly Dictionary<string, byte[]> _files;
        private readonly VesselMesh[] _vessels;
        private readonly string _logFolder;
        private readonly bool _isSteered;

        /// <param name="name">The parameter file, or what its text is called.</param>
        /// <param name="text">Its text; null: the file is read.</param>
        /// <param name="files">What it names that is not read from disk.</param>
        /// <param name="vessels">Meshes of the scene.</param>
        /// <param name="logFolder">Folder of the results, or empty.</param>
        /// <param name="isSteered">Whether the hand moves the hubs.</param>
        public RunOpening(string name, string? text, Dictionary<string, byte[]> files, VesselMesh[] vessels,
            string logFolder, bool isSteered)
        {
            _name = name;
            _text = text;
            _files = files;
            _vessels = vessels;
            _logFolder = logFolder;
            _isSteered = isSteered;
        }

        /// <summary>Opens the run with the first of some sets of overrides with which it can be.</summary>
        /// <param name="choices">KEY=VALUE each; at least one set.</param>
        /// <param name="before">What writes to the same log until it has ended, or null.</param>
        /// <param name="taken">Told which set it was.</param>
        public SimulationSession Open(IReadOnlyList<string[]> choices, WireRun? before, Action<string[]> taken,
            Action<string> report, CancellationToken cancellation)
        {
            if (_logFolder.Length > 0)
            {
                before?.WaitForEnd();
            }
            var walls = new ContactShape[_vessels.Length];
            for (int k = 0; k < walls.Length; k++)
            {
                report("opening: mesh of " + _vessels[k].Name + " (" + (k + 1) + " of " + walls.Length + ")");
                walls[k] = _vessels[k].Build();
                cancellation.ThrowIfCancellationRequested();
            }
            report("opening: " + Path.GetFileName(_name));
            for (int k = 0; ; k++)
            {
                try
                {
                    ParameterSource source = _text == null ? ParameterSource.OfFile(_name, new LastMesh())
                        : ParameterSource.OfText(_name, _text);
                    SimulationSession session = SimulationSession.Open(source.With(walls, _files), choices[k],
                        _logFolder, _isSteered, limitsHubs: true, cancellation);
                    taken(choices[k]);
                    return session;
                }
                catch (Exception error) when (k + 1 < choices.Count
                    && (error is ParameterException || error is ArgumentException))
                {
                    cancellation.ThrowIfCancellationRequested();
                }
            }
        }
    }
}
