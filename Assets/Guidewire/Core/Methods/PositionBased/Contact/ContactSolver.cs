using System;

namespace Guidewire.Core
{
    /// <summary>Corrects a predicted state between walls (thesis 2.1.3, 3.1.2): collision detection, constraint solver
    /// with contacts, swept test.</summary>
    /// <remarks>A contact plane is valid near the point where it was found. So a step whose drive moves farther than
    /// half an element or a radius is done in P parts, each with its own detection and solve. A part after which
    /// something would have passed a wall is solved again against the points of impact, twice; then it and those that
    /// follow are halved, once; then it is projected off those points without regard to the other constraints, and
    /// shortened. Where that happened to two halves in succession the wire is jammed: what follows is done in whole
    /// parts, each solved once, until one passes. The displacement that the drive did not reach is reported. So a step
    /// takes at most 2 P + 1 attempts of three solves each, whatever the shape of the wire, and P + 8 solves where it
    /// is jammed throughout.</remarks>
    internal sealed class ContactSolver : IConstraintSolver
    {
        /// <summary>Names the section of its snapshot.</summary>
        public const string SectionKey = "contact";

        private const int Resolves = 2;
        private const int MaxParts = 4096;     // of a step; a drive that asks for more gets no more
        private const int MaxShortened = 2;    // halves in succession, from which on the wire is jammed
        private const int Slides = 6;
        private const int SlideIterations = 8;
        private const double SmallerStep = 0.25;
        private readonly double _timeStep;
        private readonly IConstraintSolver _solver;
        private readonly IContactSearch _search;
        private readonly IContactResponse _response;
        private readonly ContactRecord _record;
        private readonly SweptSearch _swept;
        private readonly ShortenedMotion _shortened;
        private readonly PassageCount _passages;
        private readonly WireDepth _depth;
        private readonly double _longestPart;
        private readonly Vector3d[] _target;
        private readonly Vector3d[] _safe;
        private readonly Vector3d[] _unshortened;
        private readonly Quaterniond[] _targetTurn;
        private readonly Quaterniond[] _safeTurn;

        /// <param name="state">The wire.</param>
        /// <param name="timeStep">dt in s.</param>
        /// <param name="solver">What corrects each part; its iterations include the response.</param>
        /// <param name="search">Finds the contacts.</param>
        /// <param name="response">The effect of contacts.</param>
        /// <param name="record">Receives forces and counts.</param>
        public ContactSolver(RodState state, double timeStep, IConstraintSolver solver, IContactSearch search,
            IContactResponse response, ContactRecord record)
        {
            _timeStep = timeStep;
            _solver = solver;
            _search = search;
            _response = response;
            _record = record;
            _swept = new SweptSearch(search, state.SphereCount);
            _shortened = new ShortenedMotion(_swept, state.SphereCount);
            _passages = new PassageCount(search, state.ElementCount);
            var radius = new double[state.ElementCount];
            Array.Fill(radius, search.Radius);
            _depth = new WireDepth(search, radius);
            _longestPart = search.GuardsSpheres
                ? Math.Min(0.5 * state.ElementLength, search.Radius) : double.PositiveInfinity;
            _target = new Vector3d[state.SphereCount];
            _safe = new Vector3d[state.SphereCount];
            _unshortened = new Vector3d[state.SphereCount];
            _targetTurn = new Quaterniond[state.ElementCount];
            _safeTurn = new Quaterniond[state.ElementCount];
            _record.MaxPenetration = _depth.Deepest(state.Positions, 0.0);
        }

        /// <inheritdoc/>
        public void Solve(RodState state)
        {
            Array.Copy(state.PredictedPositions, _target, _target.Length);
            Array.Copy(state.PredictedOrientations, _targetTurn, _targetTurn.Length);
            Array.Copy(state.Positions, _safe, _safe.Length);
            Array.Copy(state.Orientations, _safeTurn, _safeTurn.Length);
            _record.StartStep();
            MoveInParts(state);
            _passages.EndStep(state.Positions, state.PredictedPositions);
            _record.Passages = _passages.Total;
            _record.EndStep(state, _target, _timeStep);
        }

        /// <inheritdoc/>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.OptionalSection(SectionKey, sums =>
            {
                _passages.Serialize(sums);
                _record.Serialize(sums);
            });
        }

        private void MoveInParts(RodState state)
        {
            Vector3d start = state.Positions[0];
            Vector3d targetPosition = _target[0];
            double asked = state.InverseMasses[0] == 0.0 ? Vector3d.Distance(targetPosition, start) : 0.0;
            double most = MaxParts * _longestPart;
            if (asked > most)
            {
                _target[0] = Vector3d.Lerp(start, targetPosition, most / asked);
            }
            int parts = (int)Math.Max(1.0, Math.Ceiling(Math.Min(asked, most) / _longestPart));
            int left = 2 * parts;
            int halves = 2;
            int shortened = 0;    // parts in succession
            while (left > 0)
            {
                bool isJammed = shortened >= MaxShortened;
                int size = Math.Min(isJammed ? 2 : halves, left);
                PredictPart(state, size / (2.0 * parts), size == left);
                if (TryPart(state, size == 1, isJammed, out bool isShortened))
                {
                    shortened = isShortened ? shortened + 1 : 0;
                    left -= size;
                    EndPart(state.PredictedPositions, left == 0);
                    Array.Copy(state.PredictedOrientations, _safeTurn, _safeTurn.Length);
                }
                else
                {
                    halves = 1;
                }
            }
            _record.AddDrive(asked, asked > 0.0 ? Vector3d.Distance(targetPosition, state.PredictedPositions[0]) : 0.0);
        }

        // False where it would have passed a wall and a smaller part may not.
        private bool TryPart(RodState state, bool isSmallest, bool isJammed, out bool isShortened)
        {
            isShortened = false;
            Vector3d[] p = state.PredictedPositions;
            _search.Find(_safe, p);
            _response.Start(_search, _safe, p);
            _solver.Solve(state);
            for (int round = 0; _swept.Find(_safe, p); round++)
            {
                if (round < Resolves && !isJammed)
                {
                    _response.Stop(_swept.Impacts);
                    _solver.Solve(state);
                }
                else if (!isSmallest && !isJammed)
                {
                    return false;
                }
                else
                {
                    ShortenPart(state, p);
                    isShortened = true;
                    break;
                }
            }
            return true;
        }

        private void EndPart(Vector3d[] p, bool isLast)
        {
            _passages.AddPart(_safe, p);
            _response.AddImpulses(_record.Impulses);
            if (isLast)
            {
                _record.MaxPenetration = _depth.Deepest(_safe, p, _record.MaxPenetration);
            }
            Array.Copy(p, _safe, p.Length);
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

        // Projected off the wall, the wire may slide along it; held spheres follow their prescribed motion. The part of
        // a sphere's motion that the wall removed is an impulse of the wall.
        private void ShortenPart(RodState state, Vector3d[] p)
        {
            bool isFree = false;
            for (int slide = 0; slide < Slides && !isFree; slide++)
            {
                _response.Stop(_swept.Impacts);
                ShortenHeld(state, p);
                for (int iteration = 0; iteration < SlideIterations; iteration++)
                {
                    _response.IterateStops(p);
                }
                isFree = !_swept.Find(_safe, p);
                if (!isFree)
                {
                    Array.Copy(p, _unshortened, p.Length);
                    TakeSmallerSteps(p);
                    AddImpulses(state, p);
                }
            }
            if (!isFree)
            {
                Array.Copy(p, _unshortened, p.Length);
                _shortened.Shorten(_safe, p);
                AddImpulses(state, p);
            }
        }

        private void AddImpulses(RodState state, Vector3d[] p)
        {
            for (int i = 0; i < p.Length; i++)
            {
                if (state.InverseMasses[i] > 0.0)
                {
                    _record.Impulses[i] += (1.0 / state.InverseMasses[i]) * (p[i] - _unshortened[i]);
                }
            }
        }

        // Along a curved wall a long displacement leaves the plane of a stop by its square: a quarter of it, by a
        // sixteenth.
        private void TakeSmallerSteps(Vector3d[] p)
        {
            for (int k = 0; k < _swept.Impacts.Count; k++)
            {
                int first = _swept.Impacts[k].Index;
                int last = _swept.Impacts[k].IsElement ? first + 1 : first;
                for (int i = first; i <= last; i++)
                {
                    p[i] = Vector3d.Lerp(_safe[i], p[i], SmallerStep);
                }
            }
        }

        private void ShortenHeld(RodState state, Vector3d[] p)
        {
            for (int i = 0; i < p.Length; i++)
            {
                if (state.InverseMasses[i] == 0.0)
                {
                    _shortened.ShortenSphere(_safe, p, i);
                }
            }
        }
    }
}
