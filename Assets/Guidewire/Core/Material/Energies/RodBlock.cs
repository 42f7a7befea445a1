using System.Runtime.InteropServices;

namespace Guidewire.Core
{
    /// <summary>What one node and the element after it hold of a symmetric matrix over (x_0, theta_0, x_1, theta_1,
    /// ...): 48 numbers, six lines of cache, each 3x3 block contiguous by rows.</summary>
    /// <remarks>A = (x, x), B = (theta, x), C = (theta, theta), and against the next node
    /// D = (x+, x), E = (x+, theta), F = (theta+, theta). Row index first; of A and C the lower triangle. The pair
    /// (theta+, x) does not occur: a node's position acts on the elements at its two sides only.</remarks>
    [StructLayout(LayoutKind.Sequential)]
    internal struct RodBlock
    {
        public double A11, A21, A22, A31, A32, A33;
        public double B11, B12, B13, B21, B22, B23, B31, B32, B33;
        public double C11, C21, C22, C31, C32, C33;
        public double D11, D12, D13, D21, D22, D23, D31, D32, D33;
        public double E11, E12, E13, E21, E22, E23, E31, E32, E33;
        public double F11, F12, F13, F21, F22, F23, F31, F32, F33;
    }
}
