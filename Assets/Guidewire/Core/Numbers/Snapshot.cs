using System;
using System.Buffers.Binary;
using System.Runtime.InteropServices;

namespace Guidewire.Core
{
    /// <summary>All that a run depends on at one time, as bits: a run that goes on from it takes the same steps, bit
    /// for bit, as one that was not interrupted.</summary>
    /// <remarks>What belongs together is listed once, in a method that takes a snapshot and passes it each number by
    /// reference, or takes each property back from it: the same list writes a snapshot and reads one, so the two cannot
    /// differ. A step that is repeated and a run that is saved have one list too, which asks <see cref="IsStep"/> where
    /// one of them needs more. Every number takes 64 bits.</remarks>
    internal sealed class Snapshot
    {
        private long[] _bits = new long[256];
        private int _count;
        private int _at;
        private int _sectionEnd;

        /// <summary>Makes an empty one.</summary>
        /// <param name="isStep">See <see cref="IsStep"/>.</param>
        public Snapshot(bool isStep = false)
        {
            IsStep = isStep;
        }

        /// <summary>Whether it is of the start of a step, for the same objects: all that the step may touch. Else it is
        /// of a run, for objects that are made anew and may be those of other parameters.</summary>
        public bool IsStep { get; }

        /// <summary>Whether numbers are written; else they are taken over.</summary>
        public bool IsWritten { get; private set; } = true;

        /// <summary>What has been written, to be read from its start.</summary>
        public Snapshot ToRead() => new Snapshot(IsStep) { _bits = _bits, _count = _count, IsWritten = false };

        /// <summary>What comes next is written from the start on, in the memory that is there.</summary>
        public void RewindForWriting()
        {
            _count = 0;
            IsWritten = true;
        }

        /// <summary>What has been written is read, from its start.</summary>
        public void RewindForReading()
        {
            _at = 0;
            IsWritten = false;
        }

        /// <summary>What has been written, eight bytes a number, the lowest first on every machine.</summary>
        public byte[] ToBytes()
        {
            var bytes = new byte[sizeof(long) * _count];
            for (int i = 0; i < _count; i++)
            {
                BinaryPrimitives.WriteInt64LittleEndian(bytes.AsSpan(sizeof(long) * i), _bits[i]);
            }
            return bytes;
        }

        /// <summary>A snapshot to be read, of bytes that another one was made into.</summary>
        public static Snapshot OfBytes(byte[] bytes)
        {
            var bits = new long[bytes.Length / sizeof(long)];
            for (int i = 0; i < bits.Length; i++)
            {
                bits[i] = BinaryPrimitives.ReadInt64LittleEndian(bytes.AsSpan(sizeof(long) * i));
            }
            return new Snapshot { _bits = bits, _count = bits.Length, IsWritten = false };
        }

        /// <summary>Makes room for some times what has been written.</summary>
        public void Reserve(double times) =>
            Array.Resize(ref _bits, Math.Max(_bits.Length, (int)Math.Ceiling(times * _count)));

        /// <summary>Writes or reads a count.</summary>
        public void Serialize(ref long value)
        {
            if (IsWritten && _count < _bits.Length)
            {
                _bits[_count++] = value;
                return;
            }
            ref long bits = ref Next(1)[0];
            if (IsWritten)
            {
                bits = value;
            }
            value = bits;
        }

        /// <summary>Writes or reads a number.</summary>
        public void Serialize(ref double value)
        {
            long bits = BitConverter.DoubleToInt64Bits(value);
            Serialize(ref bits);
            value = BitConverter.Int64BitsToDouble(bits);
        }

        /// <summary>Writes or reads a whole number.</summary>
        public void Serialize(ref int value)
        {
            long wide = value;
            Serialize(ref wide);
            value = (int)wide;
        }

        /// <summary>Writes or reads yes or no.</summary>
        public void Serialize(ref bool value)
        {
            long wide = value ? 1 : 0;
            Serialize(ref wide);
            value = wide != 0;
        }

        /// <summary>Writes or reads a vector.</summary>
        public void Serialize(ref Vector3d value)
        {
            double x = value.X;
            double y = value.Y;
            double z = value.Z;
            Serialize(ref x);
            Serialize(ref y);
            Serialize(ref z);
            value = new Vector3d(x, y, z);
        }

        /// <summary>Writes or reads an orientation.</summary>
        public void Serialize(ref Quaterniond value)
        {
            double x = value.X;
            double y = value.Y;
            double z = value.Z;
            double w = value.W;
            Serialize(ref x);
            Serialize(ref y);
            Serialize(ref z);
            Serialize(ref w);
            value = new Quaterniond(x, y, z, w);
        }

        /// <summary>Writes or reads a text.</summary>
        public void Serialize(ref string value)
        {
            int length = value.Length;
            Serialize(ref length);
            char[] characters = IsWritten ? value.ToCharArray() : new char[length];
            for (int i = 0; i < length; i++)
            {
                int character = characters[i];
                Serialize(ref character);
                characters[i] = (char)character;
            }
            value = new string(characters);
        }

        /// <summary>A count that is a property: writes it, or returns what it is to be.</summary>
        public long Serialize(long value)
        {
            Serialize(ref value);
            return value;
        }

        /// <summary>A whole number that is a property, as a count.</summary>
        public int Serialize(int value)
        {
            Serialize(ref value);
            return value;
        }

        /// <summary>A number that is a property, as a count.</summary>
        public double Serialize(double value)
        {
            Serialize(ref value);
            return value;
        }

        /// <summary>A vector that is a property, as a count.</summary>
        public Vector3d Serialize(Vector3d value)
        {
            Serialize(ref value);
            return value;
        }

        /// <summary>An orientation that is a property, as a count.</summary>
        public Quaterniond Serialize(Quaterniond value)
        {
            Serialize(ref value);
            return value;
        }

        /// <summary>A text that is a property, as a count.</summary>
        public string Serialize(string value)
        {
            Serialize(ref value);
            return value;
        }

        /// <summary>Counts; a reader has as many.</summary>
        public void Serialize(long[] values)
        {
            for (int i = 0; i < values.Length; i++)
            {
                Serialize(ref values[i]);
            }
        }

        /// <summary>Numbers, the first ones or all; a reader has as many.</summary>
        public void Serialize(double[] values, int count = int.MaxValue) =>
            Serialize(MemoryMarshal.Cast<double, long>(values.AsSpan(0, Math.Min(count, values.Length))));

        /// <summary>Vectors, the first ones or all; a reader has as many.</summary>
        public void Serialize(Vector3d[] values, int count = int.MaxValue) =>
            Serialize(MemoryMarshal.Cast<Vector3d, long>(values.AsSpan(0, Math.Min(count, values.Length))));

        /// <summary>Orientations, the first ones or all; a reader has as many.</summary>
        public void Serialize(Quaterniond[] values, int count = int.MaxValue) =>
            Serialize(MemoryMarshal.Cast<Quaterniond, long>(values.AsSpan(0, Math.Min(count, values.Length))));

        /// <summary>A section that means something only to a reader made like its writer: written whole, and read where
        /// the reader's key is the writer's (method, scheme, step size), else left out.</summary>
        /// <param name="key">What both must agree in.</param>
        /// <param name="content">Serializes the section's numbers.</param>
        /// <param name="timeStep">The step size, s, in which they must agree too; 0 where it means nothing.</param>
        /// <returns>False where a reader leaves it out: what it would have taken over is then as it was made.</returns>
        /// <exception cref="InvalidOperationException">The section is read otherwise than it was written.</exception>
        public bool Section(string key, Action<Snapshot> content, double timeStep = 0.0)
        {
            if (IsWritten)
            {
                int start = _count;
                long end = 0;
                Serialize(ref end);
                Serialize(ref key);
                Serialize(ref timeStep);
                content(this);
                _bits[start] = _count;
                return true;
            }
            long next = 0;
            Serialize(ref next);
            string written = key;
            double writtenStep = timeStep;
            Serialize(ref written);
            Serialize(ref writtenStep);
            bool agrees = written == key && writtenStep == timeStep;
            if (agrees)
            {
                _sectionEnd = (int)next;
                content(this);
                if (_at != next)
                {
                    throw new InvalidOperationException("section " + key + " is read differently from how it was "
                        + "written");
                }
            }
            _at = (int)next;
            return agrees;
        }

        /// <summary>Numbers left of a section that is read and has none within.</summary>
        public int LeftOfSection => _sectionEnd - _at;

        /// <summary>Leaves out what is left of it.</summary>
        public void SkipSection() => _at = _sectionEnd;

        /// <summary>A section of a part that a writer or a reader may be without; where only one of them has it, it is
        /// left out.</summary>
        /// <param name="key">What both must agree in.</param>
        /// <param name="content">Serializes the part's numbers; null without the part.</param>
        public void OptionalSection(string key, Action<Snapshot>? content) =>
            Section(content == null ? "no " + key : key, content ?? (_ => { }));

        // Numbers as they lie in memory: a step keeps tens of thousands of them.
        private void Serialize(Span<long> values)
        {
            Span<long> kept = Next(values.Length);
            if (IsWritten)
            {
                values.CopyTo(kept);
            }
            else
            {
                kept.CopyTo(values);
            }
        }

        // Where the next numbers are written or read.
        private Span<long> Next(int count)
        {
            if (!IsWritten)
            {
                if (count > _count - _at)
                {
                    throw new InvalidOperationException("more is read from a snapshot than was written");
                }
                _at += count;
                return _bits.AsSpan(_at - count, count);
            }
            if (_count + count > _bits.Length)
            {
                Array.Resize(ref _bits, Math.Max(2 * _bits.Length, _count + count));
            }
            _count += count;
            return _bits.AsSpan(_count - count, count);
        }
    }
}
