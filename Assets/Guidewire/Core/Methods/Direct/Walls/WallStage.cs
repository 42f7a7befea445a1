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

    /// <summary>Carries a wire along with walls that move, before a stage is predicted: x becomes phi(psi(x)), with
    /// psi the map to the wall at rest before and phi that from it now. So its gaps stay as they are. Elements turn
    /// with their chords.</summary>
    /// <remarks>What is in a sheath stays. Where several walls move differently, the first one carries the wire, and
    /// another one what it is about to touch.</remarks>
    internal sealed class WallCarrier
    {
        private const double Reach = 2.0;      // of the way of a wall: what is nearer goes with it

        private readonly BarrierEnergy _barrier;
        private readonly Vector3d[][] _rest;   // images of the nodes, by wall, units
        private readonly Vector3d[] _from;     // nodes, m
        private readonly Vector3d[] _velocity; // of what is around them, m/s
        private int _first;                    // node outside the sheath
        private int _count;                    // of nodes
        private bool _isTaken;

        /// <summary>For a wire between these walls.</summary>
        /// <param name="capacity">The most elements that it will have.</param>
        public WallCarrier(BarrierEnergy barrier, int capacity)
        {
            _barrier = barrier;
            _rest = Array.ConvertAll(barrier.Fields.Of, field => new Vector3d[field == null ? 0 : capacity + 1]);
            _from = new Vector3d[capacity + 1];
            _velocity = new Vector3d[capacity + 1];
        }

        /// <summary>Takes where the wire is; the walls are where they were then.</summary>
        /// <returns>Whether any wall moves, or is predicted to.</returns>
        public bool TakePlaces(RodShape shape)
        {
            _isTaken = _barrier.Fields.IsTimed || Array.Exists(shape.VesselRates, rate => rate != Vector3d.Zero);
            _count = shape.ElementCount + 1;
            for (int w = 0; w < _rest.Length && _isTaken; w++)
            {
                if (_rest[w].Length > 0)
                {
                    Array.Copy(_barrier.ImagesOf(shape, w), _rest[w], shape.ElementCount + 1);
                }
            }
            _first = _isTaken ? _barrier.Nodes.Inside(shape) : 0;
            return _isTaken;
        }

        /// <summary>Carries the wire to where the walls are now.</summary>
        /// <param name="since">See <see cref="Around"/>.</param>
        /// <returns>The same.</returns>
        public Vector3d[]? Carry(RodShape shape, double since)
        {
            if (!_isTaken)
            {
                return null;
            }
            int n = shape.ElementCount;
            double metres = 1.0 / _barrier.UnitsPerMetre;
            Array.Copy(shape.X, _from, n + 1);
            for (int i = _first; i <= n; i++)
            {
                int w = CarrierOf(i);
                if (w >= 0)
                {
                    shape.X[i] = metres * _barrier.Fields.Of[w]!.Moved(_rest[w][i]);
                }
            }
            for (int j = Math.Max(_first - 1, 0); j < n; j++)
            {
                shape.Q[j] = Quaterniond.Shortest(_from[j + 1] - _from[j], shape.X[j + 1] - shape.X[j])
                    * shape.Q[j];
            }
            return Around(since);
        }

        /// <summary>How fast the first moving wall, and the blood in it, goes at the nodes that were taken, m/s; null
        /// where no wall that is around the wire moves.</summary>
        /// <param name="since">Over which time before the present one, s, as the scheme finds velocities too; 0: at
        /// it.</param>
        public Vector3d[]? Around(double since)
        {
            if (!_isTaken || !_barrier.Fields.IsTimed || !IsAround(_barrier.Fields.Carrier))
            {
                return null;    // the blood does not go with an obstacle
            }
            int first = _barrier.Fields.Carrier;
            _barrier.Fields.SetVelocities(first, _rest[first], _first, _count, since, _velocity);
            for (int i = 0; i < _count; i++)
            {
                _velocity[i] = 1.0 / _barrier.UnitsPerMetre * _velocity[i];
            }
            return _velocity;
        }

        private int CarrierOf(int i)
        {
            WallFields fields = _barrier.Fields;
            int carrier = fields.Carrier;
            carrier = IsAround(carrier) ? carrier : -1;
            for (int w = 0; w < _rest.Length; w++)
            {
                if (fields.Of[w] != null && fields.Shared[w] == w && !IsAround(w))
                {
                    double units = _barrier.UnitsPerMetre;
                    double way = Vector3d.Distance(units * _from[i], fields.Of[w]!.Moved(_rest[w][i]));
                    double range = units * (_barrier.LawOf(w).RadiusOfNode(i) + _barrier.LawOf(w).OfNode(i).Distance)
                        + Reach * way;
                    int hint = -1;
                    carrier = _barrier.Walls[w].Nearest(_rest[w][i], _rest[w][i], range, ref hint, out _) ? w : carrier;
                }
            }
            return carrier;
        }

        private bool IsAround(int w) => !(_barrier.Walls[w] is ConvexObstacle || _barrier.Walls[w] is ConeShape);
    }

    /// <summary>Normal force of the walls on each element of a wire. A force on a node between two elements is shared
    /// by both; a force on an end belongs to its element.</summary>
    /// <remarks>Pressure is the sum of an element's normal forces, regardless of their directions, over its length and
    /// its diameter: what it would be if it were spread over the element's shadow. So it does not depend on n where a
    /// wire lies along a wall; at a single contact point, such as the tip, it grows with n.</remarks>
    internal sealed class ElementContactForces
    {
        private readonly MaterialRod _rod;
        private readonly BarrierEnergy _barrier;
        private readonly double[] _shadow;   // 2 r l, m^2
        private readonly double[] _force;     // N

        /// <summary>Makes the forces of a rod's contacts.</summary>
        public ElementContactForces(MaterialRod rod, BarrierEnergy barrier)
        {
            _rod = rod;
            _barrier = barrier;
            _shadow = new double[rod.Capacity];
            _force = new double[rod.Capacity];
            Remesh();
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh()
        {
            for (int j = 0; j < _rod.ElementCount; j++)
            {
                _shadow[j] = 2.0 * _rod.Radius[j] * _rod.Length[j];
            }
        }

        /// <summary>Takes those of a shape, and how far soft walls give way.</summary>
        /// <param name="record">Receives them by element.</param>
        /// <param name="extremes">Receives the largest.</param>
        /// <param name="time">s.</param>
        public void Record(RodShape shape, ContactRecord record, RunExtremes extremes, double time)
        {
            Vector3d[] forces = record.ElementForces;
            Array.Clear(forces, 0, _rod.ElementCount);
            Array.Clear(_force, 0, _rod.ElementCount);
            StructList<WallContact> contacts = _barrier.ContactsOf(shape);
            for (int k = 0; k < contacts.Count; k++)
            {
                WallContact contact = contacts[k];
                int j = contact.Element;
                bool isShared = contact.Position == 0.0 && j > 0;
                Add(j, isShared ? 0.5 : 1.0, contact, forces);
                if (isShared)
                {
                    Add(j - 1, 0.5, contact, forces);
                }
            }
            double largest = 0.0;
            double pressure = 0.0;
            for (int j = 0; j < _rod.ElementCount; j++)
            {
                largest = Math.Max(largest, forces[j].Length);
                pressure = Math.Max(pressure, _force[j] / _shadow[j]);
            }
            record.Pressure = pressure;
            extremes.TakeWalls(largest, pressure, time);
            if (record.Displacements.Length > 0)
            {
                double share = TakeDisplacements(shape, record);
                extremes.TakeDisplacements(record.LargestDisplacement, share);
            }
        }

        private void Add(int j, double fraction, in WallContact contact, Vector3d[] forces)
        {
            forces[j] += (fraction * contact.Force) * contact.Normal;
            _force[j] += fraction * contact.Force;
        }

        // Displacements of soft walls; the largest over its wall's limit.
        private double TakeDisplacements(RodShape shape, ContactRecord record)
        {
            Array.Clear(record.Displacements, 0, _rod.ElementCount);
            StructList<WallContact> contacts = _barrier.ContactsOf(shape);
            double sum = 0.0;
            double share = 0.0;
            int count = 0;
            record.LargestDisplacement = 0.0;
            for (int k = 0; k < contacts.Count; k++)
            {
                ref WallContact contact = ref contacts[k];
                double moved = contact.Displacement;
                WallLaw law = _barrier.LawOf(contact.Wall);
                if (!law.IsSoft)
                {
                    continue;
                }
                sum += moved;
                count++;
                share = Math.Max(share, moved / law.DistanceAt(contact));
                record.LargestDisplacement = Math.Max(record.LargestDisplacement, moved);
                for (int j = contact.Element - (contact.IsNode && contact.Position == 0.0 ? 1 : 0);
                    j <= contact.Element; j++)
                {
                    int own = Math.Max(j, 0);
                    if (moved * moved > record.Displacements[own].LengthSquared)
                    {
                        record.Displacements[own] = -moved * contact.Normal;
                    }
                }
            }
            record.MeanDisplacement = count > 0 ? sum / count : 0.0;
            return share;
        }
    }
}
