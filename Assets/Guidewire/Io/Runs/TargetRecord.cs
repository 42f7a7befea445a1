using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>How far the tip of a wire has come along the vessel's centreline, and whether to its target.</summary>
    internal sealed class TargetRecord
    {
        private readonly CentrelinePath _path;
        private int _near;
        private double _distance;   // units
        private double _farthest = double.NegativeInfinity;
        private double _reachedAt = double.NaN;   // s

        public TargetRecord(CentrelinePath path)
        {
            _path = path;
        }

        /// <summary>Takes the tip's position.</summary>
        /// <param name="tip">Units.</param>
        /// <param name="time">s.</param>
        public void Update(in Vector3d tip, double time)
        {
            _near = _path.Locate(tip);
            _distance = _path.DistanceOf(tip, _near);
            _farthest = System.Math.Max(_farthest, _distance);
            if (double.IsNaN(_reachedAt) && _path.IsAtTarget(_near))
            {
                _reachedAt = time;
            }
        }

        /// <summary>What the summary says of it: distances along the centreline from the inlet in units, times in s,
        /// the branches from the inlet to the tip.</summary>
        public JObject ToJson()
        {
            bool isReached = !double.IsNaN(_reachedAt);
            bool isRequested = _path.Target >= 0;
            return new JObject
            {
                ["inlet"] = _path.Inlet.Name,
                ["distance"] = _distance,
                ["farthest"] = _farthest,
                ["path"] = new JArray(_path.BranchesTo(_near)),
                ["target"] = isRequested ? _path.TargetName : null,
                ["targetDistance"] = isRequested ? _path.Distances[_path.Target] : (double?)null,
                ["reached"] = isRequested ? isReached : (bool?)null,
                ["reachedAt"] = isReached ? _reachedAt : (double?)null,
            };
        }
    }
}
