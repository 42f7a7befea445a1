using System.Runtime.InteropServices;

namespace Guidewire.Core
{
    /// <summary>The block of one node and the element after it in a symmetric matrix over (x_0, theta_0, x_1, theta_1,
    /// ...): 48 numbers, six lines of cache, column by column of the matrix from its diagonal down.</summary>
    /// <remarks>A = (x, x), B = (theta, x), C = (theta, theta), and against the next node
    /// D = (x+, x), E = (x+, theta), F = (theta+, theta). Row index first; of A and C the lower triangle. The pair
    /// (theta+, x) does not occur: a node's position acts on the elements at its two sides only.</remarks>
    [StructLayout(LayoutKind.Sequential)]
    internal struct RodBlock
    {
        public double A11, A21, A31, B11, B21, B31, D11, D21, D31;
        public double A22, A32, B12, B22, B32, D12, D22, D32;
        public double A33, B13, B23, B33, D13, D23, D33;
        public double C11, C21, C31, E11, E21, E31, F11, F21, F31;
        public double C22, C32, E12, E22, E32, F12, F22, F32;
        public double C33, E13, E23, E33, F13, F23, F33;

        /// <summary>Adds a stiffness h against motions of the point at s of an element, from 0 at its node to 1 at the
        /// next.</summary>
        public static void AddAt(ref RodBlock node, ref RodBlock next, double s, in Symmetric3 h)
        {
            double r = 1.0 - s;
            node.A11 += r * r * h.A11; node.A21 += r * r * h.A21; node.A22 += r * r * h.A22;
            node.A31 += r * r * h.A31; node.A32 += r * r * h.A32; node.A33 += r * r * h.A33;
            next.A11 += s * s * h.A11; next.A21 += s * s * h.A21; next.A22 += s * s * h.A22;
            next.A31 += s * s * h.A31; next.A32 += s * s * h.A32; next.A33 += s * s * h.A33;
            double m = r * s;
            node.D11 += m * h.A11; node.D12 += m * h.A21; node.D13 += m * h.A31;
            node.D21 += m * h.A21; node.D22 += m * h.A22; node.D23 += m * h.A32;
            node.D31 += m * h.A31; node.D32 += m * h.A32; node.D33 += m * h.A33;
        }
    }
}
