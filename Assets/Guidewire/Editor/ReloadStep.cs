using Guidewire.Runtime;
using UnityEditor;
using UnityEngine;

namespace Guidewire.Editor
{
    /// <summary>Ends the runs before scripts that were compiled anew are loaded: their logs are whole, and their
    /// threads end with them. The loops open new ones in the next frame.</summary>
    [InitializeOnLoad]
    internal static class ReloadStep
    {
        static ReloadStep()
        {
            AssemblyReloadEvents.beforeAssemblyReload += CloseAll;
        }

        private static void CloseAll()
        {
            foreach (SimulationLoop loop in Resources.FindObjectsOfTypeAll<SimulationLoop>())
            {
                loop.Close();
            }
        }
    }
}
