using System;

namespace Guidewire.Core
{
    /// <summary>Contact with walls: the <see cref="Barrier"/> of every gap between the wire's surface and a wall, over
    /// all contact points of the walls near each node, and all edge contacts of each element.</summary>
    /// <remarks>The wire's surface is that of capsules, of each element's own radius; at a node the larger of its two
    /// elements'. Nodes meet walls that are flat or hollow before the elements between them do; what bulges into the
    /// free side may lie between two nodes, and the elements meet it there. An element's contact at s acts on its two
    /// nodes with weights 1 - s and s. A node's second derivative is exact, without its negative part; an element's is
    /// b'' times the square of the gap's derivative and, where asked for, everything but the derivative of the edge's
    /// weight.
    ///
    /// Walls do not act in a sheath: for them the nodes in it are at its exit, and the element that leaves it begins
    /// there.
    ///
    /// A wall that moves is met where it is at rest (<see cref="WallImages"/>). Its gaps are distances there, which
    /// differ from those in space by the strain across the gap; an element is straight in space and not there.
    ///
    /// Walls are in units, all else in metres. Elements far from walls are skipped (<see cref="NeighbourList"/>); that
    /// changes no value. The result for one shape is cached until another is evaluated.</remarks>
    internal sealed class BarrierEnergy : EnergyTerm
    {
        private const double LongSkin = 20.0;    // of the barrier's distance, the skin without point features
        private const double SkinInMesh = 0.5;   // of the wire's radius, the least skin
        private const int MaxCuts = 40;             // of a motion out of a sheath
        private const int MaxOpenings = 40;
        private const double OverOpening = 0.1;    // of the gap: towards just that one it may come ever more slowly

        private readonly ContactShape[] _walls;
        private readonly WallLaw[] _laws;         // by wall
        private readonly double _units;           // per metre
        private readonly MaterialRod _rod;
        private readonly double[] _elementRadius; // m
        private readonly double[] _range;         // by element, units
        private readonly Barrier _barrier;
        private readonly NeighbourList _near;
        private readonly SheathedNodes _nodes;
        private int _inside;                      // nodes in the sheath in the current shape
        private readonly WallImages _now;         // nodes of the current shape
        private readonly WallImages _next;        // where they move to
        private readonly Vector3d[][] _x;         // of the current shape, by wall, units
        private double _maxGap;                   // the least range of all barriers, m
        private readonly double[] _nodeGap;       // by wall and node, m, no more than the barrier's distance
        private readonly double[] _edgeGap;      // by wall and element, between its nodes
        private readonly GapMotion _motion;
        private readonly ContactSums _sums;       // of the current shape
        private readonly Vector3d[] _resultant;   // of each wall on the wire, N
        private readonly WallLag? _lag;           // null where all walls give way at once
        private readonly StructList<ContactPoint> _contactPoints = new StructList<ContactPoint>(16);
        private readonly StructList<EdgeContact> _edgeContacts = new StructList<EdgeContact>(16);
        private double _minGap;                 // of all of these
        private bool _hasBending = true;
        private bool _isKnown;
        private double _value;
        private readonly BeamWeight[] _weights;   // of the touched nodes, where a vessel gives way
        private readonly Vector3d[] _displaced;   // of its splines after a step, m
        private readonly RodVector[] _relative;   // a step of the touched nodes against it
        private bool _hasWeights;

        /// <summary>Contact of a rod with walls.</summary>
        /// <param name="rod">The wire.</param>
        /// <param name="walls">In units.</param>
        /// <param name="metresPerUnit">m.</param>
        /// <param name="barrier">Of each gap to a rigid wall.</param>
        /// <param name="sheath">In which no wall acts, or null.</param>
        public BarrierEnergy(MaterialRod rod, ContactShape[] walls, double metresPerUnit, in Barrier barrier,
            SheathEnd? sheath = null)
        {
            int n = rod.Capacity;
            _rod = rod;
            _units = 1.0 / metresPerUnit;
            _elementRadius = rod.Radius;
            _barrier = barrier;
            _laws = WallLaw.Of(rod, walls, _units, barrier);
            walls = Array.ConvertAll(_laws, law => law.Wall);
            _walls = walls;
            Fields = new WallFields(walls);
            _nodes = new SheathedNodes(sheath, walls, metresPerUnit, Fields);
            _now = new WallImages(Fields, n + 1);
            _next = new WallImages(Fields, n + 1);
            _x = _now.OnWall;
            _range = new double[n];
            // Lists of features of points grow with the square of the skin, all others hardly grow.
            double skin = Array.Exists(walls, wall => wall.IsSurface)
                ? Math.Max(barrier.Distance, SkinInMesh * rod.Radius[rod.ElementCount - 1])
                : Math.Max(LongSkin * barrier.Distance, rod.Radius[rod.ElementCount - 1]);
            _near = new NeighbourList(walls, _range, _units * skin);
            _nodeGap = new double[walls.Length * (n + 1)];
            _edgeGap = new double[walls.Length * n];
            _motion = new GapMotion(rod, _laws, _near, (_x, _next.OnWall), (_nodeGap, _edgeGap), _units);
            _sums = new ContactSums(n, walls.Length);
            _resultant = new Vector3d[walls.Length];
            _lag = WallLag.Of(_laws, rod);
            _weights = new BeamWeight[Fields.Beam == null ? 0 : n + 1];
            _relative = new RodVector[_weights.Length];
            _displaced = new Vector3d[Fields.Beam?.Count ?? 0];
            Remesh();
            FollowElements(null);
        }

        /// <inheritdoc/>
        public override void Remesh()
        {
            _near.KeepRanges();
            Array.Clear(_range, 0, _range.Length);
            _maxGap = double.PositiveInfinity;
            for (int w = 0; w < _laws.Length; w++)
            {
                _laws[w].Remesh();
                _laws[w].AddRanges(_units, _range);
                _walls[w] = _laws[w].Wall;
                _maxGap = Math.Min(_maxGap, _laws[w].MinDistance);
            }
            _nodes.Remesh();
            _sums.Remesh(_rod.ElementCount);
            (_inside, _minGap, _isKnown, SeesBehind) = (0, 0.0, false, false);
        }

        /// <summary>Follows the elements of a rod whose barriers are set.</summary>
        /// <param name="entered">Of those that came in before the first one, where all others are as they were; null:
        /// what is near is looked for anew.</param>
        public void FollowElements(int? entered) => _near.Remesh(_rod.ElementCount, entered);

        /// <summary>Leaves out the part of elements' contacts that is proportional to their force.</summary>
        public override void DropGeometricStiffness(bool isOn) => _hasBending = !isOn;

        /// <summary>Whether second derivatives have what the turning sections of a vessel add.</summary>
        public bool HasTurning { get; private set; }

        /// <summary>Second derivatives leave out what the turning sections of a vessel add.</summary>
        public void DropTurning(bool isOn) => HasTurning = Fields.Beam != null && !isOn;

        /// <summary>The walls, in units.</summary>
        public ContactShape[] Walls => _walls;

        /// <summary>b of rigid walls.</summary>
        public Barrier Barrier => _barrier;

        /// <summary>The contacts of wall w.</summary>
        public WallLaw LawOf(int w) => _laws[w];

        /// <summary>The delay of walls; null where all give way at once.</summary>
        public WallLag? Lag => _lag;

        /// <summary>The nodes as walls meet them.</summary>
        public SheathedNodes Nodes => _nodes;

        /// <summary>Where walls that move are.</summary>
        public WallFields Fields { get; }

        /// <summary>Walls are where they are at this time, s.</summary>
        public override void SetTime(double time)
        {
            if (Fields.SetTime(time))
            {
                WallsMoved();
            }
        }

        /// <summary>A vessel that gives way is where it is in this shape.</summary>
        public void FollowVessel(RodShape shape)
        {
            if (Fields.SetBeam(shape.Vessel, _units))
            {
                WallsMoved();
            }
        }

        /// <summary>Walls are elsewhere than when the shape was evaluated last.</summary>
        public void WallsMoved()
        {
            _isKnown = false;
            _nodes.WallsMoved();
        }

        /// <summary>Estimates of the contact forces in the shape last evaluated.</summary>
        public ContactMultipliers Multipliers => _sums.Multipliers;

        /// <summary>Estimates these forces after a step from that shape.</summary>
        public void Estimate(RodShape shape, RodVector[] direction)
        {
            if (Fields.Beam == null)
            {
                Multipliers.Estimate(direction);
                return;
            }
            for (int j = 0; j < _displaced.Length; j++)
            {
                _displaced[j] = shape.Vessel[j] + direction[shape.VesselStart + j].X;
            }
            SetWeights();
            for (int i = 0; i <= _rod.ElementCount; i++)
            {
                _relative[i] = direction[i];
                _relative[i].AddX(_sums.IsTouched(i) ? -_weights[i].Move(_displaced, shape.Vessel) : Vector3d.Zero);
            }
            Multipliers.Estimate(_relative);
        }

        private void SetWeights()
        {
            for (int i = 0; i <= _rod.ElementCount && !_hasWeights; i++)
            {
                if (_sums.IsTouched(i))
                {
                    _weights[i] = Fields.Of[Fields.Carrier]!.WeightAt(_x[Fields.Carrier][i]);
                }
            }
            _hasWeights = true;
        }

        /// <summary>Whether a wall touches the wire in the shape last evaluated.</summary>
        public bool Touches => _sums.Contacts.Count > 0;

        /// <summary>Whether a surface touches a node from behind in the shape last evaluated.</summary>
        public bool SeesBehind { get; private set; }

        /// <summary>The contacts with walls in a shape, wall by wall and along the wire.</summary>
        public StructList<WallContact> ContactsOf(RodShape shape)
        {
            Update(shape);
            return _sums.Contacts;
        }

        /// <summary>Units in a metre.</summary>
        public double UnitsPerMetre => _units;

        /// <summary>Radius of element j, m.</summary>
        public double RadiusOf(int j) => _elementRadius[j];

        /// <summary>Force of each wall on the wire, N, in the shape last evaluated.</summary>
        public Vector3d[] Resultants => _resultant;

        /// <summary>Lower bound of the distance of element j from all walls in the shape last evaluated,
        /// units.</summary>
        public double ClearanceOf(int j) => _near.ClearanceOf(_x, j);

        /// <inheritdoc/>
        public override void BeginStep(RodShape shape, double dt)
        {
            for (int w = 0; w < _laws.Length; w++)
            {
                _isKnown &= !_laws[w].FollowRegions(shape, w, Fields);
            }
            if (_lag != null)
            {
                Evaluate(shape);
                _lag.BeginStep(dt);
            }
        }

        /// <summary>A stage begins.</summary>
        /// <param name="free">Where the nodes would be with the velocities v^, m.</param>
        /// <param name="velocities">v^, m/s.</param>
        /// <param name="h">The stage's length, s.</param>
        /// <param name="around">Velocities of moving walls at the nodes, m/s; null where none moves.</param>
        public void BeginStage(Vector3d[] free, Vector3d[] velocities, double h, Vector3d[]? around = null)
        {
            if (_lag != null)
            {
                _lag.BeginStage(free, velocities, h, around);
                Evaluate(_lag.Reference);
                _lag.TakeReference();
            }
        }

        /// <inheritdoc/>
        public override void EndStep(RodShape shape)
        {
            if (_lag != null)
            {
                Evaluate(shape);
                _lag.EndStep();
            }
        }

        /// <summary>Gives the energy without what dashpots add to it in a stage, J.</summary>
        public override double Stored(RodShape shape) => _lag == null ? Value(shape) : Evaluate(shape) + _lag.Stored();

        // As if walls gave way at once.
        private double Evaluate(RodShape shape)
        {
            _lag!.Begin();
            _isKnown = false;
            Update(shape);
            _lag.End();
            _isKnown = false;
            return _value;
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            Update(shape);
            return _value;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            // A shape is queried piece by piece from its first node on: each piece needs to compare its own nodes.
            Update(shape, from, Math.Min(to, _rod.ElementCount + 1));
            _sums.AddGradient(gradient, from, to, ref measured);
            if (to > _rod.ElementCount && shape.Vessel.Length > 0)
            {
                SetWeights();
                _sums.AddVesselGradient(gradient, shape.VesselStart, _weights);
            }
        }

        /// <inheritdoc/>
        public override void AddColumns(RodShape shape, LowRank columns)
        {
            if (shape.Vessel.Length > 0)
            {
                Update(shape);
                SetWeights();
                _sums.AddBorder(columns, _weights, _hasBending, HasTurning ? _units : 0.0);
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            base.AddBlocks(shape, blocks, gradient, from, to);
            _sums.AddBlocks(blocks, from, to, _hasBending);
        }

        /// <summary>Leaves at least 30 % of every gap, or a fifth of the barrier's distance, on the straight path of
        /// all nodes, for elements too. From a gap that became too small Newton's method recovers by doubling it.
        /// </summary>
        public override double MaxStep(RodShape shape, RodVector[] direction, double scale)
        {
            Update(shape);
            double step = scale * _units;
            double tried = 1.0;
            for (int k = 0; k < MaxCuts; k++)
            {
                double longest = _nodes.Move(shape, direction, tried * step, _now.InSpace, _next.InSpace);
                if (Fields.Carrier >= 0)
                {
                    for (int j = 0; j < shape.Vessel.Length; j++)
                    {
                        _displaced[j] = shape.Vessel[j] + (tried * scale) * direction[shape.VesselStart + j].X;
                    }
                    Fields.SetBeam(_displaced, _units);
                    _next.Map(_rod.ElementCount + 1);
                    Fields.SetBeam(shape.Vessel, _units);
                    longest = Math.Max(longest, _now.LongestTo(_next, _rod.ElementCount + 1));
                }
                double fraction = _motion.MaxStep(longest, _minGap);
                if (!_nodes.LeavesLumen && (fraction == 1.0 || !_nodes.LeavesSheath))
                {
                    return tried * fraction;
                }
                // A node that comes out of the sheath does not move straight from its exit to where it will be: what
                // was cut short is to be tested again.
                tried *= _nodes.LeavesLumen ? 0.5 : k == 0 ? fraction : Math.Min(fraction, 0.5);
            }
            return 0.0;
        }

        /// <summary>The neighbours of a shape; gaps are those of another.</summary>
        public NeighbourList Near(RodShape shape, RodShape other)
        {
            Update(other);
            _nodes.Set(shape, _next.InSpace);
            _next.Map(_rod.ElementCount + 1, true);
            _near.Follow(_next.OnWall);
            return _near;
        }

        /// <summary>The nodes of a shape as wall w sees them, units; until another is evaluated.</summary>
        public Vector3d[] ImagesOf(RodShape shape, int w)
        {
            Update(shape);
            return _x[w];
        }

        /// <summary>A point of the wire, units, as wall w sees it.</summary>
        public Vector3d OnWall(int w, in Vector3d x) => Fields.AtRest(w, x);

        /// <summary>The way in space by which a point of the wire comes off wall w the fastest, for a unit of distance
        /// along the normal of the wall at rest.</summary>
        public Vector3d Away(int w, in Vector3d x, in Vector3d normal)
        {
            if (Fields.Of[w] == null || normal == Vector3d.Zero)
            {
                return normal;
            }
            Fields.Of[w]!.AtRest(x, out Matrix3 gradient);
            Vector3d away = gradient.TransposeTimes(normal);
            return (1.0 / away.LengthSquared) * away;
        }

        /// <summary>Gives the gap between node i and wall w in the shape last evaluated, m, no more than the barrier's
        /// distance.</summary>
        public double NodeGap(int w, int i) => _nodeGap[w * (_rod.ElementCount + 1) + i];

        /// <summary>Gives the same between the interior of element j and convex edges of the wall.</summary>
        public double EdgeGap(int w, int j) => _edgeGap[w * _rod.ElementCount + j];

        /// <summary>The least of all gaps in a shape, m, no more than the range of any barrier.</summary>
        public double LeastGap(RodShape shape)
        {
            Update(shape);
            return _minGap;
        }

        /// <summary>Moves nodes along the normals of their and their elements' contacts until no gap is less than
        /// this one, m. What takes the place of a node that has gone is a chord, and may lie in a wall that the two
        /// before it did not touch.</summary>
        public void Open(RodShape shape, double gap)
        {
            for (int k = 0; k < MaxOpenings && LeastGap(shape) < gap; k++)
            {
                for (int w = 0; w < _walls.Length; w++)
                {
                    for (int j = Math.Max(_inside, 1); j <= _rod.ElementCount; j++)
                    {
                        OpenNode(shape, w, j, gap);
                        OpenElement(shape, w, j - 1, gap);
                    }
                }
                _isKnown = false;
            }
        }

        private void OpenNode(RodShape shape, int w, int i, double gap)
        {
            double radius = _laws[w].RadiusOfNode(i);
            _contactPoints.Clear();
            Vector3d x = _x[w][i];
            _walls[w].FindContactPoints(x, _units * (radius + gap), _near.FeaturesOfNode(w, i, x), _contactPoints);
            _walls[w].TurnToWire(_contactPoints);
            for (int k = 0; k < _contactPoints.Count; k++)
            {
                SurfaceContact contact = _contactPoints[k].Contact;
                Move(shape, i, Lacking(gap, contact.Distance, radius)
                    * Away(w, _now.InSpace[i], contact.Normal));
            }
        }

        private void OpenElement(RodShape shape, int w, int j, double gap)
        {
            double radius = _laws[w].RadiusOf(j);
            _edgeContacts.Clear();
            Vector3d[] x = _x[w];
            _walls[w].FindEdgeContacts(x[j], x[j + 1], _units * (radius + gap),
                _near.FeaturesOf(w, j, x[j], x[j + 1]), _edgeContacts);
            for (int k = 0; k < _edgeContacts.Count; k++)
            {
                EdgeContact edge = _edgeContacts[k];
                // The first node may be held.
                double first = j >= Math.Max(_inside, 1) ? 1.0 - edge.Position : 0.0;
                double second = edge.Position;
                double sum = first * (1.0 - edge.Position) + second * second;
                if (sum > 0.0)
                {
                    Vector3d move = Lacking(gap, edge.Distance, radius) / sum
                        * Away(w, _now.InSpace[j], edge.Normal);
                    Move(shape, j, first * move);
                    Move(shape, j + 1, second * move);
                }
            }
        }

        // Of a distance in units, m.
        private double Lacking(double gap, double distance, double radius)
        {
            double own = distance / _units - radius;
            return own < gap ? (1.0 + OverOpening) * gap - own : 0.0;
        }

        // m.
        private void Move(RodShape shape, int node, in Vector3d move)
        {
            shape.X[node] += move;
            _now.InSpace[node] = _units * shape.X[node];
            for (int w = 0; w < _walls.Length && Fields.Carrier >= 0; w++)
            {
                _x[w][node] = Fields.AtRest(w, _now.InSpace[node]);
            }
        }

        private void Update(RodShape shape) => Update(shape, 0, _rod.ElementCount + 1);

        // Evaluates the shape, unless these of its nodes, without the last, are those of the last call.
        private void Update(RodShape shape, int from, int to)
        {
            FollowVessel(shape);
            int inside = _nodes.Inside(shape);
            bool isSame = _isKnown && _near.IsCurrent && inside == _inside;
            for (int i = from; i < to && isSame; i++)
            {
                isSame = _nodes.Place(shape.X[i], i < inside) == _now.InSpace[i];
            }
            if (isSame)
            {
                return;
            }
            _sums.Clear();
            _inside = _nodes.Set(shape, _now.InSpace);
            _now.Map(_rod.ElementCount + 1, true);
            Array.Clear(_resultant, 0, _resultant.Length);
            SeesBehind = false;
            _isKnown = true;
            _value = 0.0;
            _hasWeights = false;
            _near.Follow(_x);
            _minGap = _maxGap;
            if (_now.IsFolded(_rod.ElementCount + 1))
            {
                (_value, _minGap) = (double.PositiveInfinity, 0.0);
                return;
            }
            for (int w = 0; w < _walls.Length; w++)
            {
                _laws[w].ClearGaps(w, _nodeGap, _edgeGap);
                AddWall(w);
            }
        }

        private void AddWall(int w)
        {
            int n = _rod.ElementCount;
            for (int j = Math.Max(_inside - 1, 0); j <= n; j++)
            {
                if (j >= _inside && _near.NodeMayBeInRange(w, j, _x[w]))
                {
                    AddNode(w, j);
                }
                if (j < n && _near.MayBeInRange(w, j, _x[w]))
                {
                    AddElement(w, j);
                }
            }
            if (_inside > 0 && _inside <= n)
            {
                _sums.Hold(_inside - 1);
            }
        }

        private void AddNode(int w, int i)
        {
            double radius = _laws[w].RadiusOfNode(i);
            ref readonly Barrier barrier = ref _laws[w].OfNode(i);
            Vector3d x = _x[w][i];
            _contactPoints.Clear();
            double distance = _walls[w].FindContactPoints(
                x, _units * (radius + barrier.Distance), _near.FeaturesOfNode(w, i, x), _contactPoints);
            if (_contactPoints.Count == 0)
            {
                _near.SetDistanceOfNode(w, i, x, distance);
                return;
            }
            SeesBehind |= _walls[w].TurnToWire(_contactPoints);
            Vector3d gradient = Vector3d.Zero;
            Symmetric3 second = default;
            ref double nearest = ref _nodeGap[w * (_rod.ElementCount + 1) + i];
            // A spring that lags behind counts all points of the node as one.
            bool lags = _lag != null && _lag.IsOf(w);
            Barrier felt = lags ? new Barrier(barrier.Distance, barrier.Stiffness) : barrier;
            var spring = default(WallLag.Spring);
            for (int k = 0; k < _contactPoints.Count; k++)
            {
                ref ContactPoint point = ref _contactPoints[k];
                double gap = point.Contact.Distance / _units - radius;
                nearest = Math.Min(nearest, gap);
                _minGap = Math.Min(_minGap, gap);
                if (lags)
                {
                    spring.Add(point, barrier.Spring, barrier.Distance - gap, _units);
                }
                double value = felt.At(gap, out double slope, out double curvature);
                if (value == 0.0)
                {
                    continue;
                }
                _value += point.Weight * value;
                slope *= point.Weight;
                gradient += slope * point.Contact.Normal;
                second += point.SecondDerivative(slope * _units, point.Weight * curvature);
                if (double.IsPositiveInfinity(value))
                {
                    _value = double.PositiveInfinity;
                    return;
                }
            }
            if (spring.Energy > 0.0)
            {
                felt = _lag!.Delay(w, i, barrier, ref spring);
                _value += spring.Energy;
                gradient += spring.Gradient;
                second += spring.Second;
            }
            if (gradient == Vector3d.Zero)
            {
                return;
            }
            if (_now.GradientOf(w) is Matrix3[] map)
            {
                gradient = map[i].TransposeTimes(gradient);
                second = map[i].Congruent(second);
            }
            _resultant[w] -= gradient;
            Symmetric3 positive = second.PositivePart();
            _sums.AddNode(w, i, gradient, positive, second + (-1.0) * positive, nearest, felt,
                Math.Max(felt.Onset, _laws[w].DisplacementAt(nearest, barrier.Distance)));
        }

        private void AddElement(int w, int j)
        {
            double radius = _laws[w].RadiusOf(j);
            double range = _laws[w].DistanceOf(j);
            _edgeContacts.Clear();
            ref double nearest = ref _edgeGap[w * _rod.ElementCount + j];
            Vector3d[] x = _x[w];
            _walls[w].FindEdgeContacts(x[j], x[j + 1], _units * (radius + range),
                _near.FeaturesOf(w, j, x[j], x[j + 1]), _edgeContacts);
            Matrix3[]? map = _now.GradientOf(w);
            int first = _sums.Contacts.Count;
            double stiffness = 0.0;
            for (int k = 0; k < _edgeContacts.Count; k++)
            {
                ref EdgeContact edge = ref _edgeContacts[k];
                double gap = edge.Distance / _units - radius;
                nearest = Math.Min(nearest, gap);
                _minGap = Math.Min(_minGap, gap);
                Barrier barrier = _laws[w].OfEdge(j, edge);
                double value = barrier.At(gap, out double slope, out double curvature);
                if (value == 0.0 || edge.Weight == 0.0)
                {
                    continue;
                }
                if (double.IsPositiveInfinity(value))
                {
                    _value = value;
                    return;
                }
                _value += edge.Weight * value;
                stiffness += edge.Weight * curvature;
                _resultant[w] -= _sums.AddEdgeContact(w, j, edge, x[j + 1] - x[j], _units, value, slope, curvature,
                    _laws[w].DisplacementAt(gap, range), map);
            }
            _sums.EndElement(w, j, first, stiffness, nearest, _laws[w].BarrierOf(j));
        }
    }
}
