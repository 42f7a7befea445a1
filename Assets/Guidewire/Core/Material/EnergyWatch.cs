using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Finds a motion that has blown up: the wire moves with more energy than was ever put into
    /// it.</summary>
    /// <remarks>With T of motion and V of the strains, T + V is at most what it was at the start plus the work W of
    /// loads and held ends; damping and implicit steps only take from it. V is no less than 0, so T never exceeds the
    /// largest sum that start and W have had. T alone is compared: strains that too few sweeps have not yet closed
    /// hold energy on paper only, and such a wire is wrong but not lost. There is room for a factor of 4, and more for
    /// explicit steps h near their limit, where T of a mode is too high by 1/(1 - (omega h/2)^2).</remarks>
    internal sealed class EnergyWatch
    {
        /// <summary>What T may be over the energy put in.</summary>
        public const double Allowance = 4.0;

        private const double Rounding = 1e-9;   // of EI/L
        private readonly MaterialScene _scene;
        private readonly RodStatics _statics;
        private readonly NodalInertia _inertia;
        private readonly HeldEnds _ends;
        private readonly Vector3d[] _before;
        private readonly double _allowance;
        private readonly double _start;         // J
        private Quaterniond _tipBefore;
        private double _loadWork;               // J
        private double _mostPutIn;              // J
        private int _step;

        /// <summary>A watch on this scene, at its start.</summary>
        /// <param name="allowance">What T may be over the energy put in, at least <see cref="Allowance"/>.</param>
        public EnergyWatch(MaterialScene scene, RodStatics statics, NodalInertia inertia, HeldEnds ends,
            double allowance)
        {
            _allowance = allowance;
            _scene = scene;
            _statics = statics;
            _inertia = inertia;
            _ends = ends;
            RodShape shape = scene.Shape;
            _before = (Vector3d[])shape.X.Clone();
            _tipBefore = shape.Q[shape.ElementCount - 1];
            _start = Motion() + statics.Stretch.Value(shape) + statics.Bending.Value(shape);
            _mostPutIn = Rounding * scene.Rod.BendStiffness[0] / scene.Rod.TotalLength;
        }

        /// <summary>Takes the wire after a step that these loads acted in; one line where it has blown up, else
        /// null.</summary>
        public string? Blowup(DeadLoads loads)
        {
            RodShape shape = _scene.Shape;
            int last = shape.ElementCount - 1;
            _step++;
            for (int i = 0; i < _before.Length; i++)
            {
                _loadWork += Vector3d.Dot(loads.Force[i], shape.X[i] - _before[i]);
                _before[i] = shape.X[i];
            }
            _loadWork += Vector3d.Dot(_statics.Moment.Moment,
                RotationVector.Log(_tipBefore.Conjugate * shape.Q[last]));
            _tipBefore = shape.Q[last];
            double motion = Motion();
            double putIn = _start + _loadWork + _ends.MostWork;
            // A NaN fails every comparison, so the question is asked for the good case.
            if (motion <= _allowance * Math.Max(_mostPutIn, putIn))
            {
                _mostPutIn = Math.Max(_mostPutIn, putIn);
                return null;
            }
            if (!(motion <= double.MaxValue))
            {
                return string.Format(CultureInfo.InvariantCulture,
                    "the wire has no finite positions or velocities at step {0}", _step);
            }
            return string.Format(CultureInfo.InvariantCulture,
                "the wire moves with {0:G3} times the energy that was put into it (step {1})",
                motion / Math.Max(_mostPutIn, putIn), _step);
        }

        // T, J.
        private double Motion()
        {
            double twice = 0.0;
            for (int i = 0; i < _before.Length; i++)
            {
                if (_inertia.InverseMass[i] > 0.0)
                {
                    twice += _scene.Velocities[i].LengthSquared / _inertia.InverseMass[i];
                }
            }
            for (int j = 0; j < _scene.Spins.Length; j++)
            {
                Vector3d w = _scene.Spins[j];
                Vector3d inverse = _inertia.InverseInertia[j];
                twice += w.X * w.X / inverse.X + w.Y * w.Y / inverse.Y + w.Z * w.Z / inverse.Z;
            }
            return 0.5 * twice;
        }
    }
}
