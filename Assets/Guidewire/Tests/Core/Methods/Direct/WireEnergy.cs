using System;

namespace Guidewire.Core.Tests
{
    /// <summary>Energy and momenta of an even round wire with length and material of <see cref="Rods"/>, without
    /// clamps, from positions, velocities, orientations and angular velocities alone, in SI; nothing of the product's
    /// own sums is used.</summary>
    /// <remarks>Along an element the velocity is linear: its kinetic energy is rho A l/6 (v0^2 + v0 v1 + v1^2). Its
    /// strain is R^T d - e3, d = chord over l; a joint turns by the angle between its elements.</remarks>
    internal sealed class WireEnergy
    {
        private readonly int _n;
        private readonly double _l;
        private readonly double _mass;  // of an element, kg
        private readonly double _area;
        private readonly double _second;
        private readonly double _rotary;  // rho I l

        public WireEnergy(int n, double radius)
        {
            _n = n;
            _l = Rods.Length / n;
            _area = Math.PI * radius * radius;
            _second = 0.25 * _area * radius * radius;
            _mass = Rods.Density * _area * _l;
            _rotary = Rods.Density * _second * _l;
        }

        public double Kinetic { get; private set; }

        public double Elastic { get; private set; }

        /// <summary>Sum of mass times place, kg m.</summary>
        public Vector3d MassMoment { get; private set; }

        public Vector3d Momentum { get; private set; }

        public Vector3d AngularMomentum { get; private set; }

        public double Mass => _n * _mass;

        /// <summary>Looks at a wire.</summary>
        /// <param name="x">m.</param>
        /// <param name="v">m/s.</param>
        /// <param name="w">rad/s along the elements' axes.</param>
        public WireEnergy Of(Vector3d[] x, Vector3d[] v, Quaterniond[] q, Vector3d[] w)
        {
            Kinetic = 0.0;
            Elastic = 0.0;
            MassMoment = Vector3d.Zero;
            Momentum = Vector3d.Zero;
            AngularMomentum = Vector3d.Zero;
            for (int j = 0; j < _n; j++)
            {
                Vector3d a = v[j];
                Vector3d b = v[j + 1];
                var spun = new Vector3d(_rotary * w[j].X, _rotary * w[j].Y, 2.0 * _rotary * w[j].Z);
                Kinetic += _mass / 6.0 * (Vector3d.Dot(a, a) + Vector3d.Dot(a, b) + Vector3d.Dot(b, b))
                    + 0.5 * Vector3d.Dot(w[j], spun);
                Momentum += 0.5 * _mass * (a + b);
                MassMoment += 0.5 * _mass * (x[j] + x[j + 1]);
                AngularMomentum += _mass / 6.0 * (Vector3d.Cross(x[j], 2.0 * a + b)
                    + Vector3d.Cross(x[j + 1], a + 2.0 * b)) + Quaterniond.Rotate(q[j], spun);
                Vector3d strain = Quaterniond.Rotate(q[j].Conjugate, (1.0 / _l) * (x[j + 1] - x[j]))
                    - Vector3d.UnitZ;
                Elastic += 0.5 * _l * _area * (Rods.Shear * (strain.X * strain.X + strain.Y * strain.Y)
                    + Rods.Young * strain.Z * strain.Z);
                if (j > 0)
                {
                    Quaterniond turn = q[j - 1].Conjugate * q[j];
                    double sine = turn.Imaginary.Length;
                    double angle = 2.0 * Math.Atan2(sine, Math.Abs(turn.W));
                    Vector3d axis = sine > 0.0 ? turn.Imaginary / sine : Vector3d.Zero;
                    Vector3d bend = angle * axis;
                    Elastic += 0.5 / _l * _second * (Rods.Young * (bend.X * bend.X + bend.Y * bend.Y)
                        + 2.0 * Rods.Shear * bend.Z * bend.Z);
                }
            }
            return this;
        }
    }
}
