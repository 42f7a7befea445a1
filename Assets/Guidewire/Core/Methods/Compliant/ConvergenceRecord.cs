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

    /// <summary>Error in the directions of the impulses of a substep: each iteration moved the wire along the gradient
    /// of C in the shape of the moment, whereas implicit Euler requires that of the final shape, x - x~ = M^-1
    /// grad C^T lambda.</summary>
    /// <remarks>The difference d of the two sides is what forces M d/h^2 and couples J d/h^2 from nowhere would do.
    /// Their moment about joint k, summed from the distal end, over the joint's stiffness is an angle that counts like
    /// a residual of that joint.</remarks>
    internal sealed class DirectionError
    {
        private readonly CompliantStretch _stretch;
        private readonly CompliantBendTwist _bendTwist;
        private readonly CompliantContacts? _contacts;
        private readonly NodalInertia _inertia;
        private readonly Joint[] _joint;
        private readonly RodShape _predicted;
        private readonly Vector3d[] _shift;
        private readonly Vector3d[] _turn;

        /// <summary>Makes the measure for these constraints.</summary>
        /// <param name="contacts">Null without walls.</param>
        public DirectionError(MaterialScene scene, NodalInertia inertia, CompliantStretch stretch,
            CompliantBendTwist bendTwist, CompliantContacts? contacts)
        {
            _stretch = stretch;
            _bendTwist = bendTwist;
            _contacts = contacts;
            _inertia = inertia;
            _joint = scene.Rod.Joints(scene.Supports);
            _predicted = new RodShape(scene.Rod.ElementCount);
            _shift = new Vector3d[scene.Rod.ElementCount + 1];
            _turn = new Vector3d[scene.Rod.ElementCount];
        }

        /// <summary>Takes the prediction, before any multiplier has moved it.</summary>
        public void Begin(RodShape shape) => _predicted.CopyFrom(shape);

        /// <summary>Adds the angles of all joints, after the iterations.</summary>
        public void Add(RodShape shape, double substep, ref IterationResidual sum)
        {
            Array.Clear(_shift, 0, _shift.Length);
            Array.Clear(_turn, 0, _turn.Length);
            _stretch.AddMotion(shape, _shift, _turn);
            _bendTwist.AddMotion(shape, _turn);
            _contacts?.AddMotion(shape, _shift, _turn);
            double perSquare = 1.0 / (substep * substep);
            Vector3d force = Vector3d.Zero;
            Vector3d moment = Vector3d.Zero;
            for (int j = _turn.Length - 1; j >= 0; j--)
            {
                double w = _inertia.InverseMass[j + 1];
                if (w > 0.0)
                {
                    force += (perSquare / w) * (shape.X[j + 1] - _predicted.X[j + 1] - _shift[j + 1]);
                }
                Quaterniond q = shape.Q[j];
                Vector3d turn = RotationVector.Log(_predicted.Q[j].Conjugate * q) - _turn[j];
                Vector3d inverse = _inertia.InverseInertia[j];
                var couple = new Vector3d(turn.X / inverse.X, turn.Y / inverse.Y, turn.Z / inverse.Z);
                moment += Vector3d.Cross(shape.X[j + 1] - shape.X[j], force)
                    + perSquare * Quaterniond.Rotate(q, couple);
                Vector3d own = Quaterniond.Rotate(q.Conjugate, moment);
                sum.Bend += Math.Sqrt(own.X * own.X + own.Y * own.Y)
                    / Math.Min(_joint[j].Bend1, _joint[j].Bend2);
                sum.Twist += Math.Abs(own.Z) / _joint[j].Twist;
            }
        }
    }
}
