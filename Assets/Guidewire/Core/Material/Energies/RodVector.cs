using System.Runtime.InteropServices;

namespace Guidewire.Core
{
    /// <summary>Six numbers of one node and the element after it: X along the world's axes (a displacement in m or a
    /// force in N), T along the element's own axes (a turn in radians or a couple in N m).</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal struct RodVector
    {
        public double X1, X2, X3;
        public double T1, T2, T3;
    }
}
