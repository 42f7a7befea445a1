namespace Guidewire.Runtime
{
    /// <summary>What the wire's colour shows.</summary>
    public enum Colouring
    {
        /// <summary>The colour shows nothing.</summary>
        Plain,

        /// <summary>Length of an element over its rest length, less 1.</summary>
        Stretch,

        /// <summary>The colour shows curvature in 1/unit.</summary>
        Bending,

        /// <summary>The colour shows twist in rad/unit.</summary>
        Twist,
    }
}
