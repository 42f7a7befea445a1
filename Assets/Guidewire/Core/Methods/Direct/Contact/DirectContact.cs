namespace Guidewire.Core
{
    /// <summary>Contact of the direct solver, as a term of the rod's energy.</summary>
    internal static class DirectContact
    {
        /// <summary>What walls add to the energy; null without walls. Only the direct solver adds such terms.</summary>
        public static WallTerms? Walls(this RodTerms terms) => (WallTerms?)terms.Contact;
    }
}
