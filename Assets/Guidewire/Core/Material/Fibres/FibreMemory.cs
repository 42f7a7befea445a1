using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>What the fibres of one instrument remember: a state of every fibre at each of its nodes, for each piece
    /// of its material there. It belongs to the material, so nodes that leave a chain keep it.</summary>
    /// <remarks>At the exit of a sheath a part of a node's wire is straight and the rest is bent: both have states of
    /// their own, and what passes the exit takes its own along.</remarks>
    internal sealed class FibreMemory
    {
        private readonly int[] _firstPiece;    // of each node
        private readonly int[] _firstSlot;     // and its slot
        private readonly int[] _start;         // of each slot among the states
        private readonly int[] _nodeOf;        // of each slot
        private readonly double[] _outsideBefore;   // lengths when the memory moved last, m
        private readonly double[] _insideBefore;
        private readonly double[] _growth;     // the last change of the length outside, m

        private FibreMemory(InstrumentProfile profile, double[] stations)
        {
            Profile = profile;
            Stations = stations;
            int n = stations.Length - 1;
            _firstPiece = new int[n + 1];
            _firstSlot = new int[n + 1];
            var sections = new List<FibreSection?>();
            var starts = new List<int>();
            var nodes = new List<int>();
            int states = 0;
            for (int k = 0; k <= n; k++)
            {
                int last = profile.PieceAt(stations[Math.Min(k + 1, n)]);
                _firstPiece[k] = profile.PieceAt(stations[Math.Max(k - 1, 0)]);
                _firstSlot[k] = sections.Count;
                for (int p = _firstPiece[k]; p <= last; p++)
                {
                    sections.Add(profile.Pieces[p].Fibres);
                    starts.Add(states);
                    nodes.Add(k);
                    states += profile.Pieces[p].Fibres?.StateCount ?? 0;
                }
            }
            Sections = sections.ToArray();
            _start = starts.ToArray();
            _nodeOf = nodes.ToArray();
            Bent = new double[states];
            Straight = new double[states];
            Remembers = new bool[_start.Length];
            Outside = new double[_start.Length];
            _outsideBefore = new double[_start.Length];
            _insideBefore = new double[_start.Length];
            _growth = new double[_start.Length];
            IsTouched = new bool[_start.Length];
            Inside = new double[_start.Length];
            Sums = new double[states];
            StraightSums = new double[states];
        }

        /// <summary>The memory of an instrument; null where all of it is linear.</summary>
        /// <param name="stations">Of its nodes, m from its hub.</param>
        public static FibreMemory? Create(InstrumentProfile profile, double[] stations) =>
            Array.Exists(profile.Pieces, piece => piece.Fibres != null) ? new FibreMemory(profile, stations) : null;

        /// <summary>What the instrument is made of.</summary>
        public InstrumentProfile Profile { get; }

        /// <summary>Stations of the instrument's nodes, m from its hub.</summary>
        public double[] Stations { get; }

        /// <summary>The section of each slot, a piece of material at a node; null where that is linear.</summary>
        public FibreSection?[] Sections { get; }

        /// <summary>e_n of the fibres of all slots, where the wire is free to bend.</summary>
        public double[] Bent { get; }

        /// <summary>Strains e_n of the fibres of all slots, where the wire is held straight in a sheath.</summary>
        public double[] Straight { get; }

        /// <summary>Whether any fibre of a slot has left its line.</summary>
        public bool[] Remembers { get; }

        /// <summary>Length of each slot that is free to bend, m, by the weights of joints.</summary>
        public double[] Outside { get; }

        /// <summary>Length of each slot in a sheath, m.</summary>
        public double[] Inside { get; }

        /// <summary>Whether a slot has sums of e times length.</summary>
        public bool[] IsTouched { get; }

        /// <summary>Sums of e times length over a step's end.</summary>
        public double[] Sums { get; }

        /// <summary>Sums of e times length over a step's end, of what is in a sheath.</summary>
        public double[] StraightSums { get; }

        /// <summary>Gives the slot of a piece at a node.</summary>
        public int SlotOf(int node, int piece) => _firstSlot[node]
            + Math.Max(0, Math.Min(piece - _firstPiece[node], EndOf(node) - _firstSlot[node] - 1));

        /// <summary>Gives the first state of a slot.</summary>
        public int StartOf(int slot) => _start[slot];

        /// <summary>Gives the node of a slot.</summary>
        public int NodeOf(int slot) => _nodeOf[slot];

        /// <summary>Gives the length that a slot stands for, m: half of the elements beside its node, where its
        /// material is.</summary>
        public double LengthOf(int slot)
        {
            int k = NodeOf(slot);
            double from = 0.5 * (Stations[Math.Max(k - 1, 0)] + Stations[k]);
            double to = 0.5 * (Stations[k] + Stations[Math.Min(k + 1, Stations.Length - 1)]);
            double[] borders = Profile.Borders;
            return Math.Max(0.0, Math.Min(to, borders[PieceOf(slot) + 1]) - Math.Max(from, borders[PieceOf(slot)]));
        }

        /// <summary>Gives the piece of material of a slot.</summary>
        public int PieceOf(int slot) => _firstPiece[_nodeOf[slot]] + slot - _firstSlot[_nodeOf[slot]];

        /// <summary>Gives the slot after the last one of a node.</summary>
        public int EndOf(int node) => node + 1 < _firstSlot.Length ? _firstSlot[node + 1] : Sections.Length;

        /// <summary>Gives the first slot of a node.</summary>
        public int FirstOf(int node) => _firstSlot[node];

        /// <summary>Adds a length, m, to a slot.</summary>
        public void AddLength(int slot, double length, bool isInside) =>
            (isInside ? Inside : Outside)[slot] += length;

        /// <summary>There are no lengths yet.</summary>
        public void ClearLengths()
        {
            Array.Clear(Outside, 0, Outside.Length);
            Array.Clear(Inside, 0, Inside.Length);
        }

        /// <summary>The memory has moved.</summary>
        /// <param name="isNew">Whether the chain is another one, in which nothing has passed the exit.</param>
        public void KeepLengths(int slot, bool isNew)
        {
            double growth = Outside[slot] - _outsideBefore[slot];
            if (growth != 0.0 && !isNew)
            {
                _growth[slot] = growth;
            }
            _outsideBefore[slot] = Outside[slot];
            _insideBefore[slot] = Inside[slot];
        }

        /// <summary>How the length outside a sheath has changed since the memory moved, or before, m; 0 where there is
        /// no exit.</summary>
        public double Growth(int slot)
        {
            double growth = Outside[slot] - _outsideBefore[slot];
            return Inside[slot] == 0.0 && _insideBefore[slot] == 0.0 ? 0.0 : growth != 0.0 ? growth : _growth[slot];
        }

        /// <summary>How much of the state outside or inside is that of its own: what passes the exit brings its state
        /// along.</summary>
        public double OwnShare(int slot, bool isInside)
        {
            double growth = Outside[slot] - _outsideBefore[slot];
            return isInside ? growth < 0.0 ? Math.Max(0.0, 1.0 + growth / Inside[slot]) : 1.0
                : growth > 0.0 && _insideBefore[slot] > 0.0
                    ? Math.Max(0.0, 1.0 - Math.Min(growth, _insideBefore[slot]) / Outside[slot]) : 1.0;
        }

        /// <summary>Remembers what another one of the same instrument did.</summary>
        public void CopyFrom(FibreMemory other)
        {
            if (other.Bent.Length == Bent.Length)
            {
                Array.Copy(other.Bent, Bent, Bent.Length);
                Array.Copy(other.Straight, Straight, Straight.Length);
                Array.Copy(other.Remembers, Remembers, Remembers.Length);
            }
        }

        /// <summary>Remembers that the wire was bent over a mandrel, and let go, before the run.</summary>
        /// <param name="from">m from the hub, as is the other end.</param>
        /// <param name="curvature">About d1, on the mandrel, rad/m.</param>
        public void Shape(double from, double to, double curvature)
        {
            for (int slot = 0; slot < Sections.Length; slot++)
            {
                if (!(Sections[slot] is FibreSection section))
                {
                    continue;
                }
                int node = _nodeOf[slot];
                double share = ShareBetween(node, from, to);
                if (share > 0.0)
                {
                    var states = new double[section.StateCount];
                    section.Shape(curvature, Profile.Pieces[PieceOf(slot)].BendStiffness1, states);
                    for (int i = 0; i < states.Length; i++)
                    {
                        Bent[_start[slot] + i] = Straight[_start[slot] + i] = share * states[i];
                        Remembers[slot] |= states[i] != 0.0;
                    }
                }
            }
        }

        // What of a node's length, weighted by its hat function, is between two places.
        private double ShareBetween(int node, double from, double to)
        {
            double whole = 0.0;
            double part = 0.0;
            for (int side = -1; side <= 1; side += 2)
            {
                int other = node + side;
                if (other >= 0 && other < Stations.Length)
                {
                    double length = Math.Abs(Stations[other] - Stations[node]);
                    // Distances from the node at which the part begins and ends.
                    double a = Math.Max(0.0, Math.Min(length, side * ((side > 0 ? from : to) - Stations[node])));
                    double b = Math.Max(0.0, Math.Min(length, side * ((side > 0 ? to : from) - Stations[node])));
                    whole += 0.5 * length;
                    part += (b - a) * (1.0 - 0.5 * (a + b) / length);
                }
            }
            return part / whole;
        }

        /// <summary>Couple of the correction at a node, N m: the mean of the pieces there.</summary>
        /// <param name="curvature">Along its own axes, rad/m.</param>
        public Vector3d CoupleAt(int node, in Vector3d curvature, bool isInside)
        {
            double mean = 0.5 * (Stations[Math.Min(node + 1, Stations.Length - 1)] + Stations[node]);
            int slot = SlotOf(node, Profile.PieceAt(mean));
            if (!(Sections[slot] is FibreSection section))
            {
                return Vector3d.Zero;
            }
            Vector3d rest = Profile.Pieces[Profile.PieceAt(mean)].RestCurvature;
            var curve = default(FibreCurve);
            section.Add(curvature.X - rest.X, curvature.Y - rest.Y, isInside ? Straight : Bent, _start[slot], 1.0,
                ref curve);
            return new Vector3d(curve.Moment1, curve.Moment2, 0.0);
        }

        /// <summary>Writes or restores the states that are not 0.</summary>
        /// <param name="hasHub">Whether lengths depend on hubs.</param>
        public void Serialize(Snapshot snapshot, bool hasHub)
        {
            int count = 0;
            for (int slot = 0; slot < Remembers.Length; slot++)
            {
                count += Remembers[slot] ? 1 : 0;
            }
            snapshot.Serialize(ref count);
            if (!snapshot.IsWritten)
            {
                Array.Clear(Bent, 0, Bent.Length);
                Array.Clear(Straight, 0, Straight.Length);
                Array.Clear(Remembers, 0, Remembers.Length);
            }
            int at = 0;
            for (int k = 0; k < count; k++, at++)
            {
                while (snapshot.IsWritten && !Remembers[at])
                {
                    at++;
                }
                snapshot.Serialize(ref at);
                Remembers[at] = true;
                for (int i = _start[at]; i < _start[at] + Sections[at]!.StateCount; i++)
                {
                    snapshot.Serialize(ref Bent[i]);
                    snapshot.Serialize(ref Straight[i]);
                }
            }
            if (hasHub)
            {
                snapshot.Serialize(_outsideBefore);
                snapshot.Serialize(_insideBefore);
                snapshot.Serialize(_growth);
            }
        }
    }
}
