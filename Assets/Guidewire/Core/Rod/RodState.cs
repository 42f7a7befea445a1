using System;

namespace Guidewire.Core
{
    /// <summary>A wire of n rod elements and n + 1 spheres at one time: what a step reads and writes.</summary>
    /// <remarks>Element j joins spheres j and j + 1. Its orientation q takes the body's z axis to the third director d3
    /// = q e3 q*, which lies along the element where nothing shears it. Arrays are made once; at the end of a step
    /// previous, current and predicted ones are swapped, so take them from the properties anew each step.</remarks>
    public sealed class RodState
    {
        /// <summary>A straight wire along z at rest: sphere i at z = offset + i l with l = L/n (thesis eq. 3.1), masses
        /// M/(n + 1) (eq. 3.2), orientations the identity with weight 1.</summary>
        /// <param name="elementCount">n, at least 1.</param>
        /// <param name="length">L in units, positive.</param>
        /// <param name="totalMass">M in mass units, positive.</param>
        /// <param name="offset">z of sphere 0 in units.</param>
        /// <exception cref="ArgumentOutOfRangeException">n below 1, or L or M not positive.</exception>
        public RodState(int elementCount, double length, double totalMass, double offset)
        {
            if (elementCount < 1)
            {
                throw new ArgumentOutOfRangeException(nameof(elementCount), elementCount,
                    "a wire has at least one element");
            }
            if (!(length > 0.0))
            {
                throw new ArgumentOutOfRangeException(nameof(length), length, "a wire has a positive length");
            }
            if (!(totalMass > 0.0))
            {
                throw new ArgumentOutOfRangeException(nameof(totalMass), totalMass, "a wire has a positive mass");
            }
            ElementCount = elementCount;
            ElementLength = length / elementCount;
            ElementLengths = new double[elementCount];
            Array.Fill(ElementLengths, ElementLength);
            int spheres = elementCount + 1;
            Positions = new Vector3d[spheres];
            PreviousPositions = new Vector3d[spheres];
            PredictedPositions = new Vector3d[spheres];
            Velocities = new Vector3d[spheres];
            Forces = new Vector3d[spheres];
            InverseMasses = new double[spheres];
            Orientations = new Quaterniond[elementCount];
            PredictedOrientations = new Quaterniond[elementCount];
            AngularVelocities = new Vector3d[elementCount];
            OrientationWeights = new double[elementCount];
            RestDarbouxVectors = new Vector3d[elementCount - 1];
            for (int i = 0; i < spheres; i++)
            {
                Positions[i] = new Vector3d(0.0, 0.0, offset + i * ElementLength);
                InverseMasses[i] = spheres / totalMass;
            }
            Array.Fill(Orientations, Quaterniond.Identity);
            Array.Fill(OrientationWeights, 1.0);
            Rest();
        }

        /// <summary>A straight wire along z at rest whose elements may differ in length.</summary>
        /// <param name="elementLengths">l of each element in units, positive.</param>
        /// <param name="totalMass">M in mass units, positive.</param>
        /// <param name="offset">z of sphere 0 in units.</param>
        internal RodState(double[] elementLengths, double totalMass, double offset)
            : this(elementLengths.Length, Sum(elementLengths), totalMass, offset)
        {
            Array.Copy(elementLengths, ElementLengths, ElementCount);
            for (int j = 0; j < ElementCount; j++)
            {
                Positions[j + 1] = Positions[j] + new Vector3d(0.0, 0.0, ElementLengths[j]);
            }
            Rest();
        }

        /// <summary>The number of elements n.</summary>
        public int ElementCount { get; }

        /// <summary>The number of spheres, n + 1.</summary>
        public int SphereCount => ElementCount + 1;

        /// <summary>l = L/n in units: the length of every element at rest with pbd, the mean of them with a
        /// material.</summary>
        public double ElementLength { get; }

        /// <summary>The length of each of the n elements at rest, in units.</summary>
        public double[] ElementLengths { get; }

        /// <summary>x, n + 1 sphere positions in units.</summary>
        public Vector3d[] Positions { get; private set; }

        /// <summary>x one step ago, in units.</summary>
        public Vector3d[] PreviousPositions { get; private set; }

        /// <summary>p, in units: what the prediction writes and the constraints correct.</summary>
        public Vector3d[] PredictedPositions { get; private set; }

        /// <summary>v in unit/s, n + 1.</summary>
        public Vector3d[] Velocities { get; }

        /// <summary>f in mass unit * unit / s^2, n + 1: external forces, gravity not among them.</summary>
        public Vector3d[] Forces { get; }

        /// <summary>w, n + 1 inverse masses; 0 for a sphere that is held or moved by a drive.</summary>
        public double[] InverseMasses { get; }

        /// <summary>q, n unit quaternions.</summary>
        public Quaterniond[] Orientations { get; private set; }

        /// <summary>What the prediction writes and the constraints correct.</summary>
        public Quaterniond[] PredictedOrientations { get; private set; }

        /// <summary>omega in rad/s, n, in each element's own frame.</summary>
        public Vector3d[] AngularVelocities { get; }

        /// <summary>w_q, n inverse inertias of the orientations, dimensionless.</summary>
        public double[] OrientationWeights { get; }

        /// <summary>Omega_0 in 1/unit, n - 1: the Darboux vector of each joint at rest; 0 for a straight
        /// wire.</summary>
        public Vector3d[] RestDarbouxVectors { get; }

        /// <summary>Takes over a start.</summary>
        /// <param name="shape">Its lengths are units.</param>
        /// <param name="velocities">Of the spheres, units/s.</param>
        /// <param name="spins">Of the elements, rad/s, in each one's own frame.</param>
        internal void Start(RodShape shape, Vector3d[] velocities, Vector3d[] spins)
        {
            Array.Copy(shape.X, Positions, SphereCount);
            Array.Copy(velocities, Velocities, SphereCount);
            Array.Copy(spins, AngularVelocities, ElementCount);
            Array.Copy(shape.Q, Orientations, ElementCount);
            Rest();
        }

        /// <summary>Makes a start from where the wire is, of copies.</summary>
        internal RodStart ToStart(Quaterniond? proximalFrame, Quaterniond? distalFrame)
        {
            return new RodStart((Vector3d[])Positions.Clone(), (Quaterniond[])Orientations.Clone(),
                (Vector3d[])Velocities.Clone(), (Vector3d[])AngularVelocities.Clone())
            {
                ProximalFrame = proximalFrame,
                DistalFrame = distalFrame,
            };
        }

        /// <summary>Writes all that a moment of the wire is into a snapshot, or takes it over from one.</summary>
        internal void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(Positions);
            snapshot.Serialize(PreviousPositions);
            snapshot.Serialize(PredictedPositions);
            snapshot.Serialize(Velocities);
            snapshot.Serialize(Orientations);
            snapshot.Serialize(PredictedOrientations);
            snapshot.Serialize(AngularVelocities);
        }

        /// <summary>Moves a sphere without giving it a velocity.</summary>
        public void Place(int sphere, in Vector3d position)
        {
            Positions[sphere] = position;
            PreviousPositions[sphere] = position;
            PredictedPositions[sphere] = position;
        }

        /// <summary>The corrected state becomes the current one, the current one the previous.</summary>
        internal void Advance()
        {
            Vector3d[] oldest = PreviousPositions;
            PreviousPositions = Positions;
            Positions = PredictedPositions;
            PredictedPositions = oldest;
            Quaterniond[] old = Orientations;
            Orientations = PredictedOrientations;
            PredictedOrientations = old;
        }

        private static double Sum(double[] values)
        {
            double sum = 0.0;
            foreach (double value in values)
            {
                sum += value;
            }
            return sum;
        }

        private void Rest()
        {
            Array.Copy(Positions, PreviousPositions, SphereCount);
            Array.Copy(Positions, PredictedPositions, SphereCount);
            Array.Copy(Orientations, PredictedOrientations, ElementCount);
        }
    }

    /// <summary>Stretch, bending and twist of the wire at each sphere: for pictures and logs only.</summary>
    public static class RodStrain
    {
        /// <summary>Length over rest length, less 1, of the elements at sphere i; the mean of both where there are two.
        /// Dimensionless.</summary>
        public static double Stretch(RodState state, int i)
        {
            return 0.5 * (ElementStretch(state, Math.Max(i - 1, 0))
                + ElementStretch(state, Math.Min(i, state.ElementCount - 1)));
        }

        /// <summary>Curvature at sphere i in 1/unit, not negative; 0 at both ends.</summary>
        public static double Curvature(RodState state, int i)
        {
            Vector3d omega = Darboux(state, i);
            return Math.Sqrt(omega.X * omega.X + omega.Y * omega.Y);
        }

        /// <summary>Twist at sphere i in rad/unit, about the third director; 0 at both ends.</summary>
        public static double Twist(RodState state, int i) => Darboux(state, i).Z;

        private static double ElementStretch(RodState state, int j) =>
            Vector3d.Distance(state.Positions[j], state.Positions[j + 1]) / state.ElementLengths[j] - 1.0;

        private static Vector3d Darboux(RodState state, int i)
        {
            if (i == 0 || i == state.ElementCount)
            {
                return Vector3d.Zero;
            }
            // q and -q are one orientation: the turn meant is the shorter one.
            Quaterniond turn = state.Orientations[i - 1].Conjugate * state.Orientations[i];
            double between = 0.5 * (state.ElementLengths[i - 1] + state.ElementLengths[i]);
            return ((turn.W < 0.0 ? -2.0 : 2.0) / between) * turn.Imaginary;
        }
    }
}
