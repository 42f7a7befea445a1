#if NET8_0_OR_GREATER
namespace Guidewire.Core
{
    /// <summary>Numbers of the wire's constraints, laid out so that lanes that work at slots <see cref="Lag"/> apart
    /// load theirs with one instruction.</summary>
    /// <remarks>An iteration passes the slots 0 to period - 1; while lane 0 is at slot p, lane k is at p - lag k,
    /// before slot 0 still at the end of the iteration before. The numbers of every third slot make a strand, written
    /// backwards, so that successive numbers are those of successive lanes.</remarks>
    internal sealed class LaneTable
    {
        /// <summary>How many slots each lane is behind the one before.</summary>
        public const int Lag = 3;

        private readonly int _lanes;

        /// <param name="columns">How many numbers a slot has.</param>
        /// <param name="period">Slots of an iteration, at least <see cref="Lag"/> times the lanes.</param>
        /// <param name="lanes">Number of lanes.</param>
        public LaneTable(int columns, int period, int lanes)
        {
            _lanes = lanes;
            ColumnLength = Lag * Strand(period);
            Numbers = new double[columns * ColumnLength];
            Rows = new int[period];
            for (int p = 0; p < period; p++)
            {
                Rows[p] = Location(p);
            }
        }

        /// <summary>The columns one after the other.</summary>
        public double[] Numbers { get; }

        /// <summary>Numbers in each column.</summary>
        public int ColumnLength { get; }

        /// <summary>Where in a column the lanes' numbers start while lane 0 is at each slot.</summary>
        public int[] Rows { get; }

        /// <summary>Writes a column.</summary>
        /// <param name="column">Which, from 0.</param>
        /// <param name="from">The slot of the first number; the slots without one get 0.</param>
        /// <param name="numbers">Those of successive slots.</param>
        public void Write(int column, int from, double[] numbers)
        {
            int period = Rows.Length;
            for (int p = -Lag * (_lanes - 1); p < period; p++)
            {
                int k = (p < 0 ? p + period : p) - from;
                bool has = k >= 0 && k < numbers.Length;
                Numbers[column * ColumnLength + Location(p)] = has ? numbers[k] : 0.0;
            }
        }

        private int Location(int slot)
        {
            int strand = Strand(Rows.Length);
            int ahead = slot + Lag * (_lanes - 1);
            return ahead % Lag * strand + strand - 1 - ahead / Lag;
        }

        private int Strand(int period) => (period + Lag * (_lanes - 1) + Lag - 1) / Lag;
    }
}
#endif
