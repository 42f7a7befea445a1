using System;
using System.Collections.Generic;
using System.Globalization;
using System.Runtime.InteropServices;
using Guidewire.Core;

namespace Guidewire.Benchmarks
{
    /// <summary>What the parts of a Newton iteration cost of a wire in a catheter over half or all of its elements, in
    /// turns with those of the wire alone: blocks of every term, elimination and back substitution of 6x6 and 7x7
    /// blocks, gradient, value, and what is read off at both hubs.</summary>
    internal sealed class CoaxialParts
    {
        private const int Before = 150;   // steps of the feed, until it bends in the arch
        private const int Calls = 60;     // in one timed turn

        private readonly TimeStepper _stepper;
        private readonly EnergyTerm[] _terms;
        private readonly EnergyTerm[] _stored;
        private readonly RodTerms _all;
        private readonly RodShape _shape;
        private readonly RodShape _moved;
        private readonly BlockTridiagonal _system;
        private readonly RodVector[] _gradient;
        private readonly RodVector[] _direction;
        private readonly RodBlock[] _blocks;
        private readonly TwistRow[] _rows;
        private readonly int _twists;

        private CoaxialParts(int covered)
        {
            SimulationParameters parameters = CoaxialFeed.Parameters(covered);
            MethodStart start = MethodBuilder.Build(parameters, new Scene(parameters));
            _stepper = start.Stepper;
            for (int k = 0; k < Before; k++)
            {
                _stepper.Advance(start.State);
            }
            RodDynamics dynamics = ((DirectStep)_stepper).Dynamics;
            _all = dynamics.Terms;
            _shape = dynamics.Shape;
            var inertia = new InertiaEnergy(_all.Mass) { StageLength = parameters.Method.TimeStep };
            inertia.BeginStep(_shape, parameters.Method.TimeStep);
            Array.Copy(_shape.X, inertia.FreePositions, _shape.ElementCount + 1);
            _terms = _all.With(inertia);
            _system = new BlockTridiagonal(_all.Rod, _all.Supports);
            _gradient = new RodVector[_system.VectorCount];
            _direction = new RodVector[_system.VectorCount];
            _blocks = new RodBlock[_shape.ElementCount + 2];
            _rows = new TwistRow[_shape.ElementCount + 1];
            _twists = _all.Supports.Coaxial?.Joints.ActiveCount ?? 0;
            _moved = new RodShape(_shape.ElementCount, _all.Supports.InnerCount);
            Array.ForEach(_terms, Blocks);
            _stored = new EnergyTerm[] { new StoredBlocks(_blocks, _rows) };
            Iterate();
        }

        /// <summary>Prints them.</summary>
        public static void Print()
        {
            var alone = new CoaxialParts(0);
            foreach (int covered in new[] { CoaxialFeed.Elements / 2, CoaxialFeed.Elements })
            {
                var both = new CoaxialParts(covered);
                Console.WriteLine("parts of a Newton iteration, us: a wire of {0} elements in a catheter over {1} of"
                    + " them, alone, ratio, difference", CoaxialFeed.Elements, covered);
                foreach ((string name, Action<CoaxialParts> part) in Parts())
                {
                    void First() => Repeat(part, both);
                    void Second() => Repeat(part, alone);
                    var timed = new Interleaved(First, Second);
                    double one = 1e-3 * timed.FirstBest / Calls;
                    double other = 1e-3 * timed.SecondBest / Calls;
                    Console.WriteLine(string.Format(CultureInfo.InvariantCulture,
                        "  {0,-34}{1,8:0.00}{2,8:0.00}{3,8:0.00}{4,8:0.00}", name, one, other, one / other,
                        one - other));
                }
            }
        }

        private static IEnumerable<(string Name, Action<CoaxialParts> Part)> Parts()
        {
            yield return ("Newton iteration", one => one.Iterate());
            yield return ("blocks: stretch", one => one.Blocks(one._all.Stretch));
            yield return ("blocks: bend-twist", one => one.Blocks(one._all.Bending));
            yield return ("blocks: inertia", one => one.Blocks(one._terms[^1]));
            yield return ("blocks: walls, loads", one => one.BlocksOfOthers());
            yield return ("elimination", one => one._system.Factorise(one._stored, one._shape,
                one._gradient, one._direction, 0.0));
            yield return ("back substitution", one => one._system.Back(one._direction));
            yield return ("move", one => one.Move());
            yield return ("gradient", one => one._system.Gradient(one._terms, one._shape, one._gradient,
                one._direction));
            yield return ("value", one => EnergySum.Value(one._terms, one._shape, out _));
            yield return ("value: bend-twist", one => one._all.Bending.Value(one._shape));
            yield return ("read off at the hubs", one => one._stepper.Hub());
        }

        private static void Repeat(Action<CoaxialParts> part, CoaxialParts one)
        {
            for (int k = 0; k < Calls; k++)
            {
                part(one);
            }
        }

        private void Iterate()
        {
            _system.Factorise(_terms, _shape, _gradient, _direction, 0.0);
            _system.Back(_direction);
            Move();
        }

        private void Blocks(EnergyTerm term)
        {
            term.AddBlocks(_shape, _blocks, _gradient, 0, _shape.ElementCount + 1);
            term.AddTwistRows(_shape, _rows, 0, _twists);
        }

        private void BlocksOfOthers()
        {
            for (int k = 2; k < _terms.Length - 1; k++)
            {
                Blocks(_terms[k]);
            }
        }

        private void Move() => RodStep.Apply(_all.Rod, _all.Supports, _shape, _direction, 1.0, _moved);
    }

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
