using System;

namespace Guidewire.Core
{
    /// <summary>Common part of the searches for a minimum of a sum of energies: the factorised second derivative with a
    /// multiple of the metric added where it is not positive definite, the bounds on a step, and its line
    /// search.</summary>
    internal sealed class NewtonDescent
    {
        private const double LargestTurn = 1.0;          // rad an iteration, of one element where forces act
        private const double LargestRelativeTurn = 0.7;  // rad an iteration, between neighbours
        private const double SufficientDecrease = 1e-4;
        private const double Rounding = 1e-13;           // of the energies' magnitudes
        private const double LeastSize = 8.0 / (1L << 52);   // of a step that rounding of the shape does not hide

        private readonly MaterialRod _rod;
        private readonly RodSupports _supports;
        private readonly EnergyTerm[] _terms;
        private readonly bool _isStraight;
        private readonly int _mostCuts;
        private readonly double _totalLength;
        private readonly double[] _values;        // of the terms in the shape evaluated last, J

        /// <summary>For a rod, held so, under these terms.</summary>
        /// <param name="isStraight">Whether nodes move on straight lines, on which gaps to walls are bounded.</param>
        /// <param name="mostCuts">How often a step is halved.</param>
        public NewtonDescent(MaterialRod rod, RodSupports supports, EnergyTerm[] terms, bool isStraight, int mostCuts)
        {
            _rod = rod;
            _supports = supports;
            _terms = terms;
            _isStraight = isStraight;
            _mostCuts = mostCuts;
            _totalLength = rod.TotalLength;
            _values = new double[terms.Length];
            System = new BlockTridiagonal(rod, supports);
            Gradient = new RodVector[System.VectorCount];
            Direction = new RodVector[System.VectorCount];
            Trial = new RodShape(rod.ElementCount, supports.InnerCount);
        }

        /// <summary>The second derivative, as it was factorised last.</summary>
        public BlockTridiagonal System { get; }

        /// <summary>The gradient in the shape factorised last.</summary>
        public RodVector[] Gradient { get; }

        /// <summary>Newton's direction.</summary>
        public RodVector[] Direction { get; }

        /// <summary>The shape tried last.</summary>
        public RodShape Trial { get; }

        /// <summary>Factorises the second derivative with a multiple of the metric added, N.</summary>
        /// <returns>How many negative eigenvalues it has.</returns>
        public int Factorise(RodShape shape, double shift)
        {
            return System.Factorise(_terms, shape, Gradient, Direction, shift);
        }

        /// <summary>The same, ended where the first negative one is found: the gradient is then incomplete.</summary>
        /// <returns>Whether all are positive.</returns>
        public bool TryFactorise(RodShape shape, double shift)
        {
            return System.Factorise(_terms, shape, Gradient, Direction, shift, onlyPositive: true) == 0;
        }

        /// <summary>Raises the multiple until no eigenvalue is negative, and sets the direction.</summary>
        /// <returns>Factorisations made.</returns>
        public int FactoriseShifted(RodShape shape, ref double shift)
        {
            int count = 1;
            while (!TryFactorise(shape, shift) && shift <= double.MaxValue)
            {
                shift *= 4.0;
                count++;
            }
            System.Back(Direction);
            return count;
        }

        /// <summary>Sets the trial to a shape moved along the direction.</summary>
        public void Apply(RodShape shape, double scale)
        {
            if (_isStraight)
            {
                RodStep.ApplyStraight(shape, Direction, scale, Trial);
            }
            else
            {
                RodStep.Apply(_rod, _supports, shape, Direction, scale, Trial);
            }
        }

        /// <summary>Size of the direction: radians, or displacement over L.</summary>
        /// <param name="relative">The largest turn of one element against the next, radians.</param>
        public double Size(out double relative)
        {
            return RodStep.Size(Direction, _rod.ElementCount, _totalLength, out relative);
        }

        /// <summary>The largest step along the direction, at most 1.</summary>
        /// <param name="relative">The largest turn of one element against the next, radians; that of an instrument
        /// against the one whose tip it leaves is found here.</param>
        /// <param name="fraction">What the terms allow of one that turns no element too far.</param>
        public double MaxStep(RodShape shape, double size, double relative, out double fraction)
        {
            double most = Math.Max(relative, CoaxialShape.TurnAtTips(_supports.Coaxial, shape, Direction));
            double scale = Math.Min(1.0, Math.Min(LargestTurn / size, LargestRelativeTurn / most));
            fraction = EnergySum.MaxStep(_terms, shape, Direction, scale);
            return scale * fraction;
        }

        /// <summary>Halves the step until the energy falls enough (Armijo); the accepted shape is left in the
        /// trial.</summary>
        /// <param name="isNew">Whether the shape is another than the last trial, whose energies are known.</param>
        /// <param name="isHidden">Whether the energy's own rounding hides the decrease: the step is then Newton's, and
        /// small, and is taken without the energies of the trial.</param>
        public bool Search(RodShape shape, bool isNew, ref double scale, double size, out bool isHidden)
        {
            double slope = RodVectors.Dot(Gradient, Direction);
            double start = isNew ? EnergySum.Value(_terms, shape, _values, out double magnitude)
                : EnergySum.AnchoredValue(_terms, _values, out magnitude);
            double rounding = Rounding * magnitude;
            isHidden = (-slope < 1e3 * rounding && size < 1e-2) || size < LeastSize;
            for (int cut = 0; cut < _mostCuts; cut++)
            {
                Apply(shape, scale);
                if (isHidden || EnergySum.Value(_terms, Trial, _values, out _)
                    <= start + SufficientDecrease * scale * slope + rounding)
                {
                    return true;
                }
                scale *= 0.5;
            }
            return false;
        }
    }
}
