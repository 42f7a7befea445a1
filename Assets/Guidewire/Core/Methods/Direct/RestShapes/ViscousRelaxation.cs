using System;

namespace Guidewire.Core
{
    /// <summary>Finds the equilibrium of a rod under a follower couple or force by viscous relaxation, M u' =
    /// -(unbalanced forces).</summary>
    /// <remarks>Under dead forces the creeping rod would go downhill in its energy and end in a minimum. A couple in
    /// space and a force that turns have no potential, but the motion makes sense all the same, and a shape is a rest
    /// shape where it ends and to which it comes back when disturbed. Each step is one of implicit Euler, linearised,
    /// over the time 1/d: the step of (K + d M), cut to a stated turn. Large d creeps, d = 0 is Newton's method; d
    /// follows how far the steps go.
    /// A rod that never rests, but turns round and round, ends with that reason; and so does one that Newton's steps
    /// brought to an equilibrium which a disturbance would leave (<see cref="ViscousSpectrum"/>).</remarks>
    internal sealed class ViscousRelaxation
    {
        private const double FirstDrag = 10.0;  // of EI/L^2
        private const double LargestTurn = 0.5; // rad a step, of an element and between neighbours
        private const double LongStep = 0.3;    // rad; beyond it the drag grows
        private const double ShortStep = 0.1;   // below it, it falls
        private const double NearRest = 0.01;   // below it, it falls fast

        private const string Flutter = "; a follower load drives a slender wire for ever, a couple above about "
            + "3.6 EI/L, a thrust above about 20 EI/L^2";

        private readonly MaterialRod _rod;
        private readonly RodSupports _supports;
        private readonly EnergyTerm[] _terms;
        private readonly FollowerTangent _tangent;
        private readonly string _keys;
        private readonly RodVector[] _step;
        private readonly RodShape _trial;

        /// <summary>A solver for this rod; <paramref name="followers"/> are among the terms.</summary>
        public ViscousRelaxation(MaterialRod rod, RodSupports supports, EnergyTerm[] terms, TipFollowers followers)
        {
            _rod = rod;
            _supports = supports;
            _terms = terms;
            _tangent = new FollowerTangent(rod, supports, terms, followers);
            _keys = followers.Keys;
            _step = new RodVector[_tangent.System.VectorCapacity];
            _trial = new RodShape(rod.ElementCount, supports.InnerCount, rod.Capacity);
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh() => _tangent.Remesh();

        /// <summary>Moves <paramref name="shape"/> to the rest shape that it creeps to, and checks whether it is
        /// stable.</summary>
        /// <param name="tolerance">On the last Newton step, radians or displacement over L.</param>
        /// <param name="maxIterations">Steps, after which the search gives up.</param>
        public EquilibriumResult Solve(RodShape shape, double tolerance, int maxIterations)
        {
            EquilibriumResult result = Settle(shape, tolerance, maxIterations);
            if (!result.Converged)
            {
                result.Reason += Flutter;
                return result;
            }
            result.SmallestEigenvalue = new ViscousSpectrum(_tangent, _rod).SmallestRealPart(shape);
            result.Converged = result.SmallestEigenvalue > 0.0;
            result.Reason = result.Converged ? string.Empty
                : "the equilibrium under " + _keys + " is not stable: a disturbance grows even in a wire with drag"
                + Flutter;
            return result;
        }

        /// <summary>Moves <paramref name="shape"/> to where it comes to rest, stable or not.</summary>
        /// <param name="tolerance">On the last Newton step, radians or displacement over L.</param>
        /// <param name="maxIterations">Steps, after which the search gives up.</param>
        public EquilibriumResult Settle(RodShape shape, double tolerance, int maxIterations)
        {
            EquilibriumResult result = default;
            result.Reason = string.Empty;
            double drag = FirstDrag * _rod.BendForce;
            while (result.Iterations < maxIterations)
            {
                result.Iterations++;
                FindStep(shape, ref drag, ref result);
                double size = RodStep.Size(_step, _rod.ElementCount, _rod.TotalLength, out double relative,
                    _tangent.System.VectorCount);
                if (!(size < double.MaxValue))
                {
                    result.Reason = "the step is not a finite number under " + _keys;
                    return result;
                }
                double scale = Math.Min(1.0, LargestTurn / Math.Max(size, relative));
                double fraction = EnergySum.MaxStep(_terms, shape, _step, scale);
                scale *= fraction;
                RodStep.Apply(_rod, _supports, shape, _step, scale, _trial);
                shape.CopyFrom(_trial);
                if (size <= tolerance && fraction == 1.0)
                {
                    result.Converged = true;
                    return result;
                }
                drag *= size > LongStep ? 1.5 : size > ShortStep ? 1.0 : size > NearRest ? 0.7 : 0.2;
            }
            result.Reason = "a wire with drag does not come to rest under " + _keys + " in "
                + maxIterations.ToString(System.Globalization.CultureInfo.InvariantCulture) + " steps";
            return result;
        }

        /// <summary>A step against the drag, which is raised until it dampens every direction.</summary>
        private void FindStep(RodShape shape, ref double drag, ref EquilibriumResult result)
        {
            result.Factorisations++;
            while (_tangent.Factorise(shape, _step, drag) > 0 && drag < double.MaxValue)
            {
                drag = Math.Max(2.0 * drag, 0.1 * _rod.BendForce);
                result.Factorisations++;
            }
        }
    }
}
