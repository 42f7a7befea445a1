using System;

namespace Guidewire.Core
{
    /// <summary>The tangent K of a rod under a couple that turns with its tip, plus a drag: K + d M, factorised and
    /// solved in O(n).</summary>
    /// <remarks>K is the symmetric second derivative S of the terms (the couple's own is 0 where it is anchored) plus
    /// the part that no energy carries, [m]/2 on the last element, put in exactly by three more solutions (Woodbury's
    /// formula). M is the metric: l on turns, l/L^2 on shifts.</remarks>
    internal sealed class FollowerTangent
    {
        private readonly EnergyTerm[] _terms;
        private readonly TipMoment _moment;
        private readonly BlockTridiagonal _system;
        private readonly RodVector[][] _response = new RodVector[3][];
        private readonly RodVector[] _gradient;
        private readonly int _tip;

        // Rows of (1 + Z G)^-1 Z, Z = [m]/2 and G the tip's turns under unit couples of the symmetric system.
        private Vector3d _row1;
        private Vector3d _row2;
        private Vector3d _row3;

        /// <summary>The tangent of this rod; <paramref name="moment"/> is among the terms.</summary>
        public FollowerTangent(MaterialRod rod, RodSupports supports, EnergyTerm[] terms, TipMoment moment)
        {
            _terms = terms;
            _moment = moment;
            _system = new BlockTridiagonal(rod, supports);
            _gradient = new RodVector[_system.VectorCount];
            _tip = rod.ElementCount - 1;
            for (int k = 0; k < 3; k++)
            {
                _response[k] = new RodVector[_system.VectorCount];
            }
        }

        /// <summary>Metric, supports and length of vectors.</summary>
        public BlockTridiagonal System => _system;

        /// <summary>Factorises at a shape; sets <paramref name="step"/> to -(K + d M)^-1 times the residual.</summary>
        /// <param name="drag">d, N; 0 for Newton's step.</param>
        /// <returns>The number of eigenvalues of S + d M that are not positive. Where it is not 0 the step may lead
        /// anywhere.</returns>
        public int Factorise(RodShape shape, RodVector[] step, double drag)
        {
            EnergySum.Anchor(_terms, shape);
            int negative = _system.Factorise(_terms, shape, _gradient, step, drag);
            _system.Back(step);
            Prepare();
            Complete(step);
            return negative;
        }

        /// <summary>y := (K + d M)^-1 y with the factorisation at hand.</summary>
        public void Solve(RodVector[] y)
        {
            _system.Solve(y);
            Complete(y);
        }

        private void Prepare()
        {
            for (int k = 0; k < 3; k++)
            {
                Array.Clear(_response[k], 0, _response[k].Length);
                _response[k][_tip].T1 = k == 0 ? 1.0 : 0.0;
                _response[k][_tip].T2 = k == 1 ? 1.0 : 0.0;
                _response[k][_tip].T3 = k == 2 ? 1.0 : 0.0;
                _system.Solve(_response[k]);
            }
            Vector3d half = 0.5 * _moment.Moment;
            Vector3d c1 = Vector3d.UnitX + Vector3d.Cross(half, Turn(_response[0]));
            Vector3d c2 = Vector3d.UnitY + Vector3d.Cross(half, Turn(_response[1]));
            Vector3d c3 = Vector3d.UnitZ + Vector3d.Cross(half, Turn(_response[2]));
            double determinant = Vector3d.Dot(c1, Vector3d.Cross(c2, c3));
            // Rows of the inverse of (c1 c2 c3), each times Z = [half] from the right: r^T [half] = (r x half)^T.
            _row1 = Vector3d.Cross(Vector3d.Cross(c2, c3), half) / determinant;
            _row2 = Vector3d.Cross(Vector3d.Cross(c3, c1), half) / determinant;
            _row3 = Vector3d.Cross(Vector3d.Cross(c1, c2), half) / determinant;
        }

        /// <summary>Turns a solution of the symmetric system into one of the full tangent.</summary>
        private void Complete(RodVector[] y)
        {
            Vector3d tip = Turn(y);
            RodVectors.AddScaled(y, -Vector3d.Dot(_row1, tip), _response[0]);
            RodVectors.AddScaled(y, -Vector3d.Dot(_row2, tip), _response[1]);
            RodVectors.AddScaled(y, -Vector3d.Dot(_row3, tip), _response[2]);
        }

        private Vector3d Turn(RodVector[] y)
        {
            return new Vector3d(y[_tip].T1, y[_tip].T2, y[_tip].T3);
        }
    }
}
