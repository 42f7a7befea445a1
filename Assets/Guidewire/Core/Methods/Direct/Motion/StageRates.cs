using System;

namespace Guidewire.Core
{
    /// <summary>The rates of a rod in the stages of a step, and what a Runge-Kutta scheme makes of them: y_i = y_0 +
    /// dt sum a_ik y'_k for y = x, v, phi and w.</summary>
    /// <remarks>Where a scheme's first stage is explicit, its rates are those at the step's start: x' = v, phi' = w
    /// (phi = 0 there), v' and w' of the last stage before.</remarks>
    internal sealed class StageRates
    {
        private readonly Vector3d[][] _velocity;      // by stage: x'
        private readonly Vector3d[][] _acceleration;  // v'
        private readonly Vector3d[][] _turnRate;      // phi'
        private readonly Vector3d[][] _spinRate;      // w'; two or more, the second the step before of one stage
        private readonly int _last;
        private readonly RodShape _shape;             // of the rod

        /// <summary>Rates of a rod in these stages, all 0.</summary>
        public StageRates(int stageCount, RodShape shape)
        {
            _last = stageCount - 1;
            _shape = shape;
            _velocity = Arrays(stageCount, shape.X.Length);
            _acceleration = Arrays(stageCount, shape.X.Length);
            _turnRate = Arrays(stageCount, shape.Q.Length);
            _spinRate = Arrays(Math.Max(stageCount, 2), shape.Q.Length);
        }

        private int Elements => _shape.ElementCount;

        private int Nodes => _shape.ElementCount + 1;

        /// <summary>v' by stage, m/s^2.</summary>
        public Vector3d[][] Acceleration => _acceleration;

        /// <summary>w' by stage, rad/s^2.</summary>
        public Vector3d[][] SpinRate => _spinRate;

        /// <summary>Forgets all stages.</summary>
        public void Clear()
        {
            Clear(_acceleration);
            Clear(_spinRate);
        }

        private static void Clear(Vector3d[][] rates)
        {
            foreach (Vector3d[] list in rates)
            {
                Array.Clear(list, 0, list.Length);
            }
        }

        /// <summary>Takes the rates at a step's start as those of the first stage.</summary>
        /// <param name="fromLast">Whether v' and w' are those of the last stage; else they are already set.</param>
        public void SetFirst(Vector3d[] velocities, Vector3d[] spins, bool fromLast)
        {
            Array.Copy(velocities, _velocity[0], Nodes);
            Array.Copy(spins, _turnRate[0], Elements);
            if (fromLast)
            {
                Array.Copy(_acceleration[_last], _acceleration[0], Nodes);
                Array.Copy(_spinRate[_last], _spinRate[0], Elements);
            }
        }

        /// <summary>Sets what a stage has from those before it.</summary>
        /// <param name="inertia">Its step has begun and its stage length is set; receives the stage.</param>
        /// <param name="row">a_ik; its length is the stage's index plus 1.</param>
        /// <param name="velocityHistory">Receives v^, m/s.</param>
        public void Prepare(InertiaEnergy inertia, double[] row, double dt, Vector3d[] positions,
            Vector3d[] velocities, Vector3d[] spins, Vector3d[] velocityHistory)
        {
            int before = row.Length - 1;
            double h = inertia.StageLength;
            Vector3d[] free = inertia.FreePositions;
            Array.Copy(positions, free, Nodes);
            Array.Copy(velocities, velocityHistory, Nodes);
            Array.Clear(inertia.TurnHistory, 0, Elements);
            Array.Copy(spins, inertia.SpinHistory, Elements);
            for (int k = 0; k < before; k++)
            {
                double weight = dt * row[k];
                Add(free, weight, _velocity[k], Nodes);
                Add(velocityHistory, weight, _acceleration[k], Nodes);
                Add(inertia.TurnHistory, weight, _turnRate[k], Elements);
                Add(inertia.SpinHistory, weight, _spinRate[k], Elements);
            }
            Add(free, h, velocityHistory, Nodes);
        }

        private static void Add(Vector3d[] sum, double weight, Vector3d[] rate, int count)
        {
            for (int i = 0; i < count; i++)
            {
                sum[i] += weight * rate[i];
            }
        }

        /// <summary>Takes the rates of a stage that is solved.</summary>
        /// <param name="isSecondStep">For a scheme of one stage: whether there is a step before.</param>
        public void Record(int stage, RodShape shape, InertiaEnergy inertia, Vector3d[] velocityHistory,
            bool isSecondStep)
        {
            if (_last == 0)
            {
                Array.Copy(_spinRate[0], _spinRate[1], shape.ElementCount);
            }
            double h = inertia.StageLength;
            double perStage = 1.0 / h;
            for (int i = 0; i < Nodes; i++)
            {
                Vector3d a = (perStage * perStage) * (shape.X[i] - inertia.FreePositions[i]);
                _acceleration[stage][i] = a;
                _velocity[stage][i] = velocityHistory[i] + h * a;
            }
            inertia.SetRates(shape, _turnRate[stage], _spinRate[stage]);
            if (_last == 0 && !isSecondStep)
            {
                // At the first step the rates of the step before it are taken equal to its own.
                Array.Copy(_spinRate[0], _spinRate[1], shape.ElementCount);
            }
        }

        /// <summary>The velocities in the last stage, which ends the step.</summary>
        public void Accept(InertiaEnergy inertia, Vector3d[] velocities, Vector3d[] spins)
        {
            double h = inertia.StageLength;
            Array.Copy(_velocity[_last], velocities, Nodes);
            for (int j = 0; j < Elements; j++)
            {
                spins[j] = inertia.SpinHistory[j] + h * _spinRate[_last][j];
            }
        }

        /// <summary>How far the embedded solution is from the step's: the largest turn in radians or displacement over
        /// L.</summary>
        /// <param name="weights">b_i - b^_i.</param>
        public double Error(double[] weights, double dt, double length)
        {
            double shift = 0.0;
            double turn = 0.0;
            for (int i = 0; i < Nodes; i++)
            {
                Vector3d x = Vector3d.Zero;
                for (int k = 0; k < weights.Length; k++)
                {
                    x += weights[k] * _velocity[k][i];
                }
                shift = Math.Max(shift, x.LengthSquared);
            }
            for (int j = 0; j < Elements; j++)
            {
                Vector3d phi = Vector3d.Zero;
                for (int k = 0; k < weights.Length; k++)
                {
                    phi += weights[k] * _turnRate[k][j];
                }
                turn = Math.Max(turn, phi.LengthSquared);
            }
            return dt * Math.Max(Math.Sqrt(shift) / length, Math.Sqrt(turn));
        }

        /// <summary>Writes or restores what the next step needs.</summary>
        public void Serialize(Snapshot snapshot)
        {
            foreach (Vector3d[] acceleration in _acceleration)
            {
                snapshot.Serialize(acceleration, Nodes);
            }
            foreach (Vector3d[] spinRate in _spinRate)
            {
                snapshot.Serialize(spinRate, Elements);
            }
        }

        private static Vector3d[][] Arrays(int count, int length)
        {
            var arrays = new Vector3d[count][];
            for (int s = 0; s < count; s++)
            {
                arrays[s] = new Vector3d[length];
            }
            return arrays;
        }
    }
}
