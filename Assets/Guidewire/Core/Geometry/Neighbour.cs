using System;

namespace Guidewire.Core
{
    /// <summary>Where a node or an element was looked for a wall, and what was found. Lengths in units.</summary>
    internal struct Neighbour
    {
        private Vector3d _a;
        private Vector3d _b;
        private double _skin;        // below 0: it was not looked for
        private double _clearance;
        private int _from;
        private int _to;

        /// <summary>Whether the wall is near within reach.</summary>
        public bool IsNear { get; private set; }

        /// <summary>It was not looked for.</summary>
        public void Forget()
        {
            _skin = -1.0;
            IsNear = false;
        }

        /// <summary>It is looked for between a and b; features are added from a place of the list on.</summary>
        public void Begin(in Vector3d a, in Vector3d b, double skin, int from)
        {
            _a = a;
            _b = b;
            _skin = skin;
            _from = from;
        }

        /// <summary>It was found at a distance, if that is within the range; features up to a place of the list are
        /// its.</summary>
        public void End(double distance, double range, int to)
        {
            IsNear = distance <= range;
            _clearance = Math.Min(distance, range);
            _to = to;
        }

        /// <summary>Whether what was found holds between a and b.</summary>
        public readonly bool Covers(in Vector3d a, in Vector3d b)
        {
            return _skin >= 0.0 && (a - _a).LengthSquared <= _skin * _skin
                && (b - _b).LengthSquared <= _skin * _skin;
        }

        /// <summary>A distance than which the wall is no nearer to what is between a and b; minus infinity where it was
        /// not looked for.</summary>
        public readonly double Clearance(in Vector3d a, in Vector3d b)
        {
            return _skin >= 0.0 ? _clearance - Moved(a, b) : double.NegativeInfinity;
        }

        /// <summary>Its features, if they are known between a and b.</summary>
        public readonly FeatureRange Features(StructList<WallFeature> features, in Vector3d a, in Vector3d b)
        {
            return Covers(a, b) ? new FeatureRange(features, _from, _to, Moved(a, b)) : default;
        }

        /// <summary>The same at its first end.</summary>
        public readonly FeatureRange FeaturesAtA(StructList<WallFeature> features, in Vector3d a)
        {
            return Features(features, a, _b);
        }

        /// <summary>The same at its second end.</summary>
        public readonly FeatureRange FeaturesAtB(StructList<WallFeature> features, in Vector3d b)
        {
            return Features(features, _a, b);
        }

        private readonly double Moved(in Vector3d a, in Vector3d b)
        {
            return Math.Sqrt(Math.Max((a - _a).LengthSquared, (b - _b).LengthSquared));
        }
    }
}
