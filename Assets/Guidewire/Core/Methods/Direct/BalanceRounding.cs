using System;

namespace Guidewire.Core
{
    /// <summary>Residual force that rounding of the positions causes in a rod's equilibrium, N: one unit in the last
    /// place
    /// times EA/l of an element and M/h^2.</summary>
    /// <remarks>The largest of all elements is added to what may be unbalanced, as long as it is less than any force
    /// that matters. In a rod so stiff that it is more (EA about a thousand times that of a wire of steel) it would
    /// hide loads, in soft pieces of the rod too. There each element has only its own: the forces on all nodes beyond
    /// one, summed up from the free tip, are the stress of the one element before it, whose strain alone is rounded;
    /// and so the force on the whole rod, from which its support's is read, has none of it. Rounding of positions is no
    /// error of the shape, since the next step of Newton's method takes it back; so at least one must have been made.
    /// Of a rod held at both ends the supports' forces remain uncertain by it.</remarks>
    internal sealed class BalanceRounding
    {
        private const double MachineEpsilon = 1.0 / (1L << 52);
        private const double Resolution = 1e-7;   // N: forces below do not matter

        private readonly MaterialRod _rod;
        private readonly RodMass _mass;
        private readonly double _factor;
        private double _totalLength;
        private readonly bool _holdsEnd;
        private double _ofMass;                   // N
        private double _distance;                 // of one unit in the last place, m

        /// <summary>Estimates it for a rod.</summary>
        /// <param name="factor">On EA/l: more than 1 where a spring holds node 0 that is stiffer than the
        /// rod.</param>
        public BalanceRounding(MaterialRod rod, RodSupports supports, RodMass mass, double factor)
        {
            _rod = rod;
            _mass = mass;
            _factor = factor;
            _holdsEnd = supports.Distal != DistalEnd.Free;
            Remesh();
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh()
        {
            _totalLength = _rod.TotalLength;
            AxialSpring = 0.0;
            for (int j = 0; j < _rod.ElementCount; j++)
            {
                AxialSpring = Math.Max(AxialSpring, _rod.StretchStiffness[j] / _rod.Length[j]);
            }
            IsLarge = MachineEpsilon * _totalLength * AxialSpring > Resolution;
        }

        /// <summary>The largest EA/l, N/m.</summary>
        public double AxialSpring { get; private set; }

        /// <summary>Whether it may hide forces that matter.</summary>
        public bool IsLarge { get; private set; }

        /// <summary>By how much the forces of two supports may be wrong, N; 0 of one, or where it does not
        /// matter.</summary>
        public double OfSupports => IsLarge && _holdsEnd ? MachineEpsilon * _totalLength * AxialSpring : 0.0;

        /// <summary>Begins a stage.</summary>
        /// <param name="stageLength">h, s.</param>
        /// <returns>The force that may be unbalanced besides in any element, N; 0 where it is large.</returns>
        public double BeginStage(RodShape shape, double stageLength)
        {
            _distance = MachineEpsilon * (shape.X[0].Length + _totalLength);
            double perMass = _mass.Total / (stageLength * stageLength);
            _ofMass = _distance * perMass;
            return IsLarge ? 0.0 : _distance * (_factor * AxialSpring + perMass);
        }

        /// <summary>The largest force on a piece of the rod from any node to its tip, or the sum of the couples over L,
        /// N, each less the rounding of its element.</summary>
        /// <param name="forces">On nodes, and couples on elements.</param>
        /// <param name="count">Of them.</param>
        public double Unbalanced(RodVector[] forces, int count)
        {
            Vector3d sum = Vector3d.Zero;
            double largest = 0.0;
            double couples = 0.0;
            double ofEnd = _holdsEnd ? Of(_rod.ElementCount - 1) : 0.0;
            for (int i = _rod.ElementCount; i >= 0; i--)
            {
                RodVector f = forces[i];
                double rounding = Of(Math.Max(i - 1, 0)) + ofEnd;
                sum += f.X;
                largest = Math.Max(largest, sum.Length - rounding);
                double couple = Math.Abs(f.T1) + Math.Abs(f.T2) + Math.Abs(f.T3);
                if (i < _rod.ElementCount)
                {
                    couples += Math.Max(0.0, couple - Of(i) * _rod.Length[i]);
                }
            }
            for (int i = _rod.ElementCount + 1; i < count; i++)
            {
                largest = Math.Max(largest, forces[i].X.Length);    // of a vessel
                couples += Math.Abs(forces[i].T1) + Math.Abs(forces[i].T2) + Math.Abs(forces[i].T3);
            }
            return Math.Max(largest, couples / _totalLength);
        }

        /// <summary>Puts the force on the whole rod in the place of that on node 0, where rounding is large and
        /// nothing else holds it.</summary>
        /// <param name="gradient">Of all terms: minus the forces.</param>
        public void SumUp(RodVector[] gradient)
        {
            for (int i = 1; IsLarge && !_holdsEnd && i <= _rod.ElementCount; i++)
            {
                gradient[0].AddX(gradient[i].X);
            }
        }

        // Of element j's force, N.
        private double Of(int j) => _ofMass + _distance * _factor * _rod.StretchStiffness[j] / _rod.Length[j];
    }
}
