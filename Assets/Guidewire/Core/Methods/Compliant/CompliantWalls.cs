using System;

namespace Guidewire.Core
{
    /// <summary>Walls for the substeps of xpbd: finds contacts, prevents passages, and records the contact
    /// forces.</summary>
    /// <remarks>Contacts are found where a step begins, and again where a node has moved farther than <see
    /// cref="Reuse"/> of the wire's radius since; a substep is much shorter than a search needs. What is nearer than
    /// half a radius to touching is found. Until a node has gone as far as the core line of any element was from the
    /// wall, nothing can have passed it; a substep that goes farther is tested by the swept search, and shortened where
    /// it would. The clearance of the core line is a thousandth of the radius. All positions are in units
    /// here.</remarks>
    internal sealed class CompliantWalls
    {
        private const double Reuse = 0.02;

        private readonly ContactSearch _search;
        private readonly SweptSearch _swept;
        private readonly ShortenedMotion _shortened;
        private readonly PassageCount _passages;
        private readonly WireDepth _depth;
        private readonly double _metres;       // per unit
        private readonly double _clearance;
        private readonly double _reused;       // displacement within which contacts are used again
        private readonly Vector3d[] _start;    // of the step
        private Vector3d[] _from;              // where contacts were found
        private Vector3d[] _at;                // where the substep begins
        private Vector3d[] _to;
        private readonly Vector3d[] _asked;    // of a substep that is shortened
        private double _freeTravel;                  // displacement from there that passes no wall
        private bool _isNew;                   // contacts are to be found

        /// <summary>The walls of a scene, around its wire as it is.</summary>
        /// <param name="stiffness">Of a contact, N/m; 0 for rigid contacts.</param>
        public CompliantWalls(MaterialScene scene, NodalInertia inertia, double stiffness)
        {
            MaterialRod rod = scene.Rod;
            int n = rod.ElementCount;
            _metres = scene.Metres;
            var radius = new double[n];
            double thinnest = double.PositiveInfinity;
            double thickest = 0.0;
            double longest = 0.0;
            for (int j = 0; j < n; j++)
            {
                radius[j] = rod.Radius[j] / _metres;
                thinnest = Math.Min(thinnest, radius[j]);
                thickest = Math.Max(thickest, radius[j]);
                longest = Math.Max(longest, rod.Length[j] / _metres);
            }
            _search = new ContactSearch(scene.Walls, n, longest, thinnest, thickest, true);
            _swept = new SweptSearch(_search, n + 1);
            _shortened = new ShortenedMotion(_swept, n + 1);
            _passages = new PassageCount(_search, n);
            _depth = new WireDepth(_search, radius);
            _clearance = SweptSearch.ClearanceFor(thinnest);
            _reused = Reuse * thinnest;
            _start = new Vector3d[n + 1];
            _from = new Vector3d[n + 1];
            _at = new Vector3d[n + 1];
            _to = new Vector3d[n + 1];
            _asked = new Vector3d[n + 1];
            Contacts = new CompliantContacts(scene, inertia, stiffness);
            Record = new ContactRecord(n + 1) { WallForces = new Vector3d[scene.Walls.Length] };
        }

        /// <summary>The contacts as constraints.</summary>
        public CompliantContacts Contacts { get; }

        /// <summary>What contact came to.</summary>
        public ContactRecord Record { get; }

        /// <summary>A step begins in this shape.</summary>
        public void BeginStep(RodShape shape)
        {
            SetUnits(shape, _at);
            Array.Copy(_at, _start, _at.Length);
            Array.Copy(_at, _from, _at.Length);
            Array.Clear(Record.Forces, 0, Record.Forces.Length);
            Array.Clear(Record.WallForces, 0, Record.WallForces.Length);
            _isNew = true;
        }

        /// <summary>Begins a substep.</summary>
        /// <param name="old">The wire where it begins, kept until its end.</param>
        /// <param name="predicted">Where it would go without constraints, except for the motion of held nodes
        /// that walls prevent.</param>
        /// <param name="substep">h, s.</param>
        public void BeginSubstep(RodShape old, RodShape predicted, double substep)
        {
            SetUnits(predicted, _to);
            double displacement = LongestDisplacement(_from, _to);
            if ((_isNew || displacement > _reused) && displacement <= double.MaxValue)
            {
                _passages.AddPart(_from, _at);
                FindContacts();
                Contacts.Renew(_search.Contacts);
                _isNew = false;
            }
            Contacts.Begin(old, predicted, substep);
        }

        /// <summary>Accepts the shape of a substep, and reverts what would pass a wall.</summary>
        public void EndSubstep(RodShape shape)
        {
            SetUnits(shape, _to);
            double displacement = LongestDisplacement(_from, _to);
            if (displacement >= _freeTravel && displacement <= double.MaxValue)
            {
                _passages.AddPart(_from, _at);
                FindContacts();
                _isNew = true;
                if (_swept.Find(_at, _to))
                {
                    Array.Copy(_to, _asked, _to.Length);
                    _shortened.Shorten(_at, _to);
                    for (int i = 0; i < _to.Length; i++)
                    {
                        shape.X[i] = _to[i] == _asked[i] ? shape.X[i] : _metres * _to[i];
                    }
                }
            }
            (_at, _to) = (_to, _at);
            Contacts.End(shape);
            Contacts.AddMultipliers(Record.Forces, Record.WallForces);
        }

        /// <summary>The step has ended.</summary>
        /// <param name="substep">h, s.</param>
        /// <param name="substeps">How many they were.</param>
        public void EndStep(double substep, int substeps)
        {
            _passages.AddPart(_from, _at);
            _passages.EndStep(_start, _at);
            Record.Passages = _passages.Total;
            Record.MaxPenetration = _depth.Deepest(_from, _at, Record.MaxPenetration);
            double rate = 1.0 / (substep * substep * substeps);
            Vector3d total = Vector3d.Zero;
            for (int i = 0; i < Record.Forces.Length; i++)
            {
                Record.Forces[i] = rate * Record.Forces[i];
                total += Record.Forces[i];
            }
            for (int w = 0; w < Record.WallForces.Length; w++)
            {
                Record.WallForces[w] = rate * Record.WallForces[w];
            }
            Record.SetTotal(total);
        }

        /// <summary>Writes or restores what was counted.</summary>
        public void Serialize(Snapshot snapshot)
        {
            _passages.Serialize(snapshot);
            Record.Serialize(snapshot);
        }

        // Finds contacts along the motion from the start of the substep, and how far nothing passes a wall.
        private void FindContacts()
        {
            _search.Find(_at, _to);
            Array.Copy(_at, _from, _at.Length);
            double nearest = double.PositiveInfinity;
            for (int w = 0; w < _search.Walls.Length; w++)
            {
                for (int j = 0; j + 1 < _at.Length; j++)
                {
                    nearest = Math.Min(nearest, _search.ClearanceOf(w, j));
                }
            }
            _freeTravel = nearest - _clearance;
        }

        // Infinite where a position is not a number.
        private static double LongestDisplacement(Vector3d[] from, Vector3d[] to)
        {
            double longest = 0.0;
            for (int i = 0; i < to.Length; i++)
            {
                double square = (to[i] - from[i]).LengthSquared;
                if (!(square <= double.MaxValue))
                {
                    return double.PositiveInfinity;
                }
                longest = Math.Max(longest, square);
            }
            return Math.Sqrt(longest);
        }

        private void SetUnits(RodShape shape, Vector3d[] x)
        {
            double units = 1.0 / _metres;
            for (int i = 0; i < x.Length; i++)
            {
                x[i] = units * shape.X[i];
            }
        }
    }
}
