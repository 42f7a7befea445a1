using System;

namespace Guidewire.Core
{
    /// <summary>Rates that are consistent with the forces at one time, M v' = f and I w' = couple - w x I w - a I w, a
    /// of the damping
    /// in proportion to mass: used by an explicit first stage at the start and after a jump of a load or of a
    /// support.</summary>
    /// <remarks>The consistent mass is tridiagonal and the same for all components of v'; elements' spins decouple. A
    /// held node's acceleration is its support's, 0, because supports move evenly between jumps. Where a support's
    /// velocity jumps, M dv = 0 on the free nodes gives the effect of the mass that they share.</remarks>
    internal sealed class ConsistentStart
    {
        private readonly RodTerms _terms;
        private readonly RodDamping? _damping;
        private readonly InnerSpin _inner;
        private readonly bool _holdsFirst;
        private readonly DistalEnd _distal;
        private readonly Vector3d _axis;
        private readonly RodVector[] _gradient;
        private readonly double[] _pivot;
        private readonly Vector3d[] _change;

        /// <summary>Makes one for a rod under these terms.</summary>
        /// <param name="damping">Of its nodes and strains, or null.</param>
        /// <param name="inner">The spin of instruments inside.</param>
        public ConsistentStart(RodTerms terms, RodDamping? damping, InnerSpin inner)
        {
            _damping = damping;
            _inner = inner;
            _terms = terms;
            _holdsFirst = terms.Supports.Proximal != ProximalEnd.Free;
            _distal = terms.Supports.Distal;
            _axis = terms.Supports.SlidingAxis;
            _gradient = new RodVector[terms.VectorCapacity];
            _pivot = new double[terms.Rod.Capacity + 1];
            _change = new Vector3d[_pivot.Length];
        }

        /// <summary>Force of the supports on both ends, N, by the rates last set; or their impulses, N s, in the jump
        /// of velocities last made.</summary>
        public StageForces Forces { get; private set; }

        /// <summary>Whether held nodes are where they should be at this time, to within a distance.</summary>
        public bool IsHeldAt(RodShape shape, RodSchedule schedule, double time, double distance)
        {
            if (_holdsFirst && Vector3d.Distance(shape.X[0], schedule.Hub.PositionAt(time)) > distance)
            {
                return false;
            }
            Vector3d miss = schedule.Distal.PositionAt(time) - shape.X[shape.ElementCount];
            return _distal == DistalEnd.Free || Across(miss).Length <= distance;
        }

        /// <summary>Sets v' and w' from the forces of all terms, whose time has been set, and of the damping, which
        /// acts by the rates of this moment.</summary>
        /// <returns>The largest of them: v' over L, or w', 1/s^2.</returns>
        public double SetRates(RodShape shape, Vector3d[] spins, Vector3d[] acceleration, Vector3d[] spinRate)
        {
            Array.Clear(_gradient, 0, _gradient.Length);
            _terms.AddGradient(shape, _gradient);
            _damping?.AddGradient(shape, _gradient);
            double damping = _terms.Rod.MassDamping;
            int n = shape.ElementCount;
            for (int i = 0; i <= n; i++)
            {
                RodVector g = _gradient[i];
                acceleration[i] = -g.X;
            }
            Vector3d first = acceleration[0];
            Vector3d last = acceleration[n];
            Solve(acceleration, Vector3d.Zero, Vector3d.Zero);
            SetReactions(acceleration, first, last);
            double shift = 0.0;
            double turn = 0.0;
            for (int i = 0; i <= n; i++)
            {
                shift = Math.Max(shift, acceleration[i].LengthSquared);
            }
            for (int j = 0; j < n; j++)
            {
                Vector3d i = _terms.Mass.Rotary[j];
                Vector3d w = spins[j];
                RodVector g = _gradient[j];
                spinRate[j] = new Vector3d(-(1.0 / i.X) * g.T1, -(1.0 / i.Y) * g.T2, -(1.0 / i.Z) * g.T3)
                    - _terms.Mass.Precession(j, w) - damping * w;
            }
            double twist = _inner.SetFirst(_gradient, spins, _terms.Mass.Rotary, spinRate);
            for (int j = 0; j < n; j++)
            {
                turn = Math.Max(turn, spinRate[j].LengthSquared);
            }
            return Math.Max(Math.Sqrt(shift) / _terms.Rod.TotalLength, Math.Max(Math.Sqrt(turn), twist));
        }

        /// <summary>A number that other forces, another mass or another damping would hardly give.</summary>
        public double CheckSum(RodShape shape)
        {
            Array.Clear(_gradient, 0, _gradient.Length);
            _terms.AddGradient(shape, _gradient);
            double sum = _terms.Mass.Total + _terms.Rod.MassDamping + _terms.Rod.MaterialDamping;
            for (int i = 0; i < _terms.VectorCount; i++)
            {
                RodVector g = _gradient[i];
                sum += (i + 1) * (g.X1 + 2.0 * g.X2 + 3.0 * g.X3 + (4.0 * g.T1 + 5.0 * g.T2 + 6.0 * g.T3)
                    / _terms.Rod.TotalLength);
            }
            return sum;
        }

        /// <summary>Gives held nodes the velocities of their supports, and the others what follows from it at
        /// once.</summary>
        /// <param name="proximal">Of the support of node 0, m/s; of no use where it is free.</param>
        /// <param name="distal">Of that of the last node.</param>
        public void Jump(Vector3d[] velocities, in Vector3d proximal, in Vector3d distal)
        {
            int n = _terms.Rod.ElementCount;
            Array.Clear(_change, 0, _change.Length);
            Solve(_change, proximal - velocities[0], Across(distal - velocities[n]));
            SetReactions(_change, Vector3d.Zero, Vector3d.Zero);
            for (int i = 0; i <= n; i++)
            {
                velocities[i] += _change[i];
            }
        }

        /// <summary>y := M^-1 y on what is free; what is held gets these values.</summary>
        private void Solve(Vector3d[] y, in Vector3d first, in Vector3d last)
        {
            double[] diagonal = _terms.Mass.Diagonal;
            double[] coupling = _terms.Mass.Coupling;
            int n = _terms.Rod.ElementCount;
            _pivot[0] = diagonal[0];
            if (_holdsFirst)
            {
                y[1] -= coupling[0] * first;
            }
            for (int i = 1; i <= n; i++)
            {
                double fraction = i == 1 && _holdsFirst ? 0.0 : coupling[i - 1] / _pivot[i - 1];
                _pivot[i] = diagonal[i] - fraction * coupling[i - 1];
                y[i] -= fraction * y[i - 1];
            }
            Vector3d end = (1.0 / _pivot[n]) * y[n];
            if (_terms.Supports.HoldsLastNode)
            {
                end = last;
            }
            else if (_distal == DistalEnd.Sliding)
            {
                end = last + Vector3d.Dot(end, _axis) * _axis;
            }
            y[n] = end;
            for (int i = n - 1; i >= 0; i--)
            {
                y[i] = (1.0 / _pivot[i]) * (y[i] - coupling[i] * y[i + 1]);
            }
            if (_holdsFirst)
            {
                y[0] = first;
            }
        }

        // (M a - f) at both ends, 0 where they are free.
        private void SetReactions(Vector3d[] a, in Vector3d first, in Vector3d last)
        {
            double[] diagonal = _terms.Mass.Diagonal;
            double[] coupling = _terms.Mass.Coupling;
            int n = _terms.Rod.ElementCount;
            Forces = new StageForces
            {
                Proximal = diagonal[0] * a[0] + coupling[0] * a[1] - first,
                Distal = diagonal[n] * a[n] + coupling[n - 1] * a[n - 1] - last,
            };
        }

        // What of a move of the last node a sliding support does not leave free.
        private Vector3d Across(in Vector3d move) =>
            _distal == DistalEnd.Sliding ? move - Vector3d.Dot(move, _axis) * _axis : move;
    }
}
