namespace Guidewire.Core
{
    /// <summary>Constitutive law of a joint between two frames a and b: its couple as a function of their relative
    /// rotation r = conj(q_a) q_b. Implemented by structs and used as a type argument, so that loops over joints have
    /// no virtual calls.</summary>
    internal interface IJointLaw
    {
        /// <summary>The turn from a to b at which the joint is free of couples.</summary>
        Quaterniond AtRest(in Joint joint);

        /// <summary>The turn to which the couple is proportional.</summary>
        Vector3d Measure(in Quaterniond relative);

        /// <summary>How fast that grows where the frames turn at these rates along their own axes, rad/s.</summary>
        Vector3d Rate(in Quaterniond relative, in Vector3d before, in Vector3d after);

        /// <summary>Gives the energy, J.</summary>
        double Value(in Joint joint, in Quaterniond relative);

        /// <summary>Adds the couples, N m, along the axes of a and of b (derivatives by their body-frame
        /// turns).</summary>
        void AddGradient(in Joint joint, in Quaterniond relative, ref RodVector a, ref RodVector b);

        /// <summary>Adds couples and second derivatives: C of a and of b, F of a.</summary>
        void AddBlocks(in Joint joint, in Quaterniond relative, ref RodVector a, ref RodVector b, ref RodBlock blockA,
            ref RodBlock blockB);
    }
}
