using System;
using System.Buffers.Binary;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.IO.Compression;
using System.Runtime.InteropServices;
using System.Text;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>One array of a log: the quantity, the catheter's index, its name and type, the shape of one entry, and
    /// its place and length in a row, bytes.</summary>
    internal readonly struct ArrayColumn
    {
        public readonly Quantity Quantity;
        public readonly int Catheter;
        public readonly string Name;
        public readonly string Type;
        public readonly int[] Shape;
        public readonly int Offset;
        public readonly int Length;

        public ArrayColumn(Quantity quantity, int catheter, string name, string type, int[] shape,
            int offset, int length)
        {
            Quantity = quantity;
            Catheter = catheter;
            Name = name;
            Type = type;
            Shape = shape;
            Offset = offset;
            Length = length;
        }
    }

    /// <summary>Writes positions.npz: an array for each quantity, in a zip of .npy files as numpy.load reads it. Their
    /// first index counts entries; the others are sphere or element, and x, y, z.</summary>
    /// <remarks>While the run goes on, one row an entry is appended to a .npy file whose header says 0 rows: how many
    /// there are follows from its length, so what a killed run leaves is readable up to its last whole row. At the end
    /// the columns are put apart, a pass over the rows for each. Memory is that of one row and one block.</remarks>
    internal sealed class ArrayLogger : StateLog
    {
        private const int Block = 1 << 20;            // bytes
        private const double FlushAfter = 1000.0;     // ms of run time
        private const int Aligned = 64;               // bytes; of a .npy header
        private const string Whole = "<i8", Double = "<f8", Single = "<f4";

        private readonly FileStream _rows;
        private readonly RunParameters _parameters;
        private readonly string _realType;
        private readonly Moment _moment = new Moment();
        private readonly List<ArrayColumn> _columns = new List<ArrayColumn>();
        private byte[] _block = Array.Empty<byte>();
        private int _length;
        private int _rowLength;
        private long _headerLength;
        private long _count;
        private double _flushed;

        /// <summary>A log into a file, which it closes.</summary>
        /// <param name="rows">Where to write.</param>
        /// <param name="parameters">What to write of each state.</param>
        public ArrayLogger(FileStream rows, RunParameters parameters)
        {
            _rows = rows;
            _parameters = parameters;
            _realType = parameters.LogFormat == LogFormat.Npz32 ? Single : Double;
        }

        /// <inheritdoc/>
        public override void Log(Simulation simulation, double elapsed)
        {
            int first = _parameters.LogSpheres == LoggedSpheres.Last ? simulation.State.ElementCount : 0;
            _moment.GoTo(simulation, elapsed, first);
            if (_count == 0)
            {
                Begin();
            }
            if (_length + _rowLength > _block.Length)
            {
                Flush();
            }
            foreach (ArrayColumn column in _columns)
            {
                Put(column);
            }
            _count++;
            if (elapsed - _flushed > FlushAfter)
            {
                _flushed = elapsed;
                Flush();
            }
        }

        /// <inheritdoc/>
        public override void Close()
        {
            Flush();
            _rows.Dispose();
            string path = _rows.Name;
            string zip = path + ".zip";
            try
            {
                using (var file = new FileStream(zip, FileMode.Create, FileAccess.Write, FileShare.None))
                {
                    using (var archive = new ZipArchive(file, ZipArchiveMode.Create, true))
                    {
                        WriteColumns(path, archive);
                    }
                    file.Flush(true);
                }
                File.Delete(path);
                File.Move(zip, path);
            }
            catch (Exception error) when (error is IOException || error is UnauthorizedAccessException)
            {
                if (File.Exists(path))
                {
                    File.Delete(zip);
                }
                throw;
            }
        }

        /// <inheritdoc/>
        public override void Dispose() => _rows.Dispose();

        // What a run has at its first entry it has at all.
        private void Begin()
        {
            foreach (Quantity quantity in Quantities.Logged(Quantities.OfWire, _parameters))
            {
                Add(quantity, quantity.Name, 0);
            }
            for (int k = 0; k < _moment.Catheters.Count; k++)
            {
                string prefix = "catheter" + (k == 0 ? "" : (k + 1).ToString(CultureInfo.InvariantCulture));
                foreach (Quantity quantity in Quantities.Logged(Quantities.OfCatheter, _parameters))
                {
                    Add(quantity, prefix + char.ToUpperInvariant(quantity.Name[0]) + quantity.Name.Substring(1), k);
                }
            }
            WriteHeader();
        }

        private void WriteHeader()
        {
            _block = new byte[Math.Max(Block, _rowLength)];
            var fields = new List<string>();
            foreach (ArrayColumn column in _columns)
            {
                fields.Add("('" + column.Name + "', '" + column.Type + "', " + Tuple(column.Shape) + ")");
            }
            byte[] header = Header("[" + string.Join(", ", fields) + "]", "(0,)");
            _rows.Write(header, 0, header.Length);
            _headerLength = header.Length;
        }

        private void Add(Quantity quantity, string name, int catheter)
        {
            _moment.CatheterIndex = catheter;
            int count = quantity.Read(_moment).Length;
            if (count == 0)
            {
                return;
            }
            string type = quantity.Type == QuantityType.Whole ? Whole
                : quantity.Type == QuantityType.Exact ? Double : _realType;
            int width = quantity.Letters.Length;
            int[] shape = quantity.Place != QuantityPlace.Run ? new[] { count / width, width }
                : width > 1 ? new[] { width } : Array.Empty<int>();
            int length = count * (type == Single ? sizeof(float) : sizeof(double));
            _columns.Add(new ArrayColumn(quantity, catheter, name, type, shape, _rowLength, length));
            _rowLength += length;
        }

        private void WriteColumns(string path, ZipArchive archive)
        {
            int rows = Math.Max(1, Block / Math.Max(1, _rowLength));
            var block = new byte[rows * _rowLength];
            var part = new byte[rows * _rowLength];
            using var source = new FileStream(path, FileMode.Open, FileAccess.Read, FileShare.Read, 1);
            foreach (ArrayColumn column in _columns)
            {
                using Stream entry = archive.CreateEntry(column.Name + ".npy", CompressionLevel.NoCompression).Open();
                var shape = new List<string> { _count.ToString(CultureInfo.InvariantCulture) };
                foreach (int size in column.Shape)
                {
                    shape.Add(size.ToString(CultureInfo.InvariantCulture));
                }
                byte[] header = Header("'" + column.Type + "'", "(" + string.Join(", ", shape) + ",)");
                entry.Write(header, 0, header.Length);
                source.Position = _headerLength;
                for (long done = 0; done < _count;)
                {
                    int now = (int)Math.Min(rows, _count - done);
                    Read(source, block, now * _rowLength);
                    for (int k = 0; k < now; k++)
                    {
                        Buffer.BlockCopy(block, k * _rowLength + column.Offset, part, k * column.Length, column.Length);
                    }
                    entry.Write(part, 0, now * column.Length);
                    done += now;
                }
            }
        }

        private static void Read(Stream source, byte[] into, int count)
        {
            int there = 0;
            while (there < count)
            {
                int read = source.Read(into, there, count - there);
                if (read == 0)
                {
                    throw new EndOfStreamException("the log is shorter than what was written to it");
                }
                there += read;
            }
        }

        // Version 1.0 of the format: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
        private static byte[] Header(string description, string shape)
        {
            string text = "{'descr': " + description + ", 'fortran_order': False, 'shape': " + shape + ", }";
            const int before = 10;    // bytes: what the file is, its version, the text's length
            int length = (before + text.Length + 1 + Aligned - 1) / Aligned * Aligned;
            var header = new byte[length];
            header[0] = 0x93;
            Encoding.ASCII.GetBytes("NUMPY", 0, 5, header, 1);
            header[6] = 1;
            BinaryPrimitives.WriteUInt16LittleEndian(header.AsSpan(8), (ushort)(length - before));
            Encoding.ASCII.GetBytes(text.PadRight(length - before - 1) + "\n", 0, length - before, header, before);
            return header;
        }

        private static string Tuple(int[] shape)
        {
            var text = new StringBuilder("(");
            foreach (int size in shape)
            {
                text.Append(size).Append(',');
            }
            return text.Append(')').ToString();
        }

        private void Put(in ArrayColumn column)
        {
            _moment.CatheterIndex = column.Catheter;
            ReadOnlySpan<double> numbers = column.Quantity.Read(_moment);
            if (numbers.Length != 0 && column.Type == Double && BitConverter.IsLittleEndian)
            {
                MemoryMarshal.AsBytes(numbers).CopyTo(_block.AsSpan(_length));
                _length += column.Length;
                return;
            }
            int end = _length + column.Length;
            for (int k = 0; _length < end; k++)
            {
                double number = numbers.Length == 0 ? double.NaN : numbers[k];
                if (column.Type == Single)
                {
                    BinaryPrimitives.WriteInt32LittleEndian(_block.AsSpan(_length),
                        BitConverter.SingleToInt32Bits((float)number));
                    _length += sizeof(float);
                    continue;
                }
                BinaryPrimitives.WriteInt64LittleEndian(_block.AsSpan(_length),
                    column.Type == Whole ? (long)number : BitConverter.DoubleToInt64Bits(number));
                _length += sizeof(long);
            }
        }

        private void Flush()
        {
            _rows.Write(_block, 0, _length);
            _length = 0;
        }
    }
}
