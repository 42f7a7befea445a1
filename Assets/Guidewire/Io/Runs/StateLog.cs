using System;
using System.IO;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Takes a run's states as they come to be.</summary>
    internal abstract class StateLog : IDisposable
    {
        /// <summary>A log into a file, which others are kept from writing to.</summary>
        /// <param name="path">The file; while the run goes on it holds what a killed run leaves.</param>
        /// <param name="parameters">What to write of each state, and how.</param>
        /// <exception cref="IOException">The file cannot be written, or another run writes to it.</exception>
        public static StateLog Open(string path, RunParameters parameters)
        {
            var file = new FileStream(path, FileMode.Create, FileAccess.Write, FileShare.None, 1);
            return parameters.LogFormat == LogFormat.Json ? new DataLogger(file, parameters)
                : (StateLog)new ArrayLogger(file, parameters);
        }

        /// <summary>Gives the name of the log of a complete run.</summary>
        public static string NameOf(LogFormat format) => format == LogFormat.Json ? "positions.json" : "positions.npz";

        /// <summary>Writes one state.</summary>
        /// <param name="simulation">The run after its last step.</param>
        /// <param name="elapsed">Wall time since the run's start in ms.</param>
        /// <exception cref="IOException">The disk is full or gone.</exception>
        public abstract void Log(Simulation simulation, double elapsed);

        /// <summary>Makes the file what a complete run leaves, and everything in it safe on the disk.</summary>
        /// <exception cref="IOException">The disk is full or gone; what was logged stays readable.</exception>
        public abstract void Close();

        /// <summary>Closes the file as it is.</summary>
        public abstract void Dispose();
    }
}
