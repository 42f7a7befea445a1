using System;

namespace Guidewire.Core
{
    /// <summary>Forces on the nodes of constant direction in the world: weight, force per length, point loads, tip
    /// force, axial force. Energy -sum f_i . x_i.</summary>
    internal sealed class DeadLoads : EnergyTerm
    {
        private readonly RodMass _mass;
        private readonly double[] _length;  // of the elements, m

        /// <summary>Makes loads of 0 on each of the n+1 nodes.</summary>
        public DeadLoads(RodMass mass, double[] length)
        {
            _mass = mass;
            _length = length;
            Force = new Vector3d[mass.Nodal.Length];
        }

        /// <summary>Force on each node, N.</summary>
        public Vector3d[] Force { get; }

        /// <summary>Sets all that is prescribed at this time, s.</summary>
        public void Set(RodSchedule schedule, double time)
        {
            Set(schedule.Loads.GravityAt(time), schedule.DistalForceAt(time));
            if (schedule.Loads.HasDistributedForce)
            {
                AddPerLength(schedule.Loads.DistributedForceAt(time));
            }
            foreach (PointLoad load in schedule.Loads.PointLoads)
            {
                AddAt(load.At, schedule.Loads.PointLoadsFactor(time) * load.Force);
            }
            Force[0] += schedule.Loads.ProximalForce;
        }

        /// <summary>Adds a force, N, at a length along the wire at rest, m: on the spheres beside it by the lever rule,
        /// so that it does the same work.</summary>
        public void AddAt(double length, in Vector3d force)
        {
            int j = 0;
            while (j < _mass.ElementCount - 1 && length > _length[j])
            {
                length -= _length[j++];
            }
            double fraction = Math.Min(1.0, length / _length[j]);
            Force[j] += (1.0 - fraction) * force;
            Force[j + 1] += fraction * force;
        }

        /// <summary>Sets the weight of the rod under gravity g (m/s^2), by the mass of each node, and adds the force
        /// at the tip (N).</summary>
        public void Set(in Vector3d gravity, in Vector3d tipForce)
        {
            for (int i = 0; i <= _mass.ElementCount; i++)
            {
                Force[i] = _mass.Nodal[i] * gravity;
            }
            Force[_mass.ElementCount] += tipForce;
        }

        /// <summary>Adds a force per length of the wire at rest, N/m: half of each element's on either node.</summary>
        public void AddPerLength(in Vector3d force)
        {
            for (int j = 0; j < _mass.ElementCount; j++)
            {
                Vector3d half = (0.5 * _length[j]) * force;
                Force[j] += half;
                Force[j + 1] += half;
            }
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            for (int i = 0; i <= shape.ElementCount; i++)
            {
                sum -= Vector3d.Dot(Force[i], shape.X[i]);
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            for (int i = from; i < to; i++)
            {
                gradient[i].AddX(-Force[i]);
            }
        }
    }
}
