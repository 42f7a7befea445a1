using System;

namespace Guidewire.Core
{
    /// <summary>Constrains a rod whose shape and loads lie in a plane to that plane, by springs as stiff as the rod
    /// against motion out of it. They have no effect on a plane shape: their value and gradient are 0 there.</summary>
    /// <remarks>A couple that turns with the tip has a potential only in a plane. Out of the plane the arc that it
    /// bends has no minimum of any energy from half a turn on (the second variation of a couple of this kind loses its
    /// sign at m L/EI = pi), though the arc is the rod's only equilibrium. So a plane problem is solved in its
    /// plane.</remarks>
    internal sealed class PlaneGuide : EnergyTerm
    {
        private readonly double[] _alongX;  // N/m, of node i
        private readonly double[] _alongT;  // N m, of element j
        private readonly Vector3d _normal;
        private readonly double _offset;    // of the plane from the origin, m

        /// <summary>The guide of the plane through <paramref name="point"/> across the unit vector
        /// <paramref name="normal"/>.</summary>
        public PlaneGuide(MaterialRod rod, in Vector3d normal, in Vector3d point)
        {
            int n = rod.ElementCount;
            _alongX = new double[n + 1];
            _alongT = new double[n];
            _normal = normal;
            _offset = Vector3d.Dot(normal, point);
            for (int j = 0; j < n; j++)
            {
                _alongX[j] = rod.ShearStiffness[j] / rod.Length[j];
                _alongX[j + 1] = _alongX[j];
                _alongT[j] = 2.0 * Math.Max(rod.BendStiffness1[j], rod.BendStiffness2[j]) / rod.Length[j];
            }
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            for (int i = 0; i < _alongX.Length; i++)
            {
                double out1 = Vector3d.Dot(_normal, shape.X[i]) - _offset;
                sum += 0.5 * _alongX[i] * out1 * out1;
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            for (int i = from; i < to; i++)
            {
                double force = _alongX[i] * (Vector3d.Dot(_normal, shape.X[i]) - _offset);
                gradient[i].AddX(force * _normal);
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            base.AddBlocks(shape, blocks, gradient, from, to);
            for (int i = from; i < to; i++)
            {
                ref RodBlock b = ref blocks[i];
                Vector3d e = _normal;
                double k = _alongX[i];
                b.A11 += k * e.X * e.X;
                b.A22 += k * e.Y * e.Y;
                b.A33 += k * e.Z * e.Z;
                b.A21 += k * e.X * e.Y;
                b.A31 += k * e.X * e.Z;
                b.A32 += k * e.Y * e.Z;
                if (i == _alongT.Length)
                {
                    continue;
                }
                e = Quaterniond.Rotate(shape.Q[i].Conjugate, _normal);
                k = _alongT[i];
                b.C11 += k * (1.0 - e.X * e.X);
                b.C22 += k * (1.0 - e.Y * e.Y);
                b.C33 += k * (1.0 - e.Z * e.Z);
                b.C21 -= k * e.X * e.Y;
                b.C31 -= k * e.X * e.Z;
                b.C32 -= k * e.Y * e.Z;
            }
        }
    }
}
