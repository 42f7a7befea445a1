using System;
using System.Buffers.Binary;
using System.Collections.Generic;
using System.IO;
using System.IO.Compression;
using System.Text;
using Guidewire.Core;

namespace Guidewire.Io
{
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
            RodState state = simulation.State;
            StressRecord? stress = _parameters.LogStrains ? simulation.Stress() : null;
            ContactRecord? contacts = _parameters.LogContacts ? simulation.Contacts : null;
            HubRecord? hub = _parameters.LogHub || _parameters.Sheath != null ? simulation.Hub() : null;
            IReadOnlyList<CoaxialRecord> catheters = simulation.Catheters();
            int first = _parameters.LogSpheres == LoggedSpheres.Last ? state.ElementCount : 0;
            if (_count == 0)
            {
                Begin(state, first, stress != null);
                AddHub(hub);
                for (int k = 0; k < catheters.Count; k++)
                {
                    AddCatheter(catheters[k], "catheter" + (k == 0 ? "" : (k + 1).ToString()),
                        contacts != null);
                }
                AddContacts(state, contacts);
                WriteHeader();
            }
            if (_length + _rowLength > _block.Length)
            {
                Flush();
            }
            Put(simulation.StepCount);
            PutExact(simulation.Time);
            PutExact(elapsed);
            PutExact(simulation.PredictionError);
            Put(first);
            Put(state.Positions, first);
            Put(state.Velocities, first);
            if (_parameters.LogOrientations)
            {
                Put(state.Orientations);
            }
            if (stress != null)
            {
                Put(stress.KineticEnergy);
                Put(stress.ElasticEnergy);
                Put(stress.PotentialEnergy);
                Put(stress.Curvature, 0);
                Put(stress.Couple, 0);
                Put(stress.Strain, 0);
                Put(stress.Force, 0);
                Put(state.AngularVelocities, 0);
            }
            Put(hub);
            foreach (CoaxialRecord catheter in catheters)
            {
                Put(catheter, contacts != null);
            }
            if (contacts != null)
            {
                Put(contacts.Forces, 0);
                Put(contacts.Total);
                Put(contacts.Reaction);
                Put(contacts.WallForces, 0);
                Put(contacts.ElementForces, 0);
                if (contacts.ElementForces.Length > 0)
                {
                    Put(contacts.Pressure);
                    Put(contacts.MeanTotal);
                    Put(contacts.ReactionAtEnd);
                }
                Put(contacts.Displacements, 0);
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

        private void Begin(RodState state, int first, bool hasStress)
        {
            int spheres = state.SphereCount;
            int elements = state.ElementCount;
            Add("step", Whole);
            Add("totalTime", Double);
            Add("elapsedMilliseconds", Double);
            Add("delta", Double);
            Add("firstSphere", Whole);
            Add("positions", _realType, spheres - first, 3);
            Add("velocities", _realType, spheres - first, 3);
            if (_parameters.LogOrientations)
            {
                Add("orientations", _realType, elements, 4);
            }
            if (hasStress)
            {
                Add("kineticEnergy", _realType);
                Add("elasticEnergy", _realType);
                Add("potentialEnergy", _realType);
                Add("curvature", _realType, elements + 1, 3);
                Add("couple", _realType, elements + 1, 3);
                Add("strain", _realType, elements, 3);
                Add("force", _realType, elements, 3);
                Add("angularVelocity", _realType, elements, 3);
            }
        }

        private void AddHub(HubRecord? hub)
        {
            if (_parameters.Sheath != null)
            {
                Add("inBody", Whole);
            }
            if (hub == null || !_parameters.LogHub)
            {
                return;
            }
            Add("hubInsertion", _realType);
            Add("hubTurn", _realType);
            Add("hubForce", _realType);
            Add("hubTorque", _realType);
            Add("tipDirection", _realType, 3);
            Add("twist", _realType);
            Add("largestCurvature", _realType);
            if (hub.LengthInBody != null)
            {
                Add("lengthInBody", _realType);
            }
        }

        private void AddCatheter(CoaxialRecord catheter, string name, bool hasContacts)
        {
            Add(name + "Positions", _realType, catheter.Positions.Length, 3);
            if (_parameters.LogOrientations)
            {
                Add(name + "Orientations", _realType, catheter.Orientations.Length, 4);
            }
            Add(name + "Extension", _realType);
            if (_parameters.LogHub)
            {
                Add(name + "Insertion", _realType);
                Add(name + "Turn", _realType);
                Add(name + "Force", _realType);
                Add(name + "Torque", _realType);
            }
            if (hasContacts)
            {
                Add(name + "ContactForces", _realType, catheter.ContactForces.Length, 3);
            }
            if (hasContacts && catheter.WallDisplacements.Length > 0)
            {
                Add(name + "WallDisplacements", _realType, catheter.WallDisplacements.Length, 3);
            }
        }

        private void AddContacts(RodState state, ContactRecord? contacts)
        {
            if (contacts == null)
            {
                return;
            }
            Add("contactForces", _realType, state.SphereCount, 3);
            Add("contactTotal", _realType, 3);
            Add("reaction", _realType, 3);
            if (contacts.WallForces.Length > 0)
            {
                Add("wallForces", _realType, contacts.WallForces.Length, 3);
            }
            if (contacts.ElementForces.Length > 0)
            {
                Add("elementForces", _realType, contacts.ElementForces.Length, 3);
                Add("wallPressure", _realType);
                Add("contactTotalMean", _realType, 3);
                Add("reactionAtEnd", _realType, 3);
            }
            if (contacts.Displacements.Length > 0)
            {
                Add("wallDisplacements", _realType, contacts.Displacements.Length, 3);
            }
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

        private void Add(string name, string type, params int[] shape)
        {
            int length = type == Single ? sizeof(float) : sizeof(double);
            foreach (int size in shape)
            {
                length *= size;
            }
            _columns.Add(new ArrayColumn
                { Name = name, Type = type, Shape = shape, Offset = _rowLength, Length = length });
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
                var shape = new List<string> { _count.ToString(System.Globalization.CultureInfo.InvariantCulture) };
                foreach (int size in column.Shape)
                {
                    shape.Add(size.ToString(System.Globalization.CultureInfo.InvariantCulture));
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

        private void Put(HubRecord? hub)
        {
            if (_parameters.Sheath != null)
            {
                Put(hub?.SpheresInBody ?? 0);
            }
            if (hub == null || !_parameters.LogHub)
            {
                return;
            }
            Put(hub.Insertion);
            Put(hub.Turn);
            Put(hub.Force);
            Put(hub.Torque);
            Put(hub.TipDirection);
            Put(hub.Twist);
            Put(hub.LargestCurvature);
            if (hub.LengthInBody is double length)
            {
                Put(length);
            }
        }

        private void Put(CoaxialRecord catheter, bool hasContacts)
        {
            Put(catheter.Positions, 0);
            if (_parameters.LogOrientations)
            {
                Put(catheter.Orientations);
            }
            Put(catheter.Extension);
            if (_parameters.LogHub)
            {
                Put(catheter.Insertion);
                Put(catheter.Turn);
                Put(catheter.Force);
                Put(catheter.Torque);
            }
            if (hasContacts)
            {
                Put(catheter.ContactForces, 0);
                Put(catheter.WallDisplacements, 0);
            }
        }

        private void Put(Quaterniond[] orientations)
        {
            foreach (Quaterniond q in orientations)
            {
                Put(q.X);
                Put(q.Y);
                Put(q.Z);
                Put(q.W);
            }
        }

        private void Put(Vector3d[] values, int first)
        {
            for (int i = first; i < values.Length; i++)
            {
                Put(values[i]);
            }
        }

        private void Put(in Vector3d value)
        {
            Put(value.X);
            Put(value.Y);
            Put(value.Z);
        }

        private void Put(double value)
        {
            if (_realType == Double)
            {
                PutExact(value);
                return;
            }
            int bits = BitConverter.SingleToInt32Bits((float)value);
            BinaryPrimitives.WriteInt32LittleEndian(_block.AsSpan(_length), bits);
            _length += sizeof(float);
        }

        private void Put(int value) => PutBits(value);
        private void PutExact(double value) => PutBits(BitConverter.DoubleToInt64Bits(value));

        private void PutBits(long value)
        {
            BinaryPrimitives.WriteInt64LittleEndian(_block.AsSpan(_length), value);
            _length += sizeof(long);
        }

        private void Flush()
        {
            _rows.Write(_block, 0, _length);
            _length = 0;
        }
    }
}
