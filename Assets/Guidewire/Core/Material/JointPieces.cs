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
        private readonly double[] _hub = new double[1];
        private readonly double[] _end;

        /// <summary>Those of a wire.</summary>
        /// <param name="stations">Of its n + 1 nodes, m from node 0.</param>
        public JointPieces(InstrumentProfile profile, double[] stations)
        {
            _profile = profile;
            _side = new CoaxialPieces(new[] { profile });
            _station = stations;
            _end = new[] { profile.Length };
        }

        /// <summary>n + 1, m from node 0.</summary>
        public double[] Stations => _station;

        /// <summary>The joint at node k with a cut: what is before it is kept straight.</summary>
        /// <param name="cut">m from node 0.</param>
        public CoaxialJoint CutAt(int k, double cut)
        {
            var joint = default(CoaxialJoint);
            for (int other = Math.Max(k - 1, 0); other <= Math.Min(k + 1, _station.Length - 1); other++)
            {
                if (other != k)
                {
                    _side.AddSide(ref joint, _station[k], _station[other], 0, 0, cut, _hub, _end);
                }
            }
            return joint;
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

        /// <summary>By how much the energy of joint k falls, J/m, as a cut moves towards node 0: the wire at the cut
        /// is straight before it and bends by its moment beyond. (m + B kappa)^2/(2 B) about each axis, times the hat
        /// function there.</summary>
        /// <param name="cut">m from node 0.</param>
        /// <param name="moment1">m about d1, N m: of the joint, 0 at its turn at rest.</param>
        /// <param name="moment2">The same about d2.</param>
        public double ReleaseAt(int k, double cut, double moment1, double moment2)
        {
            int other = cut < _station[k] ? k - 1 : k + 1;
            if (other < 0 || other >= _station.Length)
            {
                return 0.0;
            }
            double hat = (_station[other] - cut) / (_station[other] - _station[k]);
            if (!(hat > 0.0))
            {
                return 0.0;
            }
            CrossSection piece = _profile.Pieces[_profile.PieceAt(cut)];
            double full1 = moment1 + piece.BendStiffness1 * piece.RestCurvature.X;
            double full2 = moment2 + piece.BendStiffness2 * piece.RestCurvature.Y;
            return 0.5 * hat * (full1 * full1 / piece.BendStiffness1 + full2 * full2 / piece.BendStiffness2);
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
