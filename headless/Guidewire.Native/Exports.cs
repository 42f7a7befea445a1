using System;
using System.Collections.Concurrent;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using System.Text;
using System.Threading;
using Guidewire.Cli;
using Guidewire.Io;

namespace Guidewire.Native
{
    /// <summary>Sessions for programs that load this library: the runner's requests, and steps and states without
    /// text. Each session has a number; several may be asked at once, by a thread each.</summary>
    internal static unsafe class Exports
    {
        private static readonly ConcurrentDictionary<long, NativeSession> Sessions =
            new ConcurrentDictionary<long, NativeSession>();

        private static readonly KeptMeshes Meshes = new KeptMeshes(SessionHost.MeshesKept);

        private static long _last;

        /// <summary>A session, which "open" then opens; returns its number.</summary>
        [UnmanagedCallersOnly(EntryPoint = "guidewire_new")]
        public static long New()
        {
            long number = Interlocked.Increment(ref _last);
            Sessions[number] = new NativeSession(Meshes);
            return number;
        }

        /// <summary>Answers a request of docs/runs.md, JSON in UTF-8.</summary>
        /// <param name="number">The session's.</param>
        /// <param name="request">The request.</param>
        /// <param name="length">Its length in bytes; 0 asks why the last call was refused.</param>
        /// <param name="answerLength">Takes the length of the answer in bytes.</param>
        /// <returns>The answer, JSON in UTF-8; <see cref="Free"/> gives it back.</returns>
        [UnmanagedCallersOnly(EntryPoint = "guidewire_ask")]
        public static byte* Ask(long number, byte* request, int length, int* answerLength)
        {
            string answer = !Sessions.TryGetValue(number, out NativeSession? session) ? NativeSession.Closed
                : length == 0 ? session.Problem : session.Ask(Encoding.UTF8.GetString(request, length));
            byte[] bytes = Encoding.UTF8.GetBytes(answer);
            byte* copy = (byte*)NativeMemory.Alloc((nuint)bytes.Length);
            Marshal.Copy(bytes, 0, (IntPtr)copy, bytes.Length);
            *answerLength = bytes.Length;
            return copy;
        }

        /// <summary>Makes steps.</summary>
        /// <param name="motion">Push (units) and turn (rad) of each hub in each of them, the wire's first.</param>
        /// <param name="hubs">How many hubs these are; others rest.</param>
        /// <param name="head">Takes four numbers: steps done since the start, time (s), 0 or 1 where the run has ended,
        /// prediction error (units).</param>
        /// <returns>1, or 0 where the steps were refused or failed.</returns>
        [UnmanagedCallersOnly(EntryPoint = "guidewire_step")]
        public static int Step(long number, double* motion, int hubs, int steps, double* head)
        {
            return Sessions.TryGetValue(number, out NativeSession? session)
                && session.Step(new ReadOnlySpan<double>(motion, 2 * hubs), steps, new Span<double>(head, 4)) ? 1 : 0;
        }

        /// <summary>Reads a part of the state off.</summary>
        /// <param name="part">Which, a number of <see cref="StatePart"/>.</param>
        /// <param name="numbers">Takes the arrays of an answer that belong to it, in their order.</param>
        /// <param name="capacity">How many numbers fit there; where they do not fit, none is written.</param>
        /// <returns>How many numbers the part has; -1 where it cannot be read.</returns>
        [UnmanagedCallersOnly(EntryPoint = "guidewire_state")]
        public static int State(long number, int part, double* numbers, int capacity)
        {
            return Sessions.TryGetValue(number, out NativeSession? session)
                ? session.Read((StatePart)part, new Span<double>(numbers, capacity)) : -1;
        }

        /// <summary>Takes a fluoroscopic picture.</summary>
        /// <param name="number">The session's.</param>
        /// <param name="view">Which, as "view" of a request: JSON in UTF-8.</param>
        /// <param name="length">Its length in bytes.</param>
        /// <param name="positions">x, y and z of each node of the wire and then of each catheter, units.</param>
        /// <param name="count">How many numbers these are; 0: as they are now.</param>
        /// <param name="grey">Takes the grey levels, row by row.</param>
        /// <param name="capacity">How many fit there.</param>
        /// <returns>How many the picture has; they are not written where the capacity is another. 0 where it was
        /// refused.</returns>
        [UnmanagedCallersOnly(EntryPoint = "guidewire_picture")]
        public static int Picture(long number, byte* view, int length, double* positions, int count, byte* grey,
            int capacity)
        {
            return Sessions.TryGetValue(number, out NativeSession? session)
                ? session.Picture(new ReadOnlySpan<byte>(view, length), new ReadOnlySpan<double>(positions, count),
                    new Span<byte>(grey, capacity)) : 0;
        }

        /// <summary>Forgets a session, with the last one the meshes.</summary>
        [UnmanagedCallersOnly(EntryPoint = "guidewire_close")]
        public static void Close(long number)
        {
            Sessions.TryRemove(number, out _);
            if (Sessions.IsEmpty)
            {
                Meshes.Clear();
            }
        }

        /// <summary>Does what the console program does with these arguments; returns its exit code.</summary>
        /// <param name="count">How many there are.</param>
        /// <param name="arguments">Each in UTF-8, with a zero at its end.</param>
        [UnmanagedCallersOnly(EntryPoint = "guidewire_main")]
        public static int Run(int count, byte** arguments)
        {
            var texts = new string[count];
            for (int k = 0; k < count; k++)
            {
                texts[k] = Marshal.PtrToStringUTF8((IntPtr)arguments[k]) ?? "";
            }
            return Program.Main(texts);
        }

        /// <summary>Says where the program stands, above which the folder of instruments is looked for; without it that
        /// is the folder of the process's own program.</summary>
        /// <param name="folder">UTF-8, with a zero at its end.</param>
        [UnmanagedCallersOnly(EntryPoint = "guidewire_folder")]
        public static void SetFolder(byte* folder) =>
            AppContext.SetData(InstrumentLibrary.ProgramFolder, Marshal.PtrToStringUTF8((IntPtr)folder));

        /// <summary>Gives an answer's memory back.</summary>
        [UnmanagedCallersOnly(EntryPoint = "guidewire_free")]
        public static void Free(byte* answer) => NativeMemory.Free(answer);

        /// <summary>How many numbers this build computes with at once: 4, or 1 where it has no vector paths.</summary>
        [UnmanagedCallersOnly(EntryPoint = "guidewire_lanes")]
        public static int CountLanes() => Vector256.IsHardwareAccelerated ? Vector256<double>.Count : 1;
    }
}
