using System;
using System.Runtime.CompilerServices;

namespace Guidewire.Core
{
    /// <summary>The result of a neighbour query for a node or an element, and the position at which it was made.
    /// Lengths in
    /// units.</summary>
    internal struct Neighbour
    {
        private Vector3d _a;
        private Vector3d _b;
        private double _skin;        // below 0: no query was made
        private double _clearance;
        private int _from;
        private int _to;

        /// <summary>Whether the wall is within the range of the query.</summary>
        public bool IsNear { get; private set; }

        /// <summary>Marks the query as not made.</summary>
        public void Forget()
        {
            _skin = -1.0;
            IsNear = false;
        }

        /// <summary>Begins a query between a and b; features are added from an index of the list on.</summary>
        public void Begin(in Vector3d a, in Vector3d b, double skin, int from)
        {
            _a = a;
            _b = b;
            _skin = skin;
            _from = from;
        }

        /// <summary>Ends the query: the wall is at a distance, if that is within the range; features up to an index of
        /// the list belong to it.</summary>
        public void End(double distance, double range, int to)
        {
            IsNear = distance <= range;
            _clearance = Math.Min(distance, range);
            _to = to;
        }

        /// <summary>Whether the result is valid between a and b.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly bool Covers(in Vector3d a, in Vector3d b)
        {
            return _skin >= 0.0 && (a - _a).LengthSquared <= _skin * _skin
                && (b - _b).LengthSquared <= _skin * _skin;
        }

        /// <summary>Lower bound of the distance between the wall and segment a b; minus infinity where no query was
        /// made.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly double Clearance(in Vector3d a, in Vector3d b) =>
            _skin >= 0.0 ? _clearance - Moved(a, b) : double.NegativeInfinity;

        /// <summary>False where the wall is certainly farther from segment a b than a range.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly bool MayBeInRange(in Vector3d a, in Vector3d b, double range) =>
            MayBeInRange(Math.Max((a - _a).LengthSquared, (b - _b).LengthSquared), range);

        /// <summary>The same for its first end alone.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly bool FirstMayBeInRange(in Vector3d a, double range) =>
            MayBeInRange((a - _a).LengthSquared, range);

        /// <summary>The same for its second end.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly bool SecondMayBeInRange(in Vector3d b, double range) =>
            MayBeInRange((b - _b).LengthSquared, range);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private readonly bool MayBeInRange(double squaredMotion, double range)
        {
            double left = _clearance - range;
            return _skin < 0.0 || !(left > 0.0 && squaredMotion < left * left);
        }

        /// <summary>Its features, if the result is valid between a and b.</summary>
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public readonly FeatureRange Features(StructList<WallFeature> features, in Vector3d a, in Vector3d b) =>
            Covers(a, b) ? new FeatureRange(features, _from, _to, Moved(a, b)) : default;

        /// <summary>The same at its first end.</summary>
        public readonly FeatureRange FeaturesAtA(StructList<WallFeature> features, in Vector3d a) =>
            Features(features, a, _b);

        /// <summary>The same at its second end.</summary>
        public readonly FeatureRange FeaturesAtB(StructList<WallFeature> features, in Vector3d b) =>
            Features(features, _a, b);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        private readonly double Moved(in Vector3d a, in Vector3d b) =>
            Math.Sqrt(Math.Max((a - _a).LengthSquared, (b - _b).LengthSquared));
    }
}
