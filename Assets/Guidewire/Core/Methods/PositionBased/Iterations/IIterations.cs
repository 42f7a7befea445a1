namespace Guidewire.Core
{
    /// <summary>The iterations of position-and-orientation-based dynamics.</summary>
    internal interface IIterations
    {
        /// <summary>Does iterations, each all stretch constraints, then all bend-twist constraints, then all
        /// contacts.</summary>
        /// <param name="x">n + 1 positions in units, corrected in place.</param>
        /// <param name="q">n orientations, corrected in place and of unit length again.</param>
        /// <param name="iterations">How many, 0 or more.</param>
        /// <param name="contacts">Contacts, or null where there are none.</param>
        /// <returns>False, with nothing done, where these iterations cannot take these contacts.</returns>
        bool Iterate(Vector3d[] x, Quaterniond[] q, int iterations, IContactResponse? contacts);

        /// <summary>Says about how long so many iterations take, counted in elements of a scalar iteration.</summary>
        double Cost(int iterations);
    }
}
