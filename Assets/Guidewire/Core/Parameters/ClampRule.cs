namespace Guidewire.Core
{
    /// <summary>Length of rod that the spring between a clamp's frame and the first element represents.</summary>
    public enum ClampRule
    {
        /// <summary>Gregory's end weights 3/8, 7/6 and 23/24 of an element for the clamp's spring and the next two
        /// joints: static compliance of fourth order.</summary>
        /// <remarks>A thrust stays of second order, with these weights as with others: the chain itself bends in waves
        /// of k under P = EI 2 (1 - cos k l)/l^2 = EI k^2 (1 - (k l)^2/12 + ..). Clamped at both ends, k = 2 pi/L, it
        /// buckles (2 pi/n)^2/12 too early (0.82 % at n = 20, 0.21 % at n = 40), and holds as much less thrust when
        /// shortened. A correction would tie each joint's stiffness to the thrust beside it, and so positions two
        /// elements apart, which the block-tridiagonal matrix cannot hold.</remarks>
        FourthOrder,

        /// <summary>Half an element, the trapezoidal rule: second order; a circular arc comes out exact.</summary>
        HalfElement,

        /// <summary>A whole element: a hinge of the chain at the clamp, first order. To tell errors of the chain from
        /// errors of a solver: the tip's compliance is n (n + 1)(2n + 1)/(2 n^3) times that of the beam.</summary>
        WholeElement,
    }
}
