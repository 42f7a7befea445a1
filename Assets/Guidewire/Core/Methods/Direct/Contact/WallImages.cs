using System;
using System.Linq;

namespace Guidewire.Core
{
    /// <summary>Moving walls at a moment: contact with each is evaluated where it is at rest, at the images of the
    /// wire's nodes.</summary>
    /// <remarks>With X = psi(x) and G = dX/dx the energy e(X) of a contact has the gradient G^T e' and the second
    /// derivative G^T e'' G; the derivatives of G are left out of it. Walls that share a motion share its
    /// images.</remarks>
    internal sealed class WallFields
    {
        private const double VelocityStep = 1e-5;    // s: the difference by which velocities are found

        /// <summary>Those of walls.</summary>
        public WallFields(ContactShape[] walls)
        {
            Of = new WallField?[walls.Length];
            Shared = new int[walls.Length];
            Key = KeyOf(walls);
            for (int w = 0; w < walls.Length; w++)
            {
                Shared[w] = Array.FindIndex(walls, wall => wall.Motion == walls[w].Motion);
                Of[w] = walls[w].Motion == null ? null
                    : Shared[w] < w ? Of[Shared[w]] : new WallField(walls[w].Motion!);
                Carrier = Carrier < 0 && Of[w] != null ? w : Carrier;
                IsTimed |= walls[w].Motion?.Cycles.Count > 0;
            }
            Beam = Carrier < 0 ? null : walls[Carrier].Motion!.Beam;
        }

        /// <summary>By wall; null where it stands still.</summary>
        public WallField?[] Of { get; }

        /// <summary>By wall: the first one that moves alike.</summary>
        public int[] Shared { get; }

        /// <summary>The first wall that moves, -1: none. A vessel is before its obstacles.</summary>
        public int Carrier { get; } = -1;

        /// <summary>The beam as which the first wall that moves gives way, with all that move alike; null: it does not.
        /// </summary>
        public WallBeam? Beam { get; }

        /// <summary>Whether any wall moves in time.</summary>
        public bool IsTimed { get; }

        /// <summary>What a saved state has to agree in; empty where no wall moves.</summary>
        public string Key { get; }

        /// <summary>Gives <see cref="Key"/>.</summary>
        public static string KeyOf(ContactShape[] walls) => string.Concat(walls.Select(wall => wall.Motion).Distinct()
            .Where(motion => motion != null).Select(motion => ", moving " + motion!.Cycles.Count
                + (motion.Beam == null ? "" : ", beam " + motion.Beam.Count)));

        /// <summary>The time of all, s.</summary>
        public double Time { get; private set; }

        /// <summary>Goes to a time, s.</summary>
        /// <returns>Whether any wall is elsewhere then.</returns>
        public bool SetTime(double time)
        {
            Time = time;
            bool moves = false;
            foreach (WallField? field in Of)
            {
                moves |= field != null && field.SetTime(time);
            }
            return moves;
        }

        /// <summary>Takes the displacements of the beam's splines in a shape; one without has none to take.</summary>
        /// <returns>Whether they are others.</returns>
        public bool SetBeam(Vector3d[] q, double units) =>
            Beam != null && q.Length > 0 && Of[Carrier]!.SetBeam(q, units);

        /// <summary>A point, units, as wall w sees it.</summary>
        public Vector3d AtRest(int w, in Vector3d x) => Of[w]?.AtRest(x) ?? x;

        /// <summary>Sets the ways of what is at points of wall w at rest, units, between two times; the walls are
        /// left at the present one.</summary>
        /// <param name="ways">Receives the ways; where it is 0 none is asked for.</param>
        public void SetWays(int w, Vector3d[] rest, int count, double from, double to, Vector3d[] ways)
        {
            WallField field = Of[w]!;
            field.SetTime(from);
            for (int i = 0; i < count; i++)
            {
                ways[i] = ways[i] == Vector3d.Zero ? ways[i] : field.Moved(rest[i]);
            }
            field.SetTime(to);
            for (int i = 0; i < count; i++)
            {
                ways[i] = ways[i] == Vector3d.Zero ? ways[i] : field.Moved(rest[i]) - ways[i];
            }
            field.SetTime(Time);
        }

        /// <summary>Sets how wall w, or what is in it, moves at points of it at rest, units/s.</summary>
        /// <param name="since">A time before the present one by which velocities are found, s; 0: both sides of it.
        /// </param>
        public void SetVelocities(int w, Vector3d[] rest, int first, int count, double since, Vector3d[] velocities)
        {
            double from = since > 0.0 ? since : VelocityStep;
            double to = since > 0.0 ? 0.0 : VelocityStep;
            for (int i = 0; i < count; i++)
            {
                velocities[i] = i < first ? Vector3d.Zero : Vector3d.UnitX;
            }
            SetWays(w, rest, count, Time - from, Time + to, velocities);
            for (int i = first; i < count; i++)
            {
                velocities[i] = (1.0 / (from + to)) * velocities[i];
            }
        }

        /// <summary>Takes the phases of the cycles of the same walls around another rod.</summary>
        public void Follow(WallFields other)
        {
            for (int w = 0; w < Of.Length && other != this && Key == other.Key && Key.Length > 0; w++)
            {
                Of[w]?.Follow(other.Of[w]!, other.Time);
                Time = other.Time;
            }
        }

        /// <summary>Writes or restores the phases of the cycles, and where walls are.</summary>
        public void Serialize(Snapshot snapshot, double time)
        {
            for (int w = 0; w < Of.Length; w++)
            {
                if (Shared[w] == w)
                {
                    Of[w]?.Serialize(snapshot, time);
                }
            }
            Time = snapshot.IsWritten ? Time : time;
        }
    }

    /// <summary>Nodes of a wire as each wall meets them, units: those of a moving one where they are on it at
    /// rest.</summary>
    internal sealed class WallImages
    {
        private readonly WallFields _fields;
        private readonly Matrix3[]?[] _gradient;    // by wall and node

        /// <summary>Makes room for nodes.</summary>
        public WallImages(WallFields fields, int capacity)
        {
            _fields = fields;
            InSpace = new Vector3d[capacity];
            OnWall = new Vector3d[fields.Of.Length][];
            _gradient = new Matrix3[OnWall.Length][];
            for (int w = 0; w < OnWall.Length; w++)
            {
                int first = fields.Shared[w];
                OnWall[w] = fields.Of[w] == null ? InSpace : first < w ? OnWall[first] : new Vector3d[capacity];
                _gradient[w] = fields.Of[w] == null ? null : first < w ? _gradient[first] : new Matrix3[capacity];
            }
        }

        /// <summary>Where they are.</summary>
        public Vector3d[] InSpace { get; }

        /// <summary>Where each wall sees them.</summary>
        public Vector3d[][] OnWall { get; }

        /// <summary>G of wall w by node; null where it stands still.</summary>
        public Matrix3[]? GradientOf(int w) => _gradient[w];

        /// <summary>Whether the wall is folded at any of the nodes, whose gradients are set.</summary>
        public bool IsFolded(int count)
        {
            bool isFolded = false;
            for (int i = 0; i < count && _fields.Beam != null; i++)
            {
                isFolded |= _gradient[_fields.Carrier]![i].C1 == Vector3d.Zero;
            }
            return isFolded;
        }

        /// <summary>Sets the images of nodes that are set in space.</summary>
        public void Map(int count, bool hasGradient = false)
        {
            for (int w = 0; w < OnWall.Length; w++)
            {
                for (int i = 0; i < count && _fields.Shared[w] == w && _fields.Of[w] != null; i++)
                {
                    OnWall[w][i] = hasGradient ? _fields.Of[w]!.AtRest(InSpace[i], out _gradient[w]![i])
                        : _fields.Of[w]!.AtRest(InSpace[i]);
                }
            }
        }

        /// <summary>Takes those of another, with as many.</summary>
        public void CopyFrom(WallImages other, int count)
        {
            Array.Copy(other.InSpace, InSpace, count);
            for (int w = 0; w < OnWall.Length; w++)
            {
                if (OnWall[w] != InSpace && _fields.Shared[w] == w)
                {
                    Array.Copy(other.OnWall[w], OnWall[w], count);
                }
            }
        }

        /// <summary>The square of the longest displacement to others, as any wall sees it, units^2.</summary>
        public double LongestTo(WallImages others, int count)
        {
            double longest = 0.0;
            for (int w = 0; w < OnWall.Length; w++)
            {
                for (int i = 0; i < count && _fields.Shared[w] == w && _fields.Of[w] != null; i++)
                {
                    longest = Math.Max(longest, (others.OnWall[w][i] - OnWall[w][i]).LengthSquared);
                }
            }
            return longest;
        }
    }
}
