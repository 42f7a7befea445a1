#if NET8_0_OR_GREATER
namespace Guidewire.Core
{
    /// <summary>A test by which a search leaves out children of a <see cref="WideBvh"/>, eight at a time.</summary>
    internal interface IBoundsTest
    {
        /// <summary>Which of eight children may hold what is sought, one bit each.</summary>
        /// <param name="bounds">The first of the numbers of their common node: centre, extent, normal, low, high, of
        /// each eight.</param>
        uint MayHold(ref float bounds);
    }
}
#endif
