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

        /// <summary>The constraints of a rod's joints.</summary>
        public CompliantBendTwist(MaterialRod rod, RodSupports supports, Vector3d[] inverseInertia)
        {
            _joint = rod.Joints(supports);
            _multiplier = new Vector3d[_joint.Length];
            _inverseInertia = inverseInertia;
            _hasProximal = supports.HasProximalJoint;
            _hasDistal = supports.HasDistalJoint;
        }

        /// <summary>Forgets the multipliers: a new substep begins.</summary>
        public void Reset()
        {
            Array.Clear(_multiplier, 0, _multiplier.Length);
        }

        /// <summary>One Gauss-Seidel sweep over all joints.</summary>
        /// <param name="substep">h, s.</param>
        /// <param name="size">Grows to the largest turn of a correction, radians.</param>
        public void Sweep(RodShape shape, double substep, ref double size)
        {
            int n = shape.ElementCount;
            double perSquare = 1.0 / (substep * substep);
            double largest = size * size;
            if (_hasProximal)
            {
                Quaterniond frame = shape.ProximalFrame;
                Solve(0, perSquare, ref frame, Vector3d.Zero, ref shape.Q[0], _inverseInertia[0], ref largest);
            }
            for (int k = 1; k < n; k++)
            {
                Solve(k, perSquare, ref shape.Q[k - 1], _inverseInertia[k - 1], ref shape.Q[k], _inverseInertia[k],
                    ref largest);
            }
            if (_hasDistal)
            {
                Quaterniond frame = shape.DistalFrame;
                Solve(n, perSquare, ref shape.Q[n - 1], _inverseInertia[n - 1], ref frame, Vector3d.Zero, ref largest);
            }
            size = Math.Sqrt(largest);
        }

        private void Solve(int k, double perSquare, ref Quaterniond a, in Vector3d inertiaA, ref Quaterniond b,
            in Vector3d inertiaB, ref double largest)
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
            var alpha = new Vector3d(perSquare / joint.Bend, perSquare / joint.Bend, perSquare / joint.Twist);
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
            largest = Math.Max(largest, Math.Max(turnA.LengthSquared, turnB.LengthSquared));
        }
    }
}
