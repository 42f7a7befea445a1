namespace Guidewire.Io
{
    /// <summary>A column of a CSV file.</summary>
    internal readonly struct TableColumn
    {
        /// <param name="name">In a first line of words.</param>
        /// <param name="of">What its numbers measure.</param>
        public TableColumn(string name, Dimension of)
        {
            Name = name;
            Of = of;
        }

        /// <summary>The column's name.</summary>
        public string Name { get; }

        /// <summary>What its numbers measure, in SI without another unit beside the name.</summary>
        public Dimension Of { get; }

        /// <summary>The name with the unit that counts where the file states none.</summary>
        public string Words => Of == Dimension.Number ? Name : Name + " (" + UnitTable.SIUnitOf(Of) + ")";
    }
}
