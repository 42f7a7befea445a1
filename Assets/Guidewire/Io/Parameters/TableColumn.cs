namespace Guidewire.Io
{
    /// <summary>A column of a CSV file.</summary>
    internal readonly struct TableColumn
    {
        /// <param name="name">In a first line of words.</param>
        /// <param name="of">What its numbers measure.</param>
        /// <param name="missing">The number of every row where the file has no such column; null: it needs it.</param>
        public TableColumn(string name, Dimension of, double? missing = null)
        {
            Name = name;
            Of = of;
            Missing = missing;
        }

        /// <summary>The column's name.</summary>
        public string Name { get; }

        /// <summary>What its numbers measure, in SI without another unit beside the name.</summary>
        public Dimension Of { get; }

        /// <summary>What counts where the file has no such column; null: it needs it.</summary>
        public double? Missing { get; }

        /// <summary>The name with the unit that counts where the file states none.</summary>
        public string Words => Of == Dimension.Number ? Name : Name + " (" + UnitTable.SIUnitOf(Of) + ")";
    }
}
