using System;

namespace Guidewire.Core
{
    /// <summary>Counts points of the wire that are inside before a step and outside after it, ten per element (s = 0,
    /// 0.1, ... 0.9) and the last sphere. Leaving through an open rim is no passage.</summary>
    /// <remarks>Where a point left is decided in each part of a step: the straight line between a whole step's ends may
    /// cut the corner of a rim around which the wire really went. In a part, a point has left across a wall where it
    /// was inside, is outside, and its straight path meets the wall itself and not the disc of a rim, nor does the path
    /// back along the wire through that disc lead there. Only the points of an element that moved by as much as its
    /// distance from the wall are tested.</remarks>
    internal sealed class PassageCount
    {
        private const int SamplesPerElement = 10;
        private const int Halvings = 40;  // from a tenth of an element to less than a clearance
        private readonly IWallClearance _bounds;
        private readonly ContactShape[] _walls;
        private double _clearance;
        private int _elements;
        private readonly int[] _hint;     // where the nearest point was, per wall and element
        private readonly bool[] _left;    // whether a point left across a wall in this step, per wall and point

        /// <param name="bounds">Walls, radius, and the distances of elements where a part of a step begins.</param>
        /// <param name="elementCount">n.</param>
        public PassageCount(IWallClearance bounds, int elementCount)
        {
            _bounds = bounds;
            _walls = bounds.Walls;
            _hint = new int[_walls.Length * elementCount];
            _left = new bool[_walls.Length * PointsOf(elementCount)];
            Remesh(elementCount);
        }

        /// <summary>The wire has so many elements, at most those that this is made for.</summary>
        public void Remesh(int elementCount)
        {
            _elements = elementCount;
            _clearance = SweptSearch.ClearanceFor(_bounds.Radius);
            Array.Fill(_hint, -1);
        }

        /// <summary>Counts the passages so far.</summary>
        public long Total { get; private set; }

        /// <summary>Takes note of the points that leave across a wall in one part of a step.</summary>
        /// <param name="from">Where the part starts, n + 1 positions in units.</param>
        /// <param name="to">Where it ends.</param>
        public void AddPart(Vector3d[] from, Vector3d[] to)
        {
            for (int w = 0; w < _walls.Length; w++)
            {
                AddPart(w, from, to);
            }
        }

        /// <summary>Takes note of the points that leave across wall w, at these positions as that wall sees
        /// them.</summary>
        public void AddPart(int w, Vector3d[] from, Vector3d[] to)
        {
            int n = _elements;
            for (int j = 0; j < n; j++)
            {
                double motion = Math.Max(Vector3d.Distance(from[j], to[j]), Vector3d.Distance(from[j + 1], to[j + 1]));
                ref int hint = ref _hint[w * n + j];
                if (motion >= _bounds.ClearanceOf(w, j) && !_walls[w].Holds(to[j], to[j + 1], ref hint)
                    && _walls[w].MayMeet(from[j], from[j + 1], to[j], to[j + 1], _clearance, ref hint))
                {
                    MarkElement(w, from, to, j);
                }
            }
        }

        /// <summary>A step begins: marks of an abandoned attempt are cleared.</summary>
        public void BeginStep() => Array.Clear(_left, 0, _left.Length);

        /// <summary>Writes into a snapshot, or restores from one, the passages so far.</summary>
        public void Serialize(Snapshot snapshot) => Total = snapshot.Serialize(Total);

        /// <summary>Counts those of the whole step, from x_k to x_{k+1} in units.</summary>
        public void EndStep(Vector3d[] from, Vector3d[] to)
        {
            for (int w = 0; w < _walls.Length; w++)
            {
                EndStep(w, from, to);
            }
        }

        /// <summary>Counts the passages through wall w in the whole step, at these positions as that wall sees
        /// them.</summary>
        public void EndStep(int w, Vector3d[] from, Vector3d[] to)
        {
            int points = PointsOf(_elements);
            int end = (w + 1) * points;
            for (int at = Array.IndexOf(_left, true, w * points, points); at >= 0;
                at = Array.IndexOf(_left, true, at + 1, end - at - 1))
            {
                ContactShape wall = _walls[w];
                if (wall.Contains(Point(from, at % points)) && !wall.Contains(Point(to, at % points))
                    && !LeadsOut(wall, to))
                {
                    Total++;
                }
                _left[at] = false;
            }
        }

        // Whether the wire, one end of which is inside, meets the wall nowhere: what is outside then left by a rim,
        // whatever lay on the straight path of a long step.
        private bool LeadsOut(ContactShape wall, Vector3d[] x)
        {
            bool isWhole = wall.Contains(x[0]) || wall.Contains(x[_elements]);
            for (int j = 0; j < _elements && isWhole; j++)
            {
                isWhole = IsFree(wall, x[j], x[j + 1]);
            }
            return isWhole;
        }

        // Whether the wire led from point k out through the disc of a rim, and from there a straight line leads to
        // where the point is now: an end that is drawn out and aside leaves by the rim, though its straight line cuts
        // the lip. Beside the vessel no straight line from the disc leads.
        private bool LeavesByRim(ContactShape wall, Vector3d[] from, int k, in Vector3d after) =>
            LeavesByRim(wall, from, k, -1, after) || LeavesByRim(wall, from, k, 1, after);

        private bool LeavesByRim(ContactShape wall, Vector3d[] from, int k, int sense, in Vector3d after)
        {
            Vector3d before = Point(from, k);
            Vector3d inside = before;
            int points = PointsOf(_elements);
            for (int i = k + sense; i >= 0 && i < points; i += sense)
            {
                Vector3d next = Point(from, i);
                if (!IsFree(wall, inside, next))
                {
                    return false;
                }
                if (!wall.Contains(next))
                {
                    Vector3d disc = Border(wall, inside, next);
                    return IsFree(wall, before, disc) && IsFree(wall, disc, after);
                }
                inside = next;
            }
            return false;
        }

        // Where a straight line from a point inside to one outside leaves, by bisection, on the outer side.
        private static Vector3d Border(ContactShape wall, Vector3d inside, Vector3d outside)
        {
            for (int halving = 0; halving < Halvings; halving++)
            {
                Vector3d middle = Vector3d.Lerp(inside, outside, 0.5);
                if (wall.Contains(middle))
                {
                    inside = middle;
                }
                else
                {
                    outside = middle;
                }
            }
            return outside;
        }

        private bool IsFree(ContactShape wall, in Vector3d a, in Vector3d b)
        {
            int hint = -1;
            return !wall.Nearest(a, b, _clearance, ref hint, out SurfaceContact contact)
                || wall.UnsignedDistance(contact.Distance) > _clearance;
        }

        private void MarkElement(int w, Vector3d[] from, Vector3d[] to, int j)
        {
            int n = _elements;
            int end = j + 1 == n ? PointsOf(n) : (j + 1) * SamplesPerElement;
            for (int k = j * SamplesPerElement; k < end; k++)
            {
                Vector3d before = Point(from, k);
                Vector3d after = Point(to, k);
                int hint = _hint[w * n + j];
                if (_walls[w].Nearest(before, after, _clearance, ref hint, out _) && _walls[w].Contains(before)
                    && !_walls[w].Contains(after) && !LeavesByRim(_walls[w], from, k, after))
                {
                    _left[w * PointsOf(n) + k] = true;
                }
            }
        }

        private static int PointsOf(int elementCount) => elementCount * SamplesPerElement + 1;

        private Vector3d Point(Vector3d[] x, int k)
        {
            int j = Math.Min(k / SamplesPerElement, _elements - 1);
            return Vector3d.Lerp(x[j], x[j + 1], (double)(k - j * SamplesPerElement) / SamplesPerElement);
        }
    }

    /// <summary>Detects when the tip of a wire leaves a vessel by an open rim or end, beyond which no wall is near:
    /// inside before a step, outside after it, and no passage in it. A tip that is drawn back into a sheath or a
    /// catheter has not left.</summary>
    internal sealed class RimMonitor
    {
        private readonly ContactShape[] _walls;
        private readonly Func<ContactShape, WallField?, bool> _isCovered;    // by what is not outside
        private readonly Func<int, WallField?> _fieldOf;
        private readonly bool[] _isInside;    // the tip, by wall
        private long _passages;
        private bool _hasLeft;
        private Vector3d _position;              // of the tip where it first was outside, units
        private double _time;                 // s

        /// <summary>A monitor of these walls; <see cref="Begin"/> says where the tip is.</summary>
        /// <param name="isCovered">Whether the tip is in a sheath, or in a catheter with its tip within a wall.</param>
        /// <param name="fieldOf">Where a wall is that moves; null where it stands still.</param>
        public RimMonitor(ContactShape[] walls, Func<ContactShape, WallField?, bool> isCovered,
            Func<int, WallField?> fieldOf)
        {
            (_isCovered, _fieldOf) = (isCovered, fieldOf);
            _walls = walls;
            _isInside = new bool[walls.Length];
        }

        /// <summary>Where and when the tip left first, or null.</summary>
        public RunWarning? Warning => _hasLeft
            ? WarningTable.OpenRim.With(_position.X, _position.Y, _position.Z, _time) : (RunWarning?)null;

        /// <summary>The wire is in this state.</summary>
        public void Begin(RodState state)
        {
            Vector3d tip = state.Positions[state.ElementCount];
            for (int w = 0; w < _walls.Length; w++)
            {
                _isInside[w] = IsWithin(w, tip);
            }
        }

        /// <summary>Takes the state at the end of a step.</summary>
        /// <param name="time">s.</param>
        public void Update(RodState state, ContactRecord? contacts, double time)
        {
            Vector3d tip = state.Positions[state.ElementCount];
            long passages = contacts?.Passages ?? 0;
            for (int w = 0; w < _walls.Length && !_hasLeft; w++)
            {
                bool wasInside = _isInside[w];
                _isInside[w] = IsWithin(w, tip)
                    || wasInside && _isCovered(_walls[w], _fieldOf(w));
                if (wasInside && !_isInside[w] && passages == _passages && tip.IsFinite)
                {
                    _hasLeft = true;
                    _position = tip;
                    _time = time;
                }
            }
            _passages = passages;
        }

        private bool IsWithin(int w, in Vector3d tip) =>
            _walls[w].IsWithin(_fieldOf(w)?.AtRest(tip) ?? tip);

        /// <summary>Writes or restores what was seen.</summary>
        /// <param name="state">Where the wire is.</param>
        public void Serialize(Snapshot snapshot, RodState state)
        {
            snapshot.Serialize(ref _passages);
            snapshot.Serialize(ref _hasLeft);
            snapshot.Serialize(ref _position);
            snapshot.Serialize(ref _time);
            Begin(state);
        }
    }
}
