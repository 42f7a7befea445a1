using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Divides a step into intervals. Each is the least of what limits it: an equal part that the barriers can
    /// follow, a piece that was halved, the next jump of a load or row of its table, the length by the tolerance.
    /// </summary>
    /// <remarks>An interval without a solution is tried by the scheme's start, then halved, down to 1/4096 of a part:
    /// in a snap or a violent release the wire moves far within a step, and its end depends on the path. Pieces are
    /// doubled again once some of one length are solved, twice as many after each doubling that failed, half as many
    /// after one that did not. So where only short pieces have a solution, for many steps as it may be, few longer ones
    /// are tried.
    /// The next step begins with the length with which the last one ended.
    ///
    /// A wire that snaps between walls is far from where it was after however short a piece: Newton's method then
    /// descends far, energy falling in every iteration. So there the shortest piece may take
    /// <see cref="IterationFactor"/> times as many iterations.
    ///
    /// The work is bounded: what a step takes after its first halving counts for the <see cref="WorkLimit"/>.</remarks>
    internal sealed class Clock
    {
        private const int Whole = 1 << 12;        // ticks of a part
        private const int MaxPatience = 256;
        private const int MoreIterations = 10;    // as a rest shape has
        private const double SameTime = 1e-9;     // of a piece

        private readonly ImplicitStepper _stepper;
        private readonly RodSchedule _schedule;
        private readonly WorkLimit _work;
        private double _stepLength;   // s
        private double _length;       // of a part, s
        private int _parts;           // with the present one
        private int _tick;            // of the present part, where its present piece begins
        private double _time;         // the same, s
        private int _ticks;           // of that piece
        private double _done;         // of it, s
        private double _until;        // where the interval that was proposed has to end, s after the piece's start
        private string? _halvedFor;   // why an interval of this step was halved last
        private int _size = Whole;    // of a piece, ticks
        private int _patience = 1;    // pieces of one length before a longer one is tried
        private int _solved;          // of this length
        private bool _isDoubled;      // the next piece is the first of this length

        /// <summary>What is to be tried instead of an interval that was not kept.</summary>
        public Interval Shorter { get; private set; }

        /// <summary>For steps of this scheme under this schedule.</summary>
        public Clock(ImplicitStepper stepper, RodSchedule schedule, WorkLimit work)
        {
            _stepper = stepper;
            _schedule = schedule;
            _work = work;
        }

        /// <summary>Pieces that were halved so far.</summary>
        public long Halvings { get; private set; }

        /// <summary>How many times the usual iterations the next interval may take between walls.</summary>
        public int IterationFactor => _size == 1 ? MoreIterations : 1;

        /// <summary>Why an interval has no solution however short, or null.</summary>
        public string? Failure { get; private set; }

        /// <summary>Begins a step.</summary>
        /// <param name="time">Of its start, s.</param>
        /// <param name="length">s.</param>
        /// <param name="parts">Equal parts into which it is divided at least.</param>
        public void Begin(double time, double length, int parts)
        {
            _time = time;
            _stepLength = length;
            _length = length / parts;
            _parts = parts;
            Failure = null;
            _halvedFor = null;
            BeginPart();
        }

        /// <summary>The interval after those that were accepted; of length 0 where the step is done.</summary>
        public Interval Next()
        {
            if (_tick == Whole)
            {
                _parts--;
                BeginPart();
            }
            return _parts == 0 ? default : Propose();
        }

        /// <summary>Whether an interval is kept. If not, <see cref="Failure"/> says why there is no other try, or
        /// <see cref="Shorter"/> is the next one.</summary>
        /// <param name="failure">Why it has no solution, or null.</param>
        public bool Accepts(in Interval tried, string? failure)
        {
            bool isSolved = failure == null;
            bool isKept = _stepper.Control.Accepts(isSolved ? _stepper.Error : 0.0, tried.Length, LengthOf(_ticks),
                isSolved);
            if (isKept && isSolved)
            {
                Advance(tried);
                BoundWork();
                return Failure == null;
            }
            if (isKept && _stepper.MayRestart)
            {
                Interval restarted = tried;
                restarted.IsRestarted = true;
                Shorter = restarted;
                return false;
            }
            if (isKept && _size == 1)
            {
                Failure = failure;
            }
            else if (isKept)
            {
                Halve(tried);
                _halvedFor = failure;
                _work.Count();
                BoundWork();
            }
            Shorter = Propose();
            return false;
        }

        /// <summary>Writes or restores how long the next piece is, and in a run the count.</summary>
        public void Serialize(Snapshot snapshot)
        {
            if (!snapshot.IsStep)
            {
                Halvings = snapshot.Serialize(Halvings);
            }
            snapshot.Serialize(ref _size);
            snapshot.Serialize(ref _patience);
            snapshot.Serialize(ref _solved);
            snapshot.Serialize(ref _isDoubled);
        }

        private void BeginPart()
        {
            _tick = 0;
            _done = 0.0;
        }

        private Interval Propose()
        {
            _ticks = Ticks();
            double piece = LengthOf(_ticks);
            double nearly = SameTime * piece;
            double jump = _stepper.StopsAtJumps ? _schedule.NextBreak(_time + _done + nearly) : double.PositiveInfinity;
            _until = jump - _time < piece - nearly ? jump - _time : piece;
            double length = _stepper.Control.Propose(_until - _done);
            double end = length == _until - _done ? _until : _done + length;
            return new Interval
            {
                Start = _time + _done,
                Length = length,
                End = _time + end,
                Jump = jump,
                Nearly = nearly,
                StepLength = _stepLength,
            };
        }

        // Of the present piece: a jump may have ended an interval beyond where one of the present size ends.
        private int Ticks()
        {
            int ticks = _size;
            while (LengthOf(ticks) * (1.0 - SameTime) <= _done)
            {
                ticks += _size;
            }
            return ticks;
        }

        private double LengthOf(int ticks) => _length * ticks / Whole;

        private void Advance(in Interval interval)
        {
            bool isEnd = interval.Length == _until - _done;
            _done = isEnd ? _until : _done + interval.Length;
            double piece = LengthOf(_ticks);
            if (isEnd && _until == piece)
            {
                _time += piece;
                _tick += _ticks;
                _done = 0.0;
                Grow();
            }
        }

        // So that the next try ends earlier.
        private void Halve(in Interval tried)
        {
            _patience = _isDoubled ? Math.Min(2 * _patience, MaxPatience) : _patience;
            _solved = 0;
            _isDoubled = false;
            do
            {
                Halvings++;
                _size /= 2;
            }
            while (_size > 1 && LengthOf(Ticks()) >= _done + tried.Length);
        }

        // Longer again where the pieces done make up whole ones.
        private void Grow()
        {
            _patience = _isDoubled ? Math.Max(_patience / 2, 1) : _patience;
            _solved = Math.Min(_solved + 1, MaxPatience);
            _isDoubled = _size < Whole && _tick % (2 * _size) == 0 && _solved >= _patience;
            if (_isDoubled)
            {
                _size *= 2;
                _solved = 0;
            }
        }

        private void BoundWork()
        {
            if (_work.IsOver && _halvedFor != null && _tick < Whole)
            {
                Failure = string.Format(CultureInfo.InvariantCulture, "{0}; halved to pieces of {1:G3} s; {2}",
                    _halvedFor, LengthOf(_size), _work.Text);
            }
        }
    }

    /// <summary>A part of a step that a scheme solves at once; times in s.</summary>
    internal struct Interval
    {
        public double Start;
        public double Length;       // 0 where nothing is left
        public double End;          // start plus length up to rounding
        public double Jump;         // when a load jumps next: a stage at that time is before the jump
        public double Nearly;       // within which two times are the same
        public double StepLength;   // of the step to which it belongs
        public bool IsRestarted;    // it had no solution by the scheme itself: the scheme's start is used

        /// <summary>Part of the step.</summary>
        public readonly double Fraction => Length / StepLength;
    }

    /// <summary>Step size control within a time step by an error estimate: a step of length h whose error E is above
    /// the tolerance T is repeated, and the next one has h (0.9^(p+1) T/E)^(1/(p+1)), p the order
    /// of the less accurate of the two solutions.</summary>
    /// <remarks>Bounded: no step is shorter than 1/1024 of the logged one, what is left of it is divided evenly, and
    /// what is still above the tolerance then is counted and kept.</remarks>
    internal sealed class StepControl
    {
        private const double Shortest = 1.0 / 1024.0;  // of the logged step
        private const double Safety = 0.9;
        private const double Failing = 0.25;  // where a stage has no solution
        private const double MinChange = 0.2;
        private const double MaxChange = 2.0;

        private readonly double _power;
        private double _length;  // of the next step, s; 0: not yet known

        /// <summary>Steps that are taken as they come.</summary>
        /// <param name="order">p.</param>
        public StepControl(int order)
        {
            _power = 1.0 / (order + 1);
        }

        /// <summary>T, radians, or displacement over L; 0: steps are taken as they come.</summary>
        public double Tolerance { get; set; }

        /// <summary>Whether steps are cut and grown.</summary>
        public bool IsOn => Tolerance > 0.0;

        /// <summary>Largest error of a step that was kept.</summary>
        public double LargestError { get; private set; }

        /// <summary>Steps that were kept.</summary>
        public long Steps { get; private set; }

        /// <summary>Steps that were kept although their error was above the tolerance.</summary>
        public long StepsAbove { get; private set; }

        /// <summary>Forgets how long the next step was to be.</summary>
        public void Forget() => _length = 0.0;

        /// <summary>Gives the length of the next step, s.</summary>
        /// <param name="left">What is left until a jump or the end of the logged step, s.</param>
        public double Propose(double left)
        {
            double parts = IsOn && _length > 0.0 ? Math.Ceiling(left / _length * (1.0 - 1e-12)) : 1.0;
            return left / Math.Max(parts, 1.0);
        }

        /// <summary>Whether a step is kept, and how long the next one is to be.</summary>
        /// <param name="isSolved">Whether its stages have solutions.</param>
        public bool Accepts(double error, double length, double logged, bool isSolved)
        {
            bool isGood = isSolved && error <= Tolerance;
            double least = Shortest * logged;
            if (IsOn)
            {
                double change = isSolved ? Safety * Math.Pow(Tolerance / Math.Max(error, 1e-300), _power) : Failing;
                change = Math.Min(Math.Max(change, MinChange), MaxChange);
                _length = Math.Min(Math.Max(length * change, least), logged);
                if (!isGood && length > least * (1.0 + 1e-9))
                {
                    return false;
                }
            }
            Steps += isSolved ? 1 : 0;
            StepsAbove += IsOn && !isGood ? 1 : 0;
            LargestError = Math.Max(LargestError, error);
            return true;
        }

        /// <summary>Writes or restores the counts.</summary>
        public void SerializeCounts(Snapshot snapshot)
        {
            LargestError = snapshot.Serialize(LargestError);
            Steps = snapshot.Serialize(Steps);
            StepsAbove = snapshot.Serialize(StepsAbove);
        }

        /// <summary>Writes or restores the length of the next step; for a step also the counts.</summary>
        public void Serialize(Snapshot snapshot)
        {
            if (snapshot.IsStep)
            {
                SerializeCounts(snapshot);
            }
            snapshot.Serialize(ref _length);
        }
    }
}
