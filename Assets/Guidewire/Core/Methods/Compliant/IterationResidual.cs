using System;

namespace Guidewire.Core
{
    /// <summary>Residual of the iterations of a substep, in addition to the elastic strain. Sums over the
    /// whole wire: radians for bending and twist, m for stretch and shear; of contacts the largest.</summary>
    internal struct IterationResidual
    {
        /// <summary>Sum of |C + alpha lambda/h^2| over the joints, about d1 and d2.</summary>
        public double Bend;

        /// <summary>The same about d3.</summary>
        public double Twist;

        /// <summary>Sum of l |C + alpha lambda/h^2| over the elements.</summary>
        public double Stretch;

        /// <summary>The largest displacement by which one more iteration would move the point of a contact, in
        /// radii.</summary>
        public double Contact;

        /// <summary>Sum of |C| over the joints, about d1 and d2.</summary>
        public double BendStrain;

        /// <summary>The same about d3.</summary>
        public double TwistStrain;

        /// <summary>Sum of l |C| over the elements.</summary>
        public double StretchStrain;

        /// <summary>Takes in a later moment: residuals add up, weighted by the fraction of time that this one stands
        /// for, of strains the largest stays.</summary>
        public void Include(in IterationResidual other, double fraction)
        {
            Bend += fraction * other.Bend;
            Twist += fraction * other.Twist;
            Stretch += fraction * other.Stretch;
            Contact += fraction * other.Contact;
            BendStrain = Math.Max(BendStrain, other.BendStrain);
            TwistStrain = Math.Max(TwistStrain, other.TwistStrain);
            StretchStrain = Math.Max(StretchStrain, other.StretchStrain);
        }
    }
}
