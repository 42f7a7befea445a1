using System;

namespace Guidewire.Core
{
    /// <summary>Solves one implicit stage from a prediction: Newton's method with a factorisation that is kept as long
    /// as it contracts, and where it does not, the slower search that minimises the stage's energy.</summary>
    /// <remarks>After a step d1 the next correction d2 is computed with the same factorisation. Its length over that
    /// of d1 is the contraction c; the error left is about c/(1-c) |d2| and has to be below the tolerance. From the
    /// same two comes Newton's own constant, |d2|/|d1|^2: a stage for whose first step it promises an error below the
    /// tolerance takes no second one, but for every 16th, which looks whether the promise still holds.</remarks>
    internal sealed class StageSolver
    {
        private const double WorstContraction = 0.3;
        private const int MostKept = 6;
        private const int MostFactorisations = 6;
        private const int MostOnTrust = 16;  // stages
        private const double Caution = 10.0; // on an error that is not measured but extrapolated

        private readonly MaterialRod _rod;
        private readonly RodSupports _supports;
        private readonly EnergyTerm[] _terms;
        private readonly BlockTridiagonal _system;
        private readonly EquilibriumSolver _search;
        private readonly RodVector[] _gradient;
        private readonly RodVector[] _direction;
        private readonly RodShape _trial;
        private readonly RodShape _start;
        private readonly double _length;
        private double _curvature = double.PositiveInfinity;  // |d2|/|d1|^2 when last measured
        private int _stagesOnTrust;

        /// <summary>A solver for this rod under these terms, inertia among them.</summary>
        public StageSolver(MaterialRod rod, RodSupports supports, EnergyTerm[] terms)
        {
            _rod = rod;
            _supports = supports;
            _terms = terms;
            _system = new BlockTridiagonal(rod, supports);
            _search = new EquilibriumSolver(rod, supports, terms);
            _gradient = new RodVector[_system.VectorCount];
            _direction = new RodVector[_system.VectorCount];
            _trial = new RodShape(rod.ElementCount);
            _start = new RodShape(rod.ElementCount);
            _length = rod.TotalLength;
        }

        /// <summary>Factorisations so far.</summary>
        public long Factorisations { get; private set; }

        /// <summary>Solutions with a kept factorisation so far.</summary>
        public long KeptSolutions { get; private set; }

        /// <summary>Stages that needed the slower search so far.</summary>
        public long Searches { get; private set; }

        /// <summary>Room for a prediction, as a direction from the shape at hand.</summary>
        public RodVector[] Prediction => _direction;

        /// <summary>Solves the stage; the shape's supports are in place, <see cref="Prediction"/> leads to the
        /// guess.</summary>
        /// <param name="shape">In: the last shape. Out: the stage's.</param>
        /// <param name="tolerance">On the error left: radians, or displacement over L.</param>
        /// <param name="mostIterations">Of the slower search.</param>
        /// <returns>Null, or why there is no solution.</returns>
        public string? Solve(RodShape shape, double tolerance, int mostIterations)
        {
            _start.CopyFrom(shape);
            RodStep.Apply(_rod, _supports, shape, _direction, 1.0, _trial);
            shape.CopyFrom(_trial);
            if (Iterate(shape, tolerance))
            {
                return null;
            }
            shape.CopyFrom(_start);
            return Search(shape, tolerance, mostIterations);
        }

        /// <summary>The slower search alone, from the shape as it is.</summary>
        public string? Search(RodShape shape, double tolerance, int mostIterations)
        {
            Searches++;
            _curvature = double.PositiveInfinity;
            EquilibriumResult result = _search.Solve(shape, tolerance, mostIterations, false);
            return result.Converged ? null : result.Reason;
        }

        /// <summary>Gradient of all terms: what the supports have to exert.</summary>
        public RodVector[] Reactions(RodShape shape)
        {
            _system.Gradient(_terms, shape, _gradient, _direction);
            return _gradient;
        }

        /// <summary>The same before the first step, without inertia.</summary>
        public RodVector[] StaticReactions(RodShape shape, EnergyTerm inertia)
        {
            Array.Clear(_gradient, 0, _gradient.Length);
            foreach (EnergyTerm term in _terms)
            {
                if (term != inertia)
                {
                    term.AddGradient(shape, _gradient, 0, shape.ElementCount + 1);
                }
            }
            return _gradient;
        }

        private bool Iterate(RodShape shape, double tolerance)
        {
            for (int f = 0; f < MostFactorisations; f++)
            {
                Factorisations++;
                if (_system.Factorise(_terms, shape, _gradient, _direction, 0.0) != 0)
                {
                    return false;
                }
                _system.Back(_direction);
                double first = Move(shape);
                _stagesOnTrust++;
                if (_stagesOnTrust < MostOnTrust && Caution * _curvature * first * first <= tolerance)
                {
                    return true;
                }
                double size = first;
                for (int k = 0; k < MostKept; k++)
                {
                    KeptSolutions++;
                    _system.Gradient(_terms, shape, _gradient, _direction);
                    _system.Solve(_direction);
                    double next = Move(shape);
                    double contraction = next / size;
                    if (k == 0)
                    {
                        _curvature = next / (first * first);
                        _stagesOnTrust = 0;
                    }
                    size = next;
                    if (size * contraction <= tolerance * (1.0 - contraction))
                    {
                        return true;
                    }
                    if (!(contraction < 1.0))
                    {
                        return false;
                    }
                    if (contraction > WorstContraction)
                    {
                        break;
                    }
                }
            }
            return false;
        }

        private double Move(RodShape shape)
        {
            double size = RodStep.Size(_direction, _rod.ElementCount, _length, out _);
            RodStep.Apply(_rod, _supports, shape, _direction, 1.0, _trial);
            shape.CopyFrom(_trial);
            return size;
        }
    }
}
