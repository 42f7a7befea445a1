using System;

namespace Guidewire.Core
{
    /// <summary>Holds each element at its length and along its third director (Kugelstadt and Schoemer 2016, eqs. 37
    /// and 38): C = G = (x_{j+1} - x_j)/l - d3.</summary>
    /// <remarks>With D = w_j + w_{j+1} + 4 w_q l^2 one projection moves x_j by w_j l G/D, x_{j+1} by -w_{j+1} l G/D and
    /// q_j by 2 w_q l^2/D (0, G) q_j e3*, each times the gain. The gain in [0, 1] is dimensionless and counts per
    /// iteration. An iteration is successive over-relaxation: transversal motion diverges at a gain of 2, purely
    /// longitudinal motion at 2 (1 + 2 w_q l^2/w), because there the orientations' part of D moves nothing.</remarks>
    internal sealed class StretchConstraint
    {
        private readonly double _length;           // l, units
        private readonly double[] _lower;          // gain w_j l / D per element
        private readonly double[] _upper;          // gain w_{j+1} l / D
        private readonly double[] _orientation;    // gain 2 w_q l^2 / D

        /// <summary>Takes masses, weights and the length from the state, as they are now.</summary>
        /// <param name="state">The wire.</param>
        /// <param name="gain">k_A, dimensionless.</param>
        public StretchConstraint(RodState state, double gain)
        {
            int n = state.ElementCount;
            double l = state.ElementLength;
            _length = l;
            _lower = new double[n];
            _upper = new double[n];
            _orientation = new double[n];
            for (int j = 0; j < n; j++)
            {
                double weight = state.OrientationWeights[j];
                double sum = state.InverseMasses[j] + state.InverseMasses[j + 1] + 4.0 * weight * l * l;
                if (sum == 0.0)
                {
                    continue;    // both spheres and the frame are held: nothing can be corrected
                }
                _lower[j] = gain * state.InverseMasses[j] * l / sum;
                _upper[j] = gain * state.InverseMasses[j + 1] * l / sum;
                _orientation[j] = gain * 2.0 * weight * l * l / sum;
            }
        }

        /// <summary>The number of elements n.</summary>
        public int Count => _lower.Length;

        /// <summary>The length l of an element, units.</summary>
        public double Length => _length;

        /// <summary>gain w_j l/D per element.</summary>
        public double[] Lower => _lower;

        /// <summary>gain w_{j+1} l/D per element.</summary>
        public double[] Upper => _upper;

        /// <summary>gain 2 w_q l^2/D per element.</summary>
        public double[] Orientation => _orientation;

        /// <summary>Projects all elements once, in the given order.</summary>
        /// <param name="x">n + 1 positions in units, corrected in place.</param>
        /// <param name="q">n orientations, corrected in place and of unit length again.</param>
        /// <param name="order">The elements in the order of the iteration.</param>
        public void Iterate(Vector3d[] x, Quaterniond[] q, int[] order)
        {
            double inverseLength = 1.0 / _length;
            foreach (int j in order)
            {
                ref Vector3d a = ref x[j];
                ref Vector3d b = ref x[j + 1];
                ref Quaterniond r = ref q[j];
                double gx = (b.X - a.X) * inverseLength - 2.0 * (r.X * r.Z + r.W * r.Y);
                double gy = (b.Y - a.Y) * inverseLength - 2.0 * (r.Y * r.Z - r.W * r.X);
                double gz = (b.Z - a.Z) * inverseLength - (1.0 - 2.0 * (r.X * r.X + r.Y * r.Y));

                double lower = _lower[j];
                double upper = _upper[j];
                a = new Vector3d(a.X + lower * gx, a.Y + lower * gy, a.Z + lower * gz);
                b = new Vector3d(b.X - upper * gx, b.Y - upper * gy, b.Z - upper * gz);

                // q e3* = (-y, x, -w, z); the product (0, G) q e3* is written out, because half its terms vanish.
                double turn = _orientation[j];
                double ex = -r.Y;
                double ey = r.X;
                double ez = -r.W;
                double ew = r.Z;
                double qx = r.X + turn * (gx * ew + gy * ez - gz * ey);
                double qy = r.Y + turn * (gy * ew + gz * ex - gx * ez);
                double qz = r.Z + turn * (gz * ew + gx * ey - gy * ex);
                double qw = r.W - turn * (gx * ex + gy * ey + gz * ez);
                double scale = 1.0 / Math.Sqrt(qx * qx + qy * qy + qz * qz + qw * qw);
                r = new Quaterniond(scale * qx, scale * qy, scale * qz, scale * qw);
            }
        }

        /// <summary>G of element j, dimensionless: for tests and views, not for the solver.</summary>
        public static Vector3d Residual(RodState state, int j)
        {
            Vector3d d = (state.Positions[j + 1] - state.Positions[j]) / state.ElementLength;
            return d - state.Orientations[j].Director3;
        }
    }

    /// <summary>Turns neighbouring elements towards their rest angle (Kugelstadt and Schoemer 2016, eqs. 39 and 40):
    /// C = E = Omega - s Omega_0 with the Darboux vector Omega = (2/l) Im(q_j* q_{j+1}) in 1/unit.</summary>
    /// <remarks>q and -q are one orientation, so s = +1 or -1 is whichever makes E shorter. One projection adds w_j
    /// q_{j+1} (0, E)/(w_j + w_{j+1}) to q_j and -w_{j+1} q_j (0, E)/(w_j + w_{j+1}) to q_{j+1}, times the gain. The
    /// correction does not take the factor 2/l of Omega out again: the gain has the dimension of a length, acts as 2
    /// gain/l, and the iteration diverges at gain = l.</remarks>
    internal sealed class BendTwistConstraint
    {
        private readonly double _darbouxScale;    // 2/l, 1/units
        private readonly double[] _first;         // gain w_j / (w_j + w_{j+1}) per joint, units
        private readonly double[] _second;        // gain w_{j+1} / (w_j + w_{j+1}), units
        private readonly Vector3d[] _rest;        // Omega_0, 1/units

        /// <summary>Takes weights, the length and the rest shape from the state, as they are now.</summary>
        /// <param name="state">The wire.</param>
        /// <param name="gain">k_B in units.</param>
        public BendTwistConstraint(RodState state, double gain)
        {
            int joints = state.ElementCount - 1;
            _darbouxScale = 2.0 / state.ElementLength;
            _first = new double[joints];
            _second = new double[joints];
            _rest = state.RestDarbouxVectors;
            for (int j = 0; j < joints; j++)
            {
                double sum = state.OrientationWeights[j] + state.OrientationWeights[j + 1];
                _first[j] = sum > 0.0 ? gain * state.OrientationWeights[j] / sum : 0.0;
                _second[j] = sum > 0.0 ? gain * state.OrientationWeights[j + 1] / sum : 0.0;
            }
        }

        /// <summary>The number of joints, n - 1.</summary>
        public int Count => _first.Length;

        /// <summary>The factor 2/l of the Darboux vector, 1/units.</summary>
        public double DarbouxScale => _darbouxScale;

        /// <summary>gain w_j/(w_j + w_{j+1}) per joint, units.</summary>
        public double[] First => _first;

        /// <summary>gain w_{j+1}/(w_j + w_{j+1}) per joint, units.</summary>
        public double[] Second => _second;

        /// <summary>Omega_0 per joint, 1/units.</summary>
        public Vector3d[] Rest => _rest;

        /// <summary>Projects all joints once, in the given order.</summary>
        /// <param name="q">n orientations, corrected in place and of unit length again.</param>
        /// <param name="order">The joints in the order of the iteration; joint j is between elements j and j +
        /// 1.</param>
        public void Iterate(Quaterniond[] q, int[] order)
        {
            foreach (int j in order)
            {
                Quaterniond a = q[j];
                Quaterniond b = q[j + 1];
                Vector3d rest = _rest[j];
                double ex = _darbouxScale * (a.W * b.X - a.X * b.W - a.Y * b.Z + a.Z * b.Y);
                double ey = _darbouxScale * (a.W * b.Y - a.Y * b.W - a.Z * b.X + a.X * b.Z);
                double ez = _darbouxScale * (a.W * b.Z - a.Z * b.W - a.X * b.Y + a.Y * b.X);
                double sign = ex * rest.X + ey * rest.Y + ez * rest.Z < 0.0 ? -1.0 : 1.0;
                ex -= sign * rest.X;
                ey -= sign * rest.Y;
                ez -= sign * rest.Z;

                double f = _first[j];
                double ax = a.X + f * (b.W * ex + b.Y * ez - b.Z * ey);
                double ay = a.Y + f * (b.W * ey + b.Z * ex - b.X * ez);
                double az = a.Z + f * (b.W * ez + b.X * ey - b.Y * ex);
                double aw = a.W - f * (b.X * ex + b.Y * ey + b.Z * ez);
                double s = _second[j];
                double bx = b.X - s * (a.W * ex + a.Y * ez - a.Z * ey);
                double by = b.Y - s * (a.W * ey + a.Z * ex - a.X * ez);
                double bz = b.Z - s * (a.W * ez + a.X * ey - a.Y * ex);
                double bw = b.W + s * (a.X * ex + a.Y * ey + a.Z * ez);

                double scaleA = 1.0 / Math.Sqrt(ax * ax + ay * ay + az * az + aw * aw);
                double scaleB = 1.0 / Math.Sqrt(bx * bx + by * by + bz * bz + bw * bw);
                q[j] = new Quaterniond(scaleA * ax, scaleA * ay, scaleA * az, scaleA * aw);
                q[j + 1] = new Quaterniond(scaleB * bx, scaleB * by, scaleB * bz, scaleB * bw);
            }
        }
    }
}
