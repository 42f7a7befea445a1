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
        private readonly double[] _border;       // of the pieces, m from node 0
        private readonly CrossSection[] _piece;
        private readonly double[] _station;      // of the n + 1 nodes, m from node 0

        /// <summary>Those of a wire.</summary>
        /// <param name="profile">What it is made of.</param>
        /// <param name="metres">Metres in one of the profile's units.</param>
        /// <param name="stations">Of its n + 1 nodes, m from node 0.</param>
        public JointPieces(WireProfile profile, double metres, double[] stations)
        {
            _border = Array.ConvertAll(profile.Borders, position => metres * position);
            _piece = profile.Pieces;
            _station = stations;
        }

        /// <summary>n + 1, m from node 0.</summary>
        public double[] Stations => _station;

        /// <summary>What is beyond a cut of the wire that joint k stands for.</summary>
        /// <param name="cut">m from node 0; what is before it is kept straight.</param>
        public JointPart Beyond(int k, double cut)
        {
            var part = default(JointPart);
            for (int side = -1; side <= 1; side += 2)
            {
                int other = k + side;
                if (other >= 0 && other < _station.Length)
                {
                    AddSide(_station[k], _station[other], cut, ref part);
                }
            }
            return part;
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
            int p = 0;
            while (p < _piece.Length - 1 && _border[p + 1] <= cut)
            {
                p++;
            }
            CrossSection piece = _piece[p];
            double full1 = moment1 + piece.BendStiffness1 * piece.RestCurvature.X;
            double full2 = moment2 + piece.BendStiffness2 * piece.RestCurvature.Y;
            return 0.5 * hat * (full1 * full1 / piece.BendStiffness1 + full2 * full2 / piece.BendStiffness2);
        }

        /// <summary>The next position after one, m from node 0, up to which releases are linear: a node or a border.
        /// </summary>
        public double NextBreak(double position)
        {
            return Math.Min(Next(_station, position), Next(_border, position));
        }

        private static double Next(double[] positions, double position)
        {
            int at = Array.BinarySearch(positions, position);
            at = at < 0 ? ~at : at + 1;
            return at < positions.Length ? positions[at] : double.PositiveInfinity;
        }

        // Of the element between the joint's node and another; the hat function falls from 1 to 0 between them.
        private void AddSide(double node, double other, double cut, ref JointPart part)
        {
            double from = Math.Min(node, other);
            double to = Math.Max(node, other);
            for (int p = 0; p < _piece.Length && _border[p] < to; p++)
            {
                double a = p == 0 ? from : Math.Max(from, _border[p]);
                double b = p == _piece.Length - 1 ? to : Math.Min(to, _border[p + 1]);
                if (a >= b)
                {
                    continue;
                }
                CrossSection piece = _piece[p];
                Vector3d rest = piece.RestCurvature;
                double middle = Math.Min(Math.Max(cut, a), b);
                double inside = Weight(a, middle, node, other);
                double beyond = Weight(middle, b, node, other);
                part.Length += beyond;
                part.Compliance1 += beyond / piece.BendStiffness1;
                part.Compliance2 += beyond / piece.BendStiffness2;
                part.Rest += beyond * rest;
                part.Held += 0.5 * inside * (piece.BendStiffness1 * rest.X * rest.X
                    + piece.BendStiffness2 * rest.Y * rest.Y);
            }
        }

        // Integral of the hat function from a to b.
        private static double Weight(double a, double b, double node, double other)
        {
            return (b - a) * (1.0 - Math.Abs(0.5 * (a + b) - node) / Math.Abs(other - node));
        }
    }
}
