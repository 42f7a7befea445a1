using System;

namespace Guidewire.Core
{
    /// <summary>Soft walls that follow a force with a delay: the spring k of a contact has a dashpot k tau beside it
    /// (Kelvin and Voigt). The barrier before the limit acts at once.</summary>
    /// <remarks>In a stage of length h the wall came from u^ = max(0, u0) + g. u0 is how deep the wire was where it
    /// would be without a velocity in this stage, at the contact there with the nearest normal. g is by how much the
    /// wall was displaced beyond the wire's surface when the step began. The force k u + k tau (u - u^)/h is that of a
    /// spring k (1 + tau/h) that begins at u* = u^ tau/(tau + h), to where the wall comes back on its own. So the
    /// displacement of the wall stays no unknown.
    ///
    /// g is kept by wall and node, and by wall and element that edges of the wall meet. It is 0 while a wire presses on
    /// the wall. So the wall's displacement goes with the wire where that slides along.</remarks>
    internal sealed class WallLag
    {
        private const double LeastCosine = 0.5;   // between normals of what is one contact

        private readonly WallLaw[] _laws;
        private readonly int _nodes;
        private readonly double[] _nodeGap;       // of the shape evaluated last, by wall and node, m
        private readonly double[] _edgeGap;       // the same by wall and element
        private readonly double[] _time;          // tau by wall, s
        private readonly double[] _behind;        // g by contact, m
        private readonly double[] _sunk;          // u when the step began, m, 0 or more
        private readonly double[] _stiffness;     // k when it touched last, N/m
        private readonly int[] _last;             // by contact: index of its last origin, -1 without one
        private readonly StructList<Origin> _origins = new StructList<Origin>(64);
        private Use _use;
        private double _stage;                    // h, s; 0: walls give way at once
        private double _step;                     // s
        private double _heat;                     // of the step, J

        private WallLag(WallLaw[] laws, double[] nodeGap, double[] edgeGap, double[] time)
        {
            _nodes = nodeGap.Length / laws.Length;
            _laws = laws;
            _nodeGap = nodeGap;
            _edgeGap = edgeGap;
            _time = time;
            Start = new RodShape(_nodes - 1);
            From = new RodShape(_nodes - 1);
            _behind = new double[nodeGap.Length + edgeGap.Length];
            _sunk = new double[_behind.Length];
            _stiffness = new double[_behind.Length];
            _last = new int[_behind.Length];
            Array.Fill(_last, -1);
        }

        /// <summary>What contacts are looked at for.</summary>
        internal enum Use
        {
            /// <summary>Their forces in the stage.</summary>
            Stage,

            /// <summary>From where the wall comes.</summary>
            Origin,

            /// <summary>What is stored: walls give way at once.</summary>
            Spring,

            /// <summary>What dashpots turned into heat in a step.</summary>
            Heat,
        }

        /// <summary>Where the nodes were when the step began.</summary>
        public RodShape Start { get; }

        /// <summary>Where they would be without a velocity in this stage.</summary>
        public RodShape From { get; }

        /// <summary>What dashpots have turned into heat so far, J.</summary>
        public double Dissipated { get; private set; }

        /// <summary>That of walls; null where all give way at once.</summary>
        /// <param name="laws">By wall.</param>
        /// <param name="nodeGap">Those of the shape evaluated last, m.</param>
        /// <param name="edgeGap">The same of elements.</param>
        public static WallLag? Of(WallLaw[] laws, double[] nodeGap, double[] edgeGap)
        {
            double[] time = Array.ConvertAll(laws, law => law.Wall.Softness?.RelaxationTime ?? 0.0);
            return Array.Exists(time, tau => tau > 0.0) ? new WallLag(laws, nodeGap, edgeGap, time) : null;
        }

        /// <summary>Where the contact of a node of wall w is kept.</summary>
        public int OfNode(int w, int i)
        {
            return w * (2 * _nodes - 1) + i;
        }

        /// <summary>The same of an element.</summary>
        public int OfElement(int w, int j)
        {
            return OfNode(w, _nodes + j);
        }

        /// <summary>A step of dt, s, begins in the shape evaluated last.</summary>
        public void BeginStep(RodShape shape, double dt)
        {
            Start.CopyFrom(shape);
            _step = dt;
            for (int k = 0; k < _sunk.Length; k++)
            {
                _sunk[k] = Sunk(k);
            }
        }

        /// <summary>A stage begins, see <see cref="BarrierEnergy.BeginStage"/>.</summary>
        /// <returns>The shape from which the walls come.</returns>
        public RodShape BeginStage(Vector3d[] free, Vector3d[] velocities, double h)
        {
            for (int i = 0; i < _nodes; i++)
            {
                From.X[i] = free[i] - h * velocities[i];
            }
            _stage = h;
            return From;
        }

        /// <summary>An evaluation of all contacts begins.</summary>
        public void Begin(Use use)
        {
            _use = use;
            if (use == Use.Origin)
            {
                _origins.Clear();
                Array.Fill(_last, -1);
            }
        }

        /// <summary>The law of a contact of a wall.</summary>
        /// <param name="w">Which wall.</param>
        /// <param name="contact">Where it is kept.</param>
        /// <param name="weight">How often the contact counts.</param>
        /// <param name="own">Of a wall that gives way at once.</param>
        /// <param name="gap">m.</param>
        /// <param name="normal">From the wall.</param>
        public Barrier At(int w, int contact, double weight, in Barrier own, double gap, in Vector3d normal)
        {
            double length = _use == Use.Heat ? _step : _stage;
            if (_use == Use.Spring || !(_time[w] > 0.0 && length > 0.0))
            {
                return own;
            }
            double sunk = own.Distance - gap;
            if (_use == Use.Origin)
            {
                _origins.Add(new Origin { Normal = normal, Sunk = sunk, Before = _last[contact] });
                _last[contact] = _origins.Count - 1;
                return own;
            }
            double more = _time[w] / length;
            double before = OriginOf(contact, normal) + _behind[contact];
            double alone = before * more / (1.0 + more);
            if (_use == Use.Heat)
            {
                _stiffness[contact] = Math.Abs(weight) * own.Spring;
                _heat += sunk > alone ? weight * own.Spring * more * (sunk - before) * (sunk - before) : 0.0;
            }
            return new Barrier(own.Distance, own.Stiffness, (1.0 + more) * own.Spring, alone);
        }

        /// <summary>The step ends in the shape whose heat was looked at.</summary>
        public void EndStep()
        {
            int count = 2 * _nodes - 1;
            for (int k = 0; k < _behind.Length; k++)
            {
                double time = _time[k / count];
                double before = _sunk[k] + _behind[k];
                double now = Sunk(k);
                double alone = before * time / (time + _step);
                _behind[k] = Math.Max(0.0, alone - now);
                _heat += alone > now ? 0.5 * _stiffness[k] * (before * before - alone * alone) : 0.0;
            }
            Dissipated += _heat;
            _heat = 0.0;
        }

        /// <summary>Energy that walls have by what they are displaced beyond the wire's surface, J.</summary>
        public double Stored()
        {
            double sum = 0.0;
            for (int k = 0; k < _behind.Length; k++)
            {
                sum += 0.5 * _stiffness[k] * _behind[k] * (2.0 * Sunk(k) + _behind[k]);
            }
            return sum;
        }

        /// <summary>Takes over what a wire between the same walls left, see <see cref="FrictionAnchors.Take"/>.
        /// </summary>
        public void Take(WallLag other, int[] node)
        {
            Dissipated = other.Dissipated;
            FrictionAnchors.Carry(other._behind, _behind, _time.Length, node);
            FrictionAnchors.Carry(other._stiffness, _stiffness, _time.Length, node);
        }

        /// <summary>The same in a section in which it may be missing, or another wire's.</summary>
        public static void SerializeOptional(WallLag? lag, Snapshot snapshot)
        {
            if (snapshot.IsWritten)
            {
                lag?.Serialize(snapshot);
            }
            else if (lag != null && snapshot.LeftOfSection == 1 + 2 * lag._behind.Length)
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
            snapshot.Serialize(_behind);
            snapshot.Serialize(_stiffness);
        }

        // How deep the wire was there, m, 0 or more.
        private double OriginOf(int contact, in Vector3d normal)
        {
            double most = LeastCosine;
            double sunk = 0.0;
            for (int k = _last[contact]; k >= 0; k = _origins[k].Before)
            {
                double cosine = Vector3d.Dot(_origins[k].Normal, normal);
                (most, sunk) = cosine > most ? (cosine, _origins[k].Sunk) : (most, sunk);
            }
            return Math.Max(0.0, sunk);
        }

        // How deep the wire presses, m, 0 or more.
        private double Sunk(int contact)
        {
            int w = contact / (2 * _nodes - 1);
            int of = contact % (2 * _nodes - 1);
            return of < _nodes ? Math.Max(0.0, _laws[w].OfNode(of).Distance - _nodeGap[w * _nodes + of])
                : Math.Max(0.0, _laws[w].DistanceOf(of - _nodes) - _edgeGap[w * (_nodes - 1) + of - _nodes]);
        }

        private struct Origin
        {
            public Vector3d Normal;
            public double Sunk;    // m
            public int Before;     // index of that contact's origin before, -1 of the first
        }
    }
}
