using System;

namespace Guidewire.Core
{
    /// <summary>Step size control within a time step by an error estimate: a step of length h whose error E is above
    /// the tolerance T is repeated, and the next one has h (0.9^(p+1) T/E)^(1/(p+1)), p the order
    /// of the less accurate of the two solutions.</summary>
    /// <remarks>Bounded: no step is shorter than 1/1024 of the logged one, what is left of it is divided evenly, and
    /// what is still above the tolerance then is counted and kept.</remarks>
    internal sealed class StepControl
    {
        private const double Shortest = 1.0 / 1024.0;  // of the logged step
        private const double Safety = 0.9;
        private const double Failing = 0.25;  // where a stage has no solution
        private const double MinChange = 0.2;
        private const double MaxChange = 2.0;

        private readonly double _power;
        private double _length;  // of the next step, s; 0: not yet known

        /// <summary>Steps that are taken as they come.</summary>
        /// <param name="order">p.</param>
        public StepControl(int order)
        {
            _power = 1.0 / (order + 1);
        }

        /// <summary>T, radians, or displacement over L; 0: steps are taken as they come.</summary>
        public double Tolerance { get; set; }

        /// <summary>Whether steps are cut and grown.</summary>
        public bool IsOn => Tolerance > 0.0;

        /// <summary>Largest error of a step that was kept.</summary>
        public double LargestError { get; private set; }

        /// <summary>Steps that were kept.</summary>
        public long Steps { get; private set; }

        /// <summary>Steps that were kept although their error was above the tolerance.</summary>
        public long StepsAbove { get; private set; }

        /// <summary>Forgets how long the next step was to be.</summary>
        public void Forget() => _length = 0.0;

        /// <summary>Gives the length of the next step, s.</summary>
        /// <param name="left">What is left until a jump or the end of the logged step, s.</param>
        public double Propose(double left)
        {
            double parts = IsOn && _length > 0.0 ? Math.Ceiling(left / _length * (1.0 - 1e-12)) : 1.0;
            return left / Math.Max(parts, 1.0);
        }

        /// <summary>Whether a step is kept, and how long the next one is to be.</summary>
        /// <param name="isSolved">Whether its stages have solutions.</param>
        public bool Accepts(double error, double length, double logged, bool isSolved)
        {
            bool isGood = isSolved && error <= Tolerance;
            double least = Shortest * logged;
            if (IsOn)
            {
                double change = isSolved ? Safety * Math.Pow(Tolerance / Math.Max(error, 1e-300), _power) : Failing;
                change = Math.Min(Math.Max(change, MinChange), MaxChange);
                _length = Math.Min(Math.Max(length * change, least), logged);
                if (!isGood && length > least * (1.0 + 1e-9))
                {
                    return false;
                }
            }
            Steps += isSolved ? 1 : 0;
            StepsAbove += IsOn && !isGood ? 1 : 0;
            LargestError = Math.Max(LargestError, error);
            return true;
        }

        /// <summary>Writes or restores the counts.</summary>
        public void SerializeCounts(Snapshot snapshot)
        {
            LargestError = snapshot.Serialize(LargestError);
            Steps = snapshot.Serialize(Steps);
            StepsAbove = snapshot.Serialize(StepsAbove);
        }

        /// <summary>Writes or restores the length of the next step; for a step also the counts.</summary>
        public void Serialize(Snapshot snapshot)
        {
            if (snapshot.IsStep)
            {
                SerializeCounts(snapshot);
            }
            snapshot.Serialize(ref _length);
        }
    }
}
