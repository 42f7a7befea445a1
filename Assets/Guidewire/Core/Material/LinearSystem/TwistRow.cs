namespace Guidewire.Core
{
    /// <summary>The second derivatives by one twist angle z_j of an instrument inside others, and what the elimination
    /// makes of them. z_j meets the rotations theta_j and theta_(j+1), its own neighbours, and no position.</summary>
    internal struct TwistRow
    {
        /// <summary>(z_j, z_j), N m.</summary>
        public double Diagonal;

        /// <summary>(z_(j+1), z_j), N m; as eliminated, what is left of it.</summary>
        public double NextTwist;

        /// <summary>Of the first of two angles that an element has: (z'_j, z_j), z' the second one's, N m.</summary>
        public double Other;

        /// <summary>(z'_(j+1), z_j) with z' the other one of two angles, N m; as eliminated, what is left of
        /// it.</summary>
        public double NextOther;

        /// <summary>(theta_j, z_j), N m.</summary>
        public Vector3d Turn;

        /// <summary>(theta_(j+1), z_j), N m.</summary>
        public Vector3d NextTurn;

        /// <summary>(theta_j, z_(j+1)), N m.</summary>
        public Vector3d TurnOfNext;

        /// <summary>The column of z_j in block j: at first what earlier blocks leave there, as eliminated D^-1 L^-1 of
        /// it all.</summary>
        public RodVector Own;

        /// <summary>D times that.</summary>
        public RodVector WeightedOwn;

        /// <summary>The column of z_(j+1) in block j, D^-1 L^-1 of it.</summary>
        public RodVector Next;

        /// <summary>D times that.</summary>
        public RodVector WeightedNext;

        /// <summary>The column of z_j in block j + 1.</summary>
        public RodVector Below;

        /// <summary>One over the pivot, 1/(N m).</summary>
        public double Inverse;

        /// <summary>Adds the second derivatives of another.</summary>
        public void Add(in TwistRow other)
        {
            Diagonal += other.Diagonal;
            NextTwist += other.NextTwist;
            Other += other.Other;
            NextOther += other.NextOther;
            Turn += other.Turn;
            NextTurn += other.NextTurn;
            TurnOfNext += other.TurnOfNext;
        }
    }
}
