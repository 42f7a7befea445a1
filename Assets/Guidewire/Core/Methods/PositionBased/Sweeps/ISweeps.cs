namespace Guidewire.Core
{
    /// <summary>The sweeps over a wire's own constraints; contacts are not among them.</summary>
    internal interface ISweeps
    {
        /// <summary>Does iterations, each all stretch constraints, then all bend-twist constraints.</summary>
        /// <param name="x">n + 1 positions in units, corrected in place.</param>
        /// <param name="q">n orientations, corrected in place and of unit length again.</param>
        /// <param name="iterations">How many, 0 or more.</param>
        void Iterate(Vector3d[] x, Quaterniond[] q, int iterations);

        /// <summary>About how long so many iterations take, counted in elements of a scalar sweep.</summary>
        double Cost(int iterations);
    }
}
