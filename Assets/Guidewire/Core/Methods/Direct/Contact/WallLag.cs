using System;

namespace Guidewire.Core
{
    /// <summary>Soft walls that follow a node's force with a delay: the spring k of the contact has a dashpot k tau
    /// beside it (Kelvin and Voigt). The barrier before the limit, and what elements meet between nodes, act at once.
    /// </summary>
    /// <remarks>All contact points of a node with a wall have one displacement u, by the energy k u^2/2 of their
    /// springs. In a stage of length h the wall came from u^ = v + g: v is u where the node would be without a velocity
    /// in this stage, g by how much the wall was displaced beyond the wire's surface when the step began. The force
    /// k u + k tau (u - u^)/h is that of a spring k (1 + tau/h) that begins at u* = u^ tau/(tau + h), to where the wall
    /// comes back on its own. So the displacement of the wall stays no unknown.
    ///
    /// g is kept by wall and node, and is 0 while the node presses. So the wall's displacement goes with the wire where
    /// that slides along.</remarks>
    internal sealed class WallLag
    {
        private readonly WallLaw[] _laws;
        private int _nodes;
        private readonly double[] _time;          // tau by wall, s
        private double[] _behind;                 // g by wall and node, m
        private readonly double[] _from;          // v, m
        private readonly double[] _start;         // u when the step began, m
        private readonly double[] _now;           // u in the shape evaluated last as if at once, m
        private double[] _spare;                  // for those of a wire whose elements change
        private bool _isAtOnce;
        private double _stage;                    // h, s; 0: walls give way at once
        private double _step;                     // s

        private WallLag(WallLaw[] laws, MaterialRod rod, double[] time)
        {
            _laws = laws;
            _nodes = rod.ElementCount + 1;
            _time = time;
            Reference = new RodShape(rod.ElementCount, 0, rod.Capacity);
            _behind = new double[time.Length * (rod.Capacity + 1)];
            _spare = new double[_behind.Length];
            _from = new double[_behind.Length];
            _start = new double[_behind.Length];
            _now = new double[_behind.Length];
        }

        /// <summary>Where the nodes would be without a velocity in this stage.</summary>
        public RodShape Reference { get; }

        /// <summary>What dashpots have turned into heat so far, J.</summary>
        public double Dissipated { get; private set; }

        /// <summary>That of walls; null where all give way at once.</summary>
        public static WallLag? Of(WallLaw[] laws, MaterialRod rod)
        {
            double[] time = Array.ConvertAll(laws, law => law.Wall.Softness?.RelaxationTime ?? 0.0);
            return Array.Exists(time, tau => tau > 0.0) ? new WallLag(laws, rod, time) : null;
        }

        /// <summary>Says whether wall w follows with a delay.</summary>
        public bool IsOf(int w) => _time[w] > 0.0;

        /// <summary>A step of dt, s, begins in the shape evaluated last.</summary>
        public void BeginStep(double dt)
        {
            Array.Copy(_now, _start, Count);
            _step = dt;
        }

        /// <summary>A stage begins, see <see cref="BarrierEnergy.BeginStage"/>; sets the reference, which goes with
        /// moving walls.</summary>
        public void BeginStage(Vector3d[] free, Vector3d[] velocities, double h, Vector3d[]? around)
        {
            for (int i = 0; i < _nodes; i++)
            {
                Reference.X[i] = free[i] - h * (around == null ? velocities[i] : velocities[i] - around[i]);
            }
            _stage = h;
        }

        /// <summary>The shape evaluated last was the reference.</summary>
        public void TakeReference() => Array.Copy(_now, _from, Count);

        /// <summary>A shape is evaluated as if walls gave way at once.</summary>
        public void Begin()
        {
            _isAtOnce = true;
            Array.Clear(_now, 0, Count);
        }

        /// <summary>It has been.</summary>
        public void End() => _isAtOnce = false;

        /// <summary>Delays the springs of node i.</summary>
        /// <param name="w">Which wall.</param>
        /// <param name="i">Which node.</param>
        /// <param name="own">Of a wall that gives way at once.</param>
        /// <param name="spring">In: what they do at once. Out: in this stage.</param>
        /// <returns>What the node feels.</returns>
        public Barrier Delay(int w, int i, in Barrier own, ref Spring spring)
        {
            int k = w * _nodes + i;
            double u = Math.Sqrt(2.0 * spring.Energy / own.Spring);
            if (_isAtOnce)
            {
                _now[k] = u;
            }
            if (_isAtOnce || !(_stage > 0.0))
            {
                return own;
            }
            double more = _time[w] / _stage;
            double alone = (_from[k] + _behind[k]) * more / (1.0 + more);
            double pressed = Math.Max(0.0, u - alone);
            double factor = (1.0 + more) * pressed / u;
            spring.Energy = 0.5 * (1.0 + more) * own.Spring * pressed * pressed;
            spring.Second = pressed == 0.0 ? default : factor * spring.Second
                + Symmetric3.Outer((1.0 + more) * alone / (own.Spring * u * u * u), spring.Gradient);
            spring.Gradient *= factor;
            return new Barrier(own.Distance, own.Stiffness, (1.0 + more) * own.Spring, alone);
        }

        /// <summary>The step ends in the shape evaluated last.</summary>
        public void EndStep()
        {
            for (int k = 0; k < Count; k++)
            {
                double time = _time[k / _nodes];
                double stiffness = _laws[k / _nodes].OfNode(k % _nodes).Spring;
                double before = _start[k] + _behind[k];
                double alone = before * time / (time + _step);
                double now = Math.Max(alone, _now[k]);
                _behind[k] = now - _now[k];
                Dissipated += now == alone ? 0.5 * stiffness * (before * before - now * now)
                    : stiffness * time / _step * (now - before) * (now - before);
            }
        }

        /// <summary>Energy that walls have by what they are displaced beyond the surface of the wire in the shape
        /// evaluated last, J.</summary>
        public double Stored()
        {
            double sum = 0.0;
            for (int k = 0; k < Count; k++)
            {
                sum += 0.5 * _laws[k / _nodes].OfNode(k % _nodes).Spring * _behind[k] * (2.0 * _now[k] + _behind[k]);
            }
            return sum;
        }

        /// <summary>Takes over what a wire between the same walls left, see <see cref="FrictionAnchors.CarryOver"/>.
        /// </summary>
        public void CarryOver(WallLag other, int[] node, int elementCount)
        {
            Dissipated = other.Dissipated;
            double[] behind = other._behind;
            int nodes = other._nodes;
            if (other == this)
            {
                (_behind, _spare) = (_spare, _behind);
            }
            _nodes = elementCount + 1;
            Reference.ElementCount = elementCount;
            (_stage, _step) = (0.0, 0.0);
            Array.Clear(_from, 0, Count);
            Array.Clear(_start, 0, Count);
            Array.Clear(_now, 0, Count);
            for (int k = 0; k < Count; k++)
            {
                int was = node[k % _nodes];
                _behind[k] = was >= 0 ? behind[k / _nodes * nodes + was] : 0.0;
            }
        }

        // By wall and node.
        private int Count => _time.Length * _nodes;

        /// <summary>Writes or restores it in a section in which it may be missing, or another wire's.</summary>
        public static void Serialize(WallLag? lag, Snapshot snapshot)
        {
            if (snapshot.IsWritten || snapshot.IsStep)
            {
                lag?.Serialize(snapshot);
            }
            else if (lag != null && snapshot.LeftOfSection == 1 + lag.Count)
            {
                lag.Serialize(snapshot);
            }
            else
            {
                snapshot.SkipSection();
            }
        }

        /// <summary>Writes or restores what the next step depends on.</summary>
        public void Serialize(Snapshot snapshot)
        {
            Dissipated = snapshot.Serialize(Dissipated);
            snapshot.Serialize(_behind, Count);
        }

        /// <summary>The springs of a node's contact points with a wall.</summary>
        internal struct Spring
        {
            /// <summary>J.</summary>
            public double Energy;

            /// <summary>Of the energy, N.</summary>
            public Vector3d Gradient;

            /// <summary>N/m.</summary>
            public Symmetric3 Second;

            /// <summary>Adds a contact point.</summary>
            /// <param name="stiffness">N/m.</param>
            /// <param name="sunk">How deep it is, m.</param>
            /// <param name="units">Per metre.</param>
            public void Add(in ContactPoint point, double stiffness, double sunk, double units)
            {
                if (sunk > 0.0)
                {
                    double force = point.Weight * stiffness * sunk;
                    Energy += 0.5 * force * sunk;
                    Gradient -= force * point.Contact.Normal;
                    Second += point.SecondDerivative(-force * units, point.Weight * stiffness);
                }
            }
        }
    }
}
