using System;

namespace Guidewire.Core.Tests
{
    /// <summary>The longest stable substep of explicit steps about a shape, 2/omega_max, by counting eigenvalues: with
    /// K the second derivative of all terms and M the lumped mass, K - w^2 M has as many negative eigenvalues as there
    /// are frequencies below w (Sylvester), so omega_max is where the last one turns negative.</summary>
    internal sealed class ExplicitLimit
    {
        private const double Accuracy = 1e-3;  // of w^2

        private readonly RodTerms _terms;
        private readonly MassTerm _mass;
        private readonly EnergyTerm[] _all;
        private readonly BlockTridiagonal _system;
        private readonly RodVector[] _gradient;
        private readonly RodVector[] _work;
        private readonly int _count;  // of free directions

        /// <summary>For a rod with these masses.</summary>
        public ExplicitLimit(RodTerms terms, NodalInertia inertia)
        {
            _terms = terms;
            _mass = new MassTerm(inertia);
            _all = terms.With(_mass);
            _system = new BlockTridiagonal(terms.Rod, terms.Supports);
            _gradient = new RodVector[_system.VectorCount];
            _work = new RodVector[_system.VectorCount];
            _count = 3 * inertia.InverseInertia.Length;
            for (int i = 0; i < inertia.InverseMass.Length; i++)
            {
                bool slides = i > 0 && terms.Supports.Distal == DistalEnd.Sliding;
                _count += inertia.InverseMass[i] > 0.0 ? 3 : i == inertia.InverseMass.Length - 1 && slides ? 1 : 0;
            }
        }

        /// <summary>2/omega_max about this shape, s, to half a thousandth and no longer than it is.</summary>
        /// <param name="guess">s, of the same size.</param>
        public double About(RodShape shape, double guess)
        {
            double low = 0.0;
            double high = 4.0 / (guess * guess);
            while (!IsAbove(shape, high))
            {
                low = high;
                high *= 2.0;
            }
            while (high - low > Accuracy * high)
            {
                double middle = 0.5 * (low + high);
                bool isAbove = IsAbove(shape, middle);
                low = isAbove ? low : middle;
                high = isAbove ? middle : high;
            }
            return 2.0 / Math.Sqrt(high);
        }

        /// <summary>The same about the shape in which no joint is bent against its rest curvature.</summary>
        public double AtRest(RodShape start, double guess)
        {
            var rest = new RodShape(start.ElementCount);
            rest.CopyFrom(start);
            _terms.Bending.RelaxTurns(rest);
            for (int j = 0; j < start.ElementCount; j++)
            {
                rest.X[j + 1] = rest.X[j] + _terms.Rod.Length[j] * rest.Q[j].Director3;
            }
            return About(rest, guess);
        }

        // Whether all squared frequencies are below this one.
        private bool IsAbove(RodShape shape, double squared)
        {
            _mass.SquaredFrequency = squared;
            return _system.Factorise(_all, shape, _gradient, _work, 0.0) == _count;
        }

        // -w^2/2 times what the mass matrix makes of a move: blocks only.
        private sealed class MassTerm : EnergyTerm
        {
            private readonly NodalInertia _inertia;

            public MassTerm(NodalInertia inertia)
            {
                _inertia = inertia;
            }

            public double SquaredFrequency { get; set; }

            public override double Value(RodShape shape) => 0.0;

            public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
                ref GradientMeasures measured)
            {
            }

            public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
            {
                for (int i = from; i < to; i++)
                {
                    ref RodBlock block = ref blocks[i];
                    double inverse = _inertia.InverseMass[i];
                    double mass = inverse > 0.0 ? SquaredFrequency / inverse : 0.0;
                    block.A11 -= mass;
                    block.A22 -= mass;
                    block.A33 -= mass;
                    if (i < _inertia.InverseInertia.Length)
                    {
                        Vector3d turn = _inertia.InverseInertia[i];
                        block.C11 -= SquaredFrequency / turn.X;
                        block.C22 -= SquaredFrequency / turn.Y;
                        block.C33 -= SquaredFrequency / turn.Z;
                    }
                }
            }
        }
    }
}
