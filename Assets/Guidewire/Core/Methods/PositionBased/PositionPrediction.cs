using System;

namespace Guidewire.Core
{
    /// <summary>Prediction of the positions without constraints: from x, v and forces to p. A sphere of inverse mass 0
    /// stays where it is (thesis 3.1.4); its drive moves it afterwards.</summary>
    internal interface IPositionPrediction
    {
        /// <summary>Writes <see cref="RodState.PredictedPositions"/>.</summary>
        /// <param name="state">Its positions, velocities and forces are read.</param>
        /// <param name="timeStep">dt in s.</param>
        void Predict(RodState state, double timeStep);

        /// <summary>Writes into a snapshot, or restores from one, what it remembers of earlier steps; from a
        /// prediction of its kind and the same step size only.</summary>
        void Serialize(Snapshot snapshot, double timeStep);
    }

    /// <summary>Prediction of the orientations without constraints.</summary>
    internal interface IOrientationPrediction
    {
        /// <summary>Writes <see cref="RodState.PredictedOrientations"/>.</summary>
        /// <param name="state">Its orientations and angular velocities are read.</param>
        /// <param name="timeStep">dt in s.</param>
        void Predict(RodState state, double timeStep);

        /// <summary>Writes into a snapshot, or restores from one, what it remembers of earlier steps; from a
        /// prediction of its kind and the same step size only.</summary>
        void Serialize(Snapshot snapshot, double timeStep);
    }

    /// <summary>v = (1 - d) v_k + dt (w f + g), p = x_k + dt v (thesis eqs. 2.5, 2.6, with the new velocity).</summary>
    /// <remarks>Because v_k = (x_k - x_{k-1})/dt after every step, this is Verlet's formula to rounding; the two differ
    /// where a velocity is not that quotient (at the start) or dt changes.</remarks>
    internal sealed class EulerPrediction : IPositionPrediction
    {
        private readonly double _damping;
        private readonly Vector3d _gravity;

        /// <param name="damping">d in [0, 1], dimensionless, a step.</param>
        /// <param name="gravity">g in unit/s^2.</param>
        public EulerPrediction(double damping, in Vector3d gravity)
        {
            _damping = damping;
            _gravity = gravity;
        }

        /// <inheritdoc/>
        public void Predict(RodState state, double timeStep)
        {
            for (int i = 0; i < state.SphereCount; i++)
            {
                double w = state.InverseMasses[i];
                if (w == 0.0)
                {
                    state.PredictedPositions[i] = state.Positions[i];
                    continue;
                }
                Vector3d v = (1.0 - _damping) * state.Velocities[i] + timeStep * (w * state.Forces[i] + _gravity);
                state.PredictedPositions[i] = state.Positions[i] + timeStep * v;
            }
        }

        /// <inheritdoc/>
        public void Serialize(Snapshot snapshot, double timeStep) => snapshot.Section("Euler", _ => { });
    }

    /// <summary>q = q_k + dt/2 q_k (0, omega), normalised, with omega in the element's own frame
    /// (Kugelstadt and Schoemer 2016, section 4). Orientations carry no torque of their own and no damping.</summary>
    internal sealed class OrientationEulerPrediction : IOrientationPrediction
    {
        /// <inheritdoc/>
        public void Predict(RodState state, double timeStep)
        {
            for (int j = 0; j < state.ElementCount; j++)
            {
                Quaterniond q = state.Orientations[j];
                Quaterniond spin = q * Quaterniond.Pure(state.AngularVelocities[j]);
                state.PredictedOrientations[j] = Quaterniond.Normalize(q + (0.5 * timeStep) * spin);
            }
        }

        /// <inheritdoc/>
        public void Serialize(Snapshot snapshot, double timeStep) => snapshot.Section("Euler, orientations", _ => { });
    }

    /// <summary>p = (2 - d) x_k - (1 - d) x_{k-1} + dt^2 (w f + g) (thesis eq. 2.7 with damping d); the first step,
    /// which has no x_{k-1}, by Euler.</summary>
    internal sealed class VerletPrediction : IPositionPrediction
    {
        private readonly double _damping;
        private readonly Vector3d _gravity;
        private readonly EulerPrediction _firstStep;
        private bool _started;

        /// <param name="damping">d in [0, 1], dimensionless, a step.</param>
        /// <param name="gravity">g in unit/s^2.</param>
        public VerletPrediction(double damping, in Vector3d gravity)
        {
            _damping = damping;
            _gravity = gravity;
            _firstStep = new EulerPrediction(damping, gravity);
        }

        /// <inheritdoc/>
        public void Predict(RodState state, double timeStep)
        {
            if (!_started)
            {
                _started = true;
                _firstStep.Predict(state, timeStep);
                return;
            }
            for (int i = 0; i < state.SphereCount; i++)
            {
                double w = state.InverseMasses[i];
                state.PredictedPositions[i] = w == 0.0
                    ? state.Positions[i]
                    : (2.0 - _damping) * state.Positions[i] - (1.0 - _damping) * state.PreviousPositions[i]
                        + (timeStep * timeStep) * (w * state.Forces[i] + _gravity);
            }
        }

        /// <inheritdoc/>
        public void Serialize(Snapshot snapshot, double timeStep) =>
            snapshot.Section("Verlet", history => history.Serialize(ref _started), timeStep);
    }

    /// <summary>q = 2 q_k - q_(k-1), normalised: Verlet's formula (thesis eq. 2.7) for orientations, the question that
    /// the thesis leaves open; the first step by Euler.</summary>
    /// <remarks>With r = conj(q_(k-1)) q_k = (v, w) the last turn, this is q_k (2 - w + v), and Euler's q_k (1 + v),
    /// since omega = (2/dt) v. Turning on by r itself would be q_k (w + v). The three turn by half angles whose
    /// tangents are |v|/(2 - w), |v| and |v|/w: they differ in third order of the turn in a step, 1e-6 of it at a tenth
    /// of a degree.</remarks>
    internal sealed class OrientationVerletPrediction : IOrientationPrediction
    {
        private readonly OrientationEulerPrediction _firstStep = new OrientationEulerPrediction();
        private readonly Quaterniond[] _previous;
        private bool _started;

        /// <param name="elementCount">n.</param>
        public OrientationVerletPrediction(int elementCount)
        {
            _previous = new Quaterniond[elementCount];
        }

        /// <inheritdoc/>
        public void Predict(RodState state, double timeStep)
        {
            if (!_started)
            {
                _started = true;
                Array.Copy(state.Orientations, _previous, _previous.Length);
                _firstStep.Predict(state, timeStep);
                return;
            }
            for (int j = 0; j < _previous.Length; j++)
            {
                Quaterniond q = state.Orientations[j];
                // q and -q are the same orientation: the one nearer to the present is meant.
                Quaterniond relative = _previous[j].Conjugate * q;
                double sign = relative.W < 0.0 ? 1.0 : -1.0;
                state.PredictedOrientations[j] = Quaterniond.Normalize(2.0 * q + sign * _previous[j]);
                _previous[j] = q;
            }
        }

        /// <inheritdoc/>
        public void Serialize(Snapshot snapshot, double timeStep)
        {
            snapshot.Section("Verlet, orientations", history =>
            {
                history.Serialize(ref _started);
                history.Serialize(_previous);
            }, timeStep);
        }
    }
}
