using System;
using System.Runtime.CompilerServices;
#if NET8_0_OR_GREATER
using System.Runtime.Intrinsics;
#endif

namespace Guidewire.Core
{
    /// <summary>What one implicit stage of length h adds to the energy: 1/2 (x - x~)^T M (x - x~)/h^2 for the nodes
    /// and the rotary inertia of the elements. With it the stage's motion is the energy's minimum.</summary>
    /// <remarks>Nodes: a = (x - x~)/h^2 is the stage's acceleration, x~ = x^ + h v^. Elements: the turn since the
    /// step's start is phi = log(conj(q_start) q); w = J(phi) (phi - phi^)/h is the angular velocity along the
    /// element's axes, and I (w - w^)/h + w x I w + a I w is its couple, I = l diag(rho I1, rho I2, rho (I1 + I2)), a
    /// the damping of turns in proportion to mass. This couple has no potential; it enters by its work since the
    /// anchor, with (1 + a h) I/h^2 as second derivative, which leaves out terms of order |phi| I/h^2.</remarks>
    internal sealed class InertiaEnergy : EnergyTerm
    {
        private const double SurelyFirst = 4.0;  // radians squared: below it the shortest rotation vector is meant

        private readonly double[] _diagonal;  // of the mass matrix, kg, n+1
        private readonly double[] _coupling;  // between nodes i and i+1, kg, n
        private readonly Vector3d[] _rotary;  // I, kg m^2, n
        private readonly RodMass _mass;
        private readonly Quaterniond[] _anchor;
        private readonly Vector3d[] _anchorCouple;
        private double _nodes;                // energy of the nodes in the shape whose value was asked last, J
        private readonly Quaterniond[] _seen;      // orientations whose couples are known in this stage
        private readonly Vector3d[] _couple;         // found last, N m
        private readonly Vector3d[] _countedTurn;  // phi with its full turns, in the shape that was last evaluated
        private readonly Vector3d[] _keptTurn;

        /// <summary>Makes the inertia of a rod.</summary>
        public InertiaEnergy(RodMass mass)
        {
            _diagonal = mass.Diagonal;
            _coupling = mass.Coupling;
            _rotary = mass.Rotary;
            _mass = mass;
            int n = _rotary.Length;    // room
            _anchor = new Quaterniond[n];
            _anchorCouple = new Vector3d[n];
            _seen = new Quaterniond[n];
            _couple = new Vector3d[n];
            _countedTurn = new Vector3d[n];
            _keptTurn = new Vector3d[n];
            Start = new Quaterniond[n];
            FreePositions = new Vector3d[n + 1];
            TurnHistory = new Vector3d[n];
            SpinHistory = new Vector3d[n];
        }

        /// <inheritdoc/>
        public override void Remesh()
        {
            StageLength = 0.0;
            Array.Clear(_seen, 0, _seen.Length);
            Array.Clear(_countedTurn, 0, _countedTurn.Length);
            Array.Clear(FreePositions, 0, FreePositions.Length);
            Array.Clear(TurnHistory, 0, TurnHistory.Length);
            Array.Clear(SpinHistory, 0, SpinHistory.Length);
            Array.Clear(Start, 0, Start.Length);
        }

        private int Elements => _mass.ElementCount;

        /// <summary>h, s: the diagonal coefficient of the scheme times the time step.</summary>
        public double StageLength { get; set; }

        /// <summary>a, 1/s; that of the nodes is in <see cref="RodDamping"/>.</summary>
        public double TurnDamping { get; set; }

        /// <summary>Orientations at the start of the step, from which phi counts.</summary>
        public Quaterniond[] Start { get; }

        /// <summary>x~, where the nodes would go without forces, m.</summary>
        public Vector3d[] FreePositions { get; }

        /// <summary>phi^, the turn that earlier stages have contributed, radians.</summary>
        public Vector3d[] TurnHistory { get; }

        /// <summary>w^, the angular velocity that earlier stages have contributed, rad/s.</summary>
        public Vector3d[] SpinHistory { get; }

        /// <summary>Turns count from the orientations of this shape.</summary>
        public override void BeginStep(RodShape shape, double dt)
        {
            Array.Copy(shape.Q, Start, Elements);
            Array.Clear(_countedTurn, 0, Elements);
        }

        /// <summary>Stores the full turns of the shape that was last evaluated.</summary>
        public void KeepTurns() => Array.Copy(_countedTurn, _keptTurn, Elements);

        /// <summary>Turns are counted from those again that were kept.</summary>
        public void RestoreTurns() => Array.Copy(_keptTurn, _countedTurn, Elements);

        /// <summary>Whether a couple is kept until an element turns on: a search along the energy asks for each up to
        /// three times, a free iteration once.</summary>
        public bool RemembersCouples { get; set; }

        /// <summary>A stage begins: its length and what earlier stages have contributed are set.</summary>
        public void BeginStage()
        {
            if (RemembersCouples)
            {
                Array.Clear(_seen, 0, Elements);
            }
        }

        /// <summary>phi' and w' of the stage in this shape, by which its turns and angular velocities have grown over
        /// what earlier stages contributed.</summary>
        /// <param name="turnRate">Receives phi', rad/s, n.</param>
        /// <param name="spinRate">Receives w', rad/s^2, n.</param>
        public void SetRates(RodShape shape, Vector3d[] turnRate, Vector3d[] spinRate)
        {
            double perStage = 1.0 / StageLength;
            int j = 0;
            while (j < Elements)
            {
                int stop = Math.Min(j + 4, Elements);
                if (stop == j + 4
                    && InertiaLanes.SetRates(this, shape, _countedTurn, SurelyFirst, turnRate, spinRate, j))
                {
                    j = stop;
                }
                for (; j < stop; j++)
                {
                    Vector3d turn = Turn(shape.Q[j], j);
                    turnRate[j] = perStage * (turn - TurnHistory[j]);
                    spinRate[j] = perStage * (Spin(turn, j) - SpinHistory[j]);
                }
            }
        }

        /// <summary>Predicts orientations at the end of the stage, that of an element by w' of two stages before, w'_1
        /// + fraction (w'_2 - w'_1).</summary>
        /// <param name="first">w'_1, rad/s^2.</param>
        /// <param name="second">w'_2, rad/s^2.</param>
        /// <param name="predicted">Receives the orientations.</param>
        /// <returns>How far the turns phi are from those of the shape last evaluated at most, radians.</returns>
        public double Predict(Vector3d[] first, Vector3d[] second, double fraction, Quaterniond[] predicted)
        {
            double h = StageLength;
            double largest = 0.0;
            int j = 0;
            while (j < Elements)
            {
                int stop = Math.Min(j + 4, Elements);
                if (stop == j + 4 && InertiaLanes.Predict(
                    this, _countedTurn, first, second, fraction, predicted, j, ref largest))
                {
                    j = stop;
                }
                for (; j < stop; j++)
                {
                    Vector3d rate = first[j] + fraction * (second[j] - first[j]);
                    Vector3d turn = TurnHistory[j] + h * (SpinHistory[j] + h * rate);
                    predicted[j] = Start[j] * RotationVector.Exp(turn);
                    largest = Math.Max(largest, (turn - _countedTurn[j]).LengthSquared);
                }
            }
            return Math.Sqrt(largest);
        }

        /// <summary>Gives w_3 and w_3' of element j in this orientation.</summary>
        public void AxialSpin(in Quaterniond orientation, int j, out double spin, out double rate)
        {
            spin = Spin(Turn(orientation, j), j).Z;
            rate = (1.0 / StageLength) * (spin - SpinHistory[j].Z);
        }

        /// <summary>Shifts a rod that nothing holds, as a whole, until its inertia balances the sum of the loads (N).
        /// The shift costs no elastic energy; what Newton's last step leaves of the sum would change the
        /// momentum.</summary>
        public void Balance(RodShape shape, in Vector3d loads)
        {
            Vector3d sum = Vector3d.Zero;
            double mass = 0.0;
            for (int i = 0; i <= Elements; i++)
            {
                double fraction = _diagonal[i] + (i > 0 ? _coupling[i - 1] : 0.0)
                    + (i < Elements ? _coupling[i] : 0.0);
                sum += fraction * (shape.X[i] - FreePositions[i]);
                mass += fraction;
            }
            Vector3d shift = (1.0 / mass) * (StageLength * StageLength * loads - sum);
            for (int i = 0; i <= Elements; i++)
            {
                shape.X[i] += shift;
            }
        }

        /// <summary>phi of element j in this orientation: of all rotation vectors that lead there, the one nearest to
        /// the last that was requested in this step, so that more than half a turn a step is counted.</summary>
        private Vector3d Turn(in Quaterniond orientation, int j)
        {
            Vector3d turn = RotationVector.Log(Start[j].Conjugate * orientation);
            Vector3d last = _countedTurn[j];
            if (last.LengthSquared > SurelyFirst)
            {
                turn = RotationVector.Nearest(turn, last);
            }
            _countedTurn[j] = turn;
            return turn;
        }

        /// <summary>w of element j that has turned by phi.</summary>
        private Vector3d Spin(in Vector3d turn, int j) =>
            (1.0 / StageLength) * RotationVector.TangentMap(turn, turn - TurnHistory[j]);

        /// <summary>Writes or restores the last stage, by which forces are told between steps.</summary>
        public override void Serialize(Snapshot snapshot)
        {
            StageLength = snapshot.Serialize(StageLength);
            snapshot.Serialize(Start, Elements);
            snapshot.Serialize(FreePositions, Elements + 1);
            snapshot.Serialize(TurnHistory, Elements);
            snapshot.Serialize(SpinHistory, Elements);
            snapshot.Serialize(_countedTurn, Elements);
            BeginStage();
        }

        /// <summary>Of the nodes alone: no work of the couples yet.</summary>
        public override double AnchoredValue(double before) => _nodes;

        /// <inheritdoc/>
        public override void Anchor(RodShape shape)
        {
            Array.Copy(shape.Q, _anchor, Elements);
            FindCouples(shape, 0, Elements);
            Array.Copy(_couple, _anchorCouple, Elements);
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double perSquare = 1.0 / (StageLength * StageLength);
            double perTurn = PerTurn;
            double nodes = 0.0;
            int n = Elements;
            double turns = 0.0;
            for (int i = 0; i <= n; i++)
            {
                Vector3d d = shape.X[i] - FreePositions[i];
                nodes += 0.5 * _diagonal[i] * d.LengthSquared;
                if (i < n)
                {
                    Vector3d e = shape.X[i + 1] - FreePositions[i + 1];
                    nodes += _coupling[i] * Vector3d.Dot(d, e);
                }
            }
            _nodes = perSquare * nodes;
            int j = 0;
            while (j < Elements)
            {
                int stop = Math.Min(j + 4, Elements);
                if (stop == j + 4
                    && InertiaLanes.AddWork(_anchor, _anchorCouple, _rotary, perTurn, shape, j, ref turns))
                {
                    j = stop;
                }
                for (; j < stop; j++)
                {
                    Vector3d turn = RotationVector.Log(_anchor[j].Conjugate * shape.Q[j]);
                    Vector3d rotary = _rotary[j];
                    turns += Vector3d.Dot(_anchorCouple[j], turn) + 0.5 * perTurn * (rotary.X * turn.X * turn.X
                        + rotary.Y * turn.Y * turn.Y + rotary.Z * turn.Z * turn.Z);
                }
            }
            return _nodes + turns;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            double perSquare = 1.0 / (StageLength * StageLength);
            int n = Elements;
            int nodes = Math.Min(to, n + 1);
            int elements = Math.Min(to, n);
            FindCouples(shape, from, elements);
            int first = InertiaLanes.AddGradient(this, _diagonal, _coupling, _couple, shape, gradient, from, elements);
            for (int i = first; i < nodes; i++)
            {
                Vector3d a = perSquare * (shape.X[i] - FreePositions[i]);
                double mass = _diagonal[i];
                Vector3d force = mass * a;
                if (i < n)
                {
                    Vector3d b = perSquare * (shape.X[i + 1] - FreePositions[i + 1]);
                    double coupling = _coupling[i];
                    force += coupling * b;
                    gradient[i + 1].AddX(coupling * a);
                    Vector3d couple = _couple[i];
                    gradient[i].AddT(couple);
                }
                gradient[i].AddX(force);
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            base.AddBlocks(shape, blocks, gradient, from, to);
            double perSquare = 1.0 / (StageLength * StageLength);
            double perTurn = PerTurn;
            int end = Math.Min(to, Elements);
            for (int i = from; i < end; i++)
            {
                ref RodBlock b = ref blocks[i];
                AddMass(ref b, perSquare * _diagonal[i]);
                double coupling = perSquare * _coupling[i];
                b.D11 += coupling;
                b.D22 += coupling;
                b.D33 += coupling;
                Vector3d rotary = perTurn * _rotary[i];
                b.C11 += rotary.X;
                b.C22 += rotary.Y;
                b.C33 += rotary.Z;
            }
            if (end < to)
            {
                AddMass(ref blocks[end], perSquare * _diagonal[end]);
            }
        }

        // (1 + a h)/h^2.
        private double PerTurn => 1.0 / (StageLength * StageLength) + TurnDamping / StageLength;

        private static void AddMass(ref RodBlock b, double mass)
        {
            b.A11 += mass;
            b.A22 += mass;
            b.A33 += mass;
        }

        // I (w - w^)/h + w x I w + a I w of elements from (inclusive) to to (exclusive).
        private void FindCouples(RodShape shape, int from, int to)
        {
            int j = from;
            while (j < to)
            {
                int stop = Math.Min(j + 4, to);
                if (stop == j + 4 && IsNew(shape, j)
                    && InertiaLanes.FindCouples(this, _rotary, shape, _countedTurn, SurelyFirst, _couple, j))
                {
                    Remember(shape, j, 4);
                    j = stop;
                }
                for (; j < stop; j++)
                {
                    if (!RemembersCouples || shape.Q[j] != _seen[j])
                    {
                        _couple[j] = FindCouple(shape.Q[j], j);
                        Remember(shape, j, 1);
                    }
                }
            }
        }

        // Whether no couple of elements j to j+3 is known.
        private bool IsNew(RodShape shape, int j)
        {
            return !RemembersCouples || (shape.Q[j] != _seen[j] && shape.Q[j + 1] != _seen[j + 1]
                && shape.Q[j + 2] != _seen[j + 2] && shape.Q[j + 3] != _seen[j + 3]);
        }

        private void Remember(RodShape shape, int j, int count)
        {
            if (RemembersCouples)
            {
                Array.Copy(shape.Q, j, _seen, j, count);
            }
        }

        private Vector3d FindCouple(in Quaterniond orientation, int j)
        {
            Vector3d w = Spin(Turn(orientation, j), j);
            Vector3d rate = (1.0 / StageLength) * (w - SpinHistory[j]);
            Vector3d i = _rotary[j];
            Vector3d change = rate + _mass.Precession(j, w) + TurnDamping * w;
            return new Vector3d(i.X * change.X, i.Y * change.Y, i.Z * change.Z);
        }
    }

    /// <summary>What <see cref="InertiaEnergy"/> asks most of four successive elements, at once, with its formulas in
    /// its order: the same bits.</summary>
    /// <remarks>False where nothing is done, because one of the four has turned by more than the series can take or the
    /// processor has no such registers.</remarks>
    internal static class InertiaLanes
    {
#if NET8_0_OR_GREATER
        private const int Step = 6;   // numbers of a RodVector
#endif

        /// <summary>Sets the couples of elements j to j+3, and their turns since the step's start.</summary>
        /// <param name="surelyFirst">Square of a turn below which the shortest rotation vector is meant.</param>
        public static bool FindCouples(InertiaEnergy inertia, Vector3d[] rotary, RodShape shape, Vector3d[] countedTurn,
            double surelyFirst, Vector3d[] couple, int j)
        {
#if NET8_0_OR_GREATER
            if (!Rows4.IsSupported || !TryTurn(inertia, shape, countedTurn, surelyFirst, j, out Vector3d4 turn))
            {
                return false;
            }
            Vector256<double> perStage = Vector256.Create(1.0 / inertia.StageLength);
            Vector3d4 w = perStage
                * RotationVector4.TangentMap(turn, turn - Vector3d4.Load(ref inertia.TurnHistory[j]));
            Vector3d4 rate = perStage * (w - Vector3d4.Load(ref inertia.SpinHistory[j]));
            Vector3d4 i = Vector3d4.Load(ref rotary[j]);
            var precession = new Vector3d4(w.Y * w.Z, (w.X * w.Z) ^ Vector256.Create(-0.0),
                (i.Y - i.X) / i.Z * (w.X * w.Y));
            Vector3d4 change = rate + precession + Vector256.Create(inertia.TurnDamping) * w;
            new Vector3d4(i.X * change.X, i.Y * change.Y, i.Z * change.Z).Store(ref couple[j]);
            return true;
#else
            return false;
#endif
        }

        /// <summary>Sets phi' and w' of elements j to j+3, and their turns since the step's start.</summary>
        /// <param name="surelyFirst">Square of a turn below which the shortest rotation vector is meant.</param>
        public static bool SetRates(InertiaEnergy inertia, RodShape shape, Vector3d[] countedTurn, double surelyFirst,
            Vector3d[] turnRate, Vector3d[] spinRate, int j)
        {
#if NET8_0_OR_GREATER
            if (!Rows4.IsSupported || !TryTurn(inertia, shape, countedTurn, surelyFirst, j, out Vector3d4 turn))
            {
                return false;
            }
            Vector256<double> perStage = Vector256.Create(1.0 / inertia.StageLength);
            Vector3d4 change = turn - Vector3d4.Load(ref inertia.TurnHistory[j]);
            Vector3d4 w = perStage * RotationVector4.TangentMap(turn, change);
            (perStage * change).Store(ref turnRate[j]);
            (perStage * (w - Vector3d4.Load(ref inertia.SpinHistory[j]))).Store(ref spinRate[j]);
            return true;
#else
            return false;
#endif
        }

        /// <summary>Predicts orientations j to j+3 at the end of a stage from w' of two stages before.</summary>
        /// <param name="largest">In and out: the largest square of a change of a turn, rad^2.</param>
        public static bool Predict(InertiaEnergy inertia, Vector3d[] countedTurn, Vector3d[] first, Vector3d[] second,
            double fraction, Quaterniond[] predicted, int j, ref double largest)
        {
#if NET8_0_OR_GREATER
            if (!Rows4.IsSupported)
            {
                return false;
            }
            Vector256<double> h = Vector256.Create(inertia.StageLength);
            Vector3d4 one = Vector3d4.Load(ref first[j]);
            Vector3d4 rate = one + Vector256.Create(fraction) * (Vector3d4.Load(ref second[j]) - one);
            Vector3d4 turn = Vector3d4.Load(ref inertia.TurnHistory[j])
                + h * (Vector3d4.Load(ref inertia.SpinHistory[j]) + h * rate);
            if (!RotationVector4.TryExp(turn, out Quaterniond4 rotation))
            {
                return false;
            }
            (Quaterniond4.Load(ref inertia.Start[j]) * rotation).Store(ref predicted[j]);
            Vector256<double> squares = (turn - Vector3d4.Load(ref countedTurn[j])).LengthSquared;
            largest = Math.Max(Math.Max(Math.Max(largest, squares.GetElement(0)), squares.GetElement(1)),
                Math.Max(squares.GetElement(2), squares.GetElement(3)));
            return true;
#else
            return false;
#endif
        }

        /// <summary>Adds the gradients of nodes and elements from one on, four at a time.</summary>
        /// <param name="end">First element that does not belong to them.</param>
        /// <param name="couple">On the elements, N m.</param>
        /// <returns>The first that is left.</returns>
        public static int AddGradient(InertiaEnergy inertia, double[] diagonal, double[] coupling, Vector3d[] couple,
            RodShape shape, RodVector[] gradient, int from, int end)
        {
            int j = from;
#if NET8_0_OR_GREATER
            Vector256<double> perSquare = Vector256.Create(1.0 / (inertia.StageLength * inertia.StageLength));
            for (; Rows4.IsSupported && j + 4 <= end; j += 4)
            {
                Vector3d4 a = perSquare
                    * (Vector3d4.Load(ref shape.X[j]) - Vector3d4.Load(ref inertia.FreePositions[j]));
                Vector3d4 b = perSquare
                    * (Vector3d4.Load(ref shape.X[j + 1]) - Vector3d4.Load(ref inertia.FreePositions[j + 1]));
                Vector256<double> mixed = Vector256.LoadUnsafe(ref coupling[j]);
                Vector3d4 onNext = mixed * a;
                Vector3d4 force = Vector256.LoadUnsafe(ref diagonal[j]) * a + mixed * b;
                Vector3d4 c = Vector3d4.Load(ref couple[j]);
                Rows4.Add(ref gradient[j + 1].X1, Step, onNext.X, onNext.Y, onNext.Z, Rows4.Nothing);
                Rows4.Add(ref gradient[j].X1, Step, force.X, force.Y, force.Z, c.X);
                Rows4.Add(ref gradient[j].T2, Step, c.Y, c.Z);
            }
#endif
            return j;
        }

        /// <summary>Adds the work of the couples of elements j to j+3 since their anchor, J.</summary>
        /// <param name="perTurn">Second derivative by a turn over the rotary inertia, 1/s^2.</param>
        public static bool AddWork(Quaterniond[] anchor, Vector3d[] couple, Vector3d[] rotary, double perTurn,
            RodShape shape, int j, ref double sum)
        {
#if NET8_0_OR_GREATER
            if (!Rows4.IsSupported)
            {
                return false;
            }
            Quaterniond4 relative = Quaterniond4.Load(ref anchor[j]).Conjugate * Quaterniond4.Load(ref shape.Q[j]);
            if (!RotationVector4.TryLog(relative, out Vector3d4 turn))
            {
                return false;
            }
            Vector3d4 i = Vector3d4.Load(ref rotary[j]);
            Vector256<double> squares = i.X * turn.X * turn.X + i.Y * turn.Y * turn.Y + i.Z * turn.Z * turn.Z;
            sum = Rows4.Sum(sum, Vector3d4.Dot(Vector3d4.Load(ref couple[j]), turn)
                + Vector256.Create(0.5 * perTurn) * squares);
            return true;
#else
            return false;
#endif
        }

#if NET8_0_OR_GREATER
        // InertiaEnergy.Turn.
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private static bool TryTurn(InertiaEnergy inertia, RodShape shape, Vector3d[] countedTurn, double surelyFirst,
            int j, out Vector3d4 turn)
        {
            Quaterniond4 relative = Quaterniond4.Load(ref inertia.Start[j]).Conjugate
                * Quaterniond4.Load(ref shape.Q[j]);
            Vector256<double> last = Vector3d4.Load(ref countedTurn[j]).LengthSquared;
            if (!RotationVector4.TryLog(relative, out turn)
                || !Vector256.LessThanOrEqualAll(last, Vector256.Create(surelyFirst)))
            {
                return false;
            }
            turn.Store(ref countedTurn[j]);
            return true;
        }
#endif
    }
}
