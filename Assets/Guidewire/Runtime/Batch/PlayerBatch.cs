using System;
using UnityEngine;

namespace Guidewire.Runtime
{
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
