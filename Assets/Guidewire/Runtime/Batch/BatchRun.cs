using System;
using Guidewire.Io;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>One run without frames, inside Unity. What follows <c>-guidewire</c> on the command line is ours, what
    /// stands before is Unity's.</summary>
    internal static class BatchRun
    {
        /// <summary>The word that ends Unity's arguments.</summary>
        public const string Marker = "-guidewire";

        /// <summary>The arguments behind the marker, or null where there is none.</summary>
        public static string[]? Own(string[] arguments)
        {
            int marker = Array.IndexOf(arguments, Marker);
            return marker < 0 ? null : arguments.AsSpan(marker + 1).ToArray();
        }

        /// <summary>Runs to the end. Never throws: an editor that is left by an exception may not end.</summary>
        /// <param name="commandLine">All arguments of the process.</param>
        /// <returns>The exit code, as the console program's.</returns>
        public static int Execute(string[] commandLine)
        {
            try
            {
                string[] arguments = Own(commandLine) ?? throw new ParameterException("command line: " + Marker
                    + " is missing; it is followed by -parameters FILE, -out DIR and -KEY VALUE");
                var command = new RunCommand(logFileIsOurs: false)
                {
                    Say = line => Debug.Log("guidewire: " + line),
                    Error = line => Debug.LogError("guidewire: " + line),
                };
                return command.Execute(arguments);
            }
            catch (ParameterException error)
            {
                Debug.LogError("guidewire: " + error.Message);
                return ExitCodes.BadInput;
            }
            catch (Exception error)
            {
                Debug.LogError("guidewire: internal error: " + error);
                return ExitCodes.Internal;
            }
        }
    }

    /// <summary>Makes a player with <c>-batchmode ... -guidewire ...</c> do one run and end, before any scene is shown.
    /// </summary>
    internal static class PlayerBatch
    {
        /// <summary>Whether this process was started for a run without frames. Batch mode alone is not enough: the Test
        /// Runner's PlayMode tests run in it too.</summary>
        public static bool IsAsked =>
            Application.isBatchMode && BatchRun.Own(Environment.GetCommandLineArgs()) != null;

        [RuntimeInitializeOnLoadMethod(RuntimeInitializeLoadType.BeforeSceneLoad)]
        private static void RunIfRequested() => Run(Environment.GetCommandLineArgs());

        /// <summary>Does the run that the process's arguments ask for, if they ask for one.</summary>
        internal static void Run(string[] arguments)
        {
            if (!Application.isEditor && Application.isBatchMode && BatchRun.Own(arguments) != null)
            {
                Application.Quit(BatchRun.Execute(arguments));
            }
        }
    }
}
