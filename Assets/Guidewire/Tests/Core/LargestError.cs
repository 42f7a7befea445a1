using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The largest difference of values from those expected, against the largest expected.</summary>
    internal sealed class LargestError
    {
        private double _error;
        private double _peak;

        public void Add(double value, double expected)
        {
            _error = Math.Max(_error, Math.Abs(value - expected));
            _peak = Math.Max(_peak, Math.Abs(expected));
        }

        /// <summary>Some value was above `least`, and no error is as large as a millionth of the largest.</summary>
        public void AssertSmall(double least)
        {
            Assert.That(_peak, Is.GreaterThan(least));
            Assert.That(_error, Is.LessThan(1e-6 * _peak));
        }
    }
}
