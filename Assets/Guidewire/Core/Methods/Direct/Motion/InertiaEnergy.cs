using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>What one implicit stage of length h adds to the energy: 1/2 (x - x~)^T M (x - x~)/h^2 for the nodes
    /// and the rotary inertia of the elements. With it the stage's motion is the energy's minimum.</summary>
    /// <remarks>Nodes: a = (x - x~)/h^2 is the stage's acceleration, x~ = x^ + h v^. Elements: the turn since the
    /// step's start is phi = log(conj(q_start) q); w = J(phi) (phi - phi^)/h is the angular velocity along the
    /// element's axes, and I (w - w^)/h + w x I w is its couple, I = rho I l diag(1, 1, 2). This couple has no
    /// potential; it enters by its work since the anchor, with I/h^2 as second derivative, which leaves out terms of
    /// order |phi| I/h^2.</remarks>
    internal sealed class InertiaEnergy : EnergyTerm
    {
        private const double SurelyFirst = 4.0;  // radians squared: below it the shortest rotation vector is meant

        private readonly double[] _diagonal;  // of the mass matrix, kg, n+1
        private readonly double[] _coupling;  // between nodes i and i+1, kg, n
        private readonly double[] _rotary;    // rho I l, kg m^2, n
        private readonly Quaterniond[] _anchor;
        private readonly Vector3d[] _anchorCouple;

        /// <summary>The inertia of a rod under one mass rule.</summary>
        public InertiaEnergy(MaterialRod rod, MassRule rule)
        {
            int n = rod.ElementCount;
            _diagonal = new double[n + 1];
            _coupling = new double[n];
            _rotary = new double[n];
            _anchor = new Quaterniond[n];
            _anchorCouple = new Vector3d[n];
            LastTurn = new Vector3d[n];
            LastSpin = new Vector3d[n];
            Start = new Quaterniond[n];
            FreePositions = new Vector3d[n + 1];
            TurnHistory = new Vector3d[n];
            SpinHistory = new Vector3d[n];
            double total = 0.0;
            for (int j = 0; j < n; j++)
            {
                double mass = rod.LineDensity[j] * rod.Length[j];
                double share = rule == MassRule.Consistent ? mass / 3.0 : 0.5 * mass;
                _coupling[j] = rule == MassRule.Consistent ? mass / 6.0 : 0.0;
                _diagonal[j] += share;
                _diagonal[j + 1] += share;
                _rotary[j] = rod.RotaryInertia[j] * rod.Length[j];
                total += mass;
            }
            TotalMass = total;
            if (rule == MassRule.Uniform)
            {
                Array.Fill(_diagonal, total / (n + 1));
            }
        }

        /// <summary>h, s: the diagonal coefficient of the scheme times the time step.</summary>
        public double StageLength { get; set; }

        /// <summary>Orientations at the start of the step, from which phi counts.</summary>
        public Quaterniond[] Start { get; }

        /// <summary>x~, where the nodes would go without forces, m.</summary>
        public Vector3d[] FreePositions { get; }

        /// <summary>phi^, the turn that earlier stages have contributed, radians.</summary>
        public Vector3d[] TurnHistory { get; }

        /// <summary>w^, the angular velocity that earlier stages have contributed, rad/s.</summary>
        public Vector3d[] SpinHistory { get; }

        /// <summary>phi when it was last asked for, radians.</summary>
        public Vector3d[] LastTurn { get; }

        /// <summary>w when it was last asked for, rad/s.</summary>
        public Vector3d[] LastSpin { get; }

        /// <summary>kg.</summary>
        public double TotalMass { get; }

        /// <summary>A new step begins: turns count from these orientations.</summary>
        public void BeginStep(Quaterniond[] orientations)
        {
            Array.Copy(orientations, Start, Start.Length);
            Array.Clear(LastTurn, 0, LastTurn.Length);
        }

        /// <summary>phi of element j in this orientation: of all rotation vectors that lead there, the one nearest to
        /// the last that was asked for in this step, so that more than half a turn a step is counted.</summary>
        [MethodImpl(Compiled.AtOnce)]
        public Vector3d Turn(in Quaterniond orientation, int j)
        {
            Vector3d turn = RotationVector.Log(Start[j].Conjugate * orientation);
            Vector3d last = LastTurn[j];
            if (last.LengthSquared > SurelyFirst && turn.LengthSquared > 0.0)
            {
                Vector3d axis = Vector3d.Normalize(turn);
                double turns = Math.Round(Vector3d.Dot(last - turn, axis) / (2.0 * Math.PI));
                turn += (2.0 * Math.PI * turns) * axis;
            }
            LastTurn[j] = turn;
            return turn;
        }

        /// <summary>w of element j in this orientation; phi is then the last that was asked for.</summary>
        [MethodImpl(Compiled.AtOnce)]
        public Vector3d Spin(in Quaterniond orientation, int j)
        {
            Vector3d turn = Turn(orientation, j);
            Vector3d spin = (1.0 / StageLength) * RotationVector.TangentMap(turn, turn - TurnHistory[j]);
            LastSpin[j] = spin;
            return spin;
        }

        /// <summary>Linear momentum, kg m/s, of these velocities.</summary>
        public Vector3d Momentum(Vector3d[] velocities)
        {
            Vector3d sum = Vector3d.Zero;
            for (int i = 0; i < _diagonal.Length; i++)
            {
                sum += _diagonal[i] * velocities[i];
                if (i < _coupling.Length)
                {
                    sum += _coupling[i] * (velocities[i] + velocities[i + 1]);
                }
            }
            return sum;
        }

        /// <summary>Kinetic energy, J, of these velocities and angular velocities.</summary>
        public double KineticEnergy(Vector3d[] velocities, Vector3d[] spins)
        {
            double sum = 0.0;
            for (int i = 0; i < _diagonal.Length; i++)
            {
                sum += 0.5 * _diagonal[i] * velocities[i].LengthSquared;
                if (i < _coupling.Length)
                {
                    Vector3d w = spins[i];
                    sum += _coupling[i] * Vector3d.Dot(velocities[i], velocities[i + 1])
                        + 0.5 * _rotary[i] * (w.LengthSquared + w.Z * w.Z);
                }
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void Anchor(RodShape shape)
        {
            for (int j = 0; j < _anchor.Length; j++)
            {
                _anchor[j] = shape.Q[j];
                _anchorCouple[j] = Couple(shape.Q[j], j);
            }
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double perSquare = 1.0 / (StageLength * StageLength);
            double sum = 0.0;
            for (int i = 0; i < _diagonal.Length; i++)
            {
                Vector3d d = shape.X[i] - FreePositions[i];
                sum += 0.5 * perSquare * _diagonal[i] * d.LengthSquared;
                if (i < _coupling.Length)
                {
                    Vector3d e = shape.X[i + 1] - FreePositions[i + 1];
                    sum += perSquare * _coupling[i] * Vector3d.Dot(d, e);
                    Vector3d turn = RotationVector.Log(_anchor[i].Conjugate * shape.Q[i]);
                    sum += Vector3d.Dot(_anchorCouple[i], turn)
                        + 0.5 * perSquare * _rotary[i] * (turn.LengthSquared + turn.Z * turn.Z);
                }
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to)
        {
            double perSquare = 1.0 / (StageLength * StageLength);
            int nodes = Math.Min(to, _diagonal.Length);
            for (int i = from; i < nodes; i++)
            {
                Vector3d a = perSquare * (shape.X[i] - FreePositions[i]);
                double mass = _diagonal[i];
                Vector3d force = mass * a;
                if (i < _coupling.Length)
                {
                    Vector3d b = perSquare * (shape.X[i + 1] - FreePositions[i + 1]);
                    double coupling = _coupling[i];
                    force += coupling * b;
                    gradient[i + 1].X1 += coupling * a.X;
                    gradient[i + 1].X2 += coupling * a.Y;
                    gradient[i + 1].X3 += coupling * a.Z;
                    Vector3d couple = Couple(shape.Q[i], i);
                    gradient[i].T1 += couple.X;
                    gradient[i].T2 += couple.Y;
                    gradient[i].T3 += couple.Z;
                }
                gradient[i].X1 += force.X;
                gradient[i].X2 += force.Y;
                gradient[i].X3 += force.Z;
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            AddGradient(shape, gradient, from, to);
            double perSquare = 1.0 / (StageLength * StageLength);
            int end = Math.Min(to, _coupling.Length);
            for (int i = from; i < end; i++)
            {
                ref RodBlock b = ref blocks[i];
                AddMass(ref b, perSquare * _diagonal[i]);
                double coupling = perSquare * _coupling[i];
                b.D11 += coupling;
                b.D22 += coupling;
                b.D33 += coupling;
                double rotary = perSquare * _rotary[i];
                b.C11 += rotary;
                b.C22 += rotary;
                b.C33 += 2.0 * rotary;
            }
            if (end < to)
            {
                AddMass(ref blocks[end], perSquare * _diagonal[end]);
            }
        }

        private static void AddMass(ref RodBlock b, double mass)
        {
            b.A11 += mass;
            b.A22 += mass;
            b.A33 += mass;
        }

        /// <summary>I (w - w^)/h + w x I w.</summary>
        [MethodImpl(Compiled.AtOnce)]
        private Vector3d Couple(in Quaterniond orientation, int j)
        {
            Vector3d w = Spin(orientation, j);
            Vector3d rate = (1.0 / StageLength) * (w - SpinHistory[j]);
            double i = _rotary[j];
            return new Vector3d(i * (rate.X + w.Y * w.Z), i * (rate.Y - w.X * w.Z), 2.0 * i * rate.Z);
        }
    }
}
