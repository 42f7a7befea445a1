using System;

namespace Guidewire.Core
{
    /// <summary>Motion of a held end of the wire over time, in all six degrees of freedom: its displacement, and the
    /// rotation vector of its frame, both in world axes and relative to the start. Linear between rows, at rest after
    /// the last.</summary>
    public sealed class EndMotion
    {
        private const double NoTurn = 1e-12;  // radians, below which the Jacobian is 1

        private readonly double[] _times;              // s
        private readonly Vector3d[] _displacements;    // m
        private readonly Vector3d[] _rotations;        // rad

        /// <summary>Makes a motion of two rows or more.</summary>
        /// <param name="times">s, from 0 on, increasing.</param>
        /// <param name="displacements">m, the first 0.</param>
        /// <param name="rotations">rad, the first 0; more than half a turn counts.</param>
        /// <exception cref="ArgumentException">Fewer rows, or rows that are not so.</exception>
        public EndMotion(double[] times, Vector3d[] displacements, Vector3d[] rotations)
        {
            if (times.Length < 2 || displacements.Length != times.Length || rotations.Length != times.Length
                || times[0] != 0.0 || displacements[0] != Vector3d.Zero || rotations[0] != Vector3d.Zero)
            {
                throw new ArgumentException("a motion needs two rows or more, the first all 0: time, displacement and"
                    + " rotation");
            }
            for (int i = 1; i < times.Length; i++)
            {
                if (!(times[i] > times[i - 1]))
                {
                    throw new ArgumentException("a motion needs times that increase from row to row");
                }
                Turns |= rotations[i] != Vector3d.Zero;
            }
            _times = (double[])times.Clone();
            _displacements = (Vector3d[])displacements.Clone();
            _rotations = (Vector3d[])rotations.Clone();
        }

        /// <summary>Whether there is a rotation.</summary>
        public bool Turns { get; }

        /// <summary>Gives the displacement at this time, m.</summary>
        public Vector3d DisplacementAt(double time) => At(_displacements, time);

        /// <summary>Gives the velocity at this time, of two at a row that after it, m/s.</summary>
        public Vector3d VelocityAt(double time) => RateOf(_displacements, time);

        /// <summary>Gives the rotation of the frame at this time, relative to the start.</summary>
        public Quaterniond RotationAt(double time) => RotationVector.Exp(At(_rotations, time));

        /// <summary>Angular velocity at this time, rad/s, in the world's axes: J(r) r' with the left Jacobian J = 1 +
        /// (1 - cos a)/a^2 [r] + (a - sin a)/a^3 [r]^2 of the rotation vector r, a = |r|.</summary>
        public Vector3d AngularVelocityAt(double time)
        {
            Vector3d r = At(_rotations, time);
            Vector3d rate = RateOf(_rotations, time);
            double a = r.Length;
            if (a < NoTurn)
            {
                return rate;
            }
            double half = Math.Sin(0.5 * a) / a;
            double third = a < 1e-3 ? 1.0 / 6.0 - a * a / 120.0 : (a - Math.Sin(a)) / (a * a * a);
            Vector3d once = Vector3d.Cross(r, rate);
            return rate + (2.0 * half * half) * once + third * Vector3d.Cross(r, once);
        }

        /// <summary>The angle between the frames at two times, radians.</summary>
        public double AngleBetween(double from, double to)
        {
            Quaterniond between = RotationAt(from).Conjugate * RotationAt(to);
            return 2.0 * Math.Atan2(between.Imaginary.Length, Math.Abs(between.W));
        }

        /// <summary>The time of the first row after this time, s; infinite where there is none.</summary>
        public double NextRow(double time)
        {
            foreach (double row in _times)
            {
                if (row > time)
                {
                    return row;
                }
            }
            return double.PositiveInfinity;
        }

        private Vector3d At(Vector3d[] values, double time)
        {
            int next = Next(time);
            if (next == 0 || next == _times.Length)
            {
                return values[Math.Max(next - 1, 0)];
            }
            double fraction = (time - _times[next - 1]) / (_times[next] - _times[next - 1]);
            return Vector3d.Lerp(values[next - 1], values[next], fraction);
        }

        private Vector3d RateOf(Vector3d[] values, double time)
        {
            int next = Next(time);
            return next == 0 || next == _times.Length ? Vector3d.Zero
                : (values[next] - values[next - 1]) / (_times[next] - _times[next - 1]);
        }

        // The first row after a time.
        private int Next(double time)
        {
            int next = Array.BinarySearch(_times, time);
            return next >= 0 ? next + 1 : ~next;
        }
    }
}
