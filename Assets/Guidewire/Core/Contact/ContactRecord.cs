using System;

namespace Guidewire.Core
{
    /// <summary>Results of contact with walls: forces of the last step, and sums over the run.</summary>
    public sealed class ContactRecord
    {
        private readonly Vector3d[] _impulses;
        private int _spheres;

        internal ContactRecord(int sphereCount)
        {
            _impulses = new Vector3d[sphereCount];
            Forces = new Vector3d[sphereCount];
            _spheres = sphereCount;
        }

        /// <summary>The wire has so many spheres, at most those that this is made for, and nothing touches it.
        /// </summary>
        internal void Remesh(int sphereCount)
        {
            _spheres = sphereCount;
            Array.Clear(Forces, 0, Forces.Length);
            Array.Clear(ElementForces, 0, ElementForces.Length);
            Array.Clear(Displacements, 0, Displacements.Length);
            Array.Clear(StrandForces, 0, StrandForces.Length);
        }

        /// <summary>Force of the walls on each of the n + 1 spheres in the last step, mass unit * unit/s^2. What a held
        /// sphere's element took stands at that sphere.</summary>
        public Vector3d[] Forces { get; }

        /// <summary>The sum of all contact forces.</summary>
        public Vector3d Total { get; private set; }

        /// <summary>Force of the held or driven first sphere on the rest of the wire in the last step, mass unit *
        /// unit/s^2: what constraints gave the free spheres less what walls gave them. 0 where the first sphere is
        /// free. With a material: of the support, in N, the mean over the step by the scheme's weights.</summary>
        public Vector3d Reaction { get; internal set; }

        /// <summary>The same at the end of the step, as <see cref="Forces"/> and <see cref="Total"/> are: with the
        /// direct solver; else 0.</summary>
        public Vector3d ReactionAtEnd { get; internal set; }

        /// <summary>Mean of <see cref="Total"/> over the step by the scheme's weights, to go with
        /// <see cref="Reaction"/>, with the direct solver; else 0.</summary>
        public Vector3d MeanTotal { get; internal set; }

        /// <summary>Points of the wire, ten an element, that were inside before a step and outside after it.</summary>
        public long Passages { get; internal set; }

        /// <summary>How often strands passed one another, counted in each part of a step by a method that keeps them
        /// apart; else 0.</summary>
        internal long StrandPassages { get; set; }

        /// <summary>Largest penetration depth of the surface of a sphere or a rod element in a wall, at the start or
        /// after a step, units; see <see cref="WireDepth"/>.</summary>
        public double MaxPenetration { get; internal set; }

        /// <summary>What the drive asked of sphere 0 and the walls prevented, units, summed over the run.</summary>
        public double DriveShortfall { get; internal set; }

        /// <summary>The displacement that the drive asked of sphere 0, units, summed over the run.</summary>
        public double DriveAsked { get; internal set; }

        /// <summary>Successive steps, up to the last, in which the drive asked sphere 0 to move and the walls allowed
        /// less than a hundredth of it.</summary>
        public int StuckSteps { get; private set; }

        /// <summary>Momenta over dt, dp/w, of the walls on each sphere in the present step, mass unit * unit.</summary>
        internal Vector3d[] Impulses => _impulses;

        /// <summary>The largest force of the walls on one sphere after any step of the run, as
        /// <see cref="Forces"/>.</summary>
        public double LargestForce { get; private set; }

        /// <summary>The largest sum of them.</summary>
        public double LargestTotal { get; private set; }

        /// <summary>Force of each wall on the wire along its normals in the last step, N, in the order of the scene;
        /// empty with pbd.</summary>
        public Vector3d[] WallForces { get; internal set; } = Array.Empty<Vector3d>();

        /// <summary>Force of the walls along their normals on each of the n elements in the last step, N: a force on a
        /// sphere between two elements counts half for each. Empty with pbd.</summary>
        public Vector3d[] ElementForces { get; internal set; } = Array.Empty<Vector3d>();

        /// <summary>Force of the wire's other strands on each of the n + 1 spheres in the last step, N. Empty where it
        /// does not touch itself.</summary>
        public Vector3d[] StrandForces { get; private set; } = Array.Empty<Vector3d>();

        /// <summary>Largest pressure of the walls on an element in the last step, Pa: its normal force over its length
        /// and diameter. 0 with pbd.</summary>
        public double Pressure { get; internal set; }

        /// <summary>Displacement of soft walls at each of the n elements, that of the contact where it is largest, m.
        /// Empty where all walls are rigid.</summary>
        public Vector3d[] Displacements { get; internal set; } = Array.Empty<Vector3d>();

        /// <summary>The largest of them, m.</summary>
        public double LargestDisplacement { get; internal set; }

        /// <summary>Mean over all contacts with soft walls, m; 0 without any.</summary>
        public double MeanDisplacement { get; internal set; }

        /// <summary>Prepares what is recorded by element.</summary>
        /// <param name="count">Of the elements.</param>
        /// <param name="walls">Of the scene.</param>
        /// <param name="hasForces">Whether the forces on elements are recorded.</param>
        /// <param name="touchesItself">Whether the wire does.</param>
        internal void SetElements(int count, ContactShape[] walls, bool hasForces, bool touchesItself)
        {
            StrandForces = new Vector3d[touchesItself ? count + 1 : 0];
            ElementForces = new Vector3d[hasForces ? count : 0];
            Displacements = new Vector3d[HasSoft(walls) ? count : 0];
        }

        /// <summary>Whether any of these walls gives way.</summary>
        internal static bool HasSoft(ContactShape[] walls) => Array.Exists(walls, wall => wall.Softness != null);

        internal void SetTotal(in Vector3d total)
        {
            Total = total;
            LargestTotal = Math.Max(LargestTotal, total.Length);
            for (int i = 0; i < _spheres; i++)
            {
                LargestForce = Math.Max(LargestForce, Forces[i].Length);
            }
        }

        /// <summary>Takes over what another record holds, its spheres moved on by an offset.</summary>
        internal void CopyFrom(ContactRecord other, int offset)
        {
            Passages = other.Passages;
            StrandPassages = other.StrandPassages;
            MaxPenetration = other.MaxPenetration;
            DriveShortfall = other.DriveShortfall;
            DriveAsked = other.DriveAsked;
            StuckSteps = other.StuckSteps;
            Total = other.Total;
            LargestForce = other.LargestForce;
            LargestTotal = other.LargestTotal;
            Reaction = other.Reaction;
            ReactionAtEnd = other.ReactionAtEnd;
            MeanTotal = other.MeanTotal;
            WallForces = other.WallForces;
            Pressure = other.Pressure;
            LargestDisplacement = other.LargestDisplacement;
            MeanDisplacement = other.MeanDisplacement;
            Copy(other.Displacements, Displacements, offset, 0, other._spheres - 1);
            Copy(other.Forces, Forces, offset, 0, other._spheres);
            Copy(other.StrandForces, StrandForces, offset, 0, other._spheres);
            Copy(other.ElementForces, ElementForces, offset, 0, other._spheres - 1);
        }

        /// <summary>Copies the forces on spheres and the displacements at elements to those of another numbering.
        /// </summary>
        /// <param name="forces">Receives them; zero where there are none.</param>
        /// <param name="strandForces">The same.</param>
        /// <param name="displacements">The same.</param>
        /// <param name="offset">Of the other numbers.</param>
        /// <param name="first">The first sphere here whose force counts.</param>
        /// <param name="firstElement">The first element that counts.</param>
        internal void CopyTo(Vector3d[] forces, Vector3d[] strandForces, Vector3d[] displacements, int offset,
            int first, int firstElement)
        {
            Copy(Forces, forces, offset, first, _spheres);
            Copy(StrandForces, strandForces, offset, first, _spheres);
            Copy(Displacements, displacements, offset, firstElement, _spheres - 1);
        }

        private static void Copy(Vector3d[] values, Vector3d[] others, int offset, int first, int count)
        {
            for (int i = 0; i < others.Length; i++)
            {
                int from = i - offset;
                others[i] = from >= first && from < count ? values[from] : Vector3d.Zero;
            }
        }

        internal void StartStep() => Array.Clear(_impulses, 0, _impulses.Length);

        internal void Serialize(Snapshot snapshot)
        {
            Passages = snapshot.Serialize(Passages);
            MaxPenetration = snapshot.Serialize(MaxPenetration);
            DriveShortfall = snapshot.Serialize(DriveShortfall);
            DriveAsked = snapshot.Serialize(DriveAsked);
            StuckSteps = snapshot.Serialize(StuckSteps);
            Total = snapshot.Serialize(Total);
            LargestForce = snapshot.Serialize(LargestForce);
            LargestTotal = snapshot.Serialize(LargestTotal);
            Reaction = snapshot.Serialize(Reaction);
            ReactionAtEnd = snapshot.Serialize(ReactionAtEnd);
            MeanTotal = snapshot.Serialize(MeanTotal);
            Pressure = snapshot.Serialize(Pressure);
            snapshot.Serialize(Forces, _spheres);
            snapshot.Serialize(ElementForces, _spheres - 1);
            if (snapshot.IsStep)    // another run of the same wire may not have them
            {
                snapshot.Serialize(Displacements, Math.Min(Displacements.Length, _spheres - 1));
                snapshot.Serialize(StrandForces, Math.Min(StrandForces.Length, _spheres));
            }
        }

        /// <summary>Adds what the drive asked of sphere 0 in a step, and what of it the walls prevented,
        /// units.</summary>
        internal void AddDrive(double asked, double shortfall)
        {
            DriveAsked += asked;
            DriveShortfall += shortfall;
            if (asked > 0.0)
            {
                StuckSteps = shortfall > 0.99 * asked ? StuckSteps + 1 : 0;
            }
        }

        internal void EndStep(RodState state, Vector3d[] predicted, double timeStep)
        {
            double rate = 1.0 / (timeStep * timeStep);
            Vector3d total = Vector3d.Zero;
            Vector3d given = Vector3d.Zero;
            for (int i = 0; i < _impulses.Length; i++)
            {
                Forces[i] = rate * _impulses[i];
                total += Forces[i];
                double w = state.InverseMasses[i];
                if (w > 0.0)
                {
                    given += (rate / w) * (state.PredictedPositions[i] - predicted[i]) - Forces[i];
                }
            }
            SetTotal(total);
            Reaction = state.InverseMasses[0] == 0.0 ? given : Vector3d.Zero;
        }
    }
}
