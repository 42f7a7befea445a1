using System;

namespace Guidewire.Core
{
    /// <summary>Bending and twist as constraints with compliance (Macklin 2016): C = theta - theta0 with theta the
    /// rotation vector of conj(q_a) q_b, compliance (w l)/K with K = diag(EI, EI, GJ), the joints of the direct
    /// solver.</summary>
    /// <remarks>With dtheta = T delta_b - T^T delta_a, dlambda solves (T J_b^-1 T^T + T^T J_a^-1 T + alpha/h^2)
    /// dlambda = -C - alpha/h^2 lambda. A clamp's frame has J^-1 = 0.</remarks>
    internal sealed class CompliantBendTwist
    {
        private readonly Joint[] _joint;
        private readonly Vector3d[] _multiplier;
        private readonly Vector3d[] _inverseInertia;
        private readonly bool _hasProximal;
        private readonly bool _hasDistal;

        /// <summary>Makes the constraints of a rod's joints.</summary>
        public CompliantBendTwist(MaterialRod rod, RodSupports supports, Vector3d[] inverseInertia)
        {
            _joint = rod.Joints(supports);
            _multiplier = new Vector3d[_joint.Length];
            _inverseInertia = inverseInertia;
            _hasProximal = supports.HasProximalJoint;
            _hasDistal = supports.HasDistalJoint;
        }

        /// <summary>Sets the multipliers to 0.</summary>
        public void Reset() => Array.Clear(_multiplier, 0, _multiplier.Length);

        /// <summary>Writes or restores the multipliers.</summary>
        public void Serialize(Snapshot snapshot) => snapshot.Serialize(_multiplier);

        /// <summary>Adds the motion that the multipliers make in this shape.</summary>
        /// <param name="shape">The wire, not moved.</param>
        /// <param name="turn">Turn of each element along its own axes.</param>
        public void AddMotion(RodShape shape, Vector3d[] turn)
        {
            int n = shape.ElementCount;
            for (int k = _hasProximal ? 0 : 1; k < (_hasDistal ? n + 1 : n); k++)
            {
                Quaterniond a = k == 0 ? shape.ProximalFrame : shape.Q[k - 1];
                Quaterniond b = k == n ? shape.DistalFrame : shape.Q[k];
                Vector3d theta = RotationVector.Log(a.Conjugate * b);
                Vector3d lambda = _multiplier[k];
                double square = theta.LengthSquared;
                double c = RotationVector.CotangentFactor(square);
                // T lambda = even + odd, T^T lambda = even - odd.
                Vector3d even = (1.0 - c * square) * lambda + (c * Vector3d.Dot(theta, lambda)) * theta;
                Vector3d odd = 0.5 * Vector3d.Cross(theta, lambda);
                if (k < n)
                {
                    turn[k] += Scaled(_inverseInertia[k], even - odd);
                }
                if (k > 0)
                {
                    turn[k - 1] -= Scaled(_inverseInertia[k - 1], even + odd);
                }
            }
        }

        /// <summary>Makes one Gauss-Seidel iteration over all joints.</summary>
        /// <param name="shape">The wire, turned in place.</param>
        /// <param name="substep">h, s.</param>
        public void Iterate(RodShape shape, double substep)
        {
            int n = shape.ElementCount;
            double perSquare = 1.0 / (substep * substep);
            if (_hasProximal)
            {
                Quaterniond frame = shape.ProximalFrame;
                Solve(0, perSquare, ref frame, Vector3d.Zero, ref shape.Q[0], _inverseInertia[0]);
            }
            for (int k = 1; k < n; k++)
            {
                Solve(k, perSquare, ref shape.Q[k - 1], _inverseInertia[k - 1], ref shape.Q[k], _inverseInertia[k]);
            }
            if (_hasDistal)
            {
                Quaterniond frame = shape.DistalFrame;
                Solve(n, perSquare, ref shape.Q[n - 1], _inverseInertia[n - 1], ref frame, Vector3d.Zero);
            }
        }

        /// <summary>Adds what C + alpha lambda/h^2 and C have come to.</summary>
        public void AddResidual(RodShape shape, double substep, ref IterationResidual sum)
        {
            int n = shape.ElementCount;
            double perSquare = 1.0 / (substep * substep);
            for (int k = _hasProximal ? 0 : 1; k < (_hasDistal ? n + 1 : n); k++)
            {
                Joint joint = _joint[k];
                Quaterniond a = k == 0 ? shape.ProximalFrame : shape.Q[k - 1];
                Quaterniond b = k == n ? shape.DistalFrame : shape.Q[k];
                Vector3d strain = RotationVector.Log(a.Conjugate * b) - joint.Rest;
                double x = strain.X + perSquare / joint.Bend1 * _multiplier[k].X;
                double y = strain.Y + perSquare / joint.Bend2 * _multiplier[k].Y;
                sum.Bend += Math.Sqrt(x * x + y * y);
                sum.Twist += Math.Abs(strain.Z + perSquare / joint.Twist * _multiplier[k].Z);
                sum.BendStrain += Math.Sqrt(strain.X * strain.X + strain.Y * strain.Y);
                sum.TwistStrain += Math.Abs(strain.Z);
            }
        }

        private void Solve(int k, double perSquare, ref Quaterniond a, in Vector3d inertiaA, ref Quaterniond b,
            in Vector3d inertiaB)
        {
            Joint joint = _joint[k];
            Vector3d theta = RotationVector.Log(a.Conjugate * b);
            double square = theta.LengthSquared;
            double c = RotationVector.CotangentFactor(square);
            // Columns of T = (1 - c a) 1 + c theta theta^T + [theta]/2, and of T^T.
            double diagonal = 1.0 - c * square;
            Vector3d h = 0.5 * theta;
            Vector3d even1 = (c * theta.X) * theta + new Vector3d(diagonal, 0.0, 0.0);
            Vector3d even2 = (c * theta.Y) * theta + new Vector3d(0.0, diagonal, 0.0);
            Vector3d even3 = (c * theta.Z) * theta + new Vector3d(0.0, 0.0, diagonal);
            var odd1 = new Vector3d(0.0, h.Z, -h.Y);
            var odd2 = new Vector3d(-h.Z, 0.0, h.X);
            var odd3 = new Vector3d(h.Y, -h.X, 0.0);
            var alpha = new Vector3d(perSquare / joint.Bend1, perSquare / joint.Bend2, perSquare / joint.Twist);
            Symmetric3 matrix = Symmetric3.FromColumns(even1 + odd1, inertiaB.X, even2 + odd2, inertiaB.Y,
                    even3 + odd3, inertiaB.Z, alpha)
                + Symmetric3.FromColumns(even1 - odd1, inertiaA.X, even2 - odd2, inertiaA.Y,
                    even3 - odd3, inertiaA.Z, Vector3d.Zero);
            Vector3d old = _multiplier[k];
            Vector3d strain = theta - joint.Rest;
            Vector3d change = matrix.Solve(new Vector3d(-strain.X - alpha.X * old.X, -strain.Y - alpha.Y * old.Y,
                -strain.Z - alpha.Z * old.Z));
            _multiplier[k] = old + change;
            var turnB = new Vector3d(inertiaB.X * Vector3d.Dot(even1 + odd1, change),
                inertiaB.Y * Vector3d.Dot(even2 + odd2, change), inertiaB.Z * Vector3d.Dot(even3 + odd3, change));
            var turnA = new Vector3d(-inertiaA.X * Vector3d.Dot(even1 - odd1, change),
                -inertiaA.Y * Vector3d.Dot(even2 - odd2, change), -inertiaA.Z * Vector3d.Dot(even3 - odd3, change));
            a = Quaterniond.Normalize(a * RotationVector.Exp(turnA));
            b = Quaterniond.Normalize(b * RotationVector.Exp(turnB));
        }

        private static Vector3d Scaled(in Vector3d a, in Vector3d b) => new Vector3d(a.X * b.X, a.Y * b.Y, a.Z * b.Z);
    }
}
