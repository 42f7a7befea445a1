namespace Guidewire.Core
{
    /// <summary>How long a piece of rod the spring between a clamp's frame and the first element stands for.</summary>
    public enum ClampRule
    {
        /// <summary>Gregory's end weights 3/8, 7/6 and 23/24 of an element for the clamp's spring and the next two
        /// joints: static compliance of fourth order.</summary>
        FourthOrder,

        /// <summary>Half an element, the trapezoidal rule: second order; a circular arc comes out exact.</summary>
        HalfElement,

        /// <summary>A whole element: a hinge of the chain at the clamp, first order. To tell errors of the chain from
        /// errors of a solver: the tip's compliance is n (n + 1)(2n + 1)/(2 n^3) times that of the beam.</summary>
        WholeElement,
    }
}
