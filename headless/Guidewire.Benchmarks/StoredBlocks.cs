using System;
using System.Runtime.InteropServices;
using Guidewire.Core;

namespace Guidewire.Benchmarks
{
    /// <summary>Second derivatives that have been assembled before: what is left of a factorisation is its
    /// elimination.</summary>
    internal sealed class StoredBlocks : EnergyTerm
    {
        private readonly RodBlock[] _blocks;
        private readonly TwistRow[] _rows;

        /// <summary>Of these blocks and rows, which are copied.</summary>
        public StoredBlocks(RodBlock[] blocks, TwistRow[] rows)
        {
            _blocks = (RodBlock[])blocks.Clone();
            _rows = (TwistRow[])rows.Clone();
        }

        public override double Value(RodShape shape) => throw new NotSupportedException();

        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured) => throw new NotSupportedException();

        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            ReadOnlySpan<double> own = MemoryMarshal.Cast<RodBlock, double>(_blocks.AsSpan(from, to - from));
            Span<double> sum = MemoryMarshal.Cast<RodBlock, double>(blocks.AsSpan(from, to - from));
            for (int i = 0; i < own.Length; i++)
            {
                sum[i] += own[i];
            }
        }

        public override void AddTwistRows(RodShape shape, TwistRow[] rows, int from, int to)
        {
            for (int j = from; j < to; j++)
            {
                rows[j].Add(_rows[j]);
            }
        }
    }
}
