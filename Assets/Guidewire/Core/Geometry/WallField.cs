using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Where a moving wall is at a moment: the map X = psi(x) from space to the wall at rest, with its
    /// derivative G = dX/dx, and its inverse.</summary>
    /// <remarks>Each point k of the centreline, at c_k at rest and at c'_k now, has a map of its own:
    /// p_k(x) = c_k + A_k v + b_k (t'_k v)^2 with v = x - c'_k, t' the tangent now. A_k = R_k^T (1/scale across t',
    /// 1/stretch along it), R_k the shortest turn of the tangent and what the table adds to it: so sections turn with
    /// the centreline and stay as they are. b_k is half of the difference of curvatures, so that a piece of the moved
    /// centreline lies on that at rest up to the third order. The map is their mean with weights exp(-v^2/(2 s^2)), s
    /// the points' spacing. These depend on the place along a straight centreline alone, not on the distance from it.
    ///
    /// A rigid motion is that of one point, exactly. What gives way as a beam does so before it moves: psi is that of
    /// the motion and then that of the beam (<see cref="BeamField"/>). The map of a moment depends on the time alone,
    /// but for the beam and for the phases of cycles whose period was changed during a run (<see cref="Serialize"/>).
    /// </remarks>
    public sealed class WallField
    {
        private const double Negligible = 36.0;    // exponent of a weight beside the largest
        private const int MaxSteps = 40;
        internal const int PerPoint = 7;           // values of a cycle, the last one that of scale
        private const double Rounding = 1e-14;     // of a coordinate

        private readonly WallMotion _motion;
        private readonly double[][] _values;       // by cycle
        private readonly double[] _since;          // s, by cycle: when it was at the phase
        private readonly double[] _phase;
        private readonly int[] _before;            // of each point in its branch, itself at an end
        private readonly int[] _after;
        private readonly Frame[] _frames;
        private readonly double[] _weights;        // of the last query
        private readonly int[] _near;
        private readonly double[] _squares;
        private readonly BeamField? _beam;
        private double _grown;                     // part of the ramp that was over at the time below
        private double _grownAt;                   // s
        private double _time = double.NaN;

        /// <summary>Where a wall is at time 0.</summary>
        public WallField(WallMotion motion)
        {
            _motion = motion;
            _beam = motion.Beam == null ? null : new BeamField(motion.Beam);
            _values = new double[motion.Cycles.Count][];
            _since = new double[_values.Length];
            _phase = new double[_values.Length];
            for (int m = 0; m < _values.Length; m++)
            {
                _values[m] = new double[motion.Cycles[m].Count];
                _phase[m] = motion.Cycles[m].Phase;
            }
            int count = 0;
            foreach (Vector3d[] branch in motion.Branches)
            {
                count += branch.Length;
            }
            _frames = new Frame[Math.Max(count, 1)];
            _before = new int[_frames.Length];
            _after = new int[_frames.Length];
            _weights = new double[_frames.Length];
            _near = new int[_frames.Length];
            _squares = new double[_frames.Length];
            int k = 0;
            foreach (Vector3d[] branch in motion.Branches)
            {
                for (int i = 0; i < branch.Length; i++, k++)
                {
                    _frames[k].Rest = branch[i];
                    _before[k] = i > 0 ? k - 1 : k;
                    _after[k] = i + 1 < branch.Length ? k + 1 : k;
                }
            }
            SetTime(0.0);
        }

        /// <summary>How the wall moves.</summary>
        public WallMotion Motion => _motion;

        /// <summary>Goes to a time, s, with the cycles of another field of the same motion.</summary>
        public void Follow(WallField other, double time)
        {
            Array.Copy(other._since, _since, _since.Length);
            Array.Copy(other._phase, _phase, _phase.Length);
            (_grown, _grownAt) = (other._grown, other._grownAt);
            _time = double.NaN;
            SetTime(time);
            _beam?.Follow(other._beam!);
        }

        /// <summary>Takes the displacements of the splines of its beam.</summary>
        /// <returns>Whether they are others; never without a beam.</returns>
        internal bool SetBeam(Vector3d[] q, double units) => _beam != null && _beam.Set(q, units);

        /// <summary>Points of the centreline of its beam at rest, two from spline to spline, each with its displacement
        /// by the beam behind it, units; null: it has none.</summary>
        public Vector3d[]? Centreline() => _beam?.Centreline();

        /// <summary>The largest turn of a section of its beam, radians.</summary>
        internal double LargestTurn => _beam?.LargestTurn ?? 0.0;

        /// <summary>How what is at the place X of the wall at rest moves with the splines of its beam.</summary>
        internal BeamWeight WeightAt(in Vector3d rest)
        {
            BeamWeight weight = _beam!.WeightAt(rest);
            if (_motion.Cycles.Count == 0)
            {
                return weight;
            }
            TryCycle(_beam.Moved(rest), out Vector3d moved);
            BeforeCycles(moved, out Matrix3 gradient, true);
            return weight.After(new Matrix3(gradient.Solve(Vector3d.UnitX), gradient.Solve(Vector3d.UnitY),
                gradient.Solve(Vector3d.UnitZ)));
        }

        /// <summary>The time, s.</summary>
        public double Time => _time;

        /// <summary>The phase of a cycle, 0 to 1.</summary>
        public double PhaseOf(int cycle)
        {
            double phase = PhaseAt(cycle);
            return phase - Math.Floor(phase);
        }

        /// <summary>Goes to a time, s.</summary>
        /// <returns>Whether it was another one.</returns>
        public bool SetTime(double time)
        {
            if (time == _time)
            {
                return false;
            }
            _time = time;
            double u = GrownAt(time, _motion.RampTime);
            double ramp = u * u * u * (10.0 - u * (15.0 - 6.0 * u));
            for (int m = 0; m < _values.Length; m++)
            {
                _motion.Cycles[m].Evaluate(PhaseAt(m), _values[m]);
                for (int c = 0; c < _values[m].Length; c++)
                {
                    _values[m][c] *= ramp;
                }
            }
            SetFrames();
            return true;
        }

        /// <summary>The place X of the wall at rest that is at x now.</summary>
        public Vector3d AtRest(in Vector3d x) => AtRest(x, out _, false);

        /// <summary>The place X of the wall at rest that is at x now, and G there.</summary>
        internal Vector3d AtRest(in Vector3d x, out Matrix3 gradient) => AtRest(x, out gradient, true);

        /// <summary>Where the place X of the wall at rest is now.</summary>
        public Vector3d Moved(in Vector3d rest)
        {
            TryMove(rest, out Vector3d moved);
            return moved;
        }

        /// <summary>Finds where the place X of the wall at rest is now; false where Newton's method finds
        /// none.</summary>
        internal bool TryMove(in Vector3d rest, out Vector3d moved) =>
            TryCycle(_beam?.Moved(rest) ?? rest, out moved);

        private bool TryCycle(in Vector3d rest, out Vector3d moved)
        {
            if (_motion.Cycles.Count == 0)
            {
                moved = rest;
                return true;
            }
            int near = 0;
            double least = double.PositiveInfinity;
            for (int k = 0; k < _frames.Length; k++)
            {
                double distance = (rest - _frames[k].Rest).LengthSquared;
                (near, least) = distance < least ? (k, distance) : (near, least);
            }
            moved = _frames[near].Now + _frames[near].Map.Solve(rest - _frames[near].Rest);
            double tolerance = Rounding * (1.0 + rest.Length + moved.Length);
            double last = double.PositiveInfinity;
            for (int step = 0; step < MaxSteps; step++)
            {
                Vector3d miss = BeforeCycles(moved, out Matrix3 gradient, true) - rest;
                double size = miss.Length;
                if (size <= tolerance || (size >= last && size < 1e3 * tolerance))
                {
                    return true;
                }
                last = size;
                moved -= gradient.Solve(miss);
            }
            return false;
        }

        /// <summary>Adds what <see cref="WallMotion.Displacements"/> has of now.</summary>
        internal void AddDisplacements(List<float> numbers)
        {
            foreach (Frame frame in _frames)
            {
                Vector3d moved = frame.Now - frame.Rest;
                Vector3d x = frame.Map.Solve(Vector3d.UnitX) - Vector3d.UnitX;
                Vector3d y = frame.Map.Solve(Vector3d.UnitY) - Vector3d.UnitY;
                Vector3d z = frame.Map.Solve(Vector3d.UnitZ) - Vector3d.UnitZ;
                foreach (double number in new[]
                {
                    moved.X, moved.Y, moved.Z, x.X, y.X, z.X, x.Y, y.Y, z.Y, x.Z, y.Z, z.Z,
                })
                {
                    numbers.Add((float)number);
                }
            }
        }

        /// <summary>det G.</summary>
        internal double DeterminantAt(in Vector3d x)
        {
            AtRest(x, out Matrix3 gradient);
            return gradient.Determinant;
        }

        /// <summary>The turn of the wall at x, from rest.</summary>
        internal Quaterniond TurnAt(in Vector3d x) => _beam == null ? TurnOfCycles(x)
            : TurnOfCycles(x) * _beam.TurnAt(BeforeCycles(x, out _, false));

        private Quaterniond TurnOfCycles(in Vector3d x)
        {
            int count = Weigh(x);
            Quaterniond first = _frames[_near[0]].Turn;
            Quaterniond sum = _weights[0] * first;
            for (int i = 1; i < count; i++)
            {
                sum += _weights[i] * Quaterniond.Aligned(first, _frames[_near[i]].Turn);
            }
            return Quaterniond.Normalize(sum);
        }

        /// <summary>Writes or restores at which phases the cycles are, and how far the ramp is. Where a reader has
        /// another period or ramp, its cycle goes on from the phase that it has at this time, and its ramp from how far
        /// it is.</summary>
        internal void Serialize(Snapshot snapshot, double time)
        {
            for (int m = 0; m < _values.Length; m++)
            {
                MotionCycle own = _motion.Cycles[m];
                double period = snapshot.Serialize(own.Period);
                double began = snapshot.Serialize(own.Phase);
                double since = snapshot.Serialize(_since[m]);
                double phase = snapshot.Serialize(_phase[m]);
                if (!snapshot.IsWritten && began == own.Phase)
                {
                    _since[m] = period == own.Period ? since : time;
                    _phase[m] = period == own.Period ? phase : phase + (time - since) / period;
                }
            }
            double ramp = snapshot.Serialize(_motion.RampTime);
            double grown = snapshot.Serialize(_grown);
            double grownAt = snapshot.Serialize(_grownAt);
            if (!snapshot.IsWritten)
            {
                (_grown, _grownAt) = (grown, grownAt);
                if (ramp != _motion.RampTime)
                {
                    (_grown, _grownAt) = (GrownAt(time, ramp), time);
                }
                _time = double.NaN;
                SetTime(time);
            }
        }

        private double GrownAt(double time, double ramp) =>
            ramp > 0.0 ? Math.Min(1.0, Math.Max(0.0, _grown + (time - _grownAt) / ramp)) : 1.0;

        private double PhaseAt(int cycle) =>
            _phase[cycle] + (_time - _since[cycle]) / _motion.Cycles[cycle].Period;

        private Vector3d AtRest(in Vector3d x, out Matrix3 gradient, bool hasGradient)
        {
            Vector3d before = BeforeCycles(x, out gradient, hasGradient);
            if (_beam == null)
            {
                return before;
            }
            before = _beam.AtRest(before, out Matrix3 ofBeam);
            gradient = ofBeam.Times(gradient);
            return before;
        }

        private Vector3d BeforeCycles(in Vector3d x, out Matrix3 gradient, bool hasGradient)
        {
            if (_motion.Cycles.Count == 0)
            {
                gradient = Matrix3.Identity;
                return x;
            }
            if (_frames.Length == 1)
            {
                gradient = _frames[0].Map;
                return _frames[0].Rest + gradient * (x - _frames[0].Now);
            }
            int count = Weigh(x);
            double perSquare = 1.0 / (_motion.Spacing * _motion.Spacing);
            Vector3d origin = _frames[_near[0]].Rest;
            Vector3d sum = Vector3d.Zero;
            gradient = default;
            Vector3d mean = Vector3d.Zero;       // of -v/s^2
            Matrix3 spread = default;            // of p_k (-v_k)^T/s^2
            for (int i = 0; i < count; i++)
            {
                ref Frame frame = ref _frames[_near[i]];
                double w = _weights[i];
                Vector3d v = x - frame.Now;
                double s = Vector3d.Dot(frame.Tangent, v);
                Vector3d p = frame.Rest - origin + frame.Map * v + (s * s) * frame.Bend;
                sum += w * p;
                if (hasGradient)
                {
                    Vector3d slope = (-w * perSquare) * v;
                    mean += slope;
                    spread += Matrix3.Outer(p, slope);
                    gradient += w * frame.Map + Matrix3.Outer((2.0 * w * s) * frame.Bend, frame.Tangent);
                }
            }
            if (hasGradient)
            {
                gradient += spread + Matrix3.Outer(-sum, mean);
            }
            return origin + sum;
        }

        // Weights of the points near x, which sum to 1; the first is that of the nearest.
        private int Weigh(in Vector3d x)
        {
            double per = 0.5 / (_motion.Spacing * _motion.Spacing);
            double least = double.PositiveInfinity;
            int nearest = 0;
            for (int k = 0; k < _frames.Length; k++)
            {
                double square = per * (x - _frames[k].Now).LengthSquared;
                _squares[k] = square;
                (nearest, least) = square < least ? (k, square) : (nearest, least);
            }
            int count = 1;
            double sum = 1.0;
            _near[0] = nearest;
            _weights[0] = 1.0;
            for (int k = 0; k < _frames.Length; k++)
            {
                double over = _squares[k] - least;
                if (over < Negligible && k != nearest)
                {
                    _near[count] = k;
                    _weights[count] = Math.Exp(-over);
                    sum += _weights[count++];
                }
            }
            for (int i = 0; i < count; i++)
            {
                _weights[i] /= sum;
            }
            return count;
        }

        private void SetFrames()
        {
            for (int k = 0; k < _frames.Length; k++)
            {
                _frames[k].Now = _frames[k].Rest;
                _frames[k].Turn = Quaterniond.Identity;
                _frames[k].Scale = 1.0;
            }
            for (int m = 0; m < _values.Length; m++)
            {
                for (int k = 0; k < _frames.Length && !_motion.Cycles[m].IsRigid; k++)
                {
                    _frames[k].Now += Vector(m, PerPoint * k);
                    _frames[k].Turn = RotationVector.Exp(Vector(m, PerPoint * k + 3)) * _frames[k].Turn;
                    _frames[k].Scale *= 1.0 + _values[m][PerPoint * k + 6];
                }
            }
            for (int k = 0; k < _frames.Length; k++)
            {
                ref Frame frame = ref _frames[k];
                Curve rest = CurveAt(k, false);
                Curve now = CurveAt(k, true);
                double stretch = rest.Length > 0.0 ? now.Length / rest.Length : 1.0;
                Vector3d across = Vector3d.Cross(rest.Tangent, now.Tangent);
                frame.Turn *= rest.Length > 0.0 ? Quaterniond.Normalize(new Quaterniond(across.X, across.Y, across.Z,
                    1.0 + Vector3d.Dot(rest.Tangent, now.Tangent))) : Quaterniond.Identity;
                frame.Tangent = now.Tangent;
                frame.Stretch = stretch;
                frame.Map = MapOf(frame);
                frame.Bend = 0.5 * ((1.0 / (stretch * stretch)) * rest.Curvature - frame.Map * now.Curvature);
            }
            for (int k = 0; k < _frames.Length; k++)
            {
                ref Frame frame = ref _frames[k];
                for (int m = 0; m < _values.Length; m++)
                {
                    if (_motion.Cycles[m].IsRigid)
                    {
                        Quaterniond turn = RotationVector.Exp(Vector(m, 3));
                        Vector3d about = _motion.Cycles[m].About;
                        frame.Now = about + Quaterniond.Rotate(turn, frame.Now - about) + Vector(m, 0);
                        frame.Tangent = Quaterniond.Rotate(turn, frame.Tangent);
                        frame.Turn = turn * frame.Turn;
                    }
                }
                frame.Map = MapOf(frame);
            }
        }

        private static Matrix3 MapOf(in Frame frame)
        {
            Quaterniond back = frame.Turn.Conjugate;
            double across = 1.0 / frame.Scale;
            var turn = new Matrix3(Quaterniond.Rotate(back, Vector3d.UnitX), Quaterniond.Rotate(back, Vector3d.UnitY),
                Quaterniond.Rotate(back, Vector3d.UnitZ));
            return across * turn
                + Matrix3.Outer((1.0 / frame.Stretch - across) * (turn * frame.Tangent), frame.Tangent);
        }

        // The centreline at point k, by the parabola through three points.
        private Curve CurveAt(int k, bool isNow)
        {
            int middle = _before[k] == k ? _after[k] : _after[k] == k ? _before[k] : k;
            int one = _before[middle];
            int two = _after[middle];
            Vector3d before = Place(middle, isNow) - Place(one, isNow);
            Vector3d after = Place(two, isNow) - Place(middle, isNow);
            double first = before.Length;
            double second = after.Length;
            var curve = new Curve { Length = first + second };
            if (first > 0.0 && second > 0.0)
            {
                before = (1.0 / first) * before;
                after = (1.0 / second) * after;
                curve.Curvature = (2.0 / (first + second)) * (after - before);
            }
            Vector3d along = k == middle ? second * before + first * after
                : k == one ? before - (0.5 * first) * curve.Curvature : after + (0.5 * second) * curve.Curvature;
            curve.Tangent = curve.Length > 0.0 ? Vector3d.Normalize(along.LengthSquared > 0.0 ? along : before + after)
                : Vector3d.Zero;
            return curve;
        }

        private Vector3d Place(int k, bool isNow) => isNow ? _frames[k].Now : _frames[k].Rest;

        private Vector3d Vector(int cycle, int at) =>
            new Vector3d(_values[cycle][at], _values[cycle][at + 1], _values[cycle][at + 2]);

        private struct Curve
        {
            public double Length;       // of the pieces beside the point
            public Vector3d Tangent;
            public Vector3d Curvature;
        }

        private struct Frame
        {
            public Vector3d Rest;       // c
            public Vector3d Now;        // c'
            public Vector3d Tangent;    // t'
            public Matrix3 Map;         // A
            public Vector3d Bend;       // b
            public Quaterniond Turn;    // R
            public double Scale;        // of the section
            public double Stretch;      // along the centreline
        }
    }
}
