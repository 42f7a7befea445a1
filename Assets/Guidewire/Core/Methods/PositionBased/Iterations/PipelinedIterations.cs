#if NET8_0_OR_GREATER
using System;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace Guidewire.Core
{
    /// <summary>Successive iterations of <see cref="ScalarIterations"/> in the naive order, one in each lane of a
    /// vector register, each three elements behind the one before: bit for bit what they give one after the
    /// other.</summary>
    /// <remarks>An iteration is a chain: a scalar loop waits for its own results most of the time. But stretch
    /// constraint j touches x_j, x_{j+1} and q_j only, bend-twist constraint j only q_j and q_{j+1}. While lane 0 is at
    /// slot p, lane k does stretch p - 3 k and bend-twist p - 3 k - 2: nothing is touched twice, and whatever depends
    /// on each other comes in the order of the scalar iterations. What a lane is done with, one sphere and one frame a
    /// slot, goes to the next lane; the first takes from memory, the last gives back to it. An iteration has n + 1
    /// slots, the last to pass on x_n, and at least three a lane, so that nothing is taken before it is given back. A
    /// lane at the end starts its next iteration at once: lanes fill once a call. A lane that has no constraint at its
    /// slot or no iteration left to do passes on what it was given. That is selected, not multiplied by 0: 0 times
    /// infinity is not a number, and -0 + 0 is not -0.</remarks>
    internal sealed class PipelinedIterations<T> : IIterations
        where T : struct, ILanes<T>
    {
        private const int Lag = LaneTable.Lag;
        private const int CacheLine = 64;    // bytes

        // In elements of a scalar iteration: a node in and out; a contact more than it costs there.
        private const double CopyCost = 0.5;
        private const double ContactCost = 0.5;

        private const int JointDelay = 2;    // slots from a frame's stretch to the joint before it

        // Columns of the table. The first two mark slots that have an element, and slots that have a joint.
        private const int IsElement = 0;
        private const int IsJoint = 1;
        private const int Lower = 2;
        private const int Upper = 3;
        private const int Orientation = 4;
        private const int First = 5;
        private const int Second = 6;
        private const int RestX = 7;
        private const int RestY = 8;
        private const int RestZ = 9;
        private const int Columns = 10;

        // At slot p of the nodes: x_{p+1} and q_p, which lane 0 needs there; x_0 at the last.
        private const int Node = 8;
        private const int NodeFrame = 4;

        private readonly int _elements;
        private readonly int _period;
        private readonly double _inverseLength;
        private readonly double _darbouxScale;
        private readonly LaneTable _table;
        private readonly double[] _nodes;
        private readonly PipelinedContacts _contacts;
        private readonly double[] _end;      // ticks after which each lane has no iteration left

        /// <param name="scalar">The iterations to do, in the naive order.</param>
        public PipelinedIterations(ScalarIterations scalar)
        {
            StretchConstraint stretch = scalar.Stretch;
            BendTwistConstraint bendTwist = scalar.BendTwist;
            _elements = stretch.Count;
            _period = Math.Max(_elements + 1, Lag * T.Count);
            _inverseLength = 1.0 / stretch.Length;
            _darbouxScale = bendTwist.DarbouxScale;
            _table = new LaneTable(Columns, _period, T.Count);
            _table.Write(IsElement, 0, Marks(stretch.Count));
            _table.Write(IsJoint, JointDelay, Marks(bendTwist.Count));
            _table.Write(Lower, 0, stretch.Lower);
            _table.Write(Upper, 0, stretch.Upper);
            _table.Write(Orientation, 0, stretch.Orientation);
            _table.Write(First, JointDelay, bendTwist.First);
            _table.Write(Second, JointDelay, bendTwist.Second);
            _table.Write(RestX, JointDelay, Array.ConvertAll(bendTwist.Rest, omega => omega.X));
            _table.Write(RestY, JointDelay, Array.ConvertAll(bendTwist.Rest, omega => omega.Y));
            _table.Write(RestZ, JointDelay, Array.ConvertAll(bendTwist.Rest, omega => omega.Z));
            _nodes = new double[Node * _period];
            _end = new double[T.Count];
            _contacts = new PipelinedContacts(_elements, _period, T.Count);
        }

        /// <inheritdoc/>
        public bool Iterate(Vector3d[] x, Quaterniond[] q, int iterations, IContactResponse? contacts)
        {
            double contactCost = ContactCost * iterations * (contacts?.ContactCount ?? 0);
            bool isSlower = contactCost > 0.0 && Cost(iterations) + contactCost > (double)_elements * iterations;
            if (isSlower || !_contacts.TryPlan(contacts))
            {
                return false;
            }
            for (int lane = 0; lane < T.Count; lane++)
            {
                long laneIterations = (iterations - lane + T.Count - 1L) / T.Count;
                _end[lane] = Lag * lane + laneIterations * _period;
            }
            Load(x, q);
            RunAligned(Ticks(iterations), x);
            GiveBack(x, q);
            return true;
        }

        // More values are live than there are registers. Where those spilled to the stack straddle cache lines, a tick
        // takes 1.4 times as long, and the alignment of the stack differs from process to process.
        [MethodImpl(MethodImplOptions.NoInlining)]
        private void RunAligned(long ticks, Vector3d[] x)
        {
            Span<byte> top = stackalloc byte[CacheLine];
            nint address = Unsafe.ByteOffset(ref Unsafe.NullRef<byte>(), ref MemoryMarshal.GetReference(top));
            Span<byte> rest = stackalloc byte[(int)(address & (CacheLine - 1))];
            rest.Clear();
            Run(ticks, x);
        }

        /// <inheritdoc/>
        public double Cost(int iterations) => T.TickCost * Ticks(iterations) + CopyCost * _elements;

        // The joint's block has the lines of BendTwistConstraint.Iterate, the element's those of
        // StretchConstraint.Iterate. A frame rests one slot between the two, so that at one slot neither waits for the
        // other.
        [MethodImpl(Compiled.AtOnce)]
        private void Run(long ticks, Vector3d[] x)
        {
            T zero = T.Fill(0.0);
            T one = T.Fill(1.0);
            T two = T.Fill(2.0);
            T minusOne = T.Fill(-1.0);
            T inverseLength = T.Fill(_inverseLength);
            T darbouxScale = T.Fill(_darbouxScale);
            T end = T.Load(ref _end[0]);
            T time = zero;

            int period = _period;
            int[] rows = _table.Rows;
            nint column = _table.ColumnLength;
            ref double table = ref _table.Numbers[0];
            ref double nodes = ref _nodes[0];
            ref double start = ref Unsafe.Add(ref nodes, Node * (period - 1));

            // u, v: the spheres a, b of the element at each lane's slot, r its frame; a, b: the frames of the joint.
            T uX = T.Fill(start), uY = T.Fill(Unsafe.Add(ref start, 1)), uZ = T.Fill(Unsafe.Add(ref start, 2));
            T rX = zero, rY = zero, rZ = zero, rW = zero;
            T aX = zero, aY = zero, aZ = zero, aW = zero;
            T bX = zero, bY = zero, bZ = zero, bW = zero;

            // Spheres that lanes are done with since the last slot, and since the one before: v of the next lane.
            T doneX = zero, doneY = zero, doneZ = zero;
            T lateX = zero, lateY = zero, lateZ = zero;

            int[] lanesInContact = _contacts.Lanes;
            ref double held = ref _contacts.Held[0];
            int slot = 0;
            int leaving = -Lag * (T.Count - 1) - JointDelay;    // the slot of what leaves the last lane
            for (long tick = 0; tick < ticks; tick++)
            {
                ref double entering = ref Unsafe.Add(ref nodes, Node * slot);
                T vX = T.Shift(lateX, entering);
                T vY = T.Shift(lateY, Unsafe.Add(ref entering, 1));
                T vZ = T.Shift(lateZ, Unsafe.Add(ref entering, 2));
                rX = T.Shift(rX, Unsafe.Add(ref entering, NodeFrame));
                rY = T.Shift(rY, Unsafe.Add(ref entering, NodeFrame + 1));
                rZ = T.Shift(rZ, Unsafe.Add(ref entering, NodeFrame + 2));
                rW = T.Shift(rW, Unsafe.Add(ref entering, NodeFrame + 3));
                lateX = doneX;
                lateY = doneY;
                lateZ = doneZ;
                T going = time < end;
                ref double row = ref Unsafe.Add(ref table, rows[slot]);
                T turnedX, turnedY, turnedZ, turnedW;
                {
                    T isJoint = going & T.Load(ref Unsafe.Add(ref row, IsJoint * column));
                    T restX = T.Load(ref Unsafe.Add(ref row, RestX * column));
                    T restY = T.Load(ref Unsafe.Add(ref row, RestY * column));
                    T restZ = T.Load(ref Unsafe.Add(ref row, RestZ * column));
                    T ex = darbouxScale * (aW * bX - aX * bW - aY * bZ + aZ * bY);
                    T ey = darbouxScale * (aW * bY - aY * bW - aZ * bX + aX * bZ);
                    T ez = darbouxScale * (aW * bZ - aZ * bW - aX * bY + aY * bX);
                    T sign = T.Select(ex * restX + ey * restY + ez * restZ < zero, minusOne, one);
                    ex -= sign * restX;
                    ey -= sign * restY;
                    ez -= sign * restZ;

                    T f = T.Load(ref Unsafe.Add(ref row, First * column));
                    T ax = aX + f * (bW * ex + bY * ez - bZ * ey);
                    T ay = aY + f * (bW * ey + bZ * ex - bX * ez);
                    T az = aZ + f * (bW * ez + bX * ey - bY * ex);
                    T aw = aW - f * (bX * ex + bY * ey + bZ * ez);
                    T s = T.Load(ref Unsafe.Add(ref row, Second * column));
                    T bx = bX - s * (aW * ex + aY * ez - aZ * ey);
                    T by = bY - s * (aW * ey + aZ * ex - aX * ez);
                    T bz = bZ - s * (aW * ez + aX * ey - aY * ex);
                    T bw = bW + s * (aX * ex + aY * ey + aZ * ez);

                    T scaleA = one / T.Sqrt(ax * ax + ay * ay + az * az + aw * aw);
                    T scaleB = one / T.Sqrt(bx * bx + by * by + bz * bz + bw * bw);
                    turnedX = T.Select(isJoint, scaleA * ax, aX);
                    turnedY = T.Select(isJoint, scaleA * ay, aY);
                    turnedZ = T.Select(isJoint, scaleA * az, aZ);
                    turnedW = T.Select(isJoint, scaleA * aw, aW);
                    aX = T.Select(isJoint, scaleB * bx, bX);
                    aY = T.Select(isJoint, scaleB * by, bY);
                    aZ = T.Select(isJoint, scaleB * bz, bZ);
                    aW = T.Select(isJoint, scaleB * bw, bW);
                }
                {
                    T isElement = going & T.Load(ref Unsafe.Add(ref row, IsElement * column));
                    T gx = (vX - uX) * inverseLength - two * (rX * rZ + rW * rY);
                    T gy = (vY - uY) * inverseLength - two * (rY * rZ - rW * rX);
                    T gz = (vZ - uZ) * inverseLength - (one - two * (rX * rX + rY * rY));

                    T lower = T.Load(ref Unsafe.Add(ref row, Lower * column));
                    T upper = T.Load(ref Unsafe.Add(ref row, Upper * column));
                    doneX = T.Select(isElement, uX + lower * gx, uX);
                    doneY = T.Select(isElement, uY + lower * gy, uY);
                    doneZ = T.Select(isElement, uZ + lower * gz, uZ);
                    uX = T.Select(isElement, vX - upper * gx, vX);
                    uY = T.Select(isElement, vY - upper * gy, vY);
                    uZ = T.Select(isElement, vZ - upper * gz, vZ);

                    T turn = T.Load(ref Unsafe.Add(ref row, Orientation * column));
                    T ex = -rY;
                    T ey = rX;
                    T ez = -rW;
                    T ew = rZ;
                    T qx = rX + turn * (gx * ew + gy * ez - gz * ey);
                    T qy = rY + turn * (gy * ew + gz * ex - gx * ez);
                    T qz = rZ + turn * (gz * ew + gx * ey - gy * ex);
                    T qw = rW - turn * (gx * ex + gy * ey + gz * ez);
                    T scale = one / T.Sqrt(qx * qx + qy * qy + qz * qz + qw * qw);
                    bX = T.Select(isElement, scale * qx, rX);
                    bY = T.Select(isElement, scale * qy, rY);
                    bZ = T.Select(isElement, scale * qz, rZ);
                    bW = T.Select(isElement, scale * qw, rW);
                }
                rX = turnedX;
                rY = turnedY;
                rZ = turnedZ;
                rW = turnedW;
                if (lanesInContact[slot] != 0)
                {
                    T.Store(doneX, ref held);
                    T.Store(doneY, ref Unsafe.Add(ref held, T.Count));
                    T.Store(doneZ, ref Unsafe.Add(ref held, 2 * T.Count));
                    T.Store(lateX, ref Unsafe.Add(ref held, 3 * T.Count));
                    T.Store(lateY, ref Unsafe.Add(ref held, 4 * T.Count));
                    T.Store(lateZ, ref Unsafe.Add(ref held, 5 * T.Count));
                    if (_contacts.Project(slot, tick, _end, x))
                    {
                        doneX = T.Load(ref held);
                        doneY = T.Load(ref Unsafe.Add(ref held, T.Count));
                        doneZ = T.Load(ref Unsafe.Add(ref held, 2 * T.Count));
                        lateX = T.Load(ref Unsafe.Add(ref held, 3 * T.Count));
                        lateY = T.Load(ref Unsafe.Add(ref held, 4 * T.Count));
                        lateZ = T.Load(ref Unsafe.Add(ref held, 5 * T.Count));
                    }
                }
                if (leaving >= -1)
                {
                    ref double node = ref Unsafe.Add(ref nodes, Node * (leaving < 0 ? period - 1 : leaving));
                    node = T.Last(lateX);
                    Unsafe.Add(ref node, 1) = T.Last(lateY);
                    Unsafe.Add(ref node, 2) = T.Last(lateZ);
                    Unsafe.Add(ref node, NodeFrame) = T.Last(rX);
                    Unsafe.Add(ref node, NodeFrame + 1) = T.Last(rY);
                    Unsafe.Add(ref node, NodeFrame + 2) = T.Last(rZ);
                    Unsafe.Add(ref node, NodeFrame + 3) = T.Last(rW);
                }
                slot = Next(slot);
                leaving = Next(leaving);
                time += one;
            }
        }

        private void Load(Vector3d[] x, Quaterniond[] q)
        {
            for (int p = 0; p < _period; p++)
            {
                Span<double> node = _nodes.AsSpan(Node * p, Node);
                Vector3d sphere = p < _elements ? x[p + 1] : x[0];
                node[0] = sphere.X;
                node[1] = sphere.Y;
                node[2] = sphere.Z;
                Quaterniond frame = p < _elements ? q[p] : Quaterniond.Identity;
                node[NodeFrame] = frame.X;
                node[NodeFrame + 1] = frame.Y;
                node[NodeFrame + 2] = frame.Z;
                node[NodeFrame + 3] = frame.W;
            }
        }

        private void GiveBack(Vector3d[] x, Quaterniond[] q)
        {
            for (int j = 0; j < _elements; j++)
            {
                ReadOnlySpan<double> node = _nodes.AsSpan(Node * j, Node);
                x[j + 1] = new Vector3d(node[0], node[1], node[2]);
                q[j] = new Quaterniond(
                    node[NodeFrame], node[NodeFrame + 1], node[NodeFrame + 2], node[NodeFrame + 3]);
            }
            ReadOnlySpan<double> start = _nodes.AsSpan(Node * (_period - 1), Node);
            x[0] = new Vector3d(start[0], start[1], start[2]);
        }

        // From the first lane's first slot to the last lane's last, and one for x_n and q_{n-1}, which leave late.
        private long Ticks(int iterations)
        {
            long rounds = (iterations + T.Count - 1L) / T.Count;
            return rounds * _period + Lag * (T.Count - 1) + 1;
        }

        private int Next(int slot) => slot + 1 == _period ? 0 : slot + 1;

        private static double[] Marks(int count)
        {
            var marks = new double[count];
            Array.Fill(marks, BitConverter.Int64BitsToDouble(-1L));    // all bits set
            return marks;
        }
    }

    /// <summary>The contacts of a solve among iterations in lanes: which follow at each slot of an iteration, in the
    /// order of the scalar iterations.</summary>
    /// <remarks>A contact of an iteration needs its spheres after the iteration's stretch constraints and after earlier
    /// contacts of the same spheres. A lane at slot p has just finished x_p and still holds x_{p-1}, so a sphere's
    /// contact can follow at its own slot or one later, an element's at that of its second sphere. Spheres first, then
    /// elements in their order always fits; where contacts would have to wait longer, as some of several walls at one
    /// element, they cannot take part.</remarks>
    internal sealed class PipelinedContacts
    {
        private const int Lag = LaneTable.Lag;
        private const int ContactsPerSphere = 2;
        private readonly int _elements;
        private readonly int _period;
        private readonly int _lanes;
        private readonly int[] _ready;      // the slot after which each sphere has had all contacts so far
        private readonly int[] _first;      // the first contact at each slot, or -1
        private readonly int[] _last;
        private readonly int[] _next;       // the contact after each at the same slot, or -1
        private IContactResponse? _rule;

        /// <param name="elements">n.</param>
        /// <param name="period">Slots of an iteration.</param>
        /// <param name="lanes">Number of lanes.</param>
        public PipelinedContacts(int elements, int period, int lanes)
        {
            _elements = elements;
            _period = period;
            _lanes = lanes;
            _ready = new int[elements + 1];
            _first = new int[elements + 1];
            _last = new int[elements + 1];
            _next = new int[ContactsPerSphere * (elements + 1)];
            Lanes = new int[period];
            Held = new double[6 * lanes];
        }

        /// <summary>The lanes that have contacts, one bit each, while lane 0 is at each slot.</summary>
        public int[] Lanes { get; }

        /// <summary>The spheres that lanes have just finished, and those they finished one slot earlier: three times a
        /// number a lane for x, y, z, then three times for the earlier.</summary>
        public double[] Held { get; }

        /// <summary>Finds the slot of each contact; false where some have none.</summary>
        public bool TryPlan(IContactResponse? rule)
        {
            Array.Clear(Lanes, 0, Lanes.Length);
            _rule = rule;
            int count = rule?.ContactCount ?? 0;
            if (count == 0)
            {
                return true;
            }
            if (count > _next.Length)
            {
                return false;
            }
            Array.Fill(_first, -1);
            for (int i = 0; i <= _elements; i++)
            {
                _ready[i] = i;
            }
            for (int k = 0; k < count; k++)
            {
                rule!.SpheresOf(k, out int first, out int last);
                int slot = Math.Max(_ready[first], _ready[last]);
                if (slot > first + 1 || slot > _elements)
                {
                    return false;
                }
                _ready[first] = slot;
                _ready[last] = slot;
                Append(k, slot);
            }
            return true;
        }

        /// <summary>Projects the contacts of all lanes at their slots, in the spheres that are held; false where they
        /// moved none.</summary>
        /// <param name="slot">Where lane 0 is.</param>
        /// <param name="tick">Slots since it started.</param>
        /// <param name="end">The tick after which each lane has no iteration left.</param>
        /// <param name="x">n + 1 positions that may be written over.</param>
        public bool Project(int slot, long tick, double[] end, Vector3d[] x)
        {
            bool movedAny = false;
            for (int lane = 0; lane < _lanes; lane++)
            {
                bool going = tick >= Lag * lane && tick < end[lane];
                if (!going || (Lanes[slot] >> lane & 1) == 0)
                {
                    continue;
                }
                int p = slot - Lag * lane;
                p = p < 0 ? p + _period : p;
                x[p] = new Vector3d(Held[lane], Held[_lanes + lane], Held[2 * _lanes + lane]);
                if (p > 0)
                {
                    x[p - 1] = new Vector3d(
                        Held[3 * _lanes + lane], Held[4 * _lanes + lane], Held[5 * _lanes + lane]);
                }
                bool moved = false;
                for (int k = _first[p]; k >= 0; k = _next[k])
                {
                    moved |= _rule!.Project(k, x);
                }
                if (!moved)
                {
                    continue;
                }
                movedAny = true;
                Hold(lane, 0, x[p]);
                if (p > 0)
                {
                    Hold(lane, 3 * _lanes, x[p - 1]);
                }
            }
            return movedAny;
        }

        private void Append(int k, int slot)
        {
            if (_first[slot] < 0)
            {
                _first[slot] = k;
                for (int lane = 0; lane < _lanes; lane++)
                {
                    Lanes[(slot + Lag * lane) % _period] |= 1 << lane;
                }
            }
            else
            {
                _next[_last[slot]] = k;
            }
            _last[slot] = k;
            _next[k] = -1;
        }

        private void Hold(int lane, int from, in Vector3d sphere)
        {
            Held[from + lane] = sphere.X;
            Held[from + _lanes + lane] = sphere.Y;
            Held[from + 2 * _lanes + lane] = sphere.Z;
        }
    }
}
#endif
