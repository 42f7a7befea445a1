using System;
using System.IO;
using System.Runtime.InteropServices.JavaScript;
using System.Runtime.Versioning;
using Guidewire.Cli;
using Guidewire.Io;
using Guidewire.Native;

namespace Guidewire.Browser
{
    /// <summary>One session for a page's worker: the runner's requests, and steps, states and walls without
    /// text.</summary>
    [SupportedOSPlatform("browser")]
    internal static partial class Exports
    {
        private const int Head = 4;
        private static readonly NativeSession Session = new NativeSession(new KeptMeshes(1));
        private static double[] _numbers = new double[1024];

        /// <summary>Says where the program stands: the folder of instruments is below it.</summary>
        internal static void Main(string[] arguments)
        {
            AppContext.SetData(InstrumentLibrary.ProgramFolder, arguments[0]);
        }

        /// <summary>Answers a request of docs/runs.md; an empty one asks why the last call was refused.</summary>
        [JSExport]
        internal static string Ask(string request)
        {
            return request.Length == 0 ? Session.Problem : Session.Ask(request);
        }

        /// <summary>Makes steps, and gives the state: steps done since the start, time (s), 0 or 1 where the run has
        /// ended, prediction error (units), and the arrays of an answer in their order.</summary>
        /// <param name="motion">Push (units) and turn (rad) in each step of each hub, the wire's first.</param>
        /// <returns>False where the steps were refused or failed.</returns>
        [JSExport]
        internal static bool Step(double[] motion, int steps)
        {
            if (!Session.Step(motion, steps, _numbers.AsSpan(0, Head)))
            {
                return false;
            }
            int count = Head;
            for (StatePart part = StatePart.Motion; part <= StatePart.Strains; part++)
            {
                int size = Session.Read(part, _numbers.AsSpan(count));
                if (size > _numbers.Length - count)
                {
                    Array.Resize(ref _numbers, 2 * (count + size));
                    size = Session.Read(part, _numbers.AsSpan(count));
                }
                count += size;
            }
            Give(_numbers.AsSpan(0, count));
            return true;
        }

        /// <summary>The walls of the open scene, as <see cref="SessionWalls"/> has them.</summary>
        [JSExport]
        internal static byte[] Walls()
        {
            return Session.Walls();
        }

        /// <summary>Writes a file of the page's into the memory that stands for a disk here.</summary>
        [JSExport]
        internal static void Write(string path, byte[] content)
        {
            Directory.CreateDirectory(Path.GetDirectoryName(path)!);
            File.WriteAllBytes(path, content);
        }

        [JSImport("give", "worker")]
        private static partial void Give([JSMarshalAs<JSType.MemoryView>] Span<double> numbers);
    }
}
