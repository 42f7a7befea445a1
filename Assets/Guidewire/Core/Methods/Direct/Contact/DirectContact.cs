namespace Guidewire.Core
{
    /// <summary>The direct solver's contact among a rod's terms.</summary>
    internal static class DirectContact
    {
        /// <summary>What walls add to the energy; null without walls. Only the direct solver adds such terms.</summary>
        public static WallTerms? Walls(this RodTerms terms)
        {
            return (WallTerms?)terms.Contact;
        }
    }
}
