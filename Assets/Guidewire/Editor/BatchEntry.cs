using System;
using Guidewire.Runtime;
using UnityEditor;

namespace Guidewire.Editor
{
    /// <summary>Batch mode of the editor: <c>-executeMethod Guidewire.Editor.BatchEntry.Run ... -guidewire -parameters
    /// FILE -out DIR</c>. Without play mode, which would reload the domain and lose the run.</summary>
    public static class BatchEntry
    {
        /// <summary>Does one run and ends the editor with its exit code.</summary>
        public static void Run() => EditorApplication.Exit(BatchRun.Execute(Environment.GetCommandLineArgs()));
    }
}
