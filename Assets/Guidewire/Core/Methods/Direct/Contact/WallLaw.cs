using System;

namespace Guidewire.Core
{
    /// <summary>The contacts of one wall with a wire: by node and element, the distance of the core line at which the
    /// gap is 0, and the energy of the gap.</summary>
    /// <remarks>The gap to a rigid wall is that of the wire's surface. A soft wall is displaced by u where the wire
    /// presses on it, at most by u_max: its gap is that to the rigid limit, G = d - (r - u_max), and u = u_max - G. A
    /// spring k u^2/2 acts from u = 0 on, and a barrier of 0.3 k over all of u_max, which is infinite at the limit. So
    /// the force is k u (1 + 0.9 u/u_max + ...). The wall's displacement is no unknown: it follows from the gap.
    ///
    /// A node has k = K l, with l half of the elements beside it. The tip has at least the wall's tipLength: the wall
    /// beyond it gives way with it. A convex edge has tipLength times the angle by which the wall turns there, so that
    /// a bend counts the same however finely it is divided.
    ///
    /// For u_max below the radius the core line stays on the free side. A plane or a tube with a larger u_max is moved
    /// outward by it, and the gap is then that of the wire's surface. In all other walls u_max is at most 0.9 times the
    /// radius that the wire has there.</remarks>
    internal sealed class WallLaw
    {
        private const double BarrierOfSpring = 0.3;
        private const double LeftOfGap = 0.3;     // the least that a step leaves
        private const double MaxLeft = 0.2;      // of the barrier's distance
        private const double Resolved = 1e-3;     // of the clearance: approaches below it are ignored
        private const double ResolvedOfGap = 0.05;    // the same, of the gap to close

        private readonly double _units;           // per metre
        private readonly MaterialRod _rod;
        private readonly Barrier _rigid;
        private readonly ContactShape _given;
        private readonly ContactShape? _moved;    // by a soft wall's limit
        private readonly double[] _ofNodes;       // radii, m
        private readonly double[] _nodeRadius;    // m
        private readonly double[] _elementRadius;
        private readonly Barrier[] _node;
        private readonly Barrier[] _current;      // the same, by the regions where the nodes are
        private readonly double[] _factor;        // by node: the region's stiffness over the wall's
        private readonly Barrier[] _element;      // of a soft wall: by weight and radian
        private readonly double[] _length;        // of the elements, units; empty for a rigid wall
        private readonly WallRegions? _regions;
        private readonly double _stiffness;       // K where there are none, Pa

        /// <summary>Makes that of a wall on a rod.</summary>
        /// <param name="rod">The wire.</param>
        /// <param name="nodeRadius">Of its nodes, m.</param>
        /// <param name="wall">As it was given, in units.</param>
        /// <param name="units">Per metre.</param>
        /// <param name="rigid">Of each gap to a rigid wall.</param>
        private WallLaw(MaterialRod rod, double[] nodeRadius, ContactShape wall, double units, in Barrier rigid)
        {
            int n = rod.Capacity;
            _rod = rod;
            _rigid = rigid;
            _given = wall;
            Wall = wall;
            _units = units;
            _ofNodes = nodeRadius;
            _nodeRadius = nodeRadius;
            _elementRadius = rod.Radius;
            _length = Array.Empty<double>();
            _node = new Barrier[n + 1];
            _element = new Barrier[n];
            _current = wall.Softness?.Regions == null ? _node : new Barrier[n + 1];
            _factor = new double[n + 1];
            if (wall.Softness is WallSoftness soft)
            {
                IsSoft = true;
                _regions = soft.Regions;
                _stiffness = soft.Stiffness;
                _length = new double[n];
                _moved = wall.MovedOut(units * soft.Limit);
            }
            Narrowest = IsSoft ? 1.0 : wall.Motion?.Narrowest ?? 1.0;
            if (IsSoft || Narrowest < 1.0)
            {
                _nodeRadius = new double[n + 1];
                _elementRadius = new double[n];
            }
            Remesh();
        }

        /// <summary>Those of all walls.</summary>
        public static WallLaw[] Of(MaterialRod rod, ContactShape[] walls, double units, Barrier rigid)
        {
            var nodeRadius = new double[rod.Capacity + 1];
            return Array.ConvertAll(walls, wall => new WallLaw(rod, nodeRadius, wall, units, rigid));
        }

        /// <summary>The wire has other elements.</summary>
        public void Remesh()
        {
            int n = _rod.ElementCount;
            Array.Fill(_factor, 1.0);
            Array.Fill(_node, _rigid);
            Array.Fill(_element, _rigid);
            _ofNodes[0] = 0.0;
            double thinnest = double.PositiveInfinity;
            for (int j = 0; j < n; j++)
            {
                _ofNodes[j] = Math.Max(_ofNodes[j], _rod.Radius[j]);
                _ofNodes[j + 1] = _rod.Radius[j];
                thinnest = Math.Min(thinnest, _rod.Radius[j]);
            }
            if (_given.Softness is WallSoftness soft)
            {
                bool isMoved = soft.Limit >= thinnest && _moved != null;
                Wall = isMoved ? _moved! : _given;
                for (int i = 0; i <= n; i++)
                {
                    double length = 0.5 * ((i > 0 ? _rod.Length[i - 1] : 0.0) + (i < n ? _rod.Length[i] : 0.0));
                    length = i == n ? Math.Max(length, soft.TipLength) : length;
                    _node[i] = Soft(soft, isMoved, length, _ofNodes[i], out _nodeRadius[i]);
                }
                for (int j = 0; j < n; j++)
                {
                    _length[j] = _units * _rod.Length[j];
                    _element[j] = Soft(soft, isMoved, soft.TipLength, _rod.Radius[j], out _elementRadius[j]);
                }
            }
            for (int i = 0; i <= n && Narrowest < 1.0; i++)
            {
                _nodeRadius[i] = _ofNodes[i] / Narrowest;
                _elementRadius[Math.Max(i - 1, 0)] = _rod.Radius[Math.Max(i - 1, 0)] / Narrowest;
            }
            Array.Copy(_node, _current, n + 1);
        }

        /// <summary>The least scale of a section of the wall in a cycle. Gaps are those at rest: where sections become
        /// narrower the wire is thicker there by as much, so that it stays out of the wall.</summary>
        public double Narrowest { get; }

        /// <summary>The least range of all gaps, m.</summary>
        public double MinDistance
        {
            get
            {
                double least = double.PositiveInfinity;
                for (int i = 0; i <= _rod.ElementCount; i++)
                {
                    least = Math.Min(least, _node[i].Distance);
                }
                return least;
            }
        }

        /// <summary>The wall that the gaps are measured from, units.</summary>
        public ContactShape Wall { get; private set; }

        /// <summary>Whether it gives way.</summary>
        public bool IsSoft { get; }

        /// <summary>Distance of node i from the wall at which its gap is 0, m.</summary>
        public double RadiusOfNode(int i) => _nodeRadius[i];

        /// <summary>Gives the same of element j.</summary>
        public double RadiusOf(int j) => _elementRadius[j];

        /// <summary>Widens ranges, by element in units, to where the wall is felt by it or its nodes.</summary>
        public void AddRanges(double units, double[] range)
        {
            for (int j = 0; j < _rod.ElementCount; j++)
            {
                double own = Math.Max(_elementRadius[j] + _element[j].Distance, Math.Max(
                    _nodeRadius[j] + _node[j].Distance, _nodeRadius[j + 1] + _node[j + 1].Distance));
                range[j] = Math.Max(range[j], units * own);
            }
        }

        /// <summary>Gives the barrier of the gap of node i.</summary>
        public ref readonly Barrier OfNode(int i) => ref _current[i];

        /// <summary>Of the gap of element j, but for how stiff it is.</summary>
        public ref readonly Barrier BarrierOf(int j) => ref _element[j];

        /// <summary>Gives the range of the gap of element j, m.</summary>
        public double DistanceOf(int j) => _element[j].Distance;

        /// <summary>Gives the range of the gap of a contact, m: of a soft wall its limit there.</summary>
        public double DistanceAt(in WallContact contact)
        {
            int node = contact.Element + (contact.Position == 1.0 ? 1 : 0);
            return contact.IsNode ? _node[node].Distance : _element[contact.Element].Distance;
        }

        /// <summary>Gives the barrier of the gap of element j at an edge of the wall.</summary>
        public Barrier OfEdge(int j, in EdgeContact edge) =>
            IsSoft ? _element[j].Times(_factor[j] * edge.TurnUnder(_length[j])) : _element[j];

        /// <summary>What a step leaves of a gap of element j, units.</summary>
        public double LeftOf(int j, double gap) => Math.Min(LeftOfGap * gap, MaxLeft * _units * _element[j].Distance);

        /// <summary>The most that a step leaves of the distance of element j, units.</summary>
        public double MaxClearance(int j) => _units * (_elementRadius[j] + MaxLeft * _element[j].Distance);

        /// <summary>Approaches of a step that are ignored, units.</summary>
        public static double Resolution(double radius, double gap, double left) =>
            Math.Min(Resolved * (radius + left), ResolvedOfGap * (gap - left));

        /// <summary>Takes the stiffness of the wall where the nodes are: it stays that for a step.</summary>
        /// <param name="w">Which wall it is.</param>
        /// <param name="fields">Where walls are that move.</param>
        /// <returns>Whether the wall has regions.</returns>
        public bool FollowRegions(RodShape shape, int w, WallFields fields)
        {
            for (int i = 0; i <= _rod.ElementCount && _regions != null; i++)
            {
                _factor[i] = _regions.StiffnessAt(fields.AtRest(w, _units * shape.X[i])) / _stiffness;
                _current[i] = _node[i].Times(_factor[i]);
            }
            return _regions != null;
        }

        /// <summary>By how much the wall is displaced at a gap, m.</summary>
        public double DisplacementAt(double gap, double distance) => IsSoft ? Math.Max(0.0, distance - gap) : 0.0;

        /// <summary>Sets the gaps of all nodes, and of all elements, to those from which on nothing is felt.</summary>
        /// <param name="w">Number of the wall.</param>
        public void ClearGaps(int w, double[] nodeGap, double[] edgeGap)
        {
            int n = _rod.ElementCount;
            for (int j = 0; j < n; j++)
            {
                nodeGap[w * (n + 1) + j] = _node[j].Distance;
                edgeGap[w * n + j] = _element[j].Distance;
            }
            nodeGap[w * (n + 1) + n] = _node[n].Distance;
        }

        private static Barrier Soft(WallSoftness soft, bool isMoved, double length, double radius, out double from)
        {
            double most = isMoved ? soft.Limit : soft.MaxOf(radius);
            from = isMoved ? radius : radius - most;
            double spring = soft.Stiffness * length;
            return new Barrier(most, BarrierOfSpring * spring, spring);
        }
    }

    /// <summary>A contact force of a wall on the wire: on element j at s, which is one of its nodes at 0 and
    /// 1.</summary>
    internal readonly struct WallContact
    {
        /// <summary>Index in the list of walls.</summary>
        public readonly int Wall;

        /// <summary>The element j.</summary>
        public readonly int Element;

        /// <summary>The position s along it.</summary>
        public readonly double Position;

        /// <summary>Whether a node touches, else the interior of the element.</summary>
        public readonly bool IsNode;

        /// <summary>Unit normal, the direction of the force.</summary>
        public readonly Vector3d Normal;

        /// <summary>The normal force, N.</summary>
        public readonly double Force;

        /// <summary>By how much the wall gives way there, m.</summary>
        public readonly double Displacement;

        /// <summary>Makes a contact with these values.</summary>
        public WallContact(int wall, int element, double position, in Vector3d force, bool isNode, double displacement)
        {
            Displacement = displacement;
            IsNode = isNode;
            Wall = wall;
            Element = element;
            Position = position;
            Force = force.Length;
            Normal = Vector3d.Normalize(force);
        }
    }

    /// <summary>The energy of a gap g between the wire's surface and a wall: b(g) = -k (g - g0)^2 ln(g/g0) for g below
    /// g0, 0 beyond, infinite at 0 (Li et al. 2020, incremental potential contact). A soft wall adds that of a spring,
    /// s (g0 - g)^2/2 (<see cref="WallLaw"/>), which a wall that lags behind begins later (<see cref="WallLag"/>).
    /// </summary>
    internal readonly struct Barrier
    {
        /// <summary>The distance g0, m.</summary>
        public readonly double Distance;

        /// <summary>k, N/m: the force at half of g0 is 1.19 k g0.</summary>
        public readonly double Stiffness;

        /// <summary>s, N/m; 0 of a rigid wall.</summary>
        public readonly double Spring;

        /// <summary>Displacement at which the spring begins to act, m; 0 but where the wall lags.</summary>
        public readonly double Onset;

        private const double ForceTolerance = 1e-3;    // relative, of where a chord ends
        private const int MaxIterations = 30;

        /// <summary>With this distance and stiffness.</summary>
        public Barrier(double distance, double stiffness, double spring = 0.0, double onset = 0.0)
        {
            Distance = distance;
            Stiffness = stiffness;
            Spring = spring;
            Onset = onset;
        }

        /// <summary>So many times as stiff.</summary>
        public Barrier Times(double factor) => new Barrier(Distance, factor * Stiffness, factor * Spring, Onset);

        /// <summary>How far the spring is pressed, m; 0 before it acts.</summary>
        public double Pressed(double gap) => Math.Max(0.0, Distance - gap - Onset);

        /// <summary>b(g), J, with its first and second derivatives; infinite for a gap that is closed.</summary>
        public double At(double gap, out double slope, out double curvature)
        {
            slope = 0.0;
            curvature = 0.0;
            if (gap >= Distance)
            {
                return 0.0;
            }
            if (!(gap > 0.0))
            {
                return double.PositiveInfinity;
            }
            double x = gap / Distance;
            double below = x - 1.0;
            double factor = Factor(x, out double log, out double derivative);
            double sunk = Pressed(gap);
            slope = -Stiffness * Distance * below * factor - Spring * sunk;
            curvature = -Stiffness * derivative + (sunk > 0.0 ? Spring : 0.0);
            return -Stiffness * Distance * Distance * below * below * log + 0.5 * Spring * sunk * sunk;
        }

        /// <summary>The mean stiffness on the way from a gap to where the force is so many times as large, as a
        /// multiple of b''. Where that is 0 or less, the way ends where the force does.</summary>
        public double ChordStiffness(double gap, double ratio)
        {
            double x = gap / Distance;
            double force = ForceAt(x, out double slope);
            if (!(ratio > 0.0))
            {
                return force / (slope * (x - 1.0));
            }
            double asked = ratio * force;
            // Both are below the gap that is looked for: |f| >= 3 (1 - x)^2, and |f| >= 1/x - 1 for x <= 0.6. With a
            // spring it is larger still.
            double end = 1.0 - Math.Sqrt(asked / 3.0);
            end = asked > 2.0 / 3.0 ? Math.Max(end, 1.0 / (1.0 + asked)) : end;
            end = ratio < 1.0 ? Math.Max(end, x) : end;
            double forceAtEnd = ForceAt(end, out double slopeAtEnd);
            for (int k = 0; k < MaxIterations && Math.Abs(forceAtEnd - asked) > ForceTolerance * asked; k++)
            {
                if (!(slopeAtEnd < 0.0))
                {
                    break;    // rounded to g0
                }
                end -= (forceAtEnd - asked) / slopeAtEnd;
                forceAtEnd = ForceAt(end, out slopeAtEnd);
            }
            double way = end - x;
            return Math.Abs(way) > ForceTolerance * (1.0 - x) * x ? (forceAtEnd - force) / (way * slope) : 1.0;
        }

        // Of x = g/g0: |b'|/(k g0), a convex function, and its derivative.
        private double ForceAt(double x, out double slope)
        {
            double factor = Factor(x, out _, out slope);
            double spring = x < 1.0 - Onset / Distance ? Spring / Stiffness : 0.0;
            slope -= spring;
            return (x - 1.0) * (factor - spring) - spring * Onset / Distance;
        }

        // |b'|/(k g0) over x - 1, with ln x and the derivative of the former.
        private static double Factor(double x, out double log, out double derivative)
        {
            log = Math.Log(x);
            double ratio = (x - 1.0) / x;
            derivative = 2.0 * log + ratio * (4.0 - ratio);
            return 2.0 * log + ratio;
        }
    }
}
