using System;

namespace Guidewire.Core
{
    /// <summary>Contrast agent in the blood of a vessel's tree: injected somewhere, carried on, spread and washed out.
    /// No step of
    /// an instrument depends on it.</summary>
    /// <remarks>In one dimension along the centreline: d(A c)/dt + d(Q c)/dx = d(A D dc/dx)/dx, with the part c of the
    /// blood that
    /// is agent, finite volumes, upwind fluxes of second order with van Leer's limiter, and D = dispersion * radius *
    /// velocity,
    /// implicit. What is injected adds to the flow beyond that place. What leaves one cell enters others or leaves by
    /// an end, so
    /// amounts add up.</remarks>
    public sealed class ContrastFlow
    {
        private const double MaxCourant = 0.9;    // part of a cell's blood that is exchanged in a part of a step
        private const double LongestPass = 0.02;   // s that are carried on before they are spread
        private const double PerMillilitre = 1e3;  // mm^3

        private readonly VesselCells _cells;
        private readonly BloodFlow _flow;
        private readonly double _inlet;            // ml/s, mean
        private readonly double[] _volumes;        // ml
        private readonly double[] _conductances;   // of the face before each cell over the flow through it
        private readonly double[] _part;           // c
        private readonly double[] _next;
        private readonly double[] _rates;          // flow through the face before each, ml/s
        private readonly double[] _added;          // of them by injection, ml/s
        private readonly double[] _diagonal;
        private readonly bool[] _isBeyond;         // the place of injection
        private readonly bool[] _isEnd;
        private int _place = -1;
        private double _left;                      // still to be injected, ml
        private double _speed;                     // ml/s
        private double _time;

        /// <summary>Begins with blood without agent.</summary>
        /// <param name="tree">The vessel.</param>
        /// <param name="flow">How blood flows.</param>
        /// <exception cref="ArgumentException">A value of the flow out of its range.</exception>
        public ContrastFlow(VesselTree tree, BloodFlow flow)
        {
            string? problem = flow.FindProblem();
            if (problem != null)
            {
                throw new ArgumentException(problem);
            }
            _cells = new VesselCells(tree, flow.Given);
            _flow = flow;
            int n = _cells.Count;
            _volumes = new double[n];
            _conductances = new double[n];
            _part = new double[n];
            _next = new double[n];
            _rates = new double[n];
            _added = new double[n];
            _diagonal = new double[n];
            _isBeyond = new bool[n];
            _isEnd = new bool[n];
            Array.Fill(_isEnd, true);
            double area = Math.PI * tree.Radii[0] * tree.Radii[0];
            _inlet = flow.Inlet ?? area * BloodFlow.UsualVelocity / PerMillilitre;
            for (int k = 0; k < n; k++)
            {
                if (!(_cells.Shares[k] > 0.0))
                {
                    throw new ArgumentException("flows that are given need to be numbers above 0");
                }
                double radius = _cells.Radii[k];
                _volumes[k] = Math.PI * radius * radius * _cells.Lengths[k] / PerMillilitre;
                int before = _cells.Before[k];
                if (before >= 0)
                {
                    _isEnd[before] = false;
                    // A D/dx = Q * dispersion * r/dx, as D = dispersion * r * Q/A.
                    _conductances[k] = flow.Dispersion * (_cells.Radii[before] + radius)
                        / (_cells.Lengths[before] + _cells.Lengths[k]);
                }
            }
        }

        /// <summary>The number of cells.</summary>
        public int Count => _cells.Count;

        /// <summary>Part of the blood in each cell that is agent, from 0 to 1.</summary>
        public ReadOnlySpan<double> Parts => _part;

        /// <summary>Middles of the cells, mm.</summary>
        public Vector3d[] Middles => _cells.Middles;

        /// <summary>Radii of the cells, mm.</summary>
        public double[] Radii => _cells.Radii;

        /// <summary>Injected so far, ml.</summary>
        public double Injected { get; private set; }

        /// <summary>Washed out by the ends so far, ml.</summary>
        public double WashedOut { get; private set; }

        /// <summary>The agent that is in the vessel now, ml.</summary>
        public double Held
        {
            get
            {
                double sum = 0.0;
                for (int k = 0; k < _part.Length; k++)
                {
                    sum += _volumes[k] * _part[k];
                }
                return sum;
            }
        }

        /// <summary>Flow at the inlet now, ml/s.</summary>
        public double Inlet => _inlet
            * (1.0 + _flow.PulseAmplitude * Math.Sin(2.0 * Math.PI * _flow.PulseRate * _time));

        /// <summary>Whether an injection goes on.</summary>
        public bool IsInjecting => _left > 0.0;

        /// <summary>Whether there is agent, or will be: otherwise nothing changes with time.</summary>
        public bool IsActive { get; private set; }

        /// <summary>Gives the flow through a cell over that at the inlet, without injection.</summary>
        public double ShareOf(int cell) => _cells.Shares[cell];

        /// <summary>The cell that a point of the lumen belongs to: the one whose sphere has the least power.</summary>
        /// <param name="point">mm.</param>
        public int CellOf(in Vector3d point) => VesselCells.Nearest(point, _cells.Middles, _cells.Radii);

        /// <summary>Begins an injection; one that goes on ends.</summary>
        /// <param name="cell">Where.</param>
        /// <param name="amount">ml, 0 or more.</param>
        /// <param name="rate">ml/s, above 0.</param>
        /// <exception cref="ArgumentException">A value out of its range.</exception>
        public void Inject(int cell, double amount, double rate)
        {
            if (cell < 0 || cell >= Count || !(amount >= 0.0) || double.IsInfinity(amount) || !(rate > 0.0)
                || double.IsInfinity(rate))
            {
                throw new ArgumentException("an injection needs one of the cells, 0 ml or more, and more than 0 ml/s");
            }
            (_place, _left, _speed) = (cell, amount, rate);
            IsActive |= amount > 0.0;
            for (int k = 0; k < Count; k++)
            {
                int before = _cells.Before[k];
                _isBeyond[k] = before >= 0 && (before == cell || _isBeyond[before]);
            }
        }

        /// <summary>Takes all agent out of the blood, at the beginning of its pulse.</summary>
        public void Clear()
        {
            Array.Clear(_part, 0, _part.Length);
            (Injected, WashedOut, _left, _time, IsActive) = (0.0, 0.0, 0.0, 0.0, false);
        }

        /// <summary>Goes on by a time.</summary>
        /// <param name="seconds">0 or more.</param>
        /// <exception cref="ArgumentException">Another time.</exception>
        public void Advance(double seconds)
        {
            if (!(seconds >= 0.0) || double.IsInfinity(seconds))
            {
                throw new ArgumentException("blood goes on by 0 s or more");
            }
            while (seconds > 0.0 && IsActive)
            {
                double step = Math.Min(seconds, LongestPass);
                step = _left > 0.0 ? Math.Min(step, _left / _speed) : step;
                Pass(step);
                seconds -= step;
            }
            _time += seconds;
        }

        // With one rate of injection all through.
        private void Pass(double seconds)
        {
            double injected = _left > 0.0 ? _speed : 0.0;
            double inlet = _inlet * (1.0 + _flow.PulseAmplitude);    // the most that it may be meanwhile
            double most = 0.0;
            for (int k = 0; k < Count; k++)
            {
                _added[k] = _isBeyond[k] ? _cells.Shares[k] / _cells.Shares[_place] * injected : 0.0;
                double flow = _cells.Shares[k] * inlet + _added[k] + (k == _place ? injected : 0.0);
                most = Math.Max(most, flow / _volumes[k]);
            }
            long parts = Math.Max(1, (long)Math.Ceiling(most * seconds / MaxCourant));
            for (long part = 0; part < parts; part++)
            {
                Carry(seconds / parts, injected);
                _time += seconds / parts;
            }
            if (_flow.Dispersion > 0.0)
            {
                Spread(seconds);
            }
            // The last part of an amount is what is left of it, whatever the roundings of time.
            double amount = injected * seconds;
            _left = _left - amount > 1e-12 * Math.Max(1.0, amount) ? _left - amount : 0.0;
            IsActive = _left > 0.0 || Held > 1e-15 * Injected;
        }

        private void Carry(double seconds, double injected)
        {
            double inlet = Inlet;
            for (int k = 0; k < Count; k++)
            {
                _rates[k] = _cells.Shares[k] * inlet + _added[k];
                _next[k] = _volumes[k] * _part[k];
            }
            for (int k = 0; k < Count; k++)
            {
                int before = _cells.Before[k];
                if (before >= 0)
                {
                    double amount = seconds * _rates[k] * FacePart(before, k, seconds, injected);
                    _next[before] -= amount;
                    _next[k] += amount;
                }
                if (_isEnd[k])
                {
                    double amount = seconds * (_rates[k] + (k == _place ? injected : 0.0)) * _part[k];
                    _next[k] -= amount;
                    WashedOut += amount;
                }
            }
            if (injected > 0.0)
            {
                _next[_place] += seconds * injected;
                Injected += seconds * injected;
            }
            for (int k = 0; k < Count; k++)
            {
                _part[k] = _next[k] / _volumes[k];
            }
        }

        // c at the face between a cell and the next, carried there during a step: van Leer's slope.
        private double FacePart(int before, int cell, double seconds, double injected)
        {
            int first = _cells.Before[before];
            double here = _part[before];
            double behind = here - (first < 0 ? 0.0 : _part[first]);
            double ahead = _part[cell] - here;
            double product = behind * ahead;
            if (!(product > 0.0))
            {
                return here;
            }
            double courant = seconds * (_rates[before] + (before == _place ? injected : 0.0)) / _volumes[before];
            return here + product / (behind + ahead) * (1.0 - courant);
        }

        // Dispersion, implicit: the tree is eliminated from its ends to the inlet.
        private void Spread(double seconds)
        {
            for (int k = 0; k < Count; k++)
            {
                _diagonal[k] = _volumes[k];
                _next[k] = _volumes[k] * _part[k];
            }
            for (int k = Count - 1; k > 0; k--)
            {
                int before = _cells.Before[k];
                if (before < 0)
                {
                    continue;
                }
                double exchanged = seconds * _conductances[k] * _rates[k];
                double own = _diagonal[k] + exchanged;
                _diagonal[before] += exchanged * (_diagonal[k] / own);
                _next[before] += exchanged / own * _next[k];
            }
            for (int k = 0; k < Count; k++)
            {
                int before = _cells.Before[k];
                double exchanged = before < 0 ? 0.0 : seconds * _conductances[k] * _rates[k];
                double from = before < 0 ? 0.0 : exchanged * _part[before];
                _part[k] = (_next[k] + from) / (_diagonal[k] + exchanged);
            }
        }
    }

    /// <summary>How blood flows through a vessel's tree.</summary>
    public sealed class BloodFlow
    {
        /// <summary>Mean flow at the inlet, ml/s; null: such that its mean velocity is
        /// <see cref="UsualVelocity"/>.</summary>
        public double? Inlet { get; set; }

        /// <summary>Mean velocity at an inlet of which nothing is said, mm/s: 4 ml/s through a lumen of 5 mm, as
        /// through an
        /// internal carotid artery.</summary>
        public const double UsualVelocity = 200.0;

        /// <summary>Flow beyond each of the tree's points that follow a fork or the inlet, by the number of the point,
        /// ml/s or in
        /// any other unit: they count against those of the same fork. What is not said follows the radii
        /// cubed.</summary>
        public Func<int, double?> Given { get; set; } = _ => null;

        /// <summary>Dispersion coefficient over mean velocity and radius: 1 spreads a short bolus to a standard
        /// deviation of
        /// sqrt(2 r x) at a distance x.</summary>
        public double Dispersion { get; set; } = 1.0;

        /// <summary>Amplitude of the pulse over the mean flow, from 0 to 1: Q(t) = Q (1 + a sin(2 pi f t)).</summary>
        public double PulseAmplitude { get; set; }

        /// <summary>The pulse's rate f, 1/s.</summary>
        public double PulseRate { get; set; } = 1.0;

        /// <summary>What is wrong with these values in one phrase, or null.</summary>
        public string? FindProblem()
        {
            return Inlet is double flow && !(flow > 0.0 && flow <= 1e6)
                ? "flow needs to be a number > 0 and <= 1e6 (ml/s)"
                : !(Dispersion >= 0.0 && Dispersion <= 1e3) ? "dispersion needs to be a number from 0 to 1000 (radii)"
                : !(PulseAmplitude >= 0.0 && PulseAmplitude <= 1.0) ? "pulse needs an amplitude from 0 to 1"
                : !(PulseRate > 0.0 && PulseRate <= 100.0) ? "pulse needs a rate above 0 and up to 100 (1/s)" : null;
        }
    }

    /// <summary>The centreline of a vessel as blood flows through it: points from the inlet to the ends, each after
    /// the one
    /// before it.</summary>
    public sealed class VesselTree
    {
        /// <summary>Makes a tree of points, radii and the index of the point before each.</summary>
        /// <param name="points">mm.</param>
        /// <param name="radii">Of the lumen at each, mm, above 0.</param>
        /// <param name="before">The point before each towards the inlet, smaller than its own number; -1 at the inlet,
        /// the
        /// first.</param>
        /// <exception cref="ArgumentException">Fewer than two points, or no such tree.</exception>
        public VesselTree(Vector3d[] points, double[] radii, int[] before)
        {
            bool isTree = points.Length > 1 && radii.Length == points.Length && before.Length == points.Length
                && before[0] == -1;
            for (int k = 1; isTree && k < points.Length; k++)
            {
                isTree = before[k] >= 0 && before[k] < k;
            }
            for (int k = 0; isTree && k < points.Length; k++)
            {
                isTree = points[k].IsFinite && radii[k] > 0.0 && !double.IsInfinity(radii[k]);
            }
            if (!isTree)
            {
                throw new ArgumentException("a vessel's tree needs two points at least, each after the one before it,"
                    + " and radii above 0");
            }
            Points = points;
            Radii = radii;
            Before = before;
        }

        /// <summary>The points of the centreline, mm.</summary>
        public Vector3d[] Points { get; }

        /// <summary>The radius of the lumen at each point, mm.</summary>
        public double[] Radii { get; }

        /// <summary>The point before each; -1 at the inlet, the first.</summary>
        public int[] Before { get; }
    }
}
