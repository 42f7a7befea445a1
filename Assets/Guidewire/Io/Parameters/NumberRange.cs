using System.Globalization;

namespace Guidewire.Io
{
    /// <summary>Bounds of a number, each of them inside or outside.</summary>
    public readonly struct NumberRange
    {
        private readonly bool _minimumExcluded;

        private NumberRange(double minimum, bool minimumExcluded, double maximum)
        {
            Minimum = minimum;
            _minimumExcluded = minimumExcluded;
            Maximum = maximum;
        }

        /// <summary>Allows every finite number.</summary>
        public static NumberRange Any => new NumberRange(double.NegativeInfinity, false, double.PositiveInfinity);

        /// <summary>Allows numbers above 0.</summary>
        public static NumberRange Positive => new NumberRange(0.0, true, double.PositiveInfinity);

        /// <summary>Allows 0 and numbers above.</summary>
        public static NumberRange NotNegative => new NumberRange(0.0, false, double.PositiveInfinity);

        /// <summary>Allows numbers from 0 to 1.</summary>
        public static NumberRange Fraction => new NumberRange(0.0, false, 1.0);

        /// <summary>The lower bound.</summary>
        public double Minimum { get; }

        /// <summary>The upper bound.</summary>
        public double Maximum { get; }

        /// <summary>Above 0, up to a bound that is inside.</summary>
        public static NumberRange PositiveUpTo(double maximum) => new NumberRange(0.0, true, maximum);

        /// <summary>The bounds as they follow "a number".</summary>
        internal string Text
        {
            get
            {
                string text = double.IsNegativeInfinity(Minimum) ? ""
                    : (_minimumExcluded ? " > " : " >= ") + Minimum.ToString("R", CultureInfo.InvariantCulture);
                return double.IsPositiveInfinity(Maximum) ? text
                    : text + (text.Length > 0 ? " and" : "") + " <= "
                    + Maximum.ToString("R", CultureInfo.InvariantCulture);
            }
        }

        /// <summary>Whether a number lies inside.</summary>
        internal bool Contains(double value) =>
            (_minimumExcluded ? value > Minimum : value >= Minimum) && value <= Maximum;
    }
}
