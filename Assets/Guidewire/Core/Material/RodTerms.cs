using System;

namespace Guidewire.Core
{
    /// <summary>The list of all energy terms of a material rod, elastic and of loads. Rest shapes, motions, explicit
    /// forces, energies and reactions all use it.</summary>
    /// <remarks>A new load or a new kind of energy is a class of its own and one entry in the list. Elastic terms store
    /// energy, 0 or more, in the wire; loads act on it from outside. The compliant solver has constraints instead of
    /// stretch and bending, and takes the loads from here.</remarks>
    internal sealed class RodTerms
    {
        private readonly EnergyTerm[] _elastic;
        private readonly EnergyTerm[] _loads;
        private readonly RodVector[] _endGradient;
        private readonly Joint[] _joints;

        /// <summary>The terms of a rod on which nothing acts yet.</summary>
        public RodTerms(MaterialRod rod, RodSupports supports)
            : this(rod, supports, new SceneParameters())
        {
        }

        /// <summary>Makes the terms of a rod in a scene.</summary>
        /// <param name="scene">What acts on it; loads that change in time come with <see cref="SetTime"/>.</param>
        /// <param name="others">Loads besides those of the scene.</param>
        public RodTerms(MaterialRod rod, RodSupports supports, SceneParameters scene, params EnergyTerm[] others)
            : this(rod, supports, scene, null, others)
        {
        }

        /// <summary>The terms of a rod in a scene with walls.</summary>
        /// <param name="contact">What they add, or null.</param>
        public RodTerms(MaterialRod rod, RodSupports supports, SceneParameters scene, ContactTerms? contact,
            EnergyTerm[] others)
        {
            Rod = rod;
            Supports = supports;
            Mass = new RodMass(rod, supports.Mass);
            Stretch = new StretchEnergy(rod);
            CoaxialBending = supports.InnerCount > 0 ? new CoaxialBendTwist(supports.Coaxial!) : null;
            _joints = rod.Joints(supports);
            Bending = CoaxialBending ?? BendTwistTerm.Create(_joints, supports);
            Fibres = Bending.Fibres = FibreBending.Create(rod, supports, Bending);
            Release = supports.Coaxial == null ? null
                : new Release(supports.Coaxial, Bending, CoaxialBending, Stretch);
            Loads = new DeadLoads(Mass, rod.Length);
            Followers = new TipFollowers(rod, scene);
            _elastic = new EnergyTerm[]
            {
                Stretch,
                Bending,
            };
            if (supports.Winds)
            {
                _elastic = Joined(_elastic, new EnergyTerm[]
                {
                    new SheathEnergy(supports.Coaxial!, (BendTwistEnergy<RotationVectorLaw>)Bending),
                });
            }
            _elastic = Fibres == null ? _elastic : Joined(_elastic, new EnergyTerm[] { Fibres });
            _loads = Joined(new EnergyTerm[]
            {
                Loads,
                Followers.Moment,
                Followers.Force,
            }, others);
            Contact = contact;
            All = Joined(_elastic, _loads);
            All = contact == null ? All : Joined(All, contact.All);
            _endGradient = new RodVector[VectorCapacity];
        }

        /// <summary>The rod has other elements, and the terms are as they are made.</summary>
        public void Remesh()
        {
            Mass.Remesh();
            Rod.SetJoints(Supports, _joints);
            foreach (EnergyTerm term in All)
            {
                term.Remesh();
            }
        }

        /// <summary>The rod.</summary>
        public MaterialRod Rod { get; }

        /// <summary>Of all elements and, with instruments inside, of theirs, N m^2.</summary>
        public double SoftestStiffness => Supports.Coaxial?.SoftestStiffness ?? Rod.SoftestStiffness;

        /// <summary>How it is held.</summary>
        public RodSupports Supports { get; }

        /// <summary>How its mass is distributed.</summary>
        public RodMass Mass { get; }

        /// <summary>Stretch and shear.</summary>
        public StretchEnergy Stretch { get; }

        /// <summary>Bending and twist.</summary>
        public BendTwistTerm Bending { get; }

        /// <summary>What fibres that yield or give way add to it; null of a linear wire.</summary>
        public FibreBending? Fibres { get; }

        /// <summary>The same of several instruments; null of one alone.</summary>
        public CoaxialBendTwist? CoaxialBending { get; }

        /// <summary>The loads on coaxial instruments; null where those on the chain are set by hand.</summary>
        public CoaxialLoads? CoaxialLoads { get; set; }

        /// <summary>What drives instruments out of one another and out of a sheath; null of a wire alone.</summary>
        public Release? Release { get; }

        /// <summary>Weight and forces on the nodes.</summary>
        public DeadLoads Loads { get; }

        /// <summary>Couple and force at the tip that turn with it.</summary>
        public TipFollowers Followers { get; }

        /// <summary>Contact with walls; null in a scene without.</summary>
        public ContactTerms? Contact { get; }

        /// <summary>Every term.</summary>
        public EnergyTerm[] All { get; }

        /// <summary>Length of a gradient: n + 2, n + 1 where there are twist angles, and what a vessel adds.</summary>
        public int VectorCount => (Supports.InnerCount == 0 ? 1 : 2) * (Rod.ElementCount + 1) + 1 + VesselCount;

        /// <summary>Splines of a vessel that gives way as a beam.</summary>
        public int VesselCount => Contact?.VesselCount ?? 0;

        /// <summary>The same of the most elements that the rod may have.</summary>
        public int VectorCapacity => (Supports.InnerCount == 0 ? 1 : 2) * (Rod.Capacity + 1) + 1 + VesselCount;

        /// <summary>Whether every term is a true energy, so that rest shapes are its minima.</summary>
        public bool HavePotential => Array.TrueForAll(All, term => term.HasPotential);

        /// <summary>The terms that are true energies.</summary>
        public EnergyTerm[] WithPotential() => Array.FindAll(All, term => term.HasPotential);

        /// <summary>Gives every term and these.</summary>
        public EnergyTerm[] With(params EnergyTerm[] more) => Joined(All, more);

        /// <summary>Sets all that is prescribed at this time.</summary>
        public void SetTime(RodSchedule schedule, double time)
        {
            Followers.SetTime(time);
            foreach (EnergyTerm term in All)
            {
                term.SetTime(time);
            }
            if (CoaxialLoads == null)
            {
                Loads.Set(schedule, time);
                return;
            }
            CoaxialLoads.Set(Loads.Force, time);
        }

        /// <summary>Adds the gradient of all terms.</summary>
        public void AddGradient(RodShape shape, RodVector[] gradient) => AddGradient(All, shape, gradient);

        /// <summary>Adds the gradient of the loads: minus the forces and couples that act from outside.</summary>
        public void AddLoadGradient(RodShape shape, RodVector[] gradient) => AddGradient(_loads, shape, gradient);

        /// <summary>Gives the energy stored in the wire, J.</summary>
        public double ElasticEnergy(RodShape shape)
        {
            double sum = 0.0;
            foreach (EnergyTerm term in _elastic)
            {
                sum += term.Value(shape);
            }
            return sum;
        }

        /// <summary>Energy stored in the wire and in its contacts with walls, J.</summary>
        public double StoredEnergy(RodShape shape) =>
            ElasticEnergy(shape) + (Contact == null ? 0.0 : Contact.StoredEnergy(shape)) + FrictionStored;

        /// <summary>Energy stored in the wire less the work of the loads that have a potential, J.</summary>
        public double Potential(RodShape shape) => PotentialFrom(0, shape);

        /// <summary>The same without what the wire stores: of loads and contacts, J.</summary>
        public double LoadPotential(RodShape shape) => PotentialFrom(_elastic.Length, shape);

        private double PotentialFrom(int first, RodShape shape)
        {
            double sum = 0.0;
            for (int k = first; k < All.Length; k++)
            {
                sum += All[k].HasPotential && All[k].StoresEnergy ? All[k].Stored(shape) : 0.0;
            }
            return sum + FrictionStored;
        }

        /// <summary>Work of the loads, as they are now, on a wire that goes from one shape to another, J.</summary>
        public double LoadWork(RodShape from, RodShape to)
        {
            double sum = 0.0;
            foreach (EnergyTerm term in _loads)
            {
                term.Anchor(from);
                sum += term.Value(from) - term.Value(to);
            }
            return sum;
        }

        /// <summary>Force of the hub on the wire along its axis between walls, N: the slope of the energy in the hub's
        /// place.</summary>
        public double HubForce(RodShape shape)
        {
            double held = Contact == null ? 0.0 : Vector3d.Dot(Contact.SupportForce(shape), HubAxis(shape));
            return held + SheathForce(shape);
        }

        /// <summary>What of that is not on node 0, N: the force by which a sheath holds back a bent rod; 0 without
        /// one.</summary>
        public double SheathForce(RodShape shape) => Release?.SheathForce(shape) ?? 0.0;

        /// <summary>Gives the hub's axis, a unit vector.</summary>
        public Vector3d HubAxis(RodShape shape) =>
            Supports.HasProximalJoint ? shape.ProximalFrame.Director3 : shape.Q[0].Director3;

        /// <summary>Gradient of the elastic energy at node 0 or n, N: minus the force of the wire on it.</summary>
        public Vector3d EndGradient(RodShape shape, int node)
        {
            int from = Math.Max(node - 1, 0);
            Array.Clear(_endGradient, from, Math.Min(3, VectorCount - from));
            var measured = default(GradientMeasures);
            foreach (EnergyTerm term in _elastic)
            {
                term.AddGradient(shape, _endGradient, from, node + 1, ref measured);
            }
            return _endGradient[node].X;
        }

        /// <summary>Writes or restores the state of the terms between steps.</summary>
        public void Serialize(Snapshot snapshot)
        {
            foreach (EnergyTerm term in All)
            {
                if (term != Fibres || snapshot.IsStep)
                {
                    term.Serialize(snapshot);
                }
            }
            if (!snapshot.IsStep)
            {
                snapshot.OptionalSection(Fibres == null ? "fibres" : Fibres.StateCount + " fibres",
                    Fibres == null ? null : Fibres.Serialize);
            }
            Contact?.Serialize(snapshot);
        }

        private double FrictionStored => Contact == null ? 0.0 : Contact.FrictionStored;

        private static void AddGradient(EnergyTerm[] terms, RodShape shape, RodVector[] gradient)
        {
            foreach (EnergyTerm term in terms)
            {
                term.AddGradient(shape, gradient);
            }
        }

        private static EnergyTerm[] Joined(EnergyTerm[] first, EnergyTerm[] second)
        {
            var joined = new EnergyTerm[first.Length + second.Length];
            first.CopyTo(joined, 0);
            second.CopyTo(joined, first.Length);
            return joined;
        }
    }

    /// <summary>Contact as part of a rod's energy, for methods that treat walls in that way.</summary>
    internal abstract class ContactTerms
    {
        /// <summary>The terms that act.</summary>
        public abstract EnergyTerm[] All { get; }

        /// <summary>Splines of a vessel that gives way as a beam; 0 where it does not.</summary>
        public virtual int VesselCount => 0;

        /// <summary>Gives the energy stored in the contacts' normal forces and in the vessel, J.</summary>
        public abstract double StoredEnergy(RodShape shape);

        /// <summary>Energy stored in the elastic displacements of sticking contacts, J.</summary>
        public abstract double FrictionStored { get; }

        /// <summary>Gives the force of the support on node 0, N.</summary>
        public abstract Vector3d SupportForce(RodShape shape);

        /// <summary>Adds minus the force of friction on the nodes.</summary>
        public virtual void AddFriction(RodShape shape, RodVector[] gradient)
        {
        }

        /// <summary>Writes or restores what contacts keep from step to step.</summary>
        public abstract void Serialize(Snapshot snapshot);
    }
}
