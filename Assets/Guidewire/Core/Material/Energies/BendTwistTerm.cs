namespace Guidewire.Core
{
    /// <summary>Bending and twist, whatever the joints' law, with the couples that its clamps exert.</summary>
    internal abstract class BendTwistTerm : EnergyTerm
    {
        /// <summary>What the fibres of the wire add; null where it is linear.</summary>
        public FibreBending? Fibres { get; set; }

        /// <summary>Turns the elements, from the proximal clamp on (without one from the first element), so that no
        /// joint but that of a distal clamp exerts a couple.</summary>
        /// <returns>False where they are so already because no joint is turned at rest.</returns>
        public abstract bool RelaxTurns(RodShape shape);

        /// <summary>Turn of each of the n+1 joints as their law measures it, to which the couple is proportional; 0
        /// where an end has no joint.</summary>
        public abstract void Measure(RodShape shape, Vector3d[] turns);

        /// <summary>Gives the same for joint k alone.</summary>
        public abstract Vector3d TurnOf(RodShape shape, int k);

        /// <summary>A joint in a shape: its law, its turn and, of several instruments, their angles.</summary>
        public abstract void Evaluate(RodShape shape, int k, out CoaxialJointState s);

        /// <summary>Couple that the piece after each of the n+1 joints exerts on the piece before it, N m, along the
        /// world's axes; 0 where an end has no joint.</summary>
        public abstract void Couples(RodShape shape, Vector3d[] couples);

        /// <summary>Gives the term of these n+1 joints under the supports' law.</summary>
        public static BendTwistTerm Create(Joint[] joints, RodSupports supports)
        {
            if (supports.Bend == BendLaw.Darboux)
            {
                return new BendTwistEnergy<DarbouxLaw>(joints, supports.HasProximalJoint, supports.HasDistalJoint);
            }
            return new BendTwistEnergy<RotationVectorLaw>(joints, supports.HasProximalJoint, supports.HasDistalJoint,
                supports.Winds);
        }

        /// <summary>A step begins at a time, s, from which on hubs inside slide.</summary>
        public virtual void BeginSlide(double time)
        {
        }

        /// <summary>How fast the turns of <see cref="Measure"/> grow, rad/s.</summary>
        /// <param name="spins">Of the elements along their own axes, rad/s.</param>
        /// <param name="proximal">Spin of the proximal frame along its own axes.</param>
        /// <param name="distal">Spin of the distal one.</param>
        /// <param name="rates">Receives n+1 rates; 0 where an end has no joint.</param>
        public abstract void MeasureRates(RodShape shape, Vector3d[] spins, in Vector3d proximal, in Vector3d distal,
            Vector3d[] rates);

        /// <summary>Gives the torque of a hub on its instrument, N m: dE/dturn of that hub.</summary>
        /// <param name="instrument">0 the outermost one.</param>
        public abstract double TurnCouple(RodShape shape, int instrument = 0);

        /// <summary>Couple of the proximal clamp on the rod, N m, along the world's axes; 0 without a clamp.</summary>
        public abstract Vector3d ProximalCouple(RodShape shape);

        /// <summary>Couple of the distal clamp on the rod, N m, along the world's axes; 0 without a clamp.</summary>
        public abstract Vector3d DistalCouple(RodShape shape);
    }
}
