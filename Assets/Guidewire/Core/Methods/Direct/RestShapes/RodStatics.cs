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
}
