namespace Guidewire.Core
{
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
}
