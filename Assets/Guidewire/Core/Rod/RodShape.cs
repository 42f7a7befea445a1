using System;

namespace Guidewire.Core
{
    /// <summary>Shape of a rod: positions x_0 .. x_n of its nodes, orientations q_0 .. q_(n-1) of its elements,
    /// and the frames to which its two ends may be clamped.</summary>
    internal sealed class RodShape
    {
        /// <summary>Makes a rod of <paramref name="elementCount"/> elements, all at the origin and unturned.</summary>
        /// <param name="innerCount">Instruments inside it.</param>
        /// <param name="capacity">The most elements that it will have.</param>
        public RodShape(int elementCount, int innerCount = 0, int capacity = 0)
        {
            capacity = Math.Max(capacity, elementCount);
            X = new Vector3d[capacity + 1];
            Q = new Quaterniond[capacity];
            Array.Fill(Q, Quaterniond.Identity);
            Twist = innerCount > 0 ? new double[innerCount * capacity] : Array.Empty<double>();
            InnerCount = innerCount;
            ElementCount = elementCount;
        }

        /// <summary>Positions of the n+1 nodes.</summary>
        public Vector3d[] X { get; }

        /// <summary>Orientations of the n elements; d3 = q e3 q* points along the element.</summary>
        public Quaterniond[] Q { get; }

        /// <summary>Angle about d3 from each element to the instrument inside it, radians, without limit, and then,
        /// where there are two, from each element to the innermost one; none where there is one instrument
        /// alone.</summary>
        public double[] Twist { get; }

        /// <summary>Displacements of the splines of a vessel that gives way as a beam (<see cref="WallBeam"/>), m; none
        /// where it does not.</summary>
        public Vector3d[] Vessel { get; private set; } = Array.Empty<Vector3d>();

        /// <summary>Their rates in the last step, m/s, by which the next one is predicted.</summary>
        public Vector3d[] VesselRates { get; private set; } = Array.Empty<Vector3d>();

        /// <summary>Over how long they are predicted at most: the length of that step, s. What gives way at once in a
        /// short one does not go on so.</summary>
        public double VesselInterval { get; set; }

        /// <summary>The frame to which the proximal end is clamped, if it is.</summary>
        public Quaterniond ProximalFrame { get; set; } = Quaterniond.Identity;

        /// <summary>The frame to which the distal end is clamped, if it is.</summary>
        public Quaterniond DistalFrame { get; set; } = Quaterniond.Identity;

        /// <summary>The number of elements n; arrays may have room for more.</summary>
        public int ElementCount { get; set; }

        /// <summary>Angles that each element has.</summary>
        public int InnerCount { get; }

        /// <summary>The number of all angles.</summary>
        public int TwistCount => InnerCount * ElementCount;

        /// <summary>Where the vessel's displacements are in a vector of the rod: behind those of nodes and
        /// angles.</summary>
        public int VesselStart => (InnerCount == 0 ? 1 : 2) * (ElementCount + 1) + 1;

        /// <summary>Makes room for as many displacements of a vessel.</summary>
        public void FitVessel(int count)
        {
            if (Vessel.Length != count)
            {
                (Vessel, VesselRates) = (new Vector3d[count], new Vector3d[count]);
            }
        }

        /// <summary>Takes over another shape.</summary>
        public void CopyFrom(RodShape other)
        {
            ElementCount = other.ElementCount;
            other.X.AsSpan(0, ElementCount + 1).CopyTo(X);
            other.Q.AsSpan(0, ElementCount).CopyTo(Q);
            other.Twist.AsSpan(0, TwistCount).CopyTo(Twist);
            ProximalFrame = other.ProximalFrame;
            DistalFrame = other.DistalFrame;
            TakeVessel(other);
        }

        /// <summary>Takes over the displacements of another shape's vessel.</summary>
        public void TakeVessel(RodShape other)
        {
            FitVessel(other.Vessel.Length);
            other.Vessel.CopyTo(Vessel, 0);
            other.VesselRates.CopyTo(VesselRates, 0);
            VesselInterval = other.VesselInterval;
        }

        /// <summary>Writes this shape into a snapshot, or takes over one of the same n; without the vessel, of which
        /// another one may have other splines.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(X, ElementCount + 1);
            snapshot.Serialize(Q, ElementCount);
            snapshot.Serialize(Twist, TwistCount);
            ProximalFrame = snapshot.Serialize(ProximalFrame);
            DistalFrame = snapshot.Serialize(DistalFrame);
        }

        /// <summary>Writes or takes over the vessel's displacements; nothing where it has none.</summary>
        public void SerializeVessel(Snapshot snapshot)
        {
            if (Vessel.Length > 0)
            {
                snapshot.Serialize(Vessel, Vessel.Length);
                snapshot.Serialize(VesselRates, Vessel.Length);
                VesselInterval = snapshot.Serialize(VesselInterval);
            }
        }

        /// <summary>Makes this a straight rod along d3 of <paramref name="frame"/>.</summary>
        /// <param name="start">Position from which stations are counted.</param>
        /// <param name="frame">Orientation of every element.</param>
        /// <param name="stations">Distance of each of the n + 1 nodes from it.</param>
        public void SetStraight(in Vector3d start, in Quaterniond frame, double[] stations)
        {
            Vector3d axis = frame.Director3;
            X[0] = start + stations[0] * axis;
            for (int j = 0; j < ElementCount; j++)
            {
                Q[j] = frame;
                X[j + 1] = start + stations[j + 1] * axis;
            }
            ProximalFrame = frame;
            DistalFrame = frame;
        }
    }
}
