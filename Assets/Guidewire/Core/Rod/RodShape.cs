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

        /// <summary>Takes over another shape.</summary>
        public void CopyFrom(RodShape other)
        {
            ElementCount = other.ElementCount;
            other.X.AsSpan(0, ElementCount + 1).CopyTo(X);
            other.Q.AsSpan(0, ElementCount).CopyTo(Q);
            other.Twist.AsSpan(0, TwistCount).CopyTo(Twist);
            ProximalFrame = other.ProximalFrame;
            DistalFrame = other.DistalFrame;
        }

        /// <summary>Writes this shape into a snapshot, or takes over one of the same n.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(X, ElementCount + 1);
            snapshot.Serialize(Q, ElementCount);
            snapshot.Serialize(Twist, TwistCount);
            ProximalFrame = snapshot.Serialize(ProximalFrame);
            DistalFrame = snapshot.Serialize(DistalFrame);
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
