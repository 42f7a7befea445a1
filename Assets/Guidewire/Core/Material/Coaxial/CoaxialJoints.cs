using System;

namespace Guidewire.Core
{
    /// <summary>The joints of an instrument with another one inside it, on one shared centreline: nodes of the outer
    /// one up to its tip, then those of the inner one. They change with the inner one's insertion.</summary>
    /// <remarks>Positions along the chain are counted from the outer hub. The inner instrument's hub is the lead d
    /// behind it: between the hubs it is straight. Beyond the outer tip it sticks out by p = (its length) - d - (the
    /// outer one's length), and the element between that tip and the first inner node has the length l that follows
    /// from d, not from the nodes' positions: so the matrix stays block-tridiagonal. That element is stretched as all
    /// of the inner instrument from its hub is. An inner tip in the outer one is only a border of pieces.
    ///
    /// In a sheath the chain is straight, up to a length from the outer hub that follows from that hub: as an outermost
    /// instrument without bend that turns with what is inside. Its exit is a border of pieces, too.</remarks>
    internal sealed class CoaxialJoints
    {
        /// <summary>Fraction of a joint outside a sheath below which it counts as straight.</summary>
        public const double LeastFraction = 1e-3;

        private readonly InstrumentProfile _outer;
        private readonly InstrumentProfile _inner;
        private readonly double[] _innerStation;   // of the inner nodes, m from its hub
        private readonly double[] _station;        // of the chain's nodes
        private readonly CoaxialJoint[] _joint;
        private readonly int _tip;                 // the outer tip's node
        private CoaxialJoint _end;                 // of the last half element: only what it holds counts

        /// <summary>Joints of these instruments.</summary>
        /// <param name="outerStations">Nodes of the outer one, m from its hub.</param>
        /// <param name="innerStations">Nodes of the inner one, m from its hub.</param>
        /// <param name="beyond">How many of these, from the tip on, are nodes of the chain.</param>
        /// <param name="lead">d, m.</param>
        /// <param name="sheathed">Length of the chain in a sheath, m from the outer hub.</param>
        public CoaxialJoints(InstrumentProfile outer, InstrumentProfile inner, double[] outerStations,
            double[] innerStations, int beyond, double lead, double sheathed)
        {
            _outer = outer;
            _inner = inner;
            _innerStation = innerStations;
            _tip = outerStations.Length - 1;
            Beyond = beyond;
            _station = new double[_tip + 1 + beyond];
            Array.Copy(outerStations, _station, _tip + 1);
            _joint = new CoaxialJoint[_station.Length];
            SetHubs(lead, sheathed);
        }

        /// <summary>Elements of the chain.</summary>
        public int ElementCount => _station.Length - 1;

        /// <summary>Elements of the outer instrument.</summary>
        public int OuterCount => _tip;

        /// <summary>Inner nodes beyond the outer tip.</summary>
        public int Beyond { get; }

        /// <summary>Distance of the inner hub behind the outer one, d, m.</summary>
        public double Lead { get; private set; }

        /// <summary>Length of the chain in a sheath, m from the outer hub; 0 without one.</summary>
        public double Sheathed { get; private set; }

        /// <summary>How far the inner tip is beyond the outer one, p, m; negative inside.</summary>
        public double Extension => _inner.Length - Lead - _outer.Length;

        /// <summary>Elements, from the first on, whose twist angle is unknown.</summary>
        public int ActiveCount { get; private set; }

        /// <summary>Positions of the chain's nodes along it, m.</summary>
        public double[] Stations => _station;

        /// <summary>Energy of the inner instrument between the hubs, where it is kept straight, J.</summary>
        public double HeldInLead { get; private set; }

        /// <summary>The last half element of a chain that ends where both instruments are.</summary>
        public ref readonly CoaxialJoint End => ref _end;

        /// <summary>The joint at node k, 0 at the hub.</summary>
        public ref readonly CoaxialJoint this[int k] => ref _joint[k];

        /// <summary>Whether node k is the outer tip, with the inner instrument beyond it.</summary>
        public bool IsTip(int k)
        {
            return k == _tip && Beyond > 0;
        }

        /// <summary>Length of element j over that of what it stretches for: beyond the outer tip it is the axial spring
        /// of all of the wire from its hub.</summary>
        public double StretchedPart(int j)
        {
            return j == _tip && Beyond > 0 ? (_station[j + 1] - _station[j]) / (Lead + _station[j + 1]) : 1.0;
        }

        /// <summary>The length of the chain that the joint at node k stands for, m.</summary>
        public double LengthOf(int k)
        {
            return 0.5 * (_station[Math.Min(k + 1, _station.Length - 1)] - _station[Math.Max(k - 1, 0)]);
        }

        /// <summary>The fraction of that, weighted by the joint's hat function, that is not in a sheath.</summary>
        public double FractionOutside(int k)
        {
            double node = _station[k];
            if (Sheathed <= (k > 0 ? _station[k - 1] : node))
            {
                return 1.0;
            }
            double before = k > 0 ? node - _station[k - 1] : 0.0;
            double after = k < _station.Length - 1 ? _station[k + 1] - node : 0.0;
            double outside = Sheathed < node ? after + (node - Sheathed) * (1.0 + (Sheathed - node + before) / before)
                : after > 0.0 ? Math.Pow(Math.Max(0.0, node + after - Sheathed), 2.0) / after : 0.0;
            return outside / (before + after);
        }

        /// <summary>What both instruments are made of at node k, in the overlap.</summary>
        public void PiecesAt(int k, out CrossSection outer, out CrossSection inner)
        {
            outer = _outer.Pieces[_outer.PieceAt(_station[k])];
            inner = _inner.Pieces[_inner.PieceAt(_station[k] + Lead)];
        }

        /// <summary>The inner hub is this far behind the outer one, and the outer one this far in a sheath.</summary>
        /// <param name="lead">d, m.</param>
        /// <param name="sheathed">m.</param>
        public void SetHubs(double lead, double sheathed)
        {
            Lead = lead;
            Sheathed = sheathed;
            int first = _innerStation.Length - 1 - Beyond;
            for (int i = 1; i <= Beyond; i++)
            {
                _station[_tip + i] = _innerStation[first + i] - lead;
            }
            double end = Math.Min(_inner.Length - lead, _station[_tip]);
            ActiveCount = 0;
            while (ActiveCount < _tip && _station[ActiveCount] < end)
            {
                ActiveCount++;
            }
            HeldInLead = 0.0;
            for (int k = 0; k < _joint.Length; k++)
            {
                SetJoint(k);
            }
            _end = default;
            if (Beyond == 0)
            {
                AddSide(ref _end, _tip, _tip - 1, false, out _, out _);
            }
        }

        private void SetJoint(int k)
        {
            ref CoaxialJoint joint = ref _joint[k];
            joint = default;
            bool isTip = IsTip(k);
            double shared = 0.0;
            double sharedAfter = 0.0;
            Twists all = default;
            if (k > 0)
            {
                AddSide(ref joint, k, k - 1, isTip, out shared, out Twists before);
                all.Add(before);
            }
            if (k < _joint.Length - 1)
            {
                AddSide(ref joint, k, k + 1, isTip, out sharedAfter, out Twists after);
                all.Add(after);
            }
            double innerCompliance = all.InnerCompliance;
            double innerRest = all.InnerRest;
            joint.Weight = shared + sharedAfter > 0.0 ? sharedAfter / (shared + sharedAfter) : 0.0;
            if (k == 0)
            {
                AddLead(ref innerCompliance, ref innerRest);
                joint.Weight = 1.0 - 0.5 * all.InnerCompliance / innerCompliance;
            }
            if (k >= _tip && Beyond > 0)
            {
                joint.Twist = 1.0 / innerCompliance;
                joint.RestTwist = innerRest;
                return;
            }
            joint.Twist = 1.0 / all.OuterCompliance;
            joint.RestTwist = all.OuterRest;
            joint.InnerRestTwist = innerRest;
            if (k < ActiveCount)
            {
                joint.InnerTwist = 1.0 / innerCompliance;
            }
            else
            {
                joint.Weight = 0.0;
            }
        }

        // Adds the element between node k and another; its hat function falls from 1 to 0 between them.
        private void AddSide(ref CoaxialJoint joint, int k, int other, bool isTip, out double shared,
            out Twists twists)
        {
            double node = _station[k];
            double far = _station[other];
            double from = Math.Min(node, far);
            double to = Math.Max(node, far);

            double perLength = 1.0 / (to - from);
            shared = 0.0;
            twists = default;
            bool hasOuter = to <= _station[_tip];
            double innerEnd = _inner.Length - Lead;
            int o = _outer.PieceAt(from);
            int i = _inner.PieceAt(from + Lead);
            for (double at = from; at < to;)
            {
                bool hasInner = at < innerEnd;
                bool isSheathed = at < Sheathed;
                double next = isSheathed ? Math.Min(to, Sheathed) : to;
                if (hasOuter && o < _outer.Pieces.Length - 1)
                {
                    next = Math.Min(next, _outer.Borders[o + 1]);
                }
                if (hasInner)
                {
                    next = Math.Min(next, i < _inner.Pieces.Length - 1 ? _inner.Borders[i + 1] - Lead
                        : hasOuter ? innerEnd : to);
                }
                if (next > at)
                {
                    double lambda = (next - at) * (1.0 - Math.Abs(0.5 * (at + next) - node) * perLength);
                    int inner = hasInner || !hasOuter ? i : -1;
                    AddTwists(ref twists, lambda, hasOuter ? o : -1, inner);
                    if (isSheathed)
                    {
                        AddSheathed(ref joint, lambda, hasOuter ? o : -1, inner);
                    }
                    else
                    {
                        Add(ref joint, lambda, hasOuter ? o : -1, inner, isTip, ref shared);
                    }
                }
                at = Math.Max(next, at);
                o += hasOuter && o < _outer.Pieces.Length - 1 && at >= _outer.Borders[o + 1] ? 1 : 0;
                i += i < _inner.Pieces.Length - 1 && at >= _inner.Borders[i + 1] - Lead ? 1 : 0;
            }
        }

        private void AddTwists(ref Twists twists, double lambda, int outer, int inner)
        {
            if (outer >= 0)
            {
                ref CrossSection piece = ref _outer.Pieces[outer];
                twists.OuterCompliance += lambda / piece.TwistStiffness;
                twists.OuterRest += lambda * piece.RestCurvature.Z;
            }
            if (inner >= 0)
            {
                ref CrossSection piece = ref _inner.Pieces[inner];
                twists.InnerCompliance += lambda / piece.TwistStiffness;
                twists.InnerRest += lambda * piece.RestCurvature.Z;
            }
        }

        private void AddSheathed(ref CoaxialJoint joint, double lambda, int outer, int inner)
        {
            double bend = 0.0;
            double held = 0.0;
            if (outer >= 0)
            {
                bend += _outer.Pieces[outer].BendStiffness1;
                held += Straightened(_outer.Pieces[outer]);
            }
            if (inner >= 0)
            {
                bend += _inner.Pieces[inner].BendStiffness1;
                held += Straightened(_inner.Pieces[inner]);
            }
            joint.AddSheathed(lambda, bend, held);
        }

        private void Add(ref CoaxialJoint joint, double lambda, int outer, int inner, bool isTip, ref double shared)
        {
            if (outer >= 0 && inner >= 0)
            {
                shared += lambda;
                joint.AddShared(lambda, _outer.Pieces[outer], _inner.Pieces[inner], isTip);
            }
            else
            {
                joint.AddAlone(lambda, outer >= 0 ? _outer.Pieces[outer] : _inner.Pieces[inner]);
            }
        }

        private void AddLead(ref double compliance, ref double rest)
        {
            for (int p = 0; p < _inner.Pieces.Length; p++)
            {
                double length = Math.Min(Lead, _inner.Borders[p + 1]) - _inner.Borders[p];
                if (length > 0.0)
                {
                    ref CrossSection piece = ref _inner.Pieces[p];
                    compliance += length / piece.TwistStiffness;
                    rest += length * piece.RestCurvature.Z;
                    HeldInLead += length * Straightened(piece);
                }
            }
        }

        // Energy of a piece that is kept straight, J/m.
        private static double Straightened(in CrossSection piece)
        {
            Vector3d curvature = piece.RestCurvature;
            return 0.5 * (piece.BendStiffness1 * curvature.X * curvature.X
                + piece.BendStiffness2 * curvature.Y * curvature.Y);
        }

        // Of both instruments over the pieces where they are.
        private struct Twists
        {
            public double OuterCompliance;
            public double OuterRest;
            public double InnerCompliance;
            public double InnerRest;

            public void Add(in Twists other)
            {
                OuterCompliance += other.OuterCompliance;
                OuterRest += other.OuterRest;
                InnerCompliance += other.InnerCompliance;
                InnerRest += other.InnerRest;
            }
        }
    }
}
