using System;

namespace Guidewire.Core
{
    /// <summary>Brings a scene's rod to its rest shape at time 0. Displacements and rotations of the ends are applied
    /// in increments, each solved before the next, so that a rod is wound up by many turns instead of taking the
    /// shorter rotation. A rod with rest curvature and one free end starts from its stress-free shape: a coil of many
    /// turns is not reached from the straight shape.</summary>
    /// <remarks>A wire whose fibres give way remembers its path. Its loads and the displacements of its ends then grow
    /// together, and it remembers after each increment.</remarks>
    internal sealed class RestShape
    {
        /// <summary>Iterations over those of a stage of a motion: a search may start far away.</summary>
        public const int IterationFactor = 10;

        private const double LargestShift = 0.01;  // of L a part
        private const double MaxShifts = 1000.0;  // parts of a shift; by more than 10 L each is larger
        private const int PathParts = 40;    // of loads, where fibres give way

        private readonly MaterialScene _scene;
        private readonly RodTerms _terms;
        private readonly double _tolerance;
        private readonly int _maxIterations;
        private readonly SolverReport _report;
        private Action<double>? _grow;     // sets a fraction of the loads

        /// <summary>Makes a search in this scene.</summary>
        /// <param name="tolerance">Error that the shape may have: radians, or displacement over L.</param>
        /// <param name="maxIterations">Newton iterations of a part.</param>
        /// <param name="report">Told how the rest shape was found and how good it is.</param>
        public RestShape(MaterialScene scene, RodTerms terms, double tolerance, int maxIterations,
            SolverReport report)
        {
            _scene = scene;
            _terms = terms;
            _tolerance = tolerance;
            _maxIterations = maxIterations;
            _report = report;
        }

        /// <summary>Moves the shape to rest.</summary>
        /// <returns>Null, or why there is no rest shape.</returns>
        public string? Find(RodShape shape)
        {
            _terms.SetTime(_scene.Schedule, 0.0);
            if (_scene.StartsStraight && _scene.Supports.Distal == DistalEnd.Free)
            {
                var straight = new RodShape(shape.ElementCount, shape.InnerCount);
                straight.CopyFrom(shape);
                if (_terms.Bending.RelaxTurns(shape))
                {
                    PlaceNodes(shape);
                    if (MoveByPath(shape) == null)
                    {
                        return null;
                    }
                }
                shape.CopyFrom(straight);
            }
            return MoveByPath(shape);
        }

        // At once; where fibres give way once more, by their path.
        private string? MoveByPath(RodShape shape)
        {
            if (_terms.Fibres == null)
            {
                return Move(shape, 1);
            }
            var start = new RodShape(shape.ElementCount, shape.InnerCount, shape.Q.Length);
            start.CopyFrom(shape);
            string? failure = Move(shape, 1);
            if (failure == null && !_terms.Fibres.GivesWay(shape))
            {
                return null;
            }
            shape.CopyFrom(start);
            var loads = (Vector3d[])_terms.Loads.Force.Clone();
            Vector3d moment = _terms.Followers.Moment.Moment;
            Vector3d force = _terms.Followers.Force.Force;
            _grow = fraction =>
            {
                for (int i = 0; i < loads.Length; i++)
                {
                    _terms.Loads.Force[i] = fraction * loads[i];
                }
                _terms.Followers.Moment.Moment = fraction * moment;
                _terms.Followers.Force.Force = fraction * force;
            };
            failure = Move(shape, PathParts);
            _grow(1.0);
            _grow = null;
            return failure;
        }

        // Lays the elements end to end.
        private void PlaceNodes(RodShape shape)
        {
            for (int j = 0; j < shape.ElementCount; j++)
            {
                shape.X[j + 1] = shape.X[j] + _scene.Rod.Length[j] * shape.Q[j].Director3;
            }
        }

        private string? Move(RodShape shape, int least)
        {
            RodSchedule schedule = _scene.Schedule;
            var statics = new RodStatics(_terms);
            bool isHeld = _scene.Supports.Distal != DistalEnd.Free;
            int last = shape.ElementCount;
            double turn = _scene.Supports.HasDistalJoint ? schedule.Distal.TurnAt(0.0) : 0.0;
            Vector3d from = shape.X[0];
            Vector3d startShift = schedule.Hub.PositionAt(0.0) - from;
            Vector3d end = shape.X[last];
            Vector3d endShift = isHeld ? schedule.Distal.PositionAt(0.0) - end : Vector3d.Zero;
            double shift = Math.Max(endShift.Length, isHeld ? startShift.Length : 0.0) / _scene.Rod.TotalLength;
            string? failure = Winding.Split(turn, out int turns);
            if (failure != null)
            {
                return "no rest shape: " + failure;
            }
            int parts = Math.Max(least, Math.Max(turns, 1 + (int)Math.Min(shift / LargestShift, MaxShifts)));
            for (int k = 1; k <= parts; k++)
            {
                // Each part is spread over the rod as an even stretch and an even twist; the solver does the rest.
                for (int i = 0; i <= last; i++)
                {
                    Vector3d a = isHeld ? Vector3d.Lerp(startShift, endShift, (double)i / last) : startShift;
                    shape.X[i] += a / parts;
                }
                for (int j = 0; j < last; j++)
                {
                    double fraction = turn / parts * (j + 0.5) / last;
                    shape.Q[j] = shape.Q[j] * Quaterniond.FromAxisAngle(Vector3d.UnitZ, fraction);
                }
                schedule.TurnFrames(shape, 0.0, turn * k / parts, 0.0);
                _grow?.Invoke((double)k / parts);
                EquilibriumResult result = statics.Solve(shape, _tolerance, _maxIterations);
                _report.EquilibriumIterations += result.Iterations;
                _report.Factorisations += result.Factorisations;
                _report.EquilibriumResidual = result.Residual;
                _report.SmallestEigenvalue = result.SmallestEigenvalue;
                _report.Method = result.Method ?? string.Empty;
                string? turned = _scene.Joints.FindLost(shape, 0.0, (double)k / parts);
                if (turned != null || !result.Converged)
                {
                    return "no rest shape: " + (turned ?? result.Reason);
                }
                if (_grow != null)
                {
                    _terms.Fibres!.EndStep(shape);
                }
            }
            return null;
        }
    }
}
