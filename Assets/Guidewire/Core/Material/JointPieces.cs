using System;

namespace Guidewire.Core
{
    /// <summary>The pieces of wire that each joint stands for, between the borders of the wire's sections: in
    /// series.</summary>
    /// <remarks>lambda_p, the weight of piece p, is the integral over it of the joint's hat function: 1 at its node, 0
    /// at both neighbours. The pieces share one moment, so compliances add up, sum(lambda_p/B_p), and so do turns at
    /// rest, sum(lambda_p kappa_p). Fractions of a stiffness instead are wrong by an amount that does not fall with the
    /// elements' length. The hat functions add up to 1 between two joints: what all joints together release where a cut
    /// moves on is that of the wire at the cut, wherever the nodes are.</remarks>
    internal sealed class JointPieces
    {
        private readonly InstrumentProfile _profile;
        private readonly CoaxialPieces _side;
        private readonly double[] _station;      // of the n + 1 nodes, m from node 0
        private readonly HubPlaces _hub = new HubPlaces(1);
        private readonly HubSpeeds _back = new HubSpeeds(1) { Exit = -1.0 };   // of the cut, towards node 0

        /// <summary>Those of a wire.</summary>
        /// <param name="stations">Of its n + 1 nodes, m from node 0.</param>
        public JointPieces(InstrumentProfile profile, double[] stations)
        {
            _profile = profile;
            _side = new CoaxialPieces(new[] { profile });
            _station = stations;
            _hub.Ends[0] = profile.Length;
        }

        /// <summary>n + 1, m from node 0.</summary>
        public double[] Stations => _station;

        /// <summary>The joint at node k with a cut: what is before it is kept straight.</summary>
        /// <param name="cut">m from node 0.</param>
        public CoaxialJoint CutAt(int k, double cut)
        {
            var joint = default(CoaxialJoint);
            _hub.Sheathed = cut;
            for (int other = Math.Max(k - 1, 0); other <= Math.Min(k + 1, _station.Length - 1); other++)
            {
                if (other != k)
                {
                    _side.AddSide(ref joint, _station[k], _station[other], 0, 0, _hub);
                }
            }
            return joint;
        }

        /// <summary>The derivatives of its sums as the cut moves towards node 0.</summary>
        /// <param name="cut">m from node 0.</param>
        public CoaxialJoint RateAt(int k, double cut)
        {
            var rate = default(CoaxialJoint);
            _hub.Sheathed = cut;
            for (int other = Math.Max(k - 1, 0); other <= Math.Min(k + 1, _station.Length - 1); other++)
            {
                if (other != k)
                {
                    _side.AddSideRate(ref rate, _station[k], _station[other], 0, 0, _hub, _back, 0.0, 0.0);
                }
            }
            return rate;
        }

        /// <summary>The fraction, weighted by its hat function, of the length of joint k that is beyond a
        /// cut.</summary>
        /// <param name="stations">Of the nodes, m, as the cut.</param>
        public static double FractionBeyond(double[] stations, int k, double cut)
        {
            double node = stations[k];
            if (cut <= (k > 0 ? stations[k - 1] : node))
            {
                return 1.0;
            }
            double before = k > 0 ? node - stations[k - 1] : 0.0;
            double after = k < stations.Length - 1 ? stations[k + 1] - node : 0.0;
            double beyond = cut < node ? after + (node - cut) * (1.0 + (cut - node + before) / before)
                : after > 0.0 ? Math.Pow(Math.Max(0.0, node + after - cut), 2.0) / after : 0.0;
            return beyond / (before + after);
        }

        /// <summary>The next position after one, m from node 0, up to which releases are linear: a node or a border.
        /// </summary>
        public double NextBreak(double position)
        {
            return Math.Min(Next(_station, position), Next(_profile.Borders, position));
        }

        private static double Next(double[] positions, double position)
        {
            int at = Array.BinarySearch(positions, position);
            at = at < 0 ? ~at : at + 1;
            return at < positions.Length ? positions[at] : double.PositiveInfinity;
        }
    }
}
