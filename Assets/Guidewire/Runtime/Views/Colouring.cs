namespace Guidewire.Runtime
{
    /// <summary>What the wire's colour shows.</summary>
    public enum Colouring
    {
        /// <summary>Nothing.</summary>
        Plain,

        /// <summary>Length of an element over its rest length, less 1.</summary>
        Stretch,

        /// <summary>Curvature in 1/unit.</summary>
        Bending,

        /// <summary>Twist in rad/unit.</summary>
        Twist,
    }
}
