using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Records the convergence of a run's iterations.</summary>
    /// <remarks>After any number of iterations the wire has moved by exactly the impulses lambda, that is by the forces
    /// lambda/h^2 = -(C - r)/alpha with the residual r = C + alpha lambda/h^2: it moved as a wire whose shape at rest
    /// differs by r (and whose pulls have directions that are off by <see cref="DirectionError"/>). Bends, turns and
    /// strains that are wrong by r add up along the wire, so the sum of |r| over all joints, over the sum of |C|, is
    /// the relative error of its shape, for bending and for twist; for stretch and shear the sum of l |r| is compared
    /// with what strains and bends move the tip by, half of L times its turn. Peaks of residuals are compared with
    /// peaks of strains, since a swinging wire is straight twice a period. What is counted per step is kept in classes
    /// 5 % wide, because the peak is known at the end only.</remarks>
    internal sealed class ConvergenceRecord
    {
        /// <summary>Errors up to here count as converged. Errors of a whole motion were up to 3.2 times as
        /// large.</summary>
        public const double Tolerance = 0.005;

        private const int Kinds = 4;
        private const int Bend = 0;
        private const int Twist = 1;
        private const int Stretch = 2;
        private const int Contact = 3;
        private const double Floor = 1e-9;      // radians, or of L: smaller strains are ignored
        private const double Smallest = 1e-18;
        private const double Ratio = 1.05;
        private const int ClassCount = 1200;    // up to 2.7e7
        private static readonly string[] Names = { "bending", "twist", "stretch and shear", "contact" };

        private readonly long[] _classes = new long[Kinds * ClassCount];
        private readonly double[] _largest = new double[Kinds];
        private readonly double[] _peak = new double[Kinds];
        private readonly double _totalLength;
        private long _steps;

        /// <param name="length">L, m.</param>
        public ConvergenceRecord(double length)
        {
            _totalLength = length;
        }

        /// <summary>Largest residual of the run over its largest strain, of the kind for which it is
        /// largest.</summary>
        public double LargestError => Error(Worst());

        /// <summary>Steps whose residual of that kind is above <see cref="Tolerance"/> of the peak.</summary>
        public long StepsAbove
        {
            get
            {
                int kind = Worst();
                if (Error(kind) <= Tolerance)
                {
                    return 0;
                }
                long sum = 0;
                for (int k = ClassOf(Tolerance * Scale(kind)) + 1; k < ClassCount; k++)
                {
                    sum += _classes[kind * ClassCount + k];
                }
                return Math.Max(1, sum);
            }
        }

        /// <summary>Adds how many steps had not converged and what is wrong by how much.</summary>
        public void AddWarnings(List<RunWarning> warnings)
        {
            long above = StepsAbove;
            if (above > 0)
            {
                warnings.Add(WarningTable.NotConverged.With(above, _steps, Names[Worst()], 100.0 * LargestError));
            }
        }

        /// <summary>Takes one step's residual.</summary>
        public void Add(in IterationResidual step)
        {
            _steps++;
            double perLength = 1.0 / _totalLength;
            Add(Bend, step.Bend, step.BendStrain);
            Add(Twist, step.Twist, step.TwistStrain);
            Add(Stretch, perLength * step.Stretch, perLength * step.StretchStrain + 0.5 * step.BendStrain);
            Add(Contact, step.Contact, 1.0);
        }

        /// <summary>Writes or restores the steps so far.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(_classes);
            snapshot.Serialize(_largest);
            snapshot.Serialize(_peak);
            snapshot.Serialize(ref _steps);
        }

        private void Add(int kind, double residual, double strain)
        {
            if (!(residual <= double.MaxValue))
            {
                residual = double.MaxValue;
            }
            _largest[kind] = Math.Max(_largest[kind], residual);
            if (strain <= double.MaxValue)
            {
                _peak[kind] = Math.Max(_peak[kind], strain);
            }
            _classes[kind * ClassCount + ClassOf(residual)]++;
        }

        private static int ClassOf(double residual)
        {
            double bin = Math.Log(Math.Max(residual, Smallest) / Smallest) / Math.Log(Ratio);
            return (int)Math.Min(bin, ClassCount - 1);
        }

        private int Worst()
        {
            int worst = Bend;
            for (int kind = 1; kind < Kinds; kind++)
            {
                worst = Error(kind) > Error(worst) ? kind : worst;
            }
            return worst;
        }

        private double Error(int kind) => _largest[kind] / Scale(kind);

        private double Scale(int kind) => Math.Max(_peak[kind], Floor);
    }
}
