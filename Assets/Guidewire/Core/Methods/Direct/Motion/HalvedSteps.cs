using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Steps that are halved repeatedly where they have no solution, down to 1/4096: in a snap or a violent
    /// release the wire moves far within a step, and its end depends on the path.</summary>
    /// <remarks>Pieces are doubled again once some of one length are solved, twice as many after each doubling that
    /// failed, half as many after one that did not; so where only short pieces have a solution, for many steps as it
    /// may be, few longer ones are tried. The next step begins with the length with which the last one ended.
    ///
    /// A wire that snaps between walls is far from where it was after however short a piece: Newton's method then
    /// descends far, energy falling in every iteration. So there the shortest piece has <see cref="MoreIterations"/>
    /// times as many iterations before it counts as one without a solution.
    ///
    /// The work is bounded: after the first piece without a solution a step may take <see cref="MostSolutions"/> times
    /// the iterations that one solution may take.</remarks>
    internal sealed class HalvedSteps
    {
        private const int Whole = 1 << 12;
        private const int MostPatience = 256;
        private const int MoreIterations = 10;    // as a rest shape has
        private const int MostSolutions = 200;

        private readonly RodDynamics _dynamics;
        private readonly StepStart _start;
        private StageForces _meanForces;
        private int _size = Whole;    // of the next piece
        private int _patience = 1;    // pieces of one length before a longer one is tried
        private int _solved;          // of this length
        private bool _isDoubled;      // the next piece is the first of this length

        /// <summary>For this motion.</summary>
        public HalvedSteps(RodDynamics dynamics)
        {
            _dynamics = dynamics;
            _start = new StepStart(dynamics.SerializeStep);
        }

        /// <summary>Called after each completed part, or null.</summary>
        public Action? PieceDone { get; set; }

        /// <summary>The forces from outside, the means over the last step, where reactions are tracked.</summary>
        public StageForces MeanForces => _meanForces;

        /// <summary>Pieces that were halved so far.</summary>
        public long Halvings { get; private set; }

        /// <summary>One step.</summary>
        /// <param name="length">s.</param>
        /// <returns>Null, or why a piece has no solution however short; the shape is then not to be used.</returns>
        public string? Step(double length)
        {
            int done = 0;
            long most = long.MaxValue;
            string? last = null;
            StageForces sum = default;
            while (done < Whole)
            {
                double h = length * _size / Whole;
                _start.Save();
                long before = Iterations;
                string? failure = _dynamics.Step(h);
                if (failure != null && _size == 1 && _dynamics.WallSolver != null)
                {
                    _start.Restore();
                    failure = StepLong(_dynamics.WallSolver, h);
                }
                if (failure == null)
                {
                    Add(ref sum);
                    PieceDone?.Invoke();
                    done += _size;
                    Grow(done);
                }
                else if (_size == 1)
                {
                    return failure;
                }
                else
                {
                    most = last == null ? before + (long)MostSolutions * _dynamics.Solver.MostIterations : most;
                    last = failure;
                    Halve();
                }
                if (Iterations > most && done < Whole)
                {
                    return last + string.Format(CultureInfo.InvariantCulture,
                        "; halved to pieces of {0:G3} s the step took more than {1} times maxNewtonIterations", h,
                        MostSolutions);
                }
            }
            _meanForces = sum;
            return null;
        }

        /// <summary>Goes back to where the piece without a solution began.</summary>
        public void Restore()
        {
            _start.Restore();
        }

        /// <summary>Writes or restores the count, and how long the next piece is.</summary>
        public void Serialize(Snapshot snapshot)
        {
            Halvings = snapshot.Serialize(Halvings);
            snapshot.Serialize(ref _size);
            snapshot.Serialize(ref _patience);
            snapshot.Serialize(ref _solved);
            snapshot.Serialize(ref _isDoubled);
        }

        private long Iterations => (_dynamics.WallSolver?.Iterations ?? 0) + _dynamics.Solver.Iterations;

        private void Add(ref StageForces sum)
        {
            if (_size == Whole)
            {
                sum = _dynamics.Reactions.Mean;
            }
            else
            {
                sum.Add((double)_size / Whole, _dynamics.Reactions.Mean);
            }
        }

        private void Halve()
        {
            _start.Restore();
            Halvings++;
            _patience = _isDoubled ? Math.Min(2 * _patience, MostPatience) : _patience;
            _size /= 2;
            _solved = 0;
            _isDoubled = false;
        }

        // Longer again where the pieces done make up whole ones.
        private void Grow(int done)
        {
            _patience = _isDoubled ? Math.Max(_patience / 2, 1) : _patience;
            _solved = Math.Min(_solved + 1, MostPatience);
            _isDoubled = _size < Whole && done % (2 * _size) == 0 && _solved >= _patience;
            if (_isDoubled)
            {
                _size *= 2;
                _solved = 0;
            }
        }

        // With more iterations.
        private string? StepLong(BarrierNewton newton, double h)
        {
            int most = newton.MostIterations;
            newton.MostIterations = (int)Math.Min((long)MoreIterations * most, int.MaxValue);
            string? failure = _dynamics.Step(h);
            newton.MostIterations = most;
            return failure;
        }
    }
}
