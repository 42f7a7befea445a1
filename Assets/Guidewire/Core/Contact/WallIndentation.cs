using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>How a wall that gives way is drawn: vertices near a contact go with it, the less the farther away they
    /// are. Only drawn: what a run knows of a wall is how far it is displaced at its contacts.</summary>
    public sealed class WallIndentation
    {
        private const double Reach = 4.0;    // beyond the wire's surface, of its radius

        private readonly Vector3d[] _rest;      // units; none where the wall is rigid and stands still
        private readonly Vector3d[] _given;     // of a wall that moves, before it does
        private readonly double[] _radii;       // of the wire and each catheter, units
        private readonly double _perMetre;      // units
        private bool _isMoved;

        /// <summary>A wall at rest.</summary>
        /// <param name="parameters">Those of the run.</param>
        /// <param name="wall">One of its walls.</param>
        /// <param name="vertices">Those that it is drawn by, units.</param>
        public WallIndentation(SimulationParameters parameters, ContactShape wall, IEnumerable<Vector3d> vertices)
        {
            Vertices = new List<Vector3d>(vertices).ToArray();
            _rest = wall.Softness == null && wall.Motion == null ? Array.Empty<Vector3d>()
                : (Vector3d[])Vertices.Clone();
            _given = wall.Motion == null ? Array.Empty<Vector3d>() : (Vector3d[])Vertices.Clone();
            _perMetre = 1.0 / parameters.Scene.MetresPerUnit;
            _radii = new double[1 + parameters.Scene.Catheters.Count];
            for (int k = 0; k < _radii.Length; k++)
            {
                _radii[k] = _perMetre * (k == 0 ? parameters.Material : parameters.Scene.Catheters[k - 1].Material)
                    .WireRadius;
            }
        }

        /// <summary>Where its vertices are drawn, units.</summary>
        public Vector3d[] Vertices { get; }

        /// <summary>Moves the vertices to where the instruments press them.</summary>
        /// <param name="centrelines">Nodes of the wire and of each catheter, units.</param>
        /// <param name="displacements">Of walls at their elements, m, as <see cref="ContactRecord.Displacements"/>;
        /// none: the wall is at rest.</param>
        /// <param name="field">Where the wall is, if it moves; null: at rest.</param>
        /// <returns>Whether they may differ from before.</returns>
        public bool Move(IReadOnlyList<Vector3d[]> centrelines, IReadOnlyList<Vector3d[]> displacements,
            WallField? field = null)
        {
            bool wasMoved = _isMoved || field != null;
            for (int i = 0; i < _given.Length; i++)
            {
                _rest[i] = field?.Moved(_given[i]) ?? _given[i];
            }
            if (wasMoved)
            {
                Array.Copy(_rest, Vertices, _rest.Length);
                _isMoved = field != null;
            }
            for (int k = 0; k < displacements.Count && _rest.Length > 0; k++)
            {
                for (int j = 0; j < displacements[k].Length; j++)
                {
                    Vector3d displacement = _perMetre * displacements[k][j];
                    if (displacement != Vector3d.Zero)    // most elements touch nothing
                    {
                        Press(centrelines[k][j], centrelines[k][j + 1], displacement, _radii[k]);
                    }
                }
            }
            return wasMoved || _isMoved;
        }

        // Each vertex goes with the element that moves it farthest.
        private void Press(in Vector3d a, in Vector3d b, in Vector3d displacement, double radius)
        {
            double size = displacement.Length;
            double reach = (1.0 + Reach) * radius + Vector3d.Distance(a, b);
            for (int i = 0; i < _rest.Length; i++)
            {
                double share = (_rest[i] - a).LengthSquared < reach * reach
                    ? Share(_rest[i], a, b, (1.0 / size) * displacement, radius) : 0.0;
                if (share * size > Vector3d.Distance(_rest[i], Vertices[i]))
                {
                    Vertices[i] = _rest[i] + share * displacement;
                    _isMoved = true;
                }
            }
        }

        // 1 at the contact itself, 0 away from it and on the other side of the wire.
        private static double Share(in Vector3d x, in Vector3d a, in Vector3d b, in Vector3d outward, double radius)
        {
            Vector3d chord = b - a;
            double s = Math.Min(1.0, Math.Max(0.0, Vector3d.Dot(x - a, chord) / chord.LengthSquared));
            Vector3d from = x - (a + s * chord);
            double distance = from.Length;
            double beyond = Math.Max(0.0, distance - radius) / (Reach * radius);
            double side = distance > 0.0 ? Vector3d.Dot(from, outward) / distance : 0.0;
            double fade = 1.0 - beyond * beyond;
            return beyond < 1.0 && side > 0.0 ? fade * fade * side : 0.0;
        }
    }
}
