using System;

namespace Guidewire.Core
{
    /// <summary>Shape, velocities and spins of a rod: the state that its steppers advance in time.</summary>
    internal sealed class RodMotion
    {
        /// <summary>A rod at rest in this shape, which moves from then on.</summary>
        public RodMotion(RodShape shape)
        {
            Shape = shape;
            Velocities = new Vector3d[shape.X.Length];
            Spins = new Vector3d[shape.Q.Length];
            TwistRates = new double[shape.Twist.Length];
        }

        /// <summary>Positions and orientations.</summary>
        public RodShape Shape { get; }

        /// <summary>v of the nodes, m/s.</summary>
        public Vector3d[] Velocities { get; }

        /// <summary>w of the elements along their own axes, rad/s.</summary>
        public Vector3d[] Spins { get; }

        /// <summary>z' of the angles to an instrument inside, rad/s; none where there is one alone.</summary>
        public double[] TwistRates { get; }

        /// <summary>Takes over another motion.</summary>
        public void CopyFrom(RodMotion other)
        {
            Shape.CopyFrom(other.Shape);
            Begin(other.Velocities, other.Spins);
            Array.Copy(other.TwistRates, TwistRates, Shape.TwistCount);
        }

        /// <summary>Takes over velocities.</summary>
        public void Begin(Vector3d[] velocities, Vector3d[] spins)
        {
            Array.Copy(velocities, Velocities, Shape.ElementCount + 1);
            Array.Copy(spins, Spins, Shape.ElementCount);
        }

        /// <summary>Writes or restores the motion.</summary>
        public void Serialize(Snapshot snapshot)
        {
            Shape.Serialize(snapshot);
            Shape.SerializeVessel(snapshot);
            snapshot.Serialize(Velocities, Shape.ElementCount + 1);
            snapshot.Serialize(Spins, Shape.ElementCount);
            snapshot.Serialize(TwistRates, Shape.TwistCount);
        }
    }
}
