namespace Guidewire.Io
{
    /// <summary>One array of a log as <see cref="ArrayLogger"/> writes it: its name and type, the shape of one
    /// entry.</summary>
    internal struct ArrayColumn
    {
        public string Name;
        public string Type;
        public int[] Shape;

        /// <summary>The place in a row, bytes.</summary>
        public int Offset;

        /// <summary>The length of one entry, bytes.</summary>
        public int Length;
    }
}
