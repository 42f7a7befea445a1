using System;

namespace Guidewire.Core
{
    /// <summary>Sums over a list of energy terms: value, gradient, blocks, largest step.</summary>
    internal static class EnergySum
    {
        /// <summary>Gives the sum of the energies, J.</summary>
        /// <param name="magnitude">Sum of their magnitudes, J: what rounding goes with.</param>
        public static double Value(EnergyTerm[] terms, RodShape shape, out double magnitude)
        {
            double sum = 0.0;
            magnitude = 0.0;
            foreach (EnergyTerm term in terms)
            {
                double value = term.Value(shape);
                sum += value;
                magnitude += Math.Abs(value);
            }
            return sum;
        }

        /// <summary>Gives the same, term by term.</summary>
        /// <param name="values">Receives the energy of each term, J.</param>
        public static double Value(EnergyTerm[] terms, RodShape shape, double[] values, out double magnitude)
        {
            for (int k = 0; k < terms.Length; k++)
            {
                values[k] = terms[k].Value(shape);
            }
            return Sum(values, out magnitude);
        }

        /// <summary>The same once more, after every term was anchored in that shape.</summary>
        public static double AnchoredValue(EnergyTerm[] terms, double[] values, out double magnitude)
        {
            for (int k = 0; k < terms.Length; k++)
            {
                values[k] = terms[k].AnchoredValue(values[k]);
            }
            return Sum(values, out magnitude);
        }

        private static double Sum(double[] values, out double magnitude)
        {
            double sum = 0.0;
            magnitude = 0.0;
            foreach (double value in values)
            {
                sum += value;
                magnitude += Math.Abs(value);
            }
            return sum;
        }

        /// <summary>Every term counts work from this shape on.</summary>
        public static void Anchor(EnergyTerm[] terms, RodShape shape)
        {
            foreach (EnergyTerm term in terms)
            {
                term.Anchor(shape);
            }
        }

        /// <summary>Second derivatives with or without what need not be positive.</summary>
        public static void DropGeometricStiffness(EnergyTerm[] terms, bool isOn)
        {
            foreach (EnergyTerm term in terms)
            {
                term.DropGeometricStiffness(isOn);
            }
        }

        /// <summary>Gives the largest fraction of a step, at most 1, that no term forbids.</summary>
        public static double MaxStep(EnergyTerm[] terms, RodShape shape, RodVector[] direction, double scale)
        {
            double fraction = 1.0;
            foreach (EnergyTerm term in terms)
            {
                fraction = Math.Min(fraction, term.MaxStep(shape, direction, scale));
            }
            return fraction;
        }
    }
}
