namespace Guidewire.Io
{
    /// <summary>One array of a log as <see cref="ArrayLogger"/> writes it.</summary>
    internal readonly struct ArrayColumn
    {
        /// <summary>An array of this name, type and shape of one entry, at an offset in a row, bytes.</summary>
        public ArrayColumn(string name, string type, int[] shape, int offset, int length)
        {
            Name = name;
            Type = type;
            Shape = shape;
            Offset = offset;
            Length = length;
        }

        public string Name { get; }

        public string Type { get; }

        public int[] Shape { get; }

        // In a row, in bytes.
        public int Offset { get; }

        public int Length { get; }
    }
}
