using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Decides whether a wire with a material is at rest, from its speed and its unbalanced forces,
    /// independent of the method and its time step.</summary>
    /// <remarks>With K the second derivative of all terms at the current shape, g their gradient and M the mass, a wire
    /// near its rest shape moves by M u'' + K u = 0 about it. Three lengths must be below the threshold: 1. |K^-1 g|,
    /// the Newton step to the rest shape: how far the wire is from it, also at a turning point, where nothing moves. K
    /// must have no negative eigenvalue but those of neutral motions: an equilibrium that a disturbance leaves is no
    /// end. 2. sqrt(|v| |K^-1 M v|), how far the wire goes on swinging: in a mode of angular frequency w it is v/w,
    /// however slow the mode is. 3. |v| t with t = sqrt(m L^3/EI): in t the slowest bending mode of a straight
    /// cantilever turns by 3.5 rad, every other by more. It costs no factorisation and is asked in every step; the
    /// other two only where it holds, and then at most once in a tenth of t. No hold is needed: position and speed
    /// together tell how far a wire will ever be from rest, a position or a speed alone does not. Sizes are the larger
    /// of turns (times L) and shifts. A wire on which something prescribed is still to change is not at rest.</remarks>
    internal sealed class RestMonitor
    {
        private const double Interval = 0.1;           // of t
        private const double Regularisation = 1e-6;    // of EI/L^2; a wire may turn about its own load for nothing
        private const double MaxRegularisation = 0.01;  // of the softest element's EI/L^2
        private const double Unnoticed = 1e-4;         // of L: a disturbance that has not grown
        private const double Neutral = 1.01e-4;        // of EI/L^2: eigenvalues above its negative may be 0

        private readonly MaterialScene _scene;
        private readonly RodTerms _terms;
        private readonly EnergyTerm[] _all;
        private readonly Vector3d[] _velocities;
        private readonly Vector3d[] _spins;
        private readonly double _threshold;            // m
        private readonly double _end;                  // of the run, s
        private double _length;                        // L, m
        private double _bendForce;                     // N
        private double _regularisation;                // N
        private double _time;                          // t, s
        private readonly BlockTridiagonal _system;
        private readonly FollowerTangent? _tangent;    // where a load at the tip has no potential
        private EquilibriumStability? _stability;      // once it is asked
        private readonly RodVector[] _gradient;
        private readonly RodVector[] _step;
        private readonly RodVector[] _motion;
        private readonly RodVector[] _swing;
        private double _nextCheck;                      // s

        /// <summary>A monitor of this scene's wire, which moves with these velocities.</summary>
        /// <param name="other">What acts on it besides the terms, or null.</param>
        public RestMonitor(MaterialScene scene, RodTerms terms, Vector3d[] velocities, Vector3d[] spins,
            MethodParameters method, EnergyTerm? other = null)
        {
            _scene = scene;
            _terms = terms;
            _all = other == null ? terms.All : terms.With(other);
            _velocities = velocities;
            _spins = spins;
            _threshold = scene.Metres * method.DeltaThreshold;
            _end = method.MaxSimulationSteps * method.TimeStep;
            _gradient = new RodVector[terms.VectorCapacity];
            _step = new RodVector[terms.VectorCapacity];
            _motion = new RodVector[terms.VectorCapacity];
            _swing = new RodVector[terms.VectorCapacity];
            SetScales();
            _tangent = terms.HavePotential ? null
                : new FollowerTangent(scene.Rod, scene.Supports, _all, terms.Followers);
            _system = _tangent == null ? new BlockTridiagonal(scene.Rod, scene.Supports) : _tangent.System;
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh()
        {
            SetScales();
            _nextCheck = 0.0;
            _tangent?.Remesh();
            _system.Remesh();
            _stability = null;
            Array.Clear(_motion, 0, _motion.Length);
            Array.Clear(_swing, 0, _swing.Length);
        }

        /// <summary>Whether the wire is where any disturbance grows, and has not noticed. Its forces are almost in
        /// balance, K has a negative eigenvalue, and along its mode the wire is not yet displaced, nor does it move. A
        /// straight or symmetric motion stays so
        /// in a computation beyond its critical load.</summary>
        /// <param name="time">s.</param>
        public bool IsUnstable(double time)
        {
            // On walls a wire may slide or roll off without end: that is not what this is about.
            if (_tangent != null || _scene.Walls.Length > 0)
            {
                return false;
            }
            SetMotion();
            _terms.SetTime(_scene.Schedule, time);
            _stability ??= new EquilibriumStability(_scene.Rod, _scene.Supports, _all, _system, Neutral * _bendForce);
            return _stability.IsNearSaddle(_scene.Shape)
                && _stability.AwayFromSaddle(_scene.Shape, _motion, _time) <= Unnoticed * _length;
        }

        private void SetScales()
        {
            _length = _scene.Rod.TotalLength;
            _bendForce = _scene.Rod.BendForce;
            double softest = _terms.SoftestStiffness;
            _regularisation = Math.Min(Regularisation * _bendForce, MaxRegularisation * softest / (_length * _length));
            _time = Math.Sqrt(_terms.Mass.Total * _length * _length * _length / softest);
        }

        /// <summary>How the wire is at rest at this time, s, in one line; or null.</summary>
        public string? FindRest(double time)
        {
            if (_threshold <= 0.0)
            {
                return null;
            }
            SetMotion();
            double speed = Size(_motion);
            if (!(speed * _time <= _threshold))
            {
                _nextCheck = time;
                return null;
            }
            if (time < _nextCheck || !_scene.Schedule.IsOver(time, _end) || _terms.Followers.ChangeAfter(time))
            {
                return null;
            }
            _nextCheck = time + Interval * _time;
            _terms.SetTime(_scene.Schedule, time);
            if (!Factorise())
            {
                return null;
            }
            double away = Size(_step);
            if (!(away <= _threshold))
            {
                return null;
            }
            SetMomentum();
            Solve(_swing);
            double swing = Math.Sqrt(speed * Size(_swing));
            if (!(swing <= _threshold))
            {
                return null;
            }
            if (_tangent == null)
            {
                _stability ??= new EquilibriumStability(_scene.Rod, _scene.Supports, _all, _system,
                    Neutral * _bendForce);
                if (!_stability.IsStable(_scene.Shape))
                {
                    return null;
                }
            }
            return string.Format(CultureInfo.InvariantCulture,
                "the wire is at rest: {0:G3} units from its rest shape, swinging by {1:G3}; deltaThreshold = {2} units",
                away / _scene.Metres, Math.Max(swing, speed * _time) / _scene.Metres, _threshold / _scene.Metres);
        }

        /// <summary>Writes or restores the time of the next check.</summary>
        public void Serialize(Snapshot snapshot) => snapshot.Serialize(ref _nextCheck);

        // The Newton step; false where the nearby equilibrium is unstable.
        private bool Factorise()
        {
            for (double shift = _regularisation; shift <= Neutral * _bendForce; shift *= 10.0)
            {
                if (_tangent != null)
                {
                    // A load without a potential says nothing of stability by the symmetric part alone.
                    _tangent.Factorise(_scene.Shape, _step, shift);
                    return true;
                }
                if (_system.Factorise(_all, _scene.Shape, _gradient, _step, shift) == 0)
                {
                    _system.Back(_step);
                    return true;
                }
            }
            return false;
        }

        private void Solve(RodVector[] y)
        {
            if (_tangent != null)
            {
                _tangent.Solve(y);
                return;
            }
            _system.Solve(y);
        }

        private void SetMotion()
        {
            int n = _scene.Rod.ElementCount;
            for (int i = 0; i <= n; i++)
            {
                Vector3d v = _velocities[i];
                Vector3d w = i < n ? _spins[i] : Vector3d.Zero;
                _motion[i] = new RodVector(v, w);
            }
        }

        // M v, the fixed directions taken out.
        private void SetMomentum()
        {
            RodMass mass = _terms.Mass;
            int last = _scene.Rod.ElementCount;
            for (int i = 0; i <= last; i++)
            {
                Vector3d p = mass.Diagonal[i] * _velocities[i];
                Vector3d spin = Vector3d.Zero;
                if (i > 0)
                {
                    p += mass.Coupling[i - 1] * _velocities[i - 1];
                }
                if (i < last)
                {
                    p += mass.Coupling[i] * _velocities[i + 1];
                    Vector3d w = _spins[i];
                    spin = new Vector3d(mass.Rotary[i].X * w.X, mass.Rotary[i].Y * w.Y, mass.Rotary[i].Z * w.Z);
                }
                _swing[i] = new RodVector(p, spin);
            }
            _swing[last + 1] = default;
            _system.Project(_swing);
        }

        // The largest shift, or turn times L.
        private double Size(RodVector[] v) =>
            _length * RodStep.Size(v, _scene.Rod.ElementCount, _length, out _, _terms.VectorCount);
    }
}
