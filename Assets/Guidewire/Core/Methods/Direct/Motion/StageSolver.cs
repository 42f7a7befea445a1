using System;

namespace Guidewire.Core
{
    /// <summary>Solves one implicit stage from a prediction: Newton's method with a factorisation that is reused as
    /// long as the iteration contracts, and otherwise the slower minimisation of the stage's energy.</summary>
    /// <remarks>A stage is solved when no piece of the rod, from its start to any node, is unbalanced by more than
    /// a force S, nor the couples on its elements by S L in all. S is the prescribed fraction of the largest force in
    /// the rod, and at most tolerance EI/L^2, because a force S at the tip of a cantilever moves it by S L^3/(3 EI) and
    /// turns it by S L^2/(2 EI): the balance then bounds the error of the shape too. A bound on the last step alone
    /// does not do: stretching costs EA, and a step of 1e-6 L along the rod is 1e-6 EA of force, more than the weight
    /// of the wire. What rounding of the positions leaves in the balance is added to S (<see
    /// cref="BalanceRounding"/>).
    ///
    /// After a full step d1 the force left is of second order, and of first where the tangent leaves something out (the
    /// turning of fast spins): from the last that was measured it is expected to grow with |d1|^2 and to fall with
    /// |d1|. Where that promises S with a margin it is trusted, but for every 16th stage. A correction d2 with the
    /// factorisation that is kept takes the stiff direction of each element where it was a turn d1 ago, so it leaves EA
    /// |d1| |d2|: where that is below S, and |d2| below the tolerance, nothing more is evaluated. A step that a term
    /// cuts promises nothing: the next one starts again.</remarks>
    internal sealed class StageSolver
    {
        private const double WorstContraction = 0.3;
        private const int MaxReusedSteps = 6;
        private const int MostFactorisations = 6;
        private const int MostOnTrust = 16;   // stages
        private const double Caution = 10.0;  // on a force that is not measured but extrapolated
        private const double Safety = 2.0;    // on EA |d1| |d2|
        private const int LeastApart = 3;     // elements, of which the first and the last have no node in common

        private readonly MaterialRod _rod;
        private readonly RodSupports _supports;
        private readonly RodTerms _rodTerms;  // without inertia
        private readonly EnergyTerm[] _terms;  // with it
        private readonly BlockTridiagonal _system;
        private readonly EquilibriumSolver _search;
        private readonly ViscousRelaxation? _creep;  // where a couple at the tip has no potential
        private readonly RodVector[] _gradient;
        private readonly RodVector[] _direction;
        private readonly BalanceRounding _rounding;
        private readonly double _totalLength;
        private readonly double _mass;
        private readonly double _softestForce;  // softest stiffness/L^2, N
        private readonly double _stiffest;         // EA, N
        private double _largestForce;              // in the rod when last measured, N
        private double _knownStep;                 // |d1| when the force that it left was last measured
        private double _knownForce = double.PositiveInfinity;
        private int _stagesOnTrust;

        /// <summary>A solver for a rod under its terms, its inertia and what else a motion has.</summary>
        public StageSolver(RodTerms terms, params EnergyTerm[] inertia)
        {
            MaterialRod rod = terms.Rod;
            _rod = rod;
            _supports = terms.Supports;
            _rodTerms = terms;
            _terms = terms.With(inertia);
            _system = new BlockTridiagonal(rod, _supports);
            _search = new EquilibriumSolver(rod, _supports, _terms);
            _creep = terms.HavePotential ? null : new ViscousRelaxation(rod, _supports, _terms, terms.Followers);
            _gradient = new RodVector[_system.VectorCount];
            _direction = new RodVector[_system.VectorCount];
            _totalLength = rod.TotalLength;
            _mass = terms.Mass.Total;
            _rounding = new BalanceRounding(rod, terms.Supports, _mass, 1.0);
            _softestForce = terms.SoftestStiffness / (_totalLength * _totalLength);
            for (int j = 0; j < rod.ElementCount; j++)
            {
                _stiffest = Math.Max(_stiffest, rod.StretchStiffness[j]);
            }
        }

        /// <summary>Error that a stage's shape may have: radians, or displacement over L.</summary>
        public double Tolerance { get; set; } = 1e-6;

        /// <summary>Fraction of the largest force that a stage may leave unbalanced.</summary>
        public double Balance { get; set; } = 1e-7;

        /// <summary>By how much rounding makes the forces of two supports uncertain, N; 0 where it does not
        /// matter.</summary>
        public double RoundingOfSupports => _rounding.OfSupports;

        /// <summary>Newton iterations of the slower search.</summary>
        public int MostIterations { get; set; } = 50;

        /// <summary>Factorisations so far.</summary>
        public long Factorisations { get; private set; }

        /// <summary>Solutions with a kept factorisation so far.</summary>
        public long KeptSolutions { get; private set; }

        /// <summary>Stages that needed the slower search so far.</summary>
        public long Searches { get; private set; }

        /// <summary>Newton iterations of both kinds so far, those with a kept factorisation left out.</summary>
        public long Iterations { get; private set; }

        /// <summary>Solves the stage from a prediction in which the supports are in place.</summary>
        /// <param name="shape">In: the prediction. Out: the stage's.</param>
        /// <param name="stageLength">h, s.</param>
        /// <param name="loads">Sum of the loads' magnitudes, N.</param>
        /// <returns>False where the iteration does not converge; the shape is then not to be used.</returns>
        public bool Iterate(RodShape shape, double stageLength, double loads)
        {
            double rounding = _rounding.BeginStage(shape, stageLength);
            double unbalanced = double.PositiveInfinity;
            for (int f = 0; f < MostFactorisations; f++)
            {
                if (!NewtonStep(shape, out double step, out double fraction))
                {
                    return false;
                }
                if (fraction < 1.0)
                {
                    continue;
                }
                if (IsTrusted(step, Allowed(rounding, loads)))
                {
                    return true;
                }
                bool? isSolved = KeptSteps(shape, step, rounding, loads, ref unbalanced);
                if (isSolved.HasValue)
                {
                    return isSolved.Value;
                }
            }
            return false;
        }

        /// <summary>A new factorisation, and a step with it; false where there is none.</summary>
        private bool NewtonStep(RodShape shape, out double step, out double fraction)
        {
            Factorisations++;
            Iterations++;
            step = 0.0;
            fraction = 0.0;
            if (_system.Factorise(_terms, shape, _gradient, _direction, 0.0) != 0)
            {
                return false;
            }
            _system.Back(_direction);
            step = Move(shape, out fraction);
            return true;
        }

        /// <summary>Whether the force that a full step leaves is known well enough without an evaluation.</summary>
        private bool IsTrusted(double step, double allowed)
        {
            _stagesOnTrust++;
            return _stagesOnTrust < MostOnTrust && Caution * Expected(step) <= allowed;
        }

        /// <summary>Steps with the factorisation of the last one, as long as they contract.</summary>
        /// <param name="first">Size of the full step with which it was made.</param>
        /// <param name="unbalanced">In: the force left when last evaluated, N. Out: the same.</param>
        /// <returns>Whether the stage is solved; null where a new factorisation is needed.</returns>
        private bool? KeptSteps(RodShape shape, double first, double rounding, double loads, ref double unbalanced)
        {
            double size = first;
            for (int k = 0; k < MaxReusedSteps; k++)
            {
                double last = unbalanced;
                unbalanced = Unbalanced(shape);
                double allowed = Allowed(rounding, loads);
                if (k == 0)
                {
                    _knownStep = first;
                    _knownForce = unbalanced;
                    _stagesOnTrust = 0;
                }
                // A full step that no longer lowers the force left has come to what rounding leaves.
                bool atRounding = k == 0 && unbalanced >= 0.5 * last && first <= Tolerance;
                if (unbalanced <= allowed || atRounding)
                {
                    return true;
                }
                KeptSolutions++;
                _system.Solve(_direction);
                double next = Move(shape, out double fraction);
                if (fraction < 1.0)
                {
                    return null;
                }
                if (Safety * _stiffest * first * next <= allowed && next <= Tolerance)
                {
                    return true;
                }
                // Below the tolerance a factorisation that no longer contracts is only too old.
                if (!(next < size) && !(next <= Tolerance))
                {
                    return false;
                }
                if (next > WorstContraction * size)
                {
                    return null;
                }
                size = next;
            }
            return null;
        }

        /// <summary>The slower search, from the shape as it is; it judges the error of the shape alone.</summary>
        /// <returns>Null, or why there is no solution.</returns>
        public string? Search(RodShape shape)
        {
            Searches++;
            _knownForce = double.PositiveInfinity;
            EquilibriumResult result = _creep == null ? _search.Solve(shape, Tolerance, MostIterations, false)
                : _creep.Settle(shape, Tolerance, MostIterations);
            Iterations += result.Iterations;
            return result.Converged ? null : result.Reason;
        }

        /// <summary>Gradient of all terms: what the supports have to exert.</summary>
        public RodVector[] Reactions(RodShape shape)
        {
            _system.Gradient(_terms, shape, _gradient, _direction);
            _rounding.SumUp(_gradient);
            return _gradient;
        }

        /// <summary>The same where only its entries at nodes 0 and n count.</summary>
        /// <param name="shape">Walls, if there are any, have been asked for their energy in it last.</param>
        public RodVector[] EndReactions(RodShape shape)
        {
            int n = shape.ElementCount;
            if (_rounding.IsLarge || _supports.Coaxial != null || n < LeastApart)
            {
                return Reactions(shape);
            }
            var measured = default(GradientMeasures);
            Array.Clear(_gradient, 0, _gradient.Length);
            foreach (EnergyTerm term in _terms)
            {
                term.AddGradient(shape, _gradient, 0, 1, ref measured);
                term.AddGradient(shape, _gradient, n - 1, n + 1, ref measured);
            }
            return _gradient;
        }

        /// <summary>The same before the first step, without inertia.</summary>
        public RodVector[] StaticReactions(RodShape shape)
        {
            Array.Clear(_gradient, 0, _gradient.Length);
            _rodTerms.AddGradient(shape, _gradient);
            _rounding.SumUp(_gradient);
            return _gradient;
        }

        /// <summary>Writes or restores the counts.</summary>
        public void SerializeCounts(Snapshot snapshot)
        {
            Factorisations = snapshot.Serialize(Factorisations);
            KeptSolutions = snapshot.Serialize(KeptSolutions);
            Searches = snapshot.Serialize(Searches);
        }

        /// <summary>Writes or restores what is expected of the next stage; a rod that answers otherwise than the
        /// writer's is measured anew.</summary>
        public void SerializeTrust(Snapshot snapshot)
        {
            bool isSame = Agrees(snapshot, _stiffest) & Agrees(snapshot, _rounding.AxialSpring)
                & Agrees(snapshot, _mass) & Agrees(snapshot, _softestForce)
                & Agrees(snapshot, Tolerance) & Agrees(snapshot, Balance);
            snapshot.Serialize(ref _largestForce);
            snapshot.Serialize(ref _knownStep);
            snapshot.Serialize(ref _knownForce);
            snapshot.Serialize(ref _stagesOnTrust);
            if (!isSame)
            {
                _knownForce = double.PositiveInfinity;
            }
        }

        private static bool Agrees(Snapshot snapshot, double own)
        {
            double value = own;
            snapshot.Serialize(ref value);
            return value == own;
        }

        /// <summary>The force that a full step of this length is expected to leave, N.</summary>
        private double Expected(double step)
        {
            double ratio = step / _knownStep;
            return _knownForce * (ratio > 1.0 ? ratio * ratio : ratio);
        }

        /// <summary>S, N.</summary>
        private double Allowed(double rounding, double loads)
        {
            return Math.Min(Balance * Math.Max(_largestForce, loads), Tolerance * _softestForce) + rounding;
        }

        /// <summary>The largest force on a piece of the rod from its start to any node, or the sum of the couples over
        /// L, N; the direction is set to minus the gradient.</summary>
        private double Unbalanced(RodShape shape)
        {
            _largestForce = _system.Gradient(_terms, shape, _gradient, _direction).LargestForce;
            if (_rounding.IsLarge)
            {
                return _rounding.Unbalanced(_direction);
            }
            double force = RodVectors.LargestPartialForce(_direction, out double couples);
            return Math.Max(force, couples / _totalLength);
        }

        /// <summary>Takes the step, or the fraction of it that the terms allow; returns its full size.</summary>
        private double Move(RodShape shape, out double fraction)
        {
            double size = RodStep.Size(_direction, _rod.ElementCount, _totalLength, out _);
            fraction = EnergySum.MaxStep(_terms, shape, _direction, 1.0);
            RodStep.Apply(_rod, _supports, shape, _direction, fraction, shape);
            return size;
        }
    }
}
