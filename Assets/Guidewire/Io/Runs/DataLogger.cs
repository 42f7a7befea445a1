using System;
using System.Collections.Generic;
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

    /// <summary>Writes positions.json (thesis 3.2.3) as the run goes, one entry a line, in constant memory: <c>{"0":
    /// {"totalTime": s, "elapsedMilliseconds": ms, "delta": units, "sphere": {"0": {"x","y","z","vx","vy","vz"}, ...}},
    /// "1": ...}</c>, and what else <see cref="Quantities"/> has with the keys of the run.</summary>
    /// <remarks>Entry "k" is the state after k steps. Until <see cref="Close"/> the file is not whole JSON, but every
    /// line that ends is a whole entry. Numbers are round-trip exact; one that is not finite is null.</remarks>
    internal sealed class DataLogger : StateLog
    {
        private const int Buffer = 1 << 16;
        private const double FlushAfter = 1000.0;     // ms of run time

        private readonly Stream _stream;
        private readonly RunParameters _parameters;
        private byte[] _bytes = new byte[Buffer];
        private int _length;
        private readonly Moment _moment = new Moment();
        private readonly List<Quantity> _ofWire;
        private readonly List<Quantity> _ofCatheter;
        private bool _empty = true;
        private bool _isFirst;     // no member stands in the object that is open
        private string? _opens;    // the object that is to be opened by its first member
        private double _flushed;

        /// <summary>A log into a stream, which it closes.</summary>
        /// <param name="stream">Where to write.</param>
        /// <param name="parameters">What to write of each state.</param>
        public DataLogger(Stream stream, RunParameters parameters)
        {
            _stream = stream;
            _parameters = parameters;
            _ofWire = Quantities.Logged(Quantities.OfWire, parameters).FindAll(row => row.Key != null);
            _ofCatheter = Quantities.Logged(Quantities.OfCatheter, parameters).FindAll(row => row.Key != null);
            Append("{\n");
        }

        /// <inheritdoc/>
        public override void Log(Simulation simulation, double elapsed)
        {
            int first = _parameters.LogSpheres == LoggedSpheres.Last ? simulation.State.ElementCount : 0;
            _moment.GoTo(simulation, elapsed, first);
            Append(_empty ? "\"" : ",\n\"");
            _empty = false;
            Append(simulation.StepCount);
            Append("\": {");
            _isFirst = true;
            AppendTable(_ofWire);
            for (int k = 0; k < _moment.Catheters.Count; k++)
            {
                _moment.CatheterIndex = k;
                Append(k == 0 ? ", \"catheters\": [{" : "}, {");
                _isFirst = true;
                AppendMembers(_ofCatheter, 0, _ofCatheter.Count);
            }
            Append(_moment.Catheters.Count > 0 ? "}]}" : "}");
            if (elapsed - _flushed > FlushAfter)
            {
                _flushed = elapsed;
                Flush();
            }
        }

        /// <inheritdoc/>
        public override void Close()
        {
            Append("\n}\n");
            Flush();
            if (_stream is FileStream file)
            {
                file.Flush(true);
            }
            _stream.Dispose();
        }

        /// <inheritdoc/>
        public override void Dispose() => _stream.Dispose();

        // Rows of one group stand side by side, and so do rows of one key.
        private void AppendTable(List<Quantity> table)
        {
            for (int from = 0, to; from < table.Count; from = to)
            {
                string group = table[from].Group;
                for (to = from + 1; to < table.Count && table[to].Group == group; to++)
                {
                }
                if (group.Length == 0)
                {
                    AppendMembers(table, from, to);
                    continue;
                }
                _opens = group;
                _isFirst = true;
                AppendMembers(table, from, to);
                Append(_opens == null ? "}" : "");
                _opens = null;
                _isFirst = false;
            }
        }

        private void AppendMembers(List<Quantity> table, int from, int end)
        {
            for (int to; from < end; from = to)
            {
                string key = table[from].Key!;
                for (to = from + 1; to < end && table[to].Key == key; to++)
                {
                }
                AppendMember(table, from, to);
            }
        }

        private void AppendMember(List<Quantity> table, int from, int to)
        {
            Quantity quantity = table[from];
            ReadOnlySpan<double> numbers = quantity.Read(_moment);
            if (numbers.Length == 0)
            {
                return;
            }
            AppendKey(quantity.Key!);
            int width = quantity.Letters.Length;
            switch (quantity.Form)
            {
                case QuantityForm.Value when width == 1 && quantity.Type == QuantityType.Whole:
                    Append((int)numbers[0]);
                    break;
                case QuantityForm.Value when width == 1:
                    Append(numbers[0]);
                    break;
                case QuantityForm.Value:
                    AppendObject(quantity, numbers, true);
                    Append("}");
                    break;
                case QuantityForm.Rows:
                    for (int i = 0; i < numbers.Length; i++)
                    {
                        Append(i == 0 ? "[[" : i % width == 0 ? "], [" : ", ");
                        Append(numbers[i]);
                    }
                    Append("]]");
                    break;
                default:
                    AppendRows(table, from, to, numbers);
                    break;
            }
        }

        // The rows of quantities that share a key are one object each.
        private void AppendRows(List<Quantity> table, int from, int to, ReadOnlySpan<double> numbers)
        {
            int width = table[from].Letters.Length;
            int shift = table[from].Place == QuantityPlace.Node && table[from].Form == QuantityForm.ByIndex
                ? _moment.FirstSphere : 0;
            bool isFirst = true;
            Append("{");
            for (int i = 0; i < numbers.Length / width; i++)
            {
                ReadOnlySpan<double> row = numbers.Slice(i * width, width);
                if (table[from].Form == QuantityForm.Nonzero && row[0] == 0.0 && row[1] == 0.0 && row[2] == 0.0)
                {
                    continue;
                }
                Append(isFirst ? "\"" : ", \"");
                Append(shift + i);
                Append("\": ");
                isFirst = false;
                AppendObject(table[from], row, true);
                for (int k = from + 1; k < to; k++)
                {
                    int own = table[k].Letters.Length;
                    AppendObject(table[k], table[k].Read(_moment).Slice(i * own, own), false);
                }
                Append("}");
            }
            Append("}");
        }

        private void AppendObject(Quantity quantity, ReadOnlySpan<double> row, bool begins)
        {
            for (int k = 0; k < row.Length; k++)
            {
                Append(begins && k == 0 ? "{\"" : ", \"");
                Append(quantity.Letters[k]);
                Append("\": ");
                Append(row[k]);
            }
        }

        private void AppendKey(string key)
        {
            if (_opens != null)
            {
                Append(", \"");
                Append(_opens);
                Append("\": {");
                _opens = null;
            }
            Append(_isFirst ? "\"" : ", \"");
            Append(key);
            Append("\": ");
            _isFirst = false;
        }

        private void Append(string ascii)
        {
            Reserve(ascii.Length);
            for (int i = 0; i < ascii.Length; i++)
            {
                _bytes[_length + i] = (byte)ascii[i];
            }
            _length += ascii.Length;
        }

        private void Append(int value)
        {
            Reserve(16);
            System.Buffers.Text.Utf8Formatter.TryFormat(value, _bytes.AsSpan(_length), out int written);
            _length += written;
        }

        private void Append(double value)
        {
            if (double.IsNaN(value) || double.IsInfinity(value))
            {
                Append("null");
                return;
            }
            Reserve(NumberText.Longest);
            _length += NumberText.Write(value, _bytes, _length);
        }

        private void Reserve(int count)
        {
            if (_length + count > _bytes.Length)
            {
                Flush();
            }
        }

        private void Flush()
        {
            _stream.Write(_bytes, 0, _length);
            _length = 0;
        }
    }
}
