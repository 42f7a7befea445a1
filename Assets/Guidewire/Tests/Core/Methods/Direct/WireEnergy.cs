using System;
using NUnit.Framework;

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

    /// <summary>Derivatives of a wire's energy by differences, with which forces and matrices are compared.</summary>
    internal static class EnergySlopes
    {
        // Of fourth-order central differences: truncation 1e-12, rounding 1e-16/1e-3 = 1e-13.
        private const double Step = 1e-3;
        private const double GradientTolerance = 1e-9;
        private const double HessianTolerance = 1e-8;

        /// <summary>Compares a gradient with the differences of the value.</summary>
        /// <param name="value">With unknown i moved by s.</param>
        /// <param name="step">Of the differences.</param>
        public static void AssertGradient(double[] gradient, int unknowns, Func<int, double, double> value,
            double step = Step, double tolerance = GradientTolerance)
        {
            double worst = 0.0;
            double largest = 0.0;
            for (int i = 0; i < unknowns; i++)
            {
                double difference = FourthOrder(step, s => value(i, s));
                worst = Math.Max(worst, Math.Abs(difference - gradient[i]));
                largest = Math.Max(largest, Math.Abs(difference));
            }
            Assert.That(worst, Is.LessThan(tolerance * largest));
        }

        /// <summary>Compares second derivatives with the differences of the value, not of the gradient: that of a
        /// rotated shape is along its own axes.</summary>
        /// <param name="value">With unknown i moved by s and k by t.</param>
        /// <param name="step">Of the differences.</param>
        public static void AssertBlocks(double[,] second, int unknowns, Func<int, double, int, double, double> value,
            double step = Step, double tolerance = HessianTolerance)
        {
            double worst = 0.0;
            double largest = 0.0;
            for (int i = 0; i < unknowns; i++)
            {
                for (int k = 0; k <= i; k++)
                {
                    double difference = FourthOrder(step, s => FourthOrder(step, t => value(i, s, k, t)));
                    worst = Math.Max(worst, Math.Abs(difference - second[i, k]));
                    largest = Math.Max(largest, Math.Abs(difference));
                }
            }
            Assert.That(worst, Is.LessThan(tolerance * largest));
        }

        private static double FourthOrder(double step, Func<double, double> f) =>
            (8.0 * (f(step) - f(-step)) - (f(2.0 * step) - f(-2.0 * step))) / (12.0 * step);

        /// <summary>Central difference of a value that a step on and back changes.</summary>
        public static double Difference(double step, Func<double, double> value) =>
            (value(step) - value(-step)) / (2.0 * step);

        /// <summary>The same, of fourth order.</summary>
        public static double FineDifference(double step, Func<double, double> value) =>
            (4.0 * Difference(step, value) - Difference(2.0 * step, value)) / 3.0;

        /// <summary>Elastic energy and potential of dead loads, J, of coaxial instruments with their hubs where they
        /// are now; what comes in at the outermost hub has none there.</summary>
        public static double OfInstruments(RodTerms terms, RodShape shape)
        {
            terms.CoaxialLoads?.Place(terms.Loads.Force);
            double energy = terms.ElasticEnergy(shape) - terms.Supports.Coaxial!.Axial.PreloadEnergy;
            for (int i = 0; i <= shape.ElementCount; i++)
            {
                energy += Vector3d.Dot(terms.Loads.Force[i], shape.X[0]);
            }
            return energy + terms.Loads.Value(shape);
        }

        /// <summary>E'(z1)(z0 - z1) of the coordinates, J: along straight lines of the nodes, rotation vectors of the
        /// elements and, with others inside, their twist.</summary>
        public static double Along(RodDynamics motion, RodShape before)
        {
            RodShape shape = motion.Shape;
            var gradient = new RodVector[motion.Terms.VectorCount];
            motion.Terms.AddGradient(shape, gradient);
            double sum = 0.0;
            int n = shape.ElementCount;
            for (int i = 0; i <= n; i++)
            {
                Vector3d move = before.X[i] - shape.X[i];
                RodVector g = gradient[i];
                sum += g.X1 * move.X + g.X2 * move.Y + g.X3 * move.Z;
                if (i < n)
                {
                    Vector3d turn = RotationVector.Log(shape.Q[i].Conjugate * before.Q[i]);
                    sum += g.T1 * turn.X + g.T2 * turn.Y + g.T3 * turn.Z;
                }
                for (int k = 0; i < n && k < shape.InnerCount; k++)
                {
                    RodVector z = gradient[n + 2 + i];
                    sum += (k == 0 ? z.T3 : z.T2) * (before.Twist[k * n + i] - shape.Twist[k * n + i]);
                }
            }
            return sum;
        }
    }
}
