namespace Guidewire.Core
{
    /// <summary>Stretch and shear as constraints with compliance (Macklin 2016): C = R^T (x_(j+1) - x_j)/l - e3 along
    /// the element's axes, compliance (l K)^-1 with K = diag(GA, GA, EA), so that C^T (l K) C/2 is the
    /// energy.</summary>
    /// <remarks>dlambda solves (W + alpha/h^2) dlambda = -C - alpha/h^2 lambda with all three components at once, where
    /// W = (w_j + w_(j+1))/l^2 + [p] J^-1 [p]^T, p = C + e3, and J is the element's rotary inertia.</remarks>
    internal sealed class CompliantStretch
    {
        private readonly double[] _length;
        private readonly Vector3d[] _compliance;    // 1/J
        private readonly Vector3d[] _multiplier;    // J s^2
        private readonly double[] _inverseMass;     // 1/kg
        private readonly Vector3d[] _inverseInertia;  // 1/(kg m^2)

        /// <summary>Makes the constraints of a rod.</summary>
        public CompliantStretch(MaterialRod rod, double[] inverseMass, Vector3d[] inverseInertia)
        {
            int n = rod.ElementCount;
            _length = rod.Length;
            _compliance = new Vector3d[n];
            _multiplier = new Vector3d[n];
            _inverseMass = inverseMass;
            _inverseInertia = inverseInertia;
            for (int j = 0; j < n; j++)
            {
                double shear = 1.0 / (rod.Length[j] * rod.ShearStiffness[j]);
                _compliance[j] = new Vector3d(shear, shear, 1.0 / (rod.Length[j] * rod.StretchStiffness[j]));
            }
        }

        /// <summary>Sets the multipliers to 0.</summary>
        public void Reset() => System.Array.Clear(_multiplier, 0, _multiplier.Length);

        /// <summary>Writes or restores the multipliers.</summary>
        public void Serialize(Snapshot snapshot) => snapshot.Serialize(_multiplier);

        /// <summary>What element 0 gives node 1, and takes from node 0, in this shape, kg m.</summary>
        public Vector3d FirstMultiplier(RodShape shape) =>
            (1.0 / _length[0]) * Quaterniond.Rotate(shape.Q[0], _multiplier[0]);

        /// <summary>Adds the motion that the multipliers make in this shape.</summary>
        /// <param name="shape">The wire, not moved.</param>
        /// <param name="shift">Shift of each node, m.</param>
        /// <param name="turn">Turn of each element along its own axes.</param>
        public void AddMotion(RodShape shape, Vector3d[] shift, Vector3d[] turn)
        {
            for (int j = 0; j < _length.Length; j++)
            {
                double perLength = 1.0 / _length[j];
                Quaterniond q = shape.Q[j];
                Vector3d p = perLength * Quaterniond.Rotate(q.Conjugate, shape.X[j + 1] - shape.X[j]);
                Vector3d impulse = perLength * Quaterniond.Rotate(q, _multiplier[j]);
                shift[j] -= _inverseMass[j] * impulse;
                shift[j + 1] += _inverseMass[j + 1] * impulse;
                Vector3d couple = Vector3d.Cross(_multiplier[j], p);
                Vector3d inertia = _inverseInertia[j];
                turn[j] += new Vector3d(inertia.X * couple.X, inertia.Y * couple.Y, inertia.Z * couple.Z);
            }
        }

        /// <summary>Makes one Gauss-Seidel iteration over all elements.</summary>
        /// <param name="shape">The wire, moved and turned in place.</param>
        /// <param name="substep">h, s.</param>
        public void Iterate(RodShape shape, double substep)
        {
            double perSquare = 1.0 / (substep * substep);
            for (int j = 0; j < _length.Length; j++)
            {
                double perLength = 1.0 / _length[j];
                Quaterniond q = shape.Q[j];
                Vector3d p = perLength * Quaterniond.Rotate(q.Conjugate, shape.X[j + 1] - shape.X[j]);
                Vector3d alpha = perSquare * _compliance[j];
                Vector3d inertia = _inverseInertia[j];
                double w0 = _inverseMass[j];
                double w1 = _inverseMass[j + 1];
                double translation = (w0 + w1) * perLength * perLength;
                Symmetric3 matrix = Symmetric3.FromColumns(
                    new Vector3d(0.0, p.Z, -p.Y), inertia.X,
                    new Vector3d(-p.Z, 0.0, p.X), inertia.Y,
                    new Vector3d(p.Y, -p.X, 0.0), inertia.Z,
                    new Vector3d(translation + alpha.X, translation + alpha.Y, translation + alpha.Z));
                Vector3d old = _multiplier[j];
                Vector3d change = matrix.Solve(new Vector3d(
                    -p.X - alpha.X * old.X, -p.Y - alpha.Y * old.Y, 1.0 - p.Z - alpha.Z * old.Z));
                _multiplier[j] = old + change;
                Vector3d impulse = perLength * Quaterniond.Rotate(q, change);
                shape.X[j] -= w0 * impulse;
                shape.X[j + 1] += w1 * impulse;
                Vector3d couple = Vector3d.Cross(change, p);
                var turn = new Vector3d(inertia.X * couple.X, inertia.Y * couple.Y, inertia.Z * couple.Z);
                shape.Q[j] = Quaterniond.Normalize(q * RotationVector.Exp(turn));
            }
        }

        /// <summary>Adds what l |C + alpha lambda/h^2| and l |C| have come to.</summary>
        public void AddResidual(RodShape shape, double substep, ref IterationResidual sum)
        {
            double perSquare = 1.0 / (substep * substep);
            for (int j = 0; j < _length.Length; j++)
            {
                Vector3d edge = Quaterniond.Rotate(shape.Q[j].Conjugate, shape.X[j + 1] - shape.X[j]);
                Vector3d strain = (1.0 / _length[j]) * edge - Vector3d.UnitZ;
                Vector3d alpha = perSquare * _compliance[j];
                Vector3d multiplier = _multiplier[j];
                var residual = new Vector3d(strain.X + alpha.X * multiplier.X, strain.Y + alpha.Y * multiplier.Y,
                    strain.Z + alpha.Z * multiplier.Z);
                sum.Stretch += _length[j] * residual.Length;
                sum.StretchStrain += _length[j] * strain.Length;
            }
        }
    }
}
