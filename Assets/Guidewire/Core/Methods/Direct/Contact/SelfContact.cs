using System;
using System.Globalization;
using System.Runtime.InteropServices;

namespace Guidewire.Core
{
    /// <summary>Contact of a wire with itself: the <see cref="Barrier"/> of the gap between the surfaces of two
    /// elements, capsules of each element's own radius, over all pairs that are far enough apart along the
    /// wire.</summary>
    /// <remarks>Which elements are pairs does not depend on the shape, and where the closest point is at an end of an
    /// element the pair still counts: so the energy is continuous. Between facing ends a pair has at least 1.15 pi r of
    /// wire, which a bend of radius 2 r keeps apart. The second derivative is exact, with its negative part: without it
    /// Newton's method fails where a wire under tension first touches itself.
    ///
    /// In a sheath a wire does not touch itself: an element that leaves it begins at the exit.</remarks>
    internal sealed class SelfContact : EnergyTerm
    {
        private const double OfRadius = 0.2;      // the largest distance of the barrier, of the thinnest radius
        private const double OfGap = 0.3;          // what a step leaves of a gap, or
        private const double OfDistance = 0.2;     // of the barrier's distance

        private readonly MaterialRod _rod;
        private readonly SheathEnd? _sheath;
        private readonly StrandPairs _near;
        private readonly Vector3d[] _nodes;        // of the current shape, m
        private readonly Vector3d[] _x;            // the same with those in the sheath at its exit
        private readonly Vector3d[] _to;           // where they move to
        private readonly StructList<StrandContact> _contacts = new StructList<StrandContact>(32);
        private int _inside;                       // nodes in the sheath
        private bool _hasGeometric = true;
        private bool _isKnown;
        private bool _hadPairs = true;
        private double _value;

        /// <summary>Contact of a rod with itself.</summary>
        /// <param name="walls">The barrier of walls, m, whose distance is an upper limit of this one's.</param>
        /// <param name="sheath">In which there is no contact, or null.</param>
        public SelfContact(MaterialRod rod, in Barrier walls, SheathEnd? sheath)
        {
            _rod = rod;
            _sheath = sheath;
            double thinnest = double.PositiveInfinity;
            double thickest = 0.0;
            for (int j = 0; j < rod.ElementCount; j++)
            {
                thinnest = Math.Min(thinnest, rod.Radius[j]);
                thickest = Math.Max(thickest, rod.Radius[j]);
            }
            double distance = Math.Min(walls.Distance, OfRadius * thinnest);
            Barrier = new Barrier(distance, walls.Stiffness * walls.Distance / distance);
            _near = new StrandPairs(rod.Length, rod.Radius, rod.ElementCount,
                distance + CapsulePair.Contact(2.0 * thickest) - 2.0 * thickest);
            _nodes = new Vector3d[rod.Capacity + 1];
            _x = new Vector3d[rod.Capacity + 1];
            _to = new Vector3d[rod.Capacity + 1];
        }

        /// <summary>b of a gap.</summary>
        public Barrier Barrier { get; }

        /// <summary>Whether the wire touches itself in the shape evaluated last.</summary>
        public bool Touches => _contacts.Count > 0;

        /// <summary>Says whether any two elements may have come near each other since this was asked last.</summary>
        public bool TakeNear()
        {
            bool had = _hadPairs;
            _hadPairs = false;
            return had;
        }

        /// <inheritdoc/>
        public override void Remesh()
        {
            _near.Remesh(_rod.ElementCount);
            _contacts.Clear();
            _isKnown = false;
        }

        /// <inheritdoc/>
        public override void SetTime(double time) => _isKnown &= !_near.FollowLengths();

        /// <summary>The contacts in a shape, in the order of their elements.</summary>
        public StructList<StrandContact> ContactsOf(RodShape shape)
        {
            Update(shape, 0, _rod.ElementCount + 1);
            return _contacts;
        }

        /// <summary>The largest normal force between two elements in a shape, N.</summary>
        public double LargestForce(RodShape shape)
        {
            Update(shape, 0, _rod.ElementCount + 1);
            double largest = 0.0;
            for (int k = 0; k < _contacts.Count; k++)
            {
                largest = Math.Max(largest, _contacts[k].Force);
            }
            return largest;
        }

        /// <summary>Where the wire overlaps itself, in one phrase, or null.</summary>
        public string? FindOverlap(RodShape shape)
        {
            Update(shape, 0, _rod.ElementCount + 1);
            for (int k = 0; k < _near.Pairs.Count; k++)
            {
                StrandPairs.Pair pair = _near.Pairs[k];
                if (pair.Second >= _inside && PairOf(pair).Distance <= ContactOf(pair))
                {
                    return string.Format(CultureInfo.InvariantCulture,
                        "the wire overlaps itself at the start: elements {0} and {1}", pair.First, pair.Second);
                }
            }
            return null;
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            Update(shape, 0, _rod.ElementCount + 1);
            return _value;
        }

        /// <inheritdoc/>
        public override void DropGeometricStiffness(bool isOn) => _hasGeometric = !isOn;

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            Update(shape, from, Math.Min(to, _rod.ElementCount + 1));
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref StrandContact contact = ref _contacts[k];
                measured.IncludeForce(contact.Force);
                for (int end = 0; end < 4; end++)
                {
                    int i = contact.NodeOf(end);
                    if (i >= from && i < to && i >= _inside)
                    {
                        gradient[i].AddX((-contact.Push * contact.Pair.Weight(end)) * contact.Pair.Slope);
                    }
                }
            }
        }

        /// <inheritdoc/>
        public override void AddColumns(RodShape shape, LowRank columns)
        {
            Update(shape, 0, _rod.ElementCount + 1);
            for (int k = 0; k < _contacts.Count; k++)
            {
                ref StrandContact contact = ref _contacts[k];
                contact.Pair.AddColumns(columns, contact.First, contact.Second, -contact.Push, contact.Stiffness,
                    contact.First < _inside, _hasGeometric);
            }
        }

        /// <summary>Leaves at least 30 % of every gap, or a fifth of the barrier's distance, on the straight path of
        /// all nodes.</summary>
        public override double MaxStep(RodShape shape, RodVector[] direction, double scale)
        {
            int n = _rod.ElementCount;
            Update(shape, 0, n + 1);
            for (int i = 0; i <= n; i++)
            {
                _to[i] = shape.X[i] + scale * direction[i].X;
            }
            _near.Follow(shape.X, _to);
            _hadPairs |= _near.Pairs.Count > 0;
            double most = 1.0;
            if (_near.Pairs.Count == 0)
            {
                return most;
            }
            _inside = Place(_nodes, _x);    // of a list that was empty until now, too
            int inside = Place(_to, _to);
            for (int k = 0; k < _near.Pairs.Count; k++)
            {
                StrandPairs.Pair pair = _near.Pairs[k];
                if (pair.First + 1 < Math.Min(inside, _inside))
                {
                    continue;
                }
                double distance = PairOf(pair).Distance;
                double least = ContactOf(pair);
                double gap = distance - least;
                if (!(gap > 0.0))
                {
                    return 0.0;
                }
                double left = Math.Min(OfGap * gap, OfDistance * Barrier.Distance);
                most = CapsulePair.MaxMotion(_x, _to, pair.First, pair.Second, RadiiOf(pair), distance, least + left,
                    Barrier.Distance, most);
            }
            return most;
        }

        private double RadiiOf(in StrandPairs.Pair pair) => _rod.Radius[pair.First] + _rod.Radius[pair.Second];

        private double ContactOf(in StrandPairs.Pair pair) => CapsulePair.Contact(RadiiOf(pair));

        private CapsulePair PairOf(in StrandPairs.Pair pair) => new CapsulePair(_x[pair.First], _x[pair.First + 1],
            _x[pair.Second], _x[pair.Second + 1], RadiiOf(pair));

        // Nodes in the sheath at its exit; how many there are.
        private int Place(Vector3d[] nodes, Vector3d[] x)
        {
            int inside = 0;
            if (_sheath != null)
            {
                for (; inside <= _rod.ElementCount && _sheath.Outside(nodes[inside]) < 0.0; inside++)
                {
                    x[inside] = _sheath.Exit;
                }
            }
            if (x != nodes)
            {
                Array.Copy(nodes, inside, x, inside, _rod.ElementCount + 1 - inside);
            }
            return inside;
        }

        // Evaluates the shape, unless these of its nodes are those of the last call.
        private void Update(RodShape shape, int from, int to)
        {
            if (_isKnown && MemoryMarshal.AsBytes(shape.X.AsSpan(from, to - from))
                .SequenceEqual(MemoryMarshal.AsBytes(_nodes.AsSpan(from, to - from))))
            {
                return;
            }
            _isKnown = true;
            Array.Copy(shape.X, _nodes, _rod.ElementCount + 1);
            _contacts.Clear();
            _value = 0.0;
            _near.Follow(_nodes);
            _hadPairs |= _near.Pairs.Count > 0;
            if (_near.Pairs.Count == 0)
            {
                return;
            }
            _inside = Place(_nodes, _x);
            for (int k = 0; k < _near.Pairs.Count; k++)
            {
                StrandPairs.Pair pair = _near.Pairs[k];
                if (pair.First + 1 < _inside)
                {
                    continue;
                }
                CapsulePair capsules = PairOf(pair);
                double value = Barrier.At(capsules.Distance - ContactOf(pair), out double slope, out double curvature);
                _value += value;
                if (double.IsPositiveInfinity(value))
                {
                    return;
                }
                if (slope < 0.0)
                {
                    _contacts.Add(new StrandContact(pair, capsules, -slope, curvature));
                }
            }
        }
    }

    /// <summary>A contact of two elements of one wire.</summary>
    internal readonly struct StrandContact
    {
        /// <summary>The lower element.</summary>
        public readonly int First;

        /// <summary>The higher element.</summary>
        public readonly int Second;

        /// <summary>Their distance; its normal leads from the higher to the lower one.</summary>
        public readonly CapsulePair Pair;

        /// <summary>Minus the barrier's first derivative, N.</summary>
        public readonly double Push;

        /// <summary>The barrier's second derivative, N/m.</summary>
        public readonly double Stiffness;

        /// <summary>Makes a contact with these values.</summary>
        public StrandContact(in StrandPairs.Pair elements, in CapsulePair pair, double push, double stiffness)
        {
            First = elements.First;
            Second = elements.Second;
            Pair = pair;
            Push = push;
            Stiffness = stiffness;
        }

        /// <summary>The normal force, N.</summary>
        public double Force => Push * Pair.Slope.Length;

        /// <summary>The node of one of the four ends, as <see cref="CapsulePair.Weight"/> counts them.</summary>
        public int NodeOf(int end) => end < 2 ? First + end : Second + end - 2;
    }
}
