using System;

namespace Guidewire.Core
{
    /// <summary>A material rod at rest: between its supports, under dead and follower loads. Chooses how the rest shape
    /// is found: by minimisation if the loads have a potential (all but a follower force, and a follower couple in
    /// space), by minimisation within the plane for a couple in a plane problem, otherwise by minimisation without
    /// follower loads followed by viscous relaxation under them.</summary>
    internal sealed class RodStatics
    {
        private const double PlaneTolerance = 1e-12;

        private readonly MaterialRod _rod;
        private readonly RodSupports _supports;
        private readonly RodTerms _terms;

        /// <summary>A rod under these terms, as their loads stand when it is solved.</summary>
        public RodStatics(RodTerms terms)
        {
            _rod = terms.Rod;
            _supports = terms.Supports;
            _terms = terms;
        }

        /// <summary>Moves <paramref name="shape"/> to a rest shape near it.</summary>
        /// <param name="tolerance">Error that the shape may have: radians, or displacement over L.</param>
        /// <param name="maxIterations">Newton iterations, after which the search gives up.</param>
        public EquilibriumResult Solve(RodShape shape, double tolerance, int maxIterations)
        {
            EquilibriumResult result;
            string method;
            if (_terms.HavePotential)
            {
                method = "minimum of the energy";
                result = new RestSearch(_terms, _terms.All).Solve(shape, tolerance, maxIterations);
            }
            else if (_terms.Followers.Force.HasPotential && FindPlane(shape, out Vector3d normal))
            {
                method = "minimum of the energy in the plane of the loads, constrained to that plane";
                PlaneGuide guide = new PlaneGuide(_rod, normal, shape.X[0]);
                result = new RestSearch(_terms, _terms.With(guide)).Solve(shape, tolerance, maxIterations);
                if (result.Converged && !IsStableInSpace(shape))
                {
                    method += "; in space it is not stable";
                }
            }
            else
            {
                method = _terms.Followers.Force.HasPotential
                    ? "tipMoment has no potential in space: equilibrium found by motion with drag"
                    : "tipFollowerForce has no potential: equilibrium found by motion with drag";
                result = Creep(shape, tolerance, maxIterations);
            }
            result.Method = method;
            result.Residual = Residual(shape);
            if (result.Converged && !(result.Residual <= double.MaxValue))
            {
                result.Converged = false;
                result.Reason = "the forces on it are no finite numbers";
            }
            return result;
        }

        /// <summary>Minimises without what turns with the tip, then puts it on and creeps.</summary>
        private EquilibriumResult Creep(RodShape shape, double tolerance, int maxIterations)
        {
            EquilibriumResult first = new RestSearch(_terms, _terms.WithPotential()).Solve(
                shape, tolerance, maxIterations);
            if (!first.Converged)
            {
                return first;
            }
            EquilibriumResult result = new ViscousRelaxation(_rod, _supports, _terms.All, _terms.Followers).Solve(
                shape, tolerance, maxIterations);
            result.Iterations += first.Iterations;
            result.Factorisations += first.Factorisations;
            return result;
        }

        private bool IsStableInSpace(RodShape shape)
        {
            var tangent = new FollowerTangent(_rod, _supports, _terms.All, _terms.Followers);
            return new ViscousSpectrum(tangent, _rod).IsStable(shape);
        }

        /// <summary>Largest unbalanced force over EI/L^2 + the sum of the loads, or couple over that times L.</summary>
        private double Residual(RodShape shape)
        {
            var system = new BlockTridiagonal(_rod, _supports);
            var free = new RodVector[system.VectorCount];
            system.Gradient(_terms.All, shape, new RodVector[system.VectorCount], free);
            double loads = _rod.BendForce;
            foreach (Vector3d force in LoadGradient(shape))
            {
                loads += force.Length;
            }
            return RodVectors.Largest(free, _rod.TotalLength) / loads;
        }

        /// <summary>Minus the force of all loads on each node, N.</summary>
        private Vector3d[] LoadGradient(RodShape shape)
        {
            var gradient = new RodVector[shape.ElementCount + 2];
            _terms.AddLoadGradient(shape, gradient);
            var forces = new Vector3d[shape.ElementCount + 1];
            for (int i = 0; i < forces.Length; i++)
            {
                forces[i] = gradient[i].X;
            }
            return forces;
        }

        /// <summary>True where shape, rest shape and loads lie in one plane, across the couple.</summary>
        private bool FindPlane(RodShape shape, out Vector3d normal)
        {
            int n = _rod.ElementCount;
            normal = Vector3d.Normalize(Quaterniond.Rotate(shape.Q[n - 1], _terms.Followers.Moment.Moment));
            Vector3d start = shape.X[0];
            double length = _rod.TotalLength;
            bool flat = _supports.Distal == DistalEnd.Free
                && Math.Abs(Vector3d.Dot(shape.ProximalFrame.Director3, normal)) < PlaneTolerance;
            Vector3d[] forces = LoadGradient(shape);
            for (int i = 0; i <= n; i++)
            {
                Vector3d force = forces[i];
                flat &= Math.Abs(Vector3d.Dot(force, normal)) <= PlaneTolerance * force.Length;
                flat &= Math.Abs(Vector3d.Dot(shape.X[i] - start, normal)) < PlaneTolerance * length;
            }
            Vector3d across = Quaterniond.Rotate(shape.Q[0].Conjugate, normal);
            for (int j = 0; j < n; j++)
            {
                Vector3d axis = Quaterniond.Rotate(shape.Q[j].Conjugate, normal);
                Vector3d curvature = _rod.RestCurvature[j];
                flat &= Vector3d.Cross(axis, across).LengthSquared < PlaneTolerance;
                flat &= Vector3d.Cross(curvature, axis).Length <= PlaneTolerance * curvature.Length;
                // An uneven cross-section stays in the plane where it bends about one of its own axes.
                flat &= _rod.BendStiffness1[j] == _rod.BendStiffness2[j] || Math.Abs(axis.X * axis.Y) < PlaneTolerance;
            }
            return flat;
        }
    }

    /// <summary>Constrains a rod whose shape and loads lie in a plane to that plane, by springs as stiff as the rod
    /// against motion out of it. They have no effect on a plane shape: their value and gradient are 0 there.</summary>
    /// <remarks>A couple that turns with the tip has a potential only in a plane. Out of the plane the arc that it
    /// bends has no minimum of any energy from half a turn on (the second variation of a couple of this kind loses its
    /// sign at m L/EI = pi), though the arc is the rod's only equilibrium. So a plane problem is solved in its
    /// plane.</remarks>
    internal sealed class PlaneGuide : EnergyTerm
    {
        private readonly double[] _alongX;  // N/m, of node i
        private readonly double[] _alongT;  // N m, of element j
        private readonly Vector3d _normal;
        private readonly double _offset;    // of the plane from the origin, m

        /// <summary>The guide of the plane through <paramref name="point"/> across the unit vector
        /// <paramref name="normal"/>.</summary>
        public PlaneGuide(MaterialRod rod, in Vector3d normal, in Vector3d point)
        {
            int n = rod.ElementCount;
            _alongX = new double[n + 1];
            _alongT = new double[n];
            _normal = normal;
            _offset = Vector3d.Dot(normal, point);
            for (int j = 0; j < n; j++)
            {
                _alongX[j] = rod.ShearStiffness[j] / rod.Length[j];
                _alongX[j + 1] = _alongX[j];
                _alongT[j] = 2.0 * Math.Max(rod.BendStiffness1[j], rod.BendStiffness2[j]) / rod.Length[j];
            }
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            for (int i = 0; i < _alongX.Length; i++)
            {
                double out1 = Vector3d.Dot(_normal, shape.X[i]) - _offset;
                sum += 0.5 * _alongX[i] * out1 * out1;
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            for (int i = from; i < to; i++)
            {
                double force = _alongX[i] * (Vector3d.Dot(_normal, shape.X[i]) - _offset);
                gradient[i].AddX(force * _normal);
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            base.AddBlocks(shape, blocks, gradient, from, to);
            for (int i = from; i < to; i++)
            {
                ref RodBlock b = ref blocks[i];
                Vector3d e = _normal;
                double k = _alongX[i];
                b.A11 += k * e.X * e.X;
                b.A22 += k * e.Y * e.Y;
                b.A33 += k * e.Z * e.Z;
                b.A21 += k * e.X * e.Y;
                b.A31 += k * e.X * e.Z;
                b.A32 += k * e.Y * e.Z;
                if (i == _alongT.Length)
                {
                    continue;
                }
                e = Quaterniond.Rotate(shape.Q[i].Conjugate, _normal);
                k = _alongT[i];
                b.C11 += k * (1.0 - e.X * e.X);
                b.C22 += k * (1.0 - e.Y * e.Y);
                b.C33 += k * (1.0 - e.Z * e.Z);
                b.C21 -= k * e.X * e.Y;
                b.C31 -= k * e.X * e.Z;
                b.C32 -= k * e.Y * e.Z;
            }
        }
    }

    /// <summary>How a search for a rest shape ended.</summary>
    internal struct EquilibriumResult
    {
        /// <summary>True only where the forces balance to the tolerance and the shape is stable.</summary>
        public bool Converged;

        /// <summary>How the rest shape was found, in one line; null where that is not a choice.</summary>
        public string? Method;

        /// <summary>Why not, in one line; empty when converged.</summary>
        public string Reason;

        /// <summary>Newton iterations, all stages together.</summary>
        public int Iterations;

        /// <summary>Factorisations, among them those that a shift had to repeat.</summary>
        public int Factorisations;

        /// <summary>Largest unbalanced force over EI/L^2 + loads, or couple over that times L.</summary>
        public double Residual;

        /// <summary>Smallest eigenvalue of the second derivative against the metric (l on turns, l/L^2 on shifts), N:
        /// for a straight clamped-free rod EI (pi/(2 L))^2, the distance to its Euler load. Under a couple without
        /// potential the smallest real part of the tangent's.</summary>
        public double SmallestEigenvalue;
    }

    /// <summary>Finds a rest shape: a stable minimum of the sum of energy terms.</summary>
    /// <remarks>Newton's method finds a shape without unbalanced forces. It is at rest where the second derivative has
    /// no negative eigenvalue but those of neutral motions. At a saddle (a straight rod under a thrust along its axis)
    /// the search leaves along the direction of most negative curvature and goes on. A shape that may turn without any
    /// change of energy (a buckled rod about its thrust) has an eigenvalue 0, which rounding makes one of either sign:
    /// <see cref="EquilibriumStability"/> examines each above -1e-4 EI/L^2 of the stiffest element. Every direction is
    /// found with 1e-6 EI/L^2 added, and with no more than 0.01 EI/L^2 of the softest element, which would hold
    /// that.</remarks>
    internal sealed class RestSearch
    {
        private const double Neutral = 1.01e-4;          // of EI/L^2: eigenvalues above its negative may be 0
        private const double Regularisation = 1e-6;      // of EI/L^2, on every direction
        private const double MaxRegularisation = 0.01;  // of the softest element's EI/L^2
        private const int MaxSaddles = 100;

        private const string Saddle = "no descent direction at a saddle of the energy; a small gravity or tipForce "
            + "across the wire provides one";

        private readonly EnergyTerm[] _terms;
        private readonly Newton _newton;
        private readonly EquilibriumStability _stability;

        /// <summary>Makes a search under these terms.</summary>
        /// <param name="rodTerms">Those of the rod.</param>
        /// <param name="terms">Those whose sum is minimised.</param>
        public RestSearch(RodTerms rodTerms, EnergyTerm[] terms)
        {
            MaterialRod rod = rodTerms.Rod;
            _terms = terms;
            double length = rod.TotalLength;
            double neutral = Neutral * rod.BendForce;
            _newton = new Newton(rodTerms, terms)
            {
                JudgesStep = true,
                Regularisation = (Math.Min(Regularisation * rod.BendForce,
                    MaxRegularisation * rod.SoftestStiffness / (length * length)), neutral),
            };
            _stability = new EquilibriumStability(rod, rodTerms.Supports, terms, _newton.System, neutral);
        }

        /// <summary>Moves <paramref name="shape"/> to a rest shape near it.</summary>
        /// <param name="tolerance">Error that it may have: radians, or displacement over L.</param>
        /// <param name="maxIterations">Newton iterations, after which the search gives up.</param>
        public EquilibriumResult Solve(RodShape shape, double tolerance, int maxIterations)
        {
            EquilibriumResult result = default;
            _newton.Tolerance = tolerance;
            string? failure = null;
            for (int k = 0; failure == null && !result.Converged; k++)
            {
                _newton.MaxIterations = maxIterations - (int)_newton.Iterations;
                failure = k == MaxSaddles ? Saddle
                    : _newton.Minimise(shape, double.PositiveInfinity, 0.0, isSearched: true);
                result.Converged = failure == null && IsAtRest(shape, ref failure);
            }
            if (result.Converged)
            {
                _stability.LowestMode(shape, out result.SmallestEigenvalue);
            }
            result.Reason = failure ?? string.Empty;
            result.Iterations = (int)_newton.Iterations;
            result.Factorisations = (int)_newton.Factorisations;
            return result;
        }

        // Where it is not, the shape is moved to where the energy is lower; at a saddle without such a direction the
        // search has failed.
        private bool IsAtRest(RodShape shape, ref string? failure)
        {
            EnergySum.Anchor(_terms, shape);
            if (_stability.IsStable(shape))
            {
                return true;
            }
            // A negative eigenvalue within rounding of 0 along which the energy falls neither way is 0: such as that of
            // a localised helix that moves along the rod.
            RodVector[]? undecided = _stability.Undecided;
            if (undecided != null)
            {
                Array.Copy(undecided, _newton.Direction, undecided.Length);
                return !DescendAlong(shape, 1.0) && !DescendAlong(shape, -1.0);
            }
            Array.Copy(_stability.LowestMode(shape, out _), _newton.Direction, _newton.System.VectorCount);
            double sign = _newton.Slope > 0.0 ? -1.0 : 1.0;
            failure = DescendAlong(shape, sign) ? null : Saddle;
            return false;
        }

        // Goes along the direction, or against it, to where the energy is lower; false where it falls nowhere.
        private bool DescendAlong(RodShape shape, double sign)
        {
            double size = _newton.Size(out _);
            double start = EnergySum.Value(_terms, shape, out double magnitude);
            double largest = 0.3 * EnergySum.MaxStep(_terms, shape, _newton.Direction, sign * 0.3 / size);
            for (double turn = largest; turn > 1e-6; turn *= 0.5)
            {
                _newton.Apply(shape, sign * turn / size, _newton.Trial);
                if (EnergySum.Value(_terms, _newton.Trial, out _) < start - 1e-14 * magnitude)
                {
                    shape.CopyFrom(_newton.Trial);
                    return true;
                }
            }
            return false;
        }
    }
}
