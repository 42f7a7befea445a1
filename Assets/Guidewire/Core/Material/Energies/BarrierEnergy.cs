using System;

namespace Guidewire.Core
{
    /// <summary>Contact with walls: the <see cref="Barrier"/> of every gap between the wire's surface and a wall, over
    /// all places of the walls near each node, and all ridges of the walls that an element crosses.</summary>
    /// <remarks>The wire's surface is that of capsules, of each element's own radius; at a node the larger of its two
    /// elements'. Nodes meet walls that are flat or hollow before the elements between them do; what bulges into the
    /// free side may come between two nodes, and the elements meet it there. An element's contact at s acts on its two
    /// nodes with weights 1 - s and s. A node's second derivative is exact, without its negative part; an element's is
    /// b'' times the square of the gap's derivative.
    ///
    /// Walls are in units, all else in metres. Where the wire was when it was last looked for walls, elements farther
    /// from them than the barrier's distance and the way that they have gone since are passed over; that changes no
    /// value. What one shape comes to is kept until another is asked for.</remarks>
    internal sealed class BarrierEnergy : EnergyTerm
    {
        private const double LeftOfGap = 0.3;     // that a step leaves at least
        private const double MostLeft = 0.2;      // of the barrier's distance
        private const double PushedTo = 0.5;      // of it
        private const double LeastLever = 0.1;
        private const double TooWide = 4.0;       // times the reach that is needed
        private const double WithRoom = 1.25;     // to the way that is expected
        private const double Resolved = 1e-3;     // of the distance that is kept: an approach that is none
        private const double ResolvedOfWay = 0.05;    // the same, of the way to it
        private const double QuickShare = 0.9;    // of a gap that is only about right
        private const double SureOfQuick = 0.9;   // of a quick distance there is surely room

        private readonly ContactShape[] _walls;
        private readonly double _units;           // per metre
        private readonly double[] _nodeRadius;    // m
        private readonly double[] _elementRadius;
        private readonly Barrier _barrier;
        private readonly Vector3d[] _x;           // of the shape at hand, units
        private readonly Vector3d[] _reference;   // where the wire was last looked for walls, units
        private readonly double[] _room;          // by wall and element: from the reference to the wall, units
        private readonly bool[] _isNear;          // the same: whether the barrier may act within the reach
        private readonly int[] _hint;
        private readonly StructList<int> _features = new StructList<int>(256);
        private readonly int[] _firstFeature;     // by wall and element, and of none
        private readonly double[] _nodeGap;       // by wall and node, m, no more than the barrier's distance
        private readonly double[] _ridgeGap;      // by wall and element, between its nodes
        private readonly Vector3d[] _gradient;    // of the shape at hand, by node, N
        private readonly Symmetric3[] _own;       // (x_i, x_i), N/m
        private readonly Symmetric3[] _coupling;  // (x_i+1, x_i)
        private readonly Symmetric3[] _ownBending;      // what elements' contacts add by their second derivatives
        private readonly Symmetric3[] _couplingBending;
        private readonly Vector3d[] _couplingTurn;      // the same, t of the part v -> t x v
        private readonly Vector3d[] _resultant;   // of each wall on the wire, N
        private readonly StructList<WallPlace> _places = new StructList<WallPlace>(16);
        private readonly StructList<WallRidge> _ridges = new StructList<WallRidge>(16);
        private readonly StructList<WallContact> _contacts = new StructList<WallContact>(64);
        private double _leastReach;               // units
        private double _reach;                    // since the wire was last looked for walls
        private bool _hasReference;
        private bool _isWide;                     // the reach is that of a step of which a part may be left
        private bool _isKnown;
        private double _value;

        /// <summary>Contact of a rod with walls.</summary>
        /// <param name="rod">The wire.</param>
        /// <param name="walls">In units.</param>
        /// <param name="metresPerUnit">m.</param>
        /// <param name="barrier">Of each gap.</param>
        public BarrierEnergy(MaterialRod rod, ContactShape[] walls, double metresPerUnit, in Barrier barrier)
        {
            int n = rod.ElementCount;
            _walls = walls;
            _units = 1.0 / metresPerUnit;
            _elementRadius = rod.Radius;
            _nodeRadius = new double[n + 1];
            for (int j = 0; j < n; j++)
            {
                _nodeRadius[j] = Math.Max(_nodeRadius[j], rod.Radius[j]);
                _nodeRadius[j + 1] = rod.Radius[j];
            }
            _barrier = barrier;
            _leastReach = Math.Max(4.0 * barrier.Distance, rod.Radius[n - 1]) * _units;
            _x = new Vector3d[n + 1];
            _reference = new Vector3d[n + 1];
            _room = new double[walls.Length * n];
            _isNear = new bool[walls.Length * n];
            _firstFeature = new int[walls.Length * n + 1];
            _hint = new int[walls.Length * n];
            Array.Fill(_hint, -1);
            _nodeGap = new double[walls.Length * (n + 1)];
            _ridgeGap = new double[walls.Length * n];
            _gradient = new Vector3d[n + 1];
            _own = new Symmetric3[n + 1];
            _coupling = new Symmetric3[n];
            _ownBending = new Symmetric3[n + 1];
            _couplingBending = new Symmetric3[n];
            _couplingTurn = new Vector3d[n];
            _resultant = new Vector3d[walls.Length];
        }

        /// <summary>Whether the second derivatives of elements' contacts have the part that goes with their force, which
        /// need not be positive.</summary>
        public bool HasBending { get; set; } = true;

        /// <summary>The walls, in units.</summary>
        public ContactShape[] Walls => _walls;

        /// <summary>b.</summary>
        public Barrier Barrier => _barrier;

        /// <summary>The wire is looked for walls anew after this way, m; by default 4 times the barrier's
        /// distance or the wire's radius.</summary>
        public double Reach
        {
            get => _leastReach / _units;
            set => _leastReach = value * _units;
        }

        /// <summary>Whether a wall pushes the wire in the shape last looked at.</summary>
        public bool Touches => _contacts.Count > 0;

        /// <summary>Where walls push the wire in a shape, wall by wall and along the wire.</summary>
        public StructList<WallContact> ContactsOf(RodShape shape)
        {
            Look(shape);
            return _contacts;
        }

        /// <summary>Radius of element j, m.</summary>
        public double RadiusOf(int j)
        {
            return _elementRadius[j];
        }

        /// <summary>Force of each wall on the wire, N, in the shape last looked at.</summary>
        public Vector3d[] Resultants => _resultant;

        /// <summary>Force of the walls on a node, its share of those on the elements among it, N.</summary>
        public Vector3d ForceOn(RodShape shape, int node)
        {
            Look(shape);
            return -_gradient[node];
        }

        /// <summary>A distance in units by which element j is farther from all walls than 0 at least, in the shape last
        /// looked at.</summary>
        public double ClearanceOf(int j)
        {
            int n = _elementRadius.Length;
            double room = double.PositiveInfinity;
            for (int w = 0; w < _walls.Length; w++)
            {
                room = Math.Min(room, _room[w * n + j]);
            }
            return room - Math.Max(Vector3d.Distance(_x[j], _reference[j]),
                Vector3d.Distance(_x[j + 1], _reference[j + 1]));
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            Look(shape);
            return _value;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            Look(shape);
            int end = Math.Min(to, _gradient.Length);
            double largest = 0.0;
            for (int i = from; i < end; i++)
            {
                largest = Math.Max(largest, _gradient[i].LengthSquared);
                gradient[i].X1 += _gradient[i].X;
                gradient[i].X2 += _gradient[i].Y;
                gradient[i].X3 += _gradient[i].Z;
            }
            measured.IncludeForce(Math.Sqrt(largest));
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            var measured = default(GradientMeasures);
            AddGradient(shape, gradient, from, to, ref measured);
            int end = Math.Min(to, _gradient.Length);
            for (int i = from; i < end; i++)
            {
                ref RodBlock b = ref blocks[i];
                Symmetric3 a = HasBending ? _own[i] + _ownBending[i] : _own[i];
                b.A11 += a.A11; b.A21 += a.A21; b.A22 += a.A22;
                b.A31 += a.A31; b.A32 += a.A32; b.A33 += a.A33;
                if (i < _coupling.Length)
                {
                    Symmetric3 d = HasBending ? _coupling[i] + _couplingBending[i] : _coupling[i];
                    Vector3d t = HasBending ? _couplingTurn[i] : Vector3d.Zero;
                    b.D11 += d.A11; b.D12 += d.A21 - t.Z; b.D13 += d.A31 + t.Y;
                    b.D21 += d.A21 + t.Z; b.D22 += d.A22; b.D23 += d.A32 - t.X;
                    b.D31 += d.A31 - t.Y; b.D32 += d.A32 + t.X; b.D33 += d.A33;
                }
            }
        }

        /// <summary>Leaves at least 30 % of every gap, or a fifth of the barrier's distance, on the straight way of all
        /// nodes, to elements too. From a gap that is left too small Newton's method comes back by doubling it.
        /// </summary>
        public override double LargestShare(RodShape shape, RodVector[] direction, double scale)
        {
            Look(shape);
            double step = scale * _units;
            double longest = 0.0;
            for (int i = 0; i < _x.Length; i++)
            {
                Vector3d to = _x[i] + Move(direction[i], step);
                longest = Math.Max(longest, Vector3d.Distance(to, _reference[i]));
            }
            if (!(longest <= _reach))
            {
                FindNear(WithRoom * longest);
                _isWide = true;
            }
            int n = _elementRadius.Length;
            double share = 1.0;
            for (int j = 0; j < n; j++)
            {
                Vector3d a = Move(direction[j], step);
                Vector3d b = Move(direction[j + 1], step);
                double motion = Math.Sqrt(Math.Max(a.LengthSquared, b.LengthSquared));
                for (int w = 0; w < _walls.Length; w++)
                {
                    if (_isNear[w * n + j])
                    {
                        share = Math.Min(share, ShareOf(w, j, a, b, motion));
                    }
                }
            }
            return share;
        }

        /// <summary>Moves nodes off the walls, until no gap of a shape is less than it was in another shape or half of
        /// the barrier's distance, but for what one push does to the next.</summary>
        /// <param name="before">The other shape.</param>
        /// <param name="shape">Its nodes 1 to <paramref name="last"/> are moved.</param>
        /// <param name="last">Up to n.</param>
        public void PushBack(RodShape before, RodShape shape, int last)
        {
            Look(before);
            double longest = 0.0;
            for (int i = 0; i < _x.Length; i++)
            {
                longest = Math.Max(longest, Vector3d.Distance(_units * shape.X[i], _x[i]));
            }
            FindNear(WithRoom * longest);
            int n = _elementRadius.Length;
            for (int w = 0; w < _walls.Length; w++)
            {
                for (int i = 1; i <= last; i++)
                {
                    if ((i < n && _isNear[w * n + i]) || _isNear[w * n + i - 1])
                    {
                        PushNode(w, i, ref shape.X[i]);
                    }
                }
                for (int j = 0; j < n; j++)
                {
                    if (_isNear[w * n + j])
                    {
                        PushElement(w, j, shape, last);
                    }
                }
            }
        }

        private void PushNode(int w, int i, ref Vector3d x)
        {
            double asked = Math.Min(_nodeGap[w * _x.Length + i], PushedTo * _barrier.Distance);
            Vector3d place = _units * x;
            _places.Clear();
            _walls[w].FindPlaces(place, _units * (_nodeRadius[i] + asked), FeaturesOfNode(w, i), _places);
            for (int k = 0; k < _places.Count; k++)
            {
                ref WallPlace at = ref _places[k];
                double gap = at.Contact.Distance / _units - _nodeRadius[i];
                if (gap < asked && at.Weight > 0)
                {
                    x += (asked - gap) * at.Contact.Normal;
                    return;
                }
            }
        }

        private void PushElement(int w, int j, RodShape shape, int last)
        {
            double asked = Math.Min(_ridgeGap[w * _elementRadius.Length + j], PushedTo * _barrier.Distance);
            _ridges.Clear();
            _walls[w].FindRidges(_units * shape.X[j], _units * shape.X[j + 1],
                _units * (_elementRadius[j] + asked), FeaturesOf(w, j), _ridges);
            for (int k = 0; k < _ridges.Count; k++)
            {
                ref WallRidge ridge = ref _ridges[k];
                double gap = ridge.Distance / _units - _elementRadius[j];
                if (gap < asked)
                {
                    double a = j > 0 ? 1.0 - ridge.Position : 0.0;
                    double b = j < last ? ridge.Position : 0.0;
                    double share = (asked - gap) / Math.Max(a * a + b * b, LeastLever);
                    shape.X[j] += share * a * ridge.Normal;
                    shape.X[j + 1] += share * b * ridge.Normal;
                    return;
                }
            }
        }

        private static Vector3d Move(in RodVector direction, double step)
        {
            return new Vector3d(step * direction.X1, step * direction.X2, step * direction.X3);
        }

        private double ShareOf(int w, int j, in Vector3d moveA, in Vector3d moveB, double motion)
        {
            int n = _elementRadius.Length;
            double radius = _units * _elementRadius[j];
            double gap = Math.Min(Math.Min(_nodeGap[w * (n + 1) + j], _nodeGap[w * (n + 1) + j + 1]),
                _ridgeGap[w * n + j]) * _units;
            if (motion < QuickShare * gap)
            {
                return 1.0;
            }
            ref int hint = ref _hint[w * n + j];
            Vector3d a = _x[j] + moveA;
            Vector3d b = _x[j + 1] + moveB;
            double share = ShareOf(w, j, a, b, radius, gap, hint);
            if (share == 0.0)
            {
                _walls[w].Nearest(
                    _x[j], _x[j + 1], double.PositiveInfinity, ref hint, out SurfaceContact contact);
                gap = contact.Distance - radius;
                share = ShareOf(w, j, a, b, radius, gap, hint);
            }
            return Math.Min(1.0, share);
        }

        private double ShareOf(int w, int j, in Vector3d a, in Vector3d b, double radius, double gap, int hint)
        {
            double left = Math.Min(LeftOfGap * gap, MostLeft * _units * _barrier.Distance);
            double keep = radius + left;
            double resolution = Math.Min(Resolved * keep, ResolvedOfWay * (gap - left));
            return gap > 0.0 ? _walls[w].FreeShare(_x[j], _x[j + 1], a, b, keep, resolution, hint) : 0.0;
        }

        // Finds what the shape comes to, unless it is that of the last call.
        private void Look(RodShape shape)
        {
            bool isSame = _isKnown;
            for (int i = 0; i < _x.Length && isSame; i++)
            {
                isSame = _units * shape.X[i] == _x[i];
            }
            if (isSame)
            {
                return;
            }
            double farthest = 0.0;
            for (int i = 0; i < _x.Length; i++)
            {
                _x[i] = _units * shape.X[i];
                farthest = Math.Max(farthest, (_x[i] - _reference[i]).LengthSquared);
                _gradient[i] = Vector3d.Zero;
                _own[i] = default;
                _ownBending[i] = default;
            }
            Array.Clear(_couplingBending, 0, _couplingBending.Length);
            Array.Clear(_couplingTurn, 0, _couplingTurn.Length);
            _contacts.Clear();
            Array.Clear(_coupling, 0, _coupling.Length);
            Array.Clear(_resultant, 0, _resultant.Length);
            _isKnown = true;
            _value = 0.0;
            if (!_hasReference || !(farthest <= _reach * _reach)
                || (_isWide && _reach > TooWide * _leastReach && farthest * TooWide * TooWide < _reach * _reach))
            {
                FindNear(_leastReach);
            }
            Array.Fill(_nodeGap, _barrier.Distance);
            Array.Fill(_ridgeGap, _barrier.Distance);
            for (int w = 0; w < _walls.Length; w++)
            {
                AddWall(w);
            }
        }

        // Which elements may come near a wall while no node goes farther than the reach.
        private void FindNear(double reach)
        {
            int n = _elementRadius.Length;
            _reach = Math.Max(_leastReach, reach);
            _hasReference = true;
            _isWide = false;
            Array.Copy(_x, _reference, _x.Length);
            _features.Clear();
            for (int w = 0; w < _walls.Length; w++)
            {
                for (int j = 0; j < n; j++)
                {
                    int k = w * n + j;
                    double range = _reach + _units * (Math.Max(_nodeRadius[j], _nodeRadius[j + 1])
                        + _barrier.Distance);
                    _firstFeature[k] = _features.Count;
                    double distance = SureOfQuick * Math.Abs(_walls[w].FindFeatures(
                        _x[j], _x[j + 1], range / SureOfQuick, _reach, ref _hint[k], _features));
                    _isNear[k] = distance <= range;
                    _room[k] = Math.Min(distance, range);
                }
            }
            _firstFeature[_isNear.Length] = _features.Count;
        }

        private void AddWall(int w)
        {
            int n = _elementRadius.Length;
            bool wasNear = false;
            for (int j = 0; j <= n; j++)
            {
                bool isNear = j < n && _isNear[w * n + j];
                if (isNear || wasNear)
                {
                    AddNode(w, j);
                }
                if (isNear)
                {
                    AddElement(w, j);
                }
                wasNear = isNear;
            }
        }

        private FeatureRange FeaturesOf(int w, int j)
        {
            int k = w * _elementRadius.Length + j;
            return new FeatureRange(_features, _firstFeature[k], _firstFeature[k + 1]);
        }

        // Those of an element beside it that is near.
        private FeatureRange FeaturesOfNode(int w, int i)
        {
            int n = _elementRadius.Length;
            return FeaturesOf(w, i < n && _isNear[w * n + i] ? i : i - 1);
        }

        private void AddNode(int w, int i)
        {
            double radius = _nodeRadius[i];
            _places.Clear();
            _walls[w].FindPlaces(_x[i], _units * (radius + _barrier.Distance), FeaturesOfNode(w, i), _places);
            Vector3d gradient = Vector3d.Zero;
            Symmetric3 second = default;
            bool mayBeNegative = false;
            ref double nearest = ref _nodeGap[w * _x.Length + i];
            for (int k = 0; k < _places.Count; k++)
            {
                ref WallPlace place = ref _places[k];
                double gap = place.Contact.Distance / _units - radius;
                nearest = Math.Min(nearest, gap);
                double value = _barrier.At(gap, out double slope, out double curvature);
                if (value == 0.0)
                {
                    continue;
                }
                _value += place.Weight * value;
                slope *= place.Weight;
                Vector3d n = place.Contact.Normal;
                double along = slope * place.Curvature * _units;
                double across = slope * place.CrossCurvature * _units;
                mayBeNegative |= place.Weight < 0 || along < 0.0 || across < 0.0;
                gradient += slope * n;
                second += Symmetric3.Outer(place.Weight * curvature, n) + Symmetric3.Outer(along, place.Direction)
                    + Symmetric3.Outer(across, Vector3d.Cross(n, place.Direction));
                if (double.IsPositiveInfinity(value))
                {
                    _value = double.PositiveInfinity;
                    return;
                }
            }
            if (gradient == Vector3d.Zero)
            {
                return;
            }
            bool isLast = i == _elementRadius.Length;
            _contacts.Add(new WallContact(w, isLast ? i - 1 : i, isLast ? 1.0 : 0.0, -gradient));
            _gradient[i] += gradient;
            _resultant[w] -= gradient;
            _own[i] += mayBeNegative ? second.PositivePart() : second;
        }

        private void AddElement(int w, int j)
        {
            double radius = _elementRadius[j];
            _ridges.Clear();
            ref double nearest = ref _ridgeGap[w * _elementRadius.Length + j];
            _walls[w].FindRidges(_x[j], _x[j + 1], _units * (radius + _barrier.Distance), FeaturesOf(w, j), _ridges);
            for (int k = 0; k < _ridges.Count; k++)
            {
                ref WallRidge ridge = ref _ridges[k];
                double gap = ridge.Distance / _units - radius;
                nearest = Math.Min(nearest, gap);
                double value = _barrier.At(gap, out double slope, out double curvature);
                if (value == 0.0 || ridge.Weight == 0.0)
                {
                    continue;
                }
                if (double.IsPositiveInfinity(value))
                {
                    _value = value;
                    return;
                }
                double s = ridge.Position;
                double r = 1.0 - s;
                _value += ridge.Weight * value;
                Vector3d force = (ridge.Weight * slope) * ridge.Normal;
                Vector3d first = r * force + (value * _units) * ridge.WeightAlongA;
                Vector3d second = s * force + (value * _units) * ridge.WeightAlongB;
                _contacts.Add(new WallContact(w, j, s, -force));
                _gradient[j] += first;
                _gradient[j + 1] += second;
                _resultant[w] -= first + second;
                double stiffness = ridge.Weight * curvature;
                _own[j] += Symmetric3.Outer(stiffness * r * r, ridge.Normal);
                _own[j + 1] += Symmetric3.Outer(stiffness * s * s, ridge.Normal);
                _coupling[j] += Symmetric3.Outer(stiffness * r * s, ridge.Normal);
                AddBending(j, ridge, _units * ridge.Weight * slope);
                AddPairs(j, _units * slope, r * ridge.Normal, s * ridge.Normal, ridge.WeightAlongA,
                    ridge.WeightAlongB);
            }
        }

        // The force of a ridge times the second derivative of its distance.
        private void AddBending(int j, in WallRidge ridge, double force)
        {
            double s = ridge.Position;
            double r = 1.0 - s;
            Symmetric3 h = ridge.Curvature;
            _ownBending[j] += (force * r * r) * h;
            _ownBending[j + 1] += (force * s * s) * h;
            _couplingBending[j] += (force * r * s) * h;
            Vector3d u = _x[j + 1] - _x[j];
            Vector3d hu = h.Times(u);
            double half = 0.5 * Vector3d.Dot(u, hu);
            AddPairs(j, force, r * hu - ridge.Normal + half * ridge.SlideAlongA,
                s * hu + ridge.Normal + half * ridge.SlideAlongB, ridge.SlideAlongA, ridge.SlideAlongB);
        }

        // weight (c d^T + d c^T) of vectors over both nodes of an element.
        private void AddPairs(int j, double weight, in Vector3d c, in Vector3d cNext, in Vector3d d, in Vector3d dNext)
        {
            _ownBending[j] += Symmetric3.Pair(weight, c, d);
            _ownBending[j + 1] += Symmetric3.Pair(weight, cNext, dNext);
            _couplingBending[j] += Symmetric3.Pair(0.5 * weight, cNext, d) + Symmetric3.Pair(0.5 * weight, dNext, c);
            _couplingTurn[j] -= (0.5 * weight) * (Vector3d.Cross(cNext, d) + Vector3d.Cross(dNext, c));
        }
    }
}
