using System;

namespace Guidewire.Core
{
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
                shape.Q[j] = WallPrediction.ShortestRotation(_from[j + 1] - _from[j], shape.X[j + 1] - shape.X[j])
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
}
