using System;

namespace Guidewire.Core
{
    /// <summary>One step of position-and-orientation-based dynamics between walls (thesis 2.1.3): prediction, the
    /// drive's motion, collision detection, constraint solver with contacts, swept test, velocity update.</summary>
    /// <remarks>A contact plane holds near the place where it was found. So a step whose drive moves farther than half
    /// an element or a radius is done in parts, each with its own detection and solve; a part after which something
    /// would have passed a wall is solved again against the places where it met it, then halved, and at the end
    /// shortened. What the drive did not get is reported.</remarks>
    internal sealed class ContactStep : TimeStepper
    {
        private const int Resolves = 2;
        private const double SmallestPart = 1.0 / 256.0;
        private readonly double _timeStep;
        private readonly IPositionPrediction _prediction;
        private readonly IOrientationPrediction _orientationPrediction;
        private readonly IDriveMotion? _drive;
        private readonly IConstraintSolver _solver;
        private readonly IContactRule _rule;
        private readonly SweptGuard _guard;
        private readonly PassageCount _passages;
        private readonly double _longestPart;
        private readonly Vector3d[] _target;
        private readonly Vector3d[] _safe;
        private readonly Vector3d[] _unshortened;
        private readonly Quaterniond[] _targetTurn;
        private readonly Quaterniond[] _safeTurn;

        /// <param name="state">The wire.</param>
        /// <param name="parameters">dt, radius, walls.</param>
        /// <param name="prediction">How positions are predicted.</param>
        /// <param name="orientationPrediction">How orientations are predicted.</param>
        /// <param name="drive">What moves sphere 0 each step, or null where nothing does.</param>
        /// <param name="solver">What corrects the prediction; its sweeps include the rule's.</param>
        /// <param name="rule">What contacts there are and what they do.</param>
        public ContactStep(RodState state, SimulationParameters parameters, IPositionPrediction prediction,
            IOrientationPrediction orientationPrediction, IDriveMotion? drive, IConstraintSolver solver,
            IContactRule rule)
        {
            _timeStep = parameters.Method.TimeStep;
            _prediction = prediction;
            _orientationPrediction = orientationPrediction;
            _drive = drive;
            _solver = solver;
            _rule = rule;
            _guard = new SweptGuard(parameters.Scene.Walls, rule, state.SphereCount, parameters.Contact.SphereRadius);
            _passages = new PassageCount(parameters.Scene.Walls, state.ElementCount, parameters.Contact.SphereRadius);
            _longestPart = rule.GuardsSpheres
                ? Math.Min(0.5 * state.ElementLength, parameters.Contact.SphereRadius) : double.PositiveInfinity;
            _target = new Vector3d[state.SphereCount];
            _safe = new Vector3d[state.SphereCount];
            _unshortened = new Vector3d[state.SphereCount];
            _targetTurn = new Quaterniond[state.ElementCount];
            _safeTurn = new Quaterniond[state.ElementCount];
            Contacts = new ContactRecord(state.SphereCount);
        }

        /// <inheritdoc/>
        public override ContactRecord Contacts { get; }

        /// <inheritdoc/>
        public override void Advance(RodState state)
        {
            _prediction.Predict(state, _timeStep);
            _orientationPrediction.Predict(state, _timeStep);
            _drive?.Move(state);
            Array.Copy(state.PredictedPositions, _target, _target.Length);
            Array.Copy(state.PredictedOrientations, _targetTurn, _targetTurn.Length);
            Array.Copy(state.Positions, _safe, _safe.Length);
            Array.Copy(state.Orientations, _safeTurn, _safeTurn.Length);
            Contacts.StartStep();
            MoveInParts(state);
            PredictionError = Vector3d.Distance(_target[state.ElementCount], _safe[state.ElementCount]);
            _passages.EndStep(state.Positions, state.PredictedPositions);
            Contacts.Passages = _passages.Total;
            Contacts.EndStep(state, _target, _timeStep);
            VelocityUpdate.Apply(state, _timeStep);
        }

        private void MoveInParts(RodState state)
        {
            bool driven = state.InverseMasses[0] == 0.0;
            double asked = driven ? Vector3d.Distance(_target[0], state.Positions[0]) : 0.0;
            Contacts.DriveAsked += asked;
            double part = 1.0 / Math.Max(1.0, Math.Ceiling(asked / _longestPart));
            double left = 1.0;
            while (left > 0.5 * SmallestPart)
            {
                part = Math.Min(part, left);
                if (TryPart(state, part, left - part <= 0.5 * SmallestPart, part <= SmallestPart))
                {
                    left -= part;
                }
                else
                {
                    part *= 0.5;
                }
            }
        }

        private bool TryPart(RodState state, double part, bool isLast, bool shorten)
        {
            Vector3d[] p = state.PredictedPositions;
            PredictPart(state, part, isLast);
            Vector3d driveTo = p[0];
            _rule.Detect(_safe, p);
            _solver.Solve(state);
            for (int round = 0; _guard.FindImpacts(_safe, p); round++)
            {
                if (round < Resolves)
                {
                    _solver.Solve(state);
                }
                else if (!shorten)
                {
                    return false;
                }
                else
                {
                    ShortenPart(state, p);
                    break;
                }
            }
            if (state.InverseMasses[0] == 0.0)
            {
                Contacts.DriveShortfall += Vector3d.Distance(driveTo, p[0]);
            }
            _passages.AddPart(_safe, p, _rule);
            _rule.AddImpulses(Contacts.Impulses);
            Contacts.MaxPenetration = Math.Max(Contacts.MaxPenetration, _rule.Penetration(p));
            Array.Copy(p, _safe, p.Length);
            Array.Copy(state.PredictedOrientations, _safeTurn, _safeTurn.Length);
            return true;
        }

        private void PredictPart(RodState state, double part, bool isLast)
        {
            for (int i = 0; i < _safe.Length; i++)
            {
                state.PredictedPositions[i] = _safe[i] + part * (_target[i] - state.Positions[i]);
            }
            for (int j = 0; j < _safeTurn.Length; j++)
            {
                Quaterniond change = _targetTurn[j] + (-1.0) * state.Orientations[j];
                bool prescribed = isLast && state.OrientationWeights[j] == 0.0;
                state.PredictedOrientations[j] = prescribed
                    ? _targetTurn[j] : Quaterniond.Normalize(_safeTurn[j] + part * change);
            }
        }

        // What the wall took of a sphere's motion is a push of the wall.
        private void ShortenPart(RodState state, Vector3d[] p)
        {
            Array.Copy(p, _unshortened, p.Length);
            _guard.Shorten(_safe, p);
            for (int i = 0; i < p.Length; i++)
            {
                if (state.InverseMasses[i] > 0.0)
                {
                    Contacts.Impulses[i] += (1.0 / state.InverseMasses[i]) * (p[i] - _unshortened[i]);
                }
            }
        }
    }
}
