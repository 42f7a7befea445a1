using System;
using System.Runtime.CompilerServices;
#if NET8_0_OR_GREATER
using System.Runtime.Intrinsics;
#endif

namespace Guidewire.Core
{
    /// <summary>Prediction of a stage of a wire between walls: it advances along itself as far as its first node,
    /// changes its shape as in the stage before, and is moved along the walls' normals: off where it would come too
    /// near, back where it touched.</summary>
    /// <remarks>With c(s) the curve through the nodes and p the travel along it, x_i -> c(s_i + p) + x_i - c'(s_i +
    /// p'), where ' was a stage before, x' = 2 x - x~ with x~ where the nodes would go without forces: where p is 0,
    /// that is free flight, and a wire that slides along its walls preserves its shape. Free flight alone would leave
    /// the curve by p^2/2 of its curvature, and lengthen elements that turn. Beyond the tip of an outer instrument s,
    /// p and p' are the inner one's: what slid out in the stage before is no change of shape. Nodes in a
    /// sheath stay on its axis. Each element turns with its chord, and about it by its spin.</remarks>
    internal sealed class WallPrediction
    {
        private const int MaxParts = 16;
        private const double OfElement = 1.0;
        private readonly RodSupports _supports;
        private readonly WallProjection _projection;
        private readonly InertiaEnergy _inertia;
        private readonly Vector3d[] _past;       // x'
        private readonly Vector3d[] _before;     // x
        private readonly Vector3d[] _change;     // x - c'(s + p')
        private readonly Vector3d[] _point;
        private readonly Vector3d[] _slope;      // of the curve through x' or x by s
        private readonly double[] _length;       // from node i - 1 to node i in x, m
        private readonly double[] _at;           // s_i, m
        private readonly MaterialRod _rod;
        private double _shortest;                // element, m
        private readonly CoaxialBendTwist? _coaxial;
        private readonly double[] _slide;         // of each node with its instrument, m
        private readonly double[] _slideBefore;   // a stage before
        private Vector3d _start;
        private bool _isHeld;
        private bool _hasLengths;
        private double _travel;                     // p, m

        /// <summary>For a rod under terms that hold walls.</summary>
        public WallPrediction(RodTerms terms, InertiaEnergy inertia)
        {
            _supports = terms.Supports;
            _projection = new WallProjection(terms.Walls()!.Barrier);
            _inertia = inertia;
            _rod = terms.Rod;
            _past = new Vector3d[_rod.Capacity + 1];
            _before = new Vector3d[_past.Length];
            _change = new Vector3d[_past.Length];
            _point = new Vector3d[_past.Length];
            _slope = new Vector3d[_past.Length];
            _length = new double[_past.Length];
            _at = new double[_past.Length];
            _coaxial = terms.CoaxialBending;
            _slide = new double[_past.Length];
            _slideBefore = new double[_past.Length];
            Remesh();
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh()
        {
            Array.Clear(_slide, 0, _slide.Length);
            Array.Clear(_slideBefore, 0, _slide.Length);
            _shortest = double.PositiveInfinity;
            for (int j = 0; j < _rod.ElementCount; j++)
            {
                _at[j + 1] = _at[j] + _rod.Length[j];
                bool isAtTip = _coaxial != null && _coaxial.Joints.IsTip(j);
                _shortest = isAtTip ? _shortest : Math.Min(_shortest, _rod.Length[j]);
            }
        }

        /// <summary>Elements are to have the lengths that they have in this shape, before walls carry it
        /// along.</summary>
        public void TakeLengths(RodShape shape)
        {
            _hasLengths = true;
            for (int i = 1; i <= shape.ElementCount; i++)
            {
                _length[i] = Vector3d.Distance(shape.X[i - 1], shape.X[i]);
            }
        }

        /// <summary>Takes a shape from which predictions start.</summary>
        /// <param name="shape">Where the wire is.</param>
        /// <param name="start">Where node 0 is to be, m.</param>
        /// <returns>In how many parts the motion should be divided: in each a node moves at most an element
        /// along the curve, so that straight paths of the nodes stay near it.</returns>
        public int Begin(RodShape shape, in Vector3d start)
        {
            int n = shape.ElementCount;
            for (int i = 0; i <= n; i++)
            {
                _before[i] = shape.X[i];
                _past[i] = 2.0 * shape.X[i] - _inertia.FreePositions[i];
            }
            if (!_hasLengths)
            {
                TakeLengths(shape);
            }
            _hasLengths = false;
            Vector3d along = shape.Q[0].Director3;
            _isHeld = _supports.Proximal != ProximalEnd.Free;
            _start = start;
            _travel = Vector3d.Dot((_isHeld ? start : _inertia.FreePositions[0]) - shape.X[0], along);
            int at = 0;
            SetSlide();
            double travelBefore = Vector3d.Dot(shape.X[0] - _past[0], along);
            ShiftInner(-1.0);
            SetSlopes(_past);
            for (int i = 0; i <= n; i++)
            {
                double s = _at[i] + _slideBefore[i];
                _change[i] = shape.X[i] - PointOn(_past, s + travelBefore, ref at);
            }
            ShiftInner(1.0);
            SetSlopes(_before);
            double farthest = Math.Abs(_travel);
            for (int i = 0; i <= n; i++)
            {
                farthest = Math.Max(farthest, Math.Abs(_travel + _slide[i]));
            }
            return (int)Math.Min(MaxParts, Math.Ceiling(Math.Max(1.0, farthest / (OfElement * _shortest))));
        }

        /// <summary>Sets the prediction.</summary>
        /// <param name="fraction">Of the stage's time.</param>
        /// <param name="orientations">The elements' by their spins, of which the turn about the element counts.</param>
        /// <param name="shape">Where the wire is now.</param>
        /// <param name="predicted">Receives it; its last node, where that is held, and its frames are kept.</param>
        public void Set(double fraction, Quaterniond[] orientations, RodShape shape, RodShape predicted)
        {
            int n = shape.ElementCount;
            int last = _supports.Distal == DistalEnd.Free ? n : n - 1;
            int at = 0;
            for (int i = 0; i <= last; i++)
            {
                double travel = _travel + _slide[i];
                _point[i] = PointOn(_before, _at[i] + fraction * travel, ref at) + fraction * _change[i];
            }
            StraightenInSheath(last);
            predicted.X[0] = _isHeld ? Vector3d.Lerp(_before[0], _start, fraction) : _point[0];
            PlaceAtLengths(_point, predicted.X, last, fraction);
            _projection.Apply(shape, predicted, last);
            Array.Copy(predicted.X, _point, last + 1);
            PlaceAtLengths(_point, predicted.X, last, fraction);
            int j = 0;
            while (j < n)
            {
                int stop = Math.Min(j + 4, n);
                if (stop == j + 4 && PredictionLanes.Turn(shape, orientations, predicted, j))
                {
                    j = stop;
                }
                for (; j < stop; j++)
                {
                    Turn(shape, orientations, predicted, j);
                }
            }
        }

        /// <summary>Turns element j of a prediction, whose nodes are set, with its chord, and about it by its
        /// spin.</summary>
        public static void Turn(RodShape shape, Quaterniond[] orientations, RodShape predicted, int j)
        {
            Vector3d before = shape.X[j + 1] - shape.X[j];
            Vector3d after = predicted.X[j + 1] - predicted.X[j];
            Vector3d spin = RotationVector.Log(shape.Q[j].Conjugate * orientations[j]);
            predicted.Q[j] = Quaterniond.Shortest(before, after) * shape.Q[j]
                * RotationVector.Exp(new Vector3d(0.0, 0.0, spin.Z));
        }

        // The curve through nodes near the exit bends before it, which no sheath lets a wire do.
        private void StraightenInSheath(int last)
        {
            SheathEnd? sheath = _supports.SheathEnd;
            for (int i = 0; i <= last && sheath != null && sheath.Outside(_point[i]) < 0.0; i++)
            {
                _point[i] = sheath.OnAxis(_point[i]);
            }
        }

        // What slides out of outer instruments in the stage, and where nodes are before it does; in the stage before,
        // by how much the elements at tips became longer.
        private void SetSlide()
        {
            if (_coaxial == null)
            {
                return;
            }
            CoaxialJoints joints = _coaxial.Joints;
            for (int i = joints.OuterCount + 1; i <= _rod.ElementCount; i++)
            {
                _slide[i] = _coaxial.SlideOf(joints.CarrierOf(i - 1));
                _slideBefore[i] = joints.IsTip(i - 1)
                    ? _slideBefore[i - 1] + (_length[i] - Vector3d.Distance(_past[i - 1], _past[i]))
                    : _slideBefore[i - 1];
                _at[i] = joints.Stations[i] - _slide[i];
            }
        }

        // Along the curve, by what slid out in the stage before.
        private void ShiftInner(double sense)
        {
            for (int i = 0; i <= _rod.ElementCount; i++)
            {
                _at[i] += sense * _slideBefore[i];
            }
        }

        // Nodes 1 to last one after the other, in the directions of a curve, at unchanged distances: a compressed wire
        // would be an unstable start.
        private void PlaceAtLengths(Vector3d[] curve, Vector3d[] x, int last, double fraction)
        {
            int i = 1;
            while (i <= last)
            {
                int stop = Math.Min(i + 4, last + 1);
                if (stop == i + 4 && PredictionLanes.PlaceAtLengths(curve, x, _length, _slide, fraction, i))
                {
                    i = stop;
                }
                for (; i < stop; i++)
                {
                    double length = _length[i] + fraction * (_slide[i] - _slide[i - 1]);
                    x[i] = x[i - 1] + length * Vector3d.Normalize(curve[i] - curve[i - 1]);
                }
            }
        }

        // The point at s on the curve through nodes, from the element found last: cubic between two of them, with the
        // slopes of parabolas through three; behind the ends on the parabola there, at most an element or two.
        private Vector3d PointOn(Vector3d[] x, double s, ref int j)
        {
            int n = _rod.ElementCount;
            while (j + 1 < n && s > _at[j + 1])
            {
                j++;
            }
            while (j > 0 && s < _at[j])
            {
                j--;
            }
            double length = _at[j + 1] - _at[j];
            double u = (s - _at[j]) / length;
            Vector3d chord = x[j + 1] - x[j];
            Vector3d first = length * _slope[j];
            Vector3d second = length * _slope[j + 1];
            if (u < 0.0)
            {
                return x[j] + u * first;
            }
            if (u > 1.0)
            {
                double over = u - 1.0;
                return x[j + 1] + over * second + Math.Min(over * over, 0.5 * over) * (second - chord);
            }
            return x[j] + u * chord + (u * (1.0 - u)) * ((1.0 - u) * (first - chord) - u * (second - chord));
        }

        // Those of the parabolas through three nodes, at the ends through the last three.
        private void SetSlopes(Vector3d[] x)
        {
            int n = _rod.ElementCount;
            double before = _at[1] - _at[0];
            Vector3d one = (x[1] - x[0]) / before;
            _slope[0] = one;
            _slope[n] = one;
            for (int i = 1; i < n; i++)
            {
                double after = _at[i + 1] - _at[i];
                Vector3d two = (x[i + 1] - x[i]) / after;
                Vector3d bend = (two - one) / (before + after);
                _slope[i] = one + before * bend;
                _slope[0] = i == 1 ? one - before * bend : _slope[0];
                _slope[n] = two + after * bend;
                before = after;
                one = two;
            }
        }
    }

    /// <summary>Moves nodes of a shape along the walls' normals, until those that touched a wall in the shape before
    /// have the gap that they had, and no other gap is less than half of the barrier's distance, up to the effect of
    /// one projection on the next.</summary>
    /// <remarks>A node that touched is pulled back too: where it would leave the wall in the first iteration of a step,
    /// nothing would hold it there, and it would hit the wall again in the next.</remarks>
    internal sealed class WallProjection
    {
        private const double ProjectedTo = 0.5;      // of the barrier's distance
        private const double MinLever = 0.1;
        private const double Pulled = 5.0;        // barrier's distances, from where a node is still pulled back
        private readonly BarrierEnergy _barrier;
        private readonly double _units;           // per metre
        private readonly StructList<ContactPoint> _contactPoints = new StructList<ContactPoint>(16);
        private readonly StructList<EdgeContact> _edgeContacts = new StructList<EdgeContact>(16);

        /// <summary>Off the walls of a barrier.</summary>
        public WallProjection(BarrierEnergy barrier)
        {
            _barrier = barrier;
            _units = barrier.UnitsPerMetre;
        }

        /// <summary>Moves nodes of a shape.</summary>
        /// <param name="before">The other shape.</param>
        /// <param name="shape">Its nodes 1 to <paramref name="last"/> are moved.</param>
        /// <param name="last">Up to n.</param>
        public void Apply(RodShape before, RodShape shape, int last)
        {
            NeighbourList near = _barrier.Near(shape, before);
            int n = shape.ElementCount;
            int first = _barrier.Nodes.Inside(shape);
            for (int w = 0; w < _barrier.Walls.Length; w++)
            {
                for (int i = Math.Max(first, 1); i <= last; i++)
                {
                    if (near.IsNodeNear(w, i))
                    {
                        ProjectNode(w, i, near, ref shape.X[i]);
                    }
                }
                for (int j = first; j < n; j++)
                {
                    if (near.IsNear(w, j))
                    {
                        ProjectElement(w, j, near, shape, last);
                    }
                }
            }
        }

        private void ProjectNode(int w, int i, NeighbourList near, ref Vector3d x)
        {
            double radius = _barrier.LawOf(w).RadiusOfNode(i);
            double distance = _barrier.LawOf(w).OfNode(i).Distance;
            double before = _barrier.NodeGap(w, i);
            bool touched = before < distance;
            double asked = touched ? before : ProjectedTo * distance;
            double nearest = !touched ? asked
                : Math.Min(Pulled * distance, distance + Pulled * _barrier.Barrier.Distance);
            _contactPoints.Clear();
            Vector3d point = _barrier.OnWall(w, _units * x);
            double range = _units * (radius + nearest);
            if (near.NodeMayBeInRange(w, i, point, range))
            {
                double found = _barrier.Walls[w].FindContactPoints(
                    point, range, near.FeaturesOfNode(w, i, point), _contactPoints);
                if (_contactPoints.Count == 0)
                {
                    near.SetDistanceOfNode(w, i, point, found);
                }
            }
            Vector3d normal = Vector3d.Zero;
            for (int k = 0; k < _contactPoints.Count; k++)
            {
                double gap = _contactPoints[k].Contact.Distance / _units - radius;
                if (gap < nearest && _contactPoints[k].Weight > 0)
                {
                    nearest = gap;
                    normal = _contactPoints[k].Contact.Normal;
                }
            }
            x += (asked - nearest) * _barrier.Away(w, _units * x, normal);
        }

        private void ProjectElement(int w, int j, NeighbourList near, RodShape shape, int last)
        {
            double radius = _barrier.LawOf(w).RadiusOf(j);
            double asked = Math.Min(_barrier.EdgeGap(w, j), ProjectedTo * _barrier.LawOf(w).DistanceOf(j));
            _edgeContacts.Clear();
            Vector3d start = _barrier.OnWall(w, _units * shape.X[j]);
            Vector3d end = _barrier.OnWall(w, _units * shape.X[j + 1]);
            _barrier.Walls[w].FindEdgeContacts(
                start, end, _units * (radius + asked), near.FeaturesOf(w, j, start, end), _edgeContacts);
            for (int k = 0; k < _edgeContacts.Count; k++)
            {
                ref EdgeContact edgeContact = ref _edgeContacts[k];
                double gap = edgeContact.Distance / _units - radius;
                if (gap < asked)
                {
                    double a = j > 0 ? 1.0 - edgeContact.Position : 0.0;
                    double b = j < last ? edgeContact.Position : 0.0;
                    double fraction = (asked - gap) / Math.Max(a * a + b * b, MinLever);
                    Vector3d normal = _barrier.Away(w, _units * shape.X[j], edgeContact.Normal);
                    shape.X[j] += fraction * a * normal;
                    shape.X[j + 1] += fraction * b * normal;
                    return;
                }
            }
        }
    }

    /// <summary>What <see cref="WallPrediction"/> and <see cref="WallStage"/> do for each element, of four successive
    /// ones at once, with their formulas in their order: the same bits.</summary>
    /// <remarks>False where nothing is done, because one of the four turns by more than the series can take or the
    /// processor has no such registers.</remarks>
    internal static class PredictionLanes
    {
#if NET8_0_OR_GREATER
        private const int Step = 6;   // numbers of a RodVector
#endif

        /// <summary>Places nodes i to i+3 one after the other, in the directions of a curve.</summary>
        /// <param name="slide">What slides out of outer instruments by node, of which a fraction is added to the
        /// lengths.</param>
        public static bool PlaceAtLengths(Vector3d[] curve, Vector3d[] x, double[] lengths, double[] slide,
            double fraction, int i)
        {
#if NET8_0_OR_GREATER
            if (!Rows4.IsSupported)
            {
                return false;
            }
            Vector256<double> length = Vector256.LoadUnsafe(ref lengths[i]) + Vector256.Create(fraction)
                * (Vector256.LoadUnsafe(ref slide[i]) - Vector256.LoadUnsafe(ref slide[i - 1]));
            Vector3d4 along = length
                * Vector3d4.Normalize(Vector3d4.Load(ref curve[i]) - Vector3d4.Load(ref curve[i - 1]));
            Vector3d last = x[i - 1];
            double px = last.X, py = last.Y, pz = last.Z;
            for (int k = 0; k < 4; k++)
            {
                px += along.X.GetElement(k);
                py += along.Y.GetElement(k);
                pz += along.Z.GetElement(k);
                x[i + k] = new Vector3d(px, py, pz);
            }
            return true;
#else
            return false;
#endif
        }

        /// <summary>Turns elements j to j+3 with their chords, and about these by their spins.</summary>
        /// <param name="orientations">By the spins.</param>
        /// <param name="predicted">Its nodes are set; receives the orientations.</param>
        public static bool Turn(RodShape shape, Quaterniond[] orientations, RodShape predicted, int j)
        {
#if NET8_0_OR_GREATER
            if (!Rows4.IsSupported)
            {
                return false;
            }
            Vector3d4 from = Vector3d4.Load(ref shape.X[j + 1]) - Vector3d4.Load(ref shape.X[j]);
            Vector3d4 to = Vector3d4.Load(ref predicted.X[j + 1]) - Vector3d4.Load(ref predicted.X[j]);
            Vector3d4 across = Vector3d4.Cross(from, to);
            Vector256<double> along = Vector3d4.Dot(from, to)
                + Vector256.Sqrt(from.LengthSquared) * Vector256.Sqrt(to.LengthSquared);
            Quaterniond4 q = Quaterniond4.Load(ref shape.Q[j]);
            Vector256<double> zero = Vector256<double>.Zero;
            if (!Vector256.GreaterThanAll(along, zero)
                || !RotationVector4.TryLog(q.Conjugate * Quaterniond4.Load(ref orientations[j]), out Vector3d4 spin)
                || !RotationVector4.TryExp(new Vector3d4(zero, zero, spin.Z), out Quaterniond4 about))
            {
                return false;
            }
            Quaterniond4 shortest = Quaterniond4.Normalize(new Quaterniond4(across.X, across.Y, across.Z, along));
            (shortest * q * about).Store(ref predicted.Q[j]);
            return true;
#else
            return false;
#endif
        }

        /// <summary>Sets the direction of nodes and elements j to j+3 from one shape to another.</summary>
        public static bool SetDirection(RodShape shape, RodShape to, RodVector[] direction, int j)
        {
#if NET8_0_OR_GREATER
            if (!Rows4.IsSupported || !RotationVector4.TryLog(
                Quaterniond4.Load(ref shape.Q[j]).Conjugate * Quaterniond4.Load(ref to.Q[j]), out Vector3d4 turn))
            {
                return false;
            }
            Vector3d4 move = Vector3d4.Load(ref to.X[j]) - Vector3d4.Load(ref shape.X[j]);
            Rows4.Store(ref direction[j].X1, Step, move.X, move.Y, move.Z, turn.X);
            Rows4.Store(ref direction[j].T2, Step, turn.Y, turn.Z);
            return true;
#else
            return false;
#endif
        }
    }
}
