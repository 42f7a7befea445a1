using System;

namespace Guidewire.Core
{
    /// <summary>Where an implicit stage of a wire between walls begins: from the current shape it moves as far towards
    /// the prediction as the walls allow.</summary>
    internal sealed class WallStage
    {
        private const double LeastFraction = 1e-6;

        private readonly RodTerms _terms;
        private readonly RodSupports _supports;
        private readonly WallPrediction _prediction;
        private readonly RodShape _predicted;
        private readonly RodVector[] _direction;
        private readonly EnergyTerm[] _all;
        private readonly WallCarrier _carrier;
        private readonly RodShape _start;
        private Vector3d? _lag;                // of node 0 behind its support, before walls moved, m

        /// <summary>For a rod under terms that hold walls.</summary>
        /// <param name="all">Those and the terms of its motion.</param>
        public WallStage(RodTerms terms, InertiaEnergy inertia, EnergyTerm[] all)
        {
            _terms = terms;
            _supports = terms.Supports;
            _prediction = new WallPrediction(terms, inertia);
            _predicted = new RodShape(terms.Rod.ElementCount, terms.Supports.InnerCount, terms.Rod.Capacity);
            _direction = new RodVector[terms.VectorCapacity];
            _all = all;
            _carrier = new WallCarrier(terms.Walls()!.Barrier, terms.Rod.Capacity);
            _start = new RodShape(terms.Rod.ElementCount, terms.Supports.InnerCount, terms.Rod.Capacity);
        }

        /// <summary>Takes where the wire is, before walls go to where they are in this stage.</summary>
        public void TakePlaces(RodShape shape)
        {
            _lag = null;
            if (_carrier.TakePlaces(shape))
            {
                _prediction.TakeLengths(shape);
                _lag = _terms.Walls()!.Spring.LagOf(shape);
            }
        }

        /// <summary>See <see cref="WallCarrier.Around"/>.</summary>
        public Vector3d[]? Around() => _carrier.Around(0.0);

        /// <summary>Carries the wire along with walls that have moved; see <see cref="WallCarrier.Carry"/>. A vessel
        /// that gives way goes on as in the last step, unless what holds the wire would then touch it.</summary>
        /// <param name="began">Displacements of its splines when the step began, m.</param>
        /// <param name="elapsed">Since then, s.</param>
        public Vector3d[]? Carry(RodShape shape, double since, Vector3d[] began, double elapsed)
        {
            BarrierEnergy barrier = _terms.Walls()!.Barrier;
            _start.CopyFrom(shape);
            for (int j = 0; j < began.Length; j++)
            {
                shape.Vessel[j] = began[j] + Math.Min(elapsed, shape.VesselInterval) * shape.VesselRates[j];
            }
            barrier.FollowVessel(shape);
            Vector3d[]? around = _carrier.Carry(shape, since);
            if (began.Length > 0 && !(barrier.LeastGap(shape) > 0.0))
            {
                shape.CopyFrom(_start);
                barrier.FollowVessel(shape);
                around = _carrier.Carry(shape, since);
            }
            return around;
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh()
        {
            Array.Clear(_direction, 0, _direction.Length);
            _prediction.Remesh();
        }

        /// <summary>Begins a stage.</summary>
        /// <param name="shape">In: where the wire was, its frames turned. Out: where the search begins.</param>
        /// <param name="orientations">The prediction of the elements' orientations.</param>
        /// <param name="start">Where node 0 is to be, m.</param>
        /// <param name="end">Where the last node is held, if it is.</param>
        /// <returns>Null, or why it has no solution; the shape is then not to be used.</returns>
        public string? Begin(RodShape shape, Quaterniond[] orientations, in Vector3d start, in Vector3d end)
        {
            SupportSpring spring = _terms.Walls()!.Spring;
            Vector3d lag = _lag ?? spring.LagOf(shape);
            spring.Position = start;
            spring.ReleaseForce = _terms.Release?.SheathForceAtStart ?? 0.0;
            _terms.Walls()!.Lag(shape);
            PlaceEnd(shape, end);
            int parts = _prediction.Begin(shape, start - lag);
            for (int k = 1; k <= parts; k++)
            {
                _predicted.CopyFrom(shape);
                _prediction.Set((double)k / parts, orientations, shape, _predicted);
                SetDirection(shape);
                double fraction = EnergySum.MaxStep(_all, shape, _direction, 1.0);
                if (!(fraction > 0.0) && k == 1)
                {
                    return "the wire's surface touches a wall or itself at the start of the step";
                }
                fraction = Advance(shape, fraction);
                if (fraction < 1.0)
                {
                    break;
                }
            }
            return null;
        }

        // Straight paths of nodes are not straight as a moving wall sees them: what ends in it is halved.
        private double Advance(RodShape shape, double fraction)
        {
            BarrierEnergy barrier = _terms.Walls()!.Barrier;
            if (barrier.Fields.Carrier < 0)
            {
                RodStep.ApplyStraight(shape, _direction, fraction, shape);
                return fraction;
            }
            _start.CopyFrom(shape);
            RodStep.ApplyStraight(shape, _direction, fraction, shape);
            while (!(barrier.LeastGap(shape) > 0.0) && fraction > 0.0)
            {
                fraction = fraction > LeastFraction ? 0.5 * fraction : 0.0;
                RodStep.ApplyStraight(_start, _direction, fraction, shape);
            }
            return fraction;
        }

        // A held last node is where its support is.
        private void PlaceEnd(RodShape shape, in Vector3d end)
        {
            int n = shape.ElementCount;
            if (_supports.Distal != DistalEnd.Free)
            {
                Vector3d miss = end - shape.X[n];
                shape.X[n] += _supports.Distal == DistalEnd.Sliding
                    ? miss - Vector3d.Dot(miss, _supports.SlidingAxis) * _supports.SlidingAxis : miss;
            }
        }

        private void SetDirection(RodShape shape)
        {
            int n = shape.ElementCount;
            int j = 0;
            while (j <= n)
            {
                int stop = Math.Min(j + 4, n + 1);
                if (stop <= n && PredictionLanes.SetDirection(shape, _predicted, _direction, j))
                {
                    j = stop;
                }
                for (; j < stop; j++)
                {
                    Vector3d move = _predicted.X[j] - shape.X[j];
                    Vector3d turn = j < n ? RotationVector.Log(shape.Q[j].Conjugate * _predicted.Q[j]) : Vector3d.Zero;
                    _direction[j] = new RodVector(move, turn);
                }
            }
        }
    }

    /// <summary>Into how many equal parts a step between walls is divided: none moves or turns the proximal end farther
    /// than the range of the barriers.</summary>
    internal static class BarrierRange
    {
        private const int MaxParts = 64;
        private const double LargestTurn = 0.5;   // radians a part
        private const double SmallExcess = 0.01;  // over the longest part without dividing it

        /// <summary>Gives the parts of the next step of dt, s.</summary>
        public static int PartsOf(RodDynamics dynamics, RodSchedule schedule, double dt)
        {
            WallTerms walls = dynamics.Terms.Walls()!;
            double start = dynamics.Time;
            double end = start + dt;
            bool isCarried = walls.Barrier.Fields.IsTimed && !walls.HoldsStart;
            double move = isCarried ? 0.0 : Vector3d.Distance(
                schedule.Hub.PositionAt(end) - walls.Spring.LagOf(dynamics.Shape), dynamics.Shape.X[0]);
            move = Math.Max(move, schedule.InnerMove(dt));
            double turn = Math.Abs(schedule.Hub.FrameTurnAt(end) - dynamics.ProximalTurn)
                + Math.Abs(schedule.Distal.TurnAt(end) - dynamics.DistalTurn);
            if (schedule.HasMotions)
            {
                turn += schedule.AngleBetween(start, end);
                move = Math.Max(move, Vector3d.Distance(
                    schedule.Distal.PositionAt(start), schedule.Distal.PositionAt(end)));
            }
            // Rounding, and the small distance of node 0 from its support, must not add a part.
            double longest = BarrierDefaults.MaxMove * walls.Barrier.Barrier.Distance;
            double parts = Math.Ceiling(Math.Max(move / longest, turn / LargestTurn) * (1.0 - SmallExcess));
            return (int)Math.Min(Math.Max(parts, 1.0), MaxParts);
        }
    }
}
