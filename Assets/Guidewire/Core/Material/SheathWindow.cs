using System;

namespace Guidewire.Core
{
    /// <summary>The sheathed part as seen by the simulated elements: an axial and a torsional spring, and the position
    /// of the exit.</summary>
    internal sealed class SheathWindow : SheathEnd
    {
        private readonly (double Stretch, double Twist)[] _sheathed;  // EA and GJ of the elements up to the first

        /// <summary>The window from an element on.</summary>
        /// <param name="whole">The whole wire.</param>
        /// <param name="joints">Its n + 1 joints.</param>
        /// <param name="lengths">The length that each of them stands for, m.</param>
        /// <param name="pieces">What each of them is made of.</param>
        /// <param name="first">The first element that is simulated.</param>
        /// <param name="end">Of the sheath.</param>
        public SheathWindow(MaterialRod whole, Joint[] joints, double[] lengths, JointPieces pieces, int first,
            SheathEnd end)
            : base(end.Exit, end.Axis)
        {
            First = first;
            Pieces = pieces;
            int count = joints.Length - first;
            Joints = new Joint[count];
            JointLengths = new double[count];
            Array.Copy(joints, first, Joints, 0, count);
            Array.Copy(lengths, first, JointLengths, 0, count);
            _sheathed = new (double Stretch, double Twist)[first + 1];
            for (int j = 0; j <= first; j++)
            {
                _sheathed[j] = (whole.StretchStiffness[j], whole.TwistStiffness[j]);
                AxialCompliance += j == first ? 0.0 : whole.Length[j] / whole.StretchStiffness[j];
            }
            double compliance = 0.0;
            double rest = 0.0;
            for (int k = 0; k <= first; k++)
            {
                compliance += 1.0 / joints[k].Twist;
                rest += joints[k].Rest.Z;
                HeldBefore += k < first ? pieces.CutAt(k, double.PositiveInfinity).Held : 0.0;
            }
            Joints[0].Twist = 1.0 / compliance;
            Joints[0].Rest = new Vector3d(Joints[0].Rest.X, Joints[0].Rest.Y, rest);
        }

        /// <summary>The first element that is simulated.</summary>
        public int First { get; }

        /// <summary>The joints of the window; joint 0 twists as all of the sheathed part with it.</summary>
        public Joint[] Joints { get; }

        /// <summary>The length of wire that each represents, m.</summary>
        public double[] JointLengths { get; }

        /// <summary>Sum of l/EA in the sheath, m/N.</summary>
        public double AxialCompliance { get; }

        /// <summary>What the joints of the whole wire are made of.</summary>
        public JointPieces Pieces { get; }

        /// <summary>Energy of the joints before the window's, all of them kept straight, J.</summary>
        public double HeldBefore { get; }

        /// <summary>EA, N, and GJ, N m^2, of element j of the whole, up to the window's first.</summary>
        public (double Stretch, double Twist) Stiffness(int j)
        {
            return _sheathed[j];
        }

        /// <summary>Where the exit is along the wire, m from node 0 of the whole.</summary>
        /// <param name="position">Where the hub would hold the window's node 0 if nothing were compressed, m.</param>
        public double ExitFrom(in Vector3d position)
        {
            return Pieces.Stations[First] - Outside(position);
        }
    }
}
