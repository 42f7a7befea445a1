using System;
using System.Collections.Concurrent;
using System.IO;
using System.Threading;

namespace Guidewire.Cli
{
    /// <summary>Reads lines ahead of whoever takes them, so that the end of the input is known at once.</summary>
    internal sealed class LinesAhead : TextReader
    {
        private readonly BlockingCollection<string> _lines = new BlockingCollection<string>();

        /// <summary>Starts to read.</summary>
        /// <param name="input">The lines.</param>
        /// <param name="ended">Called, from another thread, where there are no more.</param>
        public LinesAhead(TextReader input, Action ended)
        {
            var reader = new Thread(() =>
            {
                string? line;
                while ((line = input.ReadLine()) != null)
                {
                    _lines.Add(line);
                }
                ended();
                _lines.CompleteAdding();
            });
            reader.IsBackground = true;
            reader.Start();
        }

        /// <inheritdoc/>
        public override string? ReadLine() => _lines.TryTake(out string? line, Timeout.Infinite) ? line : null;
    }
}
