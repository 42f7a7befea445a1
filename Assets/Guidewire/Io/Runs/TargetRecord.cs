using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>How far a wire has come within its vessel along the centreline, and whether to its target.</summary>
    internal sealed class TargetRecord
    {
        private readonly CentrelinePath _path;
        private readonly LumenPlaces _places;
        private LumenPlace _place;
        private double _farthest = double.NegativeInfinity;
        private double _reachedAt = double.NaN;   // s

        public TargetRecord(CentrelinePath path, LumenPlaces places)
        {
            _path = path;
            _places = places;
        }

        /// <summary>Takes the wire's position.</summary>
        /// <param name="points">Of its spheres, units.</param>
        /// <param name="time">s.</param>
        /// <param name="field">Where the vessel is, if it moves.</param>
        public void Update(Vector3d[] points, double time, WallField? field)
        {
            _place = _places.Of(points, field);
            _farthest = System.Math.Max(_farthest, _place.Distance);
            if (double.IsNaN(_reachedAt) && _place.IsAtTarget)
            {
                _reachedAt = time;
            }
        }

        /// <summary>What the summary says of it: distances along the centreline from the inlet in units, times in s,
        /// the branches from the inlet to there.</summary>
        public JObject ToJson()
        {
            bool isReached = !double.IsNaN(_reachedAt);
            bool isRequested = _path.Target >= 0;
            return new JObject
            {
                ["inlet"] = _path.Inlet.Name,
                ["inLumen"] = _place.IsInside,
                ["distance"] = _place.Distance,
                ["farthest"] = _farthest,
                ["path"] = new JArray(_path.BranchesTo(_place.Near)),
                ["target"] = isRequested ? _path.TargetName : null,
                ["targetDistance"] = isRequested ? _path.Distances[_path.Target] : (double?)null,
                ["reached"] = isRequested ? isReached : (bool?)null,
                ["reachedAt"] = isReached ? _reachedAt : (double?)null,
            };
        }
    }
}
