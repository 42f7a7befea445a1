using System;

namespace Guidewire.Core
{
    /// <summary>The pieces of coaxial instruments along one side of a joint, from one border of any of them to the
    /// next.</summary>
    internal sealed class CoaxialPieces
    {
        private const double Retained = 1e-4;  // of the shear compliance of what is in a sheath

        private readonly CrossSection[][] _pieces;   // of each instrument
        private readonly double[][] _borders;
        private readonly int[] _piece;         // where each is
        private readonly bool[] _isPresent;
        private int _carrier;                  // the outermost one
        private int _presentCount;

        /// <summary>Of these instruments, the outermost one first.</summary>
        public CoaxialPieces(InstrumentProfile[] instruments)
        {
            _pieces = Array.ConvertAll(instruments, profile => profile.Pieces);
            _borders = Array.ConvertAll(instruments, profile => profile.Borders);
            _piece = new int[instruments.Length];
            _isPresent = new bool[instruments.Length];
            Compliance = new double[instruments.Length];
            Rest = new double[instruments.Length];
            Shared = new double[instruments.Length];
            Stretch = new double[instruments.Length];
        }

        /// <summary>Called after each piece with the integral of the joint's hat function over it, m, and whether it is
        /// in a sheath; or null.</summary>
        public Action<double, bool>? Added { get; set; }

        /// <summary>Sum of lambda/GJ of each, rad/(N m).</summary>
        public double[] Compliance { get; }

        /// <summary>Sum of lambda times the rest twist of each, rad.</summary>
        public double[] Rest { get; }

        /// <summary>Sum of lambda where each is with others, out of a sheath, m.</summary>
        public double[] Shared { get; }

        /// <summary>Sum of lengths over EA of each, m/N.</summary>
        public double[] Stretch { get; }

        /// <summary>Sum of lengths over the EA of all that are there together, m/N.</summary>
        public double Axial { get; private set; }

        /// <summary>Sum of lengths over the GA of all that are there, m/N; in a sheath less.</summary>
        public double Shear { get; private set; }

        /// <summary>There are no pieces yet.</summary>
        public void Clear()
        {
            Shear = 0.0;
            Axial = 0.0;
            for (int i = 0; i < _piece.Length; i++)
            {
                Compliance[i] = 0.0;
                Rest[i] = 0.0;
                Shared[i] = 0.0;
                Stretch[i] = 0.0;
            }
        }

        /// <summary>Adds an element on one side of a joint; its hat function falls from 1 at the node to 0 at the other
        /// end.</summary>
        /// <param name="node">m along the chain, as is the other end.</param>
        /// <param name="carrier">The outermost instrument there.</param>
        /// <param name="frame">The instrument on whose frame the joint stands.</param>
        public void AddSide(ref CoaxialJoint joint, double node, double far, int carrier, int frame, HubPlaces hubs)
        {
            double from = Math.Min(node, far);
            double to = Math.Max(node, far);
            double perLength = 1.0 / (to - from);
            bool isSheathed = Begin(carrier, from, hubs);
            for (double at = from; at < to;)
            {
                double next = FindNext(isSheathed ? Math.Min(to, hubs.Sheathed) : to, hubs, out int nearest);
                if (next > at)
                {
                    double lambda = (next - at) * (1.0 - Math.Abs(0.5 * (at + next) - node) * perLength);
                    Add(ref joint, next - at, lambda, frame, isSheathed);
                }
                at = Math.Max(next, at);
                isSheathed &= at < hubs.Sheathed;
                Pass(nearest);
            }
        }

        /// <summary>Adds the derivatives of the same sums while borders and nodes move: every sum is linear in the
        /// lengths and in their weights.</summary>
        /// <param name="rate">The joint's.</param>
        /// <param name="nodeSpeed">Of the node, as the others over that of what the derivative is by.</param>
        /// <returns>Whether any of them is not 0.</returns>
        /// <remarks>A border at the side's first end has yet to pass it, and then a piece without length has a
        /// derivative.</remarks>
        public bool AddSideRate(ref CoaxialJoint rate, double node, double far, int carrier, int frame, HubPlaces hubs,
            HubSpeeds speeds, double nodeSpeed, double farSpeed)
        {
            bool isAfter = node < far;
            (double from, double fromSpeed) = isAfter ? (node, nodeSpeed) : (far, farSpeed);
            (double to, double toSpeed) = isAfter ? (far, farSpeed) : (node, nodeSpeed);
            double perLength = 1.0 / (to - from);
            double stretching = (toSpeed - fromSpeed) * perLength;
            double atSpeed = fromSpeed;
            bool isSheathed = Begin(carrier, from, hubs);
            bool moves = false;
            for (double at = from; at < to;)
            {
                bool endsInSheath = isSheathed && hubs.Sheathed < to;
                double next = FindNext(endsInSheath ? hubs.Sheathed : to, hubs, out int nearest);
                double nextSpeed = nearest >= 0 ? speeds.Instruments[nearest] : endsInSheath ? speeds.Exit : toSpeed;
                double distance = Math.Abs(0.5 * (at + next) - node) * perLength;
                double apart = (0.5 * (atSpeed + nextSpeed) - nodeSpeed) * perLength;
                double length = Math.Max(next - at, 0.0);
                double grows = nextSpeed - atSpeed;
                double lambda = grows * (1.0 - distance)
                    - length * ((isAfter ? apart : -apart) - distance * stretching);
                if (grows != 0.0 || lambda != 0.0)
                {
                    Add(ref rate, grows, lambda, frame, isSheathed);
                    moves = true;
                }
                at = Math.Max(next, at);
                atSpeed = nextSpeed;
                isSheathed &= at < hubs.Sheathed;
                Pass(nearest);
            }
            return moves;
        }

        // The first pieces from a position on; whether they are in a sheath.
        private bool Begin(int carrier, double from, HubPlaces hubs)
        {
            _carrier = carrier;
            for (int i = carrier; i < _piece.Length; i++)
            {
                double[] borders = _borders[i];
                int p = _piece[i];    // where the last joint ended: mostly the same
                while (p > 0 && borders[p] - hubs.Leads[i] >= from)
                {
                    p--;
                }
                while (p < borders.Length - 2 && borders[p + 1] - hubs.Leads[i] < from)
                {
                    p++;
                }
                _piece[i] = p;
                _isPresent[i] = i == carrier || from <= hubs.Ends[i];
            }
            return from <= hubs.Sheathed;
        }

        // The next border of a piece, no farther than 'to', and the instrument whose it is; -1: that is 'to'.
        private double FindNext(double to, HubPlaces hubs, out int nearest)
        {
            double next = to;
            nearest = -1;
            _presentCount = 0;
            for (int i = _carrier; i < _piece.Length; i++)
            {
                if (_isPresent[i])
                {
                    int p = _piece[i];
                    double[] borders = _borders[i];
                    _presentCount++;
                    double border = p < borders.Length - 2 ? borders[p + 1] - hubs.Leads[i]
                        : i == _carrier ? to : hubs.Ends[i];
                    if (border < next)
                    {
                        next = border;
                        nearest = i;
                    }
                }
            }
            return next;
        }

        // Adds the pieces up to that border, of a length, m, to a joint with the integral of its hat function, m.
        private void Add(ref CoaxialJoint joint, double length, double lambda, int frame, bool isSheathed)
        {
            double shear = 0.0;
            double axial = 0.0;
            double bend = 0.0;
            double held = 0.0;
            for (int i = _carrier; i < _piece.Length; i++)
            {
                if (_isPresent[i])
                {
                    ref readonly CrossSection piece = ref PieceOf(i);
                    shear += piece.ShearStiffness;
                    axial += piece.StretchStiffness;
                    Stretch[i] += length / piece.StretchStiffness;
                    Compliance[i] += lambda / piece.TwistStiffness;
                    Rest[i] += lambda * piece.RestCurvature.Z;
                    if (isSheathed)
                    {
                        bend += piece.BendStiffness1;
                        held += Straightened(piece);
                    }
                    else if (i != frame)
                    {
                        Shared[i] += lambda;
                    }
                }
            }
            Axial += length / axial;
            Shear += (isSheathed ? Retained : 1.0) * length / shear;
            if (isSheathed)
            {
                joint.AddSheathed(lambda, bend, held);
            }
            else
            {
                AddBend(ref joint, lambda, frame);
            }
            Added?.Invoke(lambda, isSheathed);
        }

        // The border of an instrument's piece; one at a time, as others in the same place move otherwise.
        private void Pass(int instrument)
        {
            if (instrument < 0)
            {
                return;
            }
            if (_piece[instrument] < _borders[instrument].Length - 2)
            {
                _piece[instrument]++;
                return;
            }
            _isPresent[instrument] = false;
        }

        /// <summary>Energy of a piece that is kept straight, J/m.</summary>
        public static double Straightened(in CrossSection piece)
        {
            Vector3d curvature = piece.RestCurvature;
            return 0.5 * (piece.BendStiffness1 * curvature.X * curvature.X
                + piece.BendStiffness2 * curvature.Y * curvature.Y);
        }

        /// <summary>Whether an instrument is in the piece that was added last.</summary>
        public bool IsPresent(int instrument) => instrument >= _carrier && _isPresent[instrument];

        /// <summary>Gives the index of an instrument's piece there.</summary>
        public int IndexOf(int instrument) => _piece[instrument];

        /// <summary>What an instrument is made of there.</summary>
        public ref readonly CrossSection PieceOf(int instrument) => ref _pieces[instrument][_piece[instrument]];

        private void AddBend(ref CoaxialJoint joint, double lambda, int frame)
        {
            if (_presentCount == 1)
            {
                joint.AddAlone(lambda, PieceOf(_carrier));
                return;
            }
            if (_presentCount == 2)
            {
                int inner = _isPresent[_carrier + 1] ? _carrier + 1 : _carrier + 2;
                int other = frame == inner ? _carrier : inner;
                CoaxialJoint.AddShared(ref joint, ref (other == 0 || (other == 1 && frame == 0) ? ref joint.First
                    : ref joint.Second), lambda, PieceOf(_carrier), PieceOf(inner), frame == inner);
                return;
            }
            joint.AddThree(lambda, PieceOf(frame), PieceOf(frame == 0 ? 1 : 0), PieceOf(frame == 2 ? 1 : 2));
        }
    }
}
