using System;

namespace Guidewire.Core
{
    /// <summary>Coulomb friction of pbd contacts, at the level of positions: in each iteration, after its normal
    /// correction off the wall, a contact reverses the tangential displacement of its point, by at most mu times its
    /// total normal correction.</summary>
    /// <remarks>In a solve a contact's point is moved by P n along its normal, P the sum of its normal corrections, and
    /// by t along the wall. Both are impulses of the wall, P/W and t/W times 1/dt, over the same inverse mass W of the
    /// point. A wall with friction gives |t| &lt;= mu P (Coulomb): within that it brings the point back to where the
    /// solve began, which is no slip, and beyond it pulls against the slip that is left, with |t| = mu P. An iteration
    /// therefore asks for t - s, with s the motion along the wall since the solve began, t included; shortens that to
    /// what t may be; and moves the point by the change of t. That is projected Gauss-Seidel on the total, not on each
    /// correction: what an early iteration held too much is given back by a later one, and a contact that corrects in
    /// small portions, as stiffness below 1 does, has in the end the friction of their sum. With pbd a force in the
    /// wire is a correction in every iteration. Friction balances it only if it is applied likewise: in iteration i of
    /// m, t may be mu P i/m. Given all at once it would be spent in the first iterations, and the wire would slip
    /// without friction in those that are left: it creeps under less than mu times its weight. Past iteration m, where
    /// a part is solved again, t may be mu P. A solve begins where a part of a step does. The parts of a step hold no
    /// slip each, so none in the step, and their sums of t are at most mu times their sums of P. Turning about its own
    /// axis costs a wire nothing.</remarks>
    internal sealed class WallFriction
    {
        private readonly double _iterations;
        private readonly double[] _coefficient;    // mu, per contact
        private readonly int[] _done;              // i, per contact
        private readonly Vector3d[] _taken;        // t, units, per contact

        /// <param name="capacity">Contacts that fit.</param>
        /// <param name="iterations">m of a solve.</param>
        public WallFriction(int capacity, int iterations)
        {
            _iterations = Math.Max(1, iterations);
            _coefficient = new double[capacity];
            _done = new int[capacity];
            _taken = new Vector3d[capacity];
        }

        /// <summary>Starts contact k without friction so far.</summary>
        public void Add(int k, double coefficient)
        {
            _coefficient[k] = coefficient;
            _done[k] = 0;
            _taken[k] = Vector3d.Zero;
        }

        /// <summary>True where contact k has friction and a normal correction so far.</summary>
        public bool HasFriction(int k, double correction) => correction > 0.0 && _coefficient[k] > 0.0;

        /// <summary>t of contact k in units: how far friction has moved its point in this solve.</summary>
        public Vector3d Taken(int k) => _taken[k];

        /// <summary>Displacement of the point of contact k by friction in one iteration, units.</summary>
        /// <param name="k">The contact.</param>
        /// <param name="motion">Its point's motion since the solve began, units.</param>
        /// <param name="normal">Its normal n.</param>
        /// <param name="correction">P, units.</param>
        public Vector3d Correct(int k, in Vector3d motion, in Vector3d normal, double correction)
        {
            Vector3d slip = motion - Vector3d.Dot(motion, normal) * normal;
            Vector3d taken = _taken[k] - slip;
            _done[k]++;
            double most = _coefficient[k] * correction * Math.Min(1.0, _done[k] / _iterations);
            double size = taken.Length;
            if (size > most)
            {
                taken = (most / size) * taken;
            }
            Vector3d change = taken - _taken[k];
            _taken[k] = taken;
            return change;
        }
    }
}
