using System;

namespace Guidewire.Core
{
    /// <summary>A material rod at rest: between its supports, under dead loads and a couple at the tip. Chooses the
    /// way to the rest shape: minimisation where the loads have a potential (all but a couple in space), a
    /// minimisation kept in the plane for a couple in a plane problem, else minimisation without the couple and then
    /// creeping under it.</summary>
    internal sealed class RodStatics
    {
        private const double PlaneTolerance = 1e-12;

        private readonly MaterialRod _rod;
        private readonly RodSupports _supports;
        private readonly EnergyTerm[] _terms;

        /// <summary>A rod without loads.</summary>
        public RodStatics(MaterialRod rod, RodSupports supports)
        {
            _rod = rod;
            _supports = supports;
            Stretch = new StretchEnergy(rod);
            Bending = CreateBending(rod, supports);
            Loads = new DeadLoads(rod.ElementCount);
            Moment = new TipMoment();
            _terms = new EnergyTerm[] { Stretch, Bending, Loads };
        }

        /// <summary>The stretch energy, for stresses and reactions.</summary>
        public StretchEnergy Stretch { get; }

        /// <summary>The bending energy.</summary>
        public BendTwistTerm Bending { get; }

        /// <summary>Forces on the nodes.</summary>
        public DeadLoads Loads { get; }

        /// <summary>The couple on the last element, along its own axes.</summary>
        public TipMoment Moment { get; }

        /// <summary>How the last rest shape was found, in one line.</summary>
        public string Method { get; private set; } = "";

        /// <summary>The bending energy of a rod for the law that its supports name.</summary>
        public static BendTwistTerm CreateBending(MaterialRod rod, RodSupports supports)
        {
            Joint[] joints = rod.Joints(supports);
            if (supports.Bend == BendLaw.Darboux)
            {
                return new BendTwistEnergy<DarbouxLaw>(joints, supports.HasProximalJoint, supports.HasDistalJoint);
            }
            return new BendTwistEnergy<RotationVectorLaw>(joints, supports.HasProximalJoint, supports.HasDistalJoint);
        }

        /// <summary>Moves <paramref name="shape"/> to a rest shape near it.</summary>
        /// <param name="tolerance">On the last Newton step, radians or displacement over L.</param>
        /// <param name="mostIterations">Newton iterations, after which the search gives up.</param>
        public EquilibriumResult Solve(RodShape shape, double tolerance, int mostIterations)
        {
            EquilibriumResult result;
            if (Moment.Moment == Vector3d.Zero)
            {
                Method = "minimum of the energy";
                result = new EquilibriumSolver(_rod, _supports, _terms).Solve(shape, tolerance, mostIterations);
            }
            else if (FindPlane(shape, out Vector3d normal))
            {
                Method = "minimum of the energy in the plane of the loads, kept to that plane";
                PlaneGuide guide = new PlaneGuide(_rod, normal, shape.X[0]);
                EnergyTerm[] inPlane = { Stretch, Bending, Loads, Moment, guide };
                result = new EquilibriumSolver(_rod, _supports, inPlane).Solve(shape, tolerance, mostIterations);
                if (result.Converged && !IsStableInSpace(shape))
                {
                    Method += "; free to leave it, the wire would not stay";
                }
            }
            else
            {
                Method = "tipMoment has no potential in space: where a wire with drag comes to rest";
                result = Creep(shape, tolerance, mostIterations);
            }
            result.Residual = Residual(shape);
            return result;
        }

        /// <summary>Minimises without the couple, then puts it on and creeps.</summary>
        private EquilibriumResult Creep(RodShape shape, double tolerance, int mostIterations)
        {
            EquilibriumResult first = new EquilibriumSolver(_rod, _supports, _terms).Solve(
                shape, tolerance, mostIterations, false);
            if (!first.Converged)
            {
                return first;
            }
            EquilibriumResult result = new DragFlow(_rod, _supports, AllTerms(), Moment).Solve(
                shape, tolerance, mostIterations);
            result.Iterations += first.Iterations;
            result.Factorisations += first.Factorisations;
            return result;
        }

        private bool IsStableInSpace(RodShape shape)
        {
            var tangent = new FollowerTangent(_rod, _supports, AllTerms(), Moment);
            return new DragSpectrum(tangent, _rod).IsStable(shape);
        }

        private EnergyTerm[] AllTerms()
        {
            return new EnergyTerm[] { Stretch, Bending, Loads, Moment };
        }

        /// <summary>Largest unbalanced force over EI/L^2 + the sum of the loads, or couple over that times L.</summary>
        private double Residual(RodShape shape)
        {
            var system = new BlockTridiagonal(_rod, _supports);
            var free = new RodVector[system.VectorCount];
            system.Gradient(AllTerms(), shape, new RodVector[system.VectorCount], free);
            double loads = _rod.BendForce;
            foreach (Vector3d force in Loads.Force)
            {
                loads += force.Length;
            }
            return RodVectors.Largest(free, _rod.TotalLength) / loads;
        }

        /// <summary>The terms of a motion: all that stores energy or does work, and the inertia.</summary>
        public EnergyTerm[] DynamicTerms(EnergyTerm inertia)
        {
            return Moment.Moment == Vector3d.Zero
                ? new EnergyTerm[] { Stretch, Bending, Loads, inertia }
                : new EnergyTerm[] { Stretch, Bending, Loads, Moment, inertia };
        }

        /// <summary>True where shape, rest shape and loads lie in one plane, across the couple.</summary>
        private bool FindPlane(RodShape shape, out Vector3d normal)
        {
            int n = _rod.ElementCount;
            normal = Vector3d.Normalize(Quaterniond.Rotate(shape.Q[n - 1], Moment.Moment));
            Vector3d start = shape.X[0];
            double length = _rod.TotalLength;
            bool flat = _supports.Distal == DistalEnd.Free
                && Math.Abs(Vector3d.Dot(shape.ProximalFrame.Director3, normal)) < PlaneTolerance;
            for (int i = 0; i <= n; i++)
            {
                Vector3d force = Loads.Force[i];
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
            }
            return flat;
        }
    }
}
