using System;
using System.Collections.Generic;
using System.Runtime.CompilerServices;
using System.Threading;
using System.Threading.Tasks;
using Guidewire.Core;
using Guidewire.Io;
using Guidewire.Runtime;
using UnityEditor;

namespace Guidewire.Editor
{
    /// <summary>Opens a loop's run as Play would, beside the editor, and keeps what the Inspector and the gizmos show
    /// of it: the problem of its start, or its keys with their values. Nothing is stepped or logged.</summary>
    internal sealed class StartCheck
    {
        private static readonly ConditionalWeakTable<SimulationLoop, StartCheck> Known =
            new ConditionalWeakTable<SimulationLoop, StartCheck>();

        private string _asked = "";
        private Task<Found>? _task;
        private Found _found = new Found();

        /// <summary>What was found of the loop as it was when it was last asked for; empty until then.</summary>
        public Found Last => _found;

        /// <summary>Whether an answer is on its way.</summary>
        public bool IsAtWork => _task != null;

        /// <summary>What is known of a loop; asks again where its fields have changed.</summary>
        public static StartCheck Of(SimulationLoop loop)
        {
            StartCheck check = Known.GetOrCreateValue(loop);
            check.Update(loop);
            return check;
        }

        private void Update(SimulationLoop loop)
        {
            if (_task != null && _task.IsCompleted)
            {
                _found = _task.Result;
                _task = null;
                SceneView.RepaintAll();
            }
            string key = loop.OpeningKey;
            if (_task != null || key == _asked)
            {
                return;
            }
            _asked = key;
            if (!loop.HasParameters)
            {
                _found = new Found
                {
                    Hint = "Choose a Parameter Asset; Assets > Create > Guidewire > Parameters makes one.",
                };
                return;
            }
            RunOpening opening;
            try
            {
                opening = loop.Opening(isLogged: false);
            }
            catch (Exception error) when (error is ArgumentException || error is ParameterException)
            {
                _found = new Found { Problem = error.Message };
                return;
            }
            string[] overrides = loop.Overrides;
            _task = Task.Run(() => Open(opening, overrides));
        }

        private static Found Open(RunOpening opening, string[] overrides)
        {
            try
            {
                using SimulationSession session = opening.Open(new[] { overrides }, null, taken => { }, text => { },
                    CancellationToken.None);
                return new Found(session);
            }
            catch (Exception error)
            {
                bool isExpected = error is ParameterException || error is ArgumentException;
                return new Found { Problem = isExpected ? error.Message : "internal error: " + error };
            }
        }

        /// <summary>What a start is like.</summary>
        internal sealed class Found
        {
            public Found()
            {
            }

            public Found(SimulationSession session)
            {
                Parameters = session.Parameters;
                Target = session.Target;
                Start = new WireState(session);
                Start.CopyFrom(session, false, false);
                for (int k = 0; k < session.InstrumentCount; k++)
                {
                    Instruments.Add((session.NameOf(k), session.ChoicesOf(k)));
                }
                foreach (ParameterGroup group in ParameterTable.Groups)
                {
                    foreach (ParameterEntry entry in group.Entries)
                    {
                        if (entry.IsTakenBy(session.Parameters.Method.Solver))
                        {
                            Keys.Add((group.Name, entry, session.Text(entry.Key)));
                        }
                    }
                }
                Warnings = string.Join("\n", session.Warnings);
            }

            /// <summary>Why Play would stop at once; empty where it would not.</summary>
            public string Problem { get; set; } = "";

            /// <summary>What is still to be done; empty where nothing is.</summary>
            public string Hint { get; set; } = "";

            /// <summary>The wire at its start; null where the run cannot be opened.</summary>
            public WireState? Start { get; }

            /// <summary>What is allowed but most likely not meant.</summary>
            public string Warnings { get; } = "";

            /// <summary>Null where the run cannot be opened.</summary>
            public SimulationParameters? Parameters { get; }

            /// <summary>Where the tip is to come, units, or null.</summary>
            public Vector3d? Target { get; }

            /// <summary>Name of each instrument, the wire first, and those that can replace it.</summary>
            public List<(string Name, IReadOnlyList<string> Choices)> Instruments { get; } =
                new List<(string Name, IReadOnlyList<string> Choices)>();

            /// <summary>The keys that the solver takes, each with its group and its value as text.</summary>
            public List<(string Group, ParameterEntry Entry, string Value)> Keys { get; } =
                new List<(string Group, ParameterEntry Entry, string Value)>();
        }
    }
}
