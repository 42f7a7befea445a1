#if NET8_0_OR_GREATER
namespace Guidewire.Core
{
    /// <summary>A test by which a search leaves out children of a <see cref="WideBvh"/>, four at a time.</summary>
    internal interface IBoundsTest
    {
        /// <summary>Which of four children may hold what is sought, one bit each.</summary>
        /// <param name="bounds">The first of the numbers of their common node: centre, extent, normal, low, high, of
        /// each four.</param>
        uint MayHold(ref double bounds);
    }
}
#endif
