using System.Runtime.CompilerServices;
using System;

namespace Guidewire.Core
{
    /// <summary>The nodes of a wire as used for contact with walls: those in its sheath are placed at the
    /// exit.</summary>
    /// <remarks>In the last element before the exit only its frame holds the wire sideways. A node there that is
    /// farther from the axis than the lumen is wide would come out through a wall, so no motion may lead to
    /// it.</remarks>
    internal sealed class SheathedNodes
    {
        private const double Range = 1e3;    // units, within which the walls around the exit are looked for

        private readonly SheathEnd? _sheath;
        private readonly ContactShape[] _walls;
        private readonly double _metres;     // per unit of the walls
        private readonly double _units;      // per metre
        private double _clearance;           // of the exit, m
        private readonly WallFields? _fields;

        /// <param name="sheath">Null: no node is in one.</param>
        /// <param name="metres">Of a unit of the walls.</param>
        /// <param name="fields">Where walls are that move; null: none does.</param>
        public SheathedNodes(SheathEnd? sheath, ContactShape[] walls, double metres, WallFields? fields = null)
        {
            _fields = fields;
            _sheath = sheath;
            _walls = walls;
            _metres = metres;
            _units = 1.0 / metres;
            Remesh();
        }

        /// <summary>Walls are elsewhere.</summary>
        public void WallsMoved() =>
            _clearance = _sheath == null ? 0.0 : _metres * ClearanceAt(_units * _sheath.Exit);

        /// <summary>The wire has other elements, and walls may be where they were not.</summary>
        public void Remesh()
        {
            WallsMoved();
            (LeavesLumen, LeavesSheath, HasBuckled) = (false, false, false);
        }

        /// <summary>Distance of the sheath's exit from the walls, m.</summary>
        public double Clearance => _clearance;

        /// <summary>Whether the last motion takes a node in the sheath farther sideways than the lumen is wide at the
        /// exit.</summary>
        public bool LeavesLumen { get; private set; }

        /// <summary>Whether the last motion takes a node out of the sheath.</summary>
        public bool LeavesSheath { get; private set; }

        /// <summary>Whether any motion was a <see cref="LeavesLumen"/> since this was last set to false.</summary>
        public bool HasBuckled { get; set; }

        /// <summary>How many nodes of a shape, from its first on, are in the sheath.</summary>
        public int Inside(RodShape shape) => _sheath == null ? 0 : _sheath.NodesInside(shape);

        /// <summary>A node as walls meet it, units.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public Vector3d Place(in Vector3d x, bool isInside) => _units * (isInside ? _sheath!.Exit : x);

        /// <summary>The nodes of a shape as walls meet them, units.</summary>
        /// <param name="x">Receives them.</param>
        /// <returns>How many of them are in the sheath.</returns>
        public int Set(RodShape shape, Vector3d[] x)
        {
            int inside = Inside(shape);
            for (int i = 0; i <= shape.ElementCount; i++)
            {
                x[i] = Place(shape.X[i], i < inside);
            }
            return inside;
        }

        /// <summary>Where the nodes are after a motion, as walls meet them.</summary>
        /// <param name="direction">By node.</param>
        /// <param name="step">Units a unit of the direction.</param>
        /// <param name="from">Where they are, units.</param>
        /// <param name="to">Receives where they go, units.</param>
        /// <returns>The square of the longest of the nodes' displacements, units^2.</returns>
        public double Move(RodShape shape, RodVector[] direction, double step, Vector3d[] from, Vector3d[] to)
        {
            double longest = 0.0;
            bool isInside = _sheath != null;
            LeavesLumen = false;
            LeavesSheath = false;
            for (int i = 0; i <= shape.ElementCount; i++)
            {
                RodVector d = direction[i];
                Vector3d move = step * d.X;
                to[i] = from[i] + move;
                if (isInside)
                {
                    Vector3d x = shape.X[i] + (1.0 / _units) * move;
                    isInside = _sheath!.Outside(x) < 0.0;
                    LeavesLumen |= isInside && IsOutsideLumen(x);
                    LeavesSheath |= !isInside && _sheath.Outside(shape.X[i]) < 0.0;
                    to[i] = Place(x, isInside);
                    move = to[i] - from[i];
                }
                longest = Math.Max(longest, move.LengthSquared);
            }
            HasBuckled |= LeavesLumen;
            return longest;
        }

        private double ClearanceAt(in Vector3d exit)
        {
            double clearance = Range;
            for (int w = 0; w < _walls.Length; w++)
            {
                int hint = -1;
                Vector3d x = _fields?.AtRest(w, exit) ?? exit;
                if (_walls[w].Nearest(x, x, Range, ref hint, out SurfaceContact contact))
                {
                    clearance = Math.Min(clearance, contact.Distance);
                }
            }
            return clearance;
        }

        private bool IsOutsideLumen(in Vector3d x)
        {
            Vector3d atExit = x - _sheath!.Outside(x) * _sheath.Axis;
            if ((atExit - _sheath.Exit).LengthSquared < _clearance * Math.Abs(_clearance))
            {
                return false;
            }
            for (int w = 0; w < _walls.Length; w++)
            {
                if (!_walls[w].Contains(_fields?.AtRest(w, _units * atExit) ?? _units * atExit))
                {
                    return true;
                }
            }
            return false;
        }
    }
}
