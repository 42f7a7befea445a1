namespace Guidewire.Core
{
    /// <summary>Lower bounds of the distances between a wire's elements and walls.</summary>
    internal interface IWallClearance
    {
        /// <summary>The walls from which distances count.</summary>
        ContactShape[] Walls { get; }

        /// <summary>Radius of the wire, its least where it varies, units.</summary>
        double Radius { get; }

        /// <summary>Lower bound of the distance of element j from wall w at the start of the motion under test,
        /// units.</summary>
        double ClearanceOf(int w, int j);
    }
}
