using System;

namespace Guidewire.Core
{
    /// <summary>Strains, stresses and energies along a wire at one time, in SI units: for logs and pictures
    /// only.</summary>
    /// <remarks>Forces and couples are those that the piece towards the tip exerts on the piece towards the proximal
    /// end, along the world's axes, by the law of the material in this shape.</remarks>
    public sealed class StressRecord
    {
        /// <param name="jointLengths">Of the wire that each joint stands for, m; they may change.</param>
        internal StressRecord(double[] jointLengths)
        {
            int n = jointLengths.Length - 1;
            Strain = new Vector3d[n];
            Force = new Vector3d[n];
            Curvature = new Vector3d[n + 1];
            Couple = new Vector3d[n + 1];
            JointLength = jointLengths;
        }

        /// <summary>Shear along d1 and d2 and stretch along d3 of each of the n elements, dimensionless.</summary>
        public Vector3d[] Strain { get; }

        /// <summary>Force in each of the n elements, N.</summary>
        public Vector3d[] Force { get; }

        /// <summary>Curvature about d1 and d2 and twist about d3 at each of the n+1 joints, rad/m: 0 at an end without
        /// a clamp.</summary>
        public Vector3d[] Curvature { get; }

        /// <summary>Couple at each of the n+1 joints, N m: 0 at an end without a clamp.</summary>
        public Vector3d[] Couple { get; }

        /// <summary>Largest strain by bending of the core's fibres at each of the n+1 joints; empty of a linear
        /// wire.</summary>
        public double[] CoreStrain { get; private set; } = Array.Empty<double>();

        /// <summary>Share of the core's section there whose fibres have left their line, from 0 to 1; empty of a linear
        /// wire.</summary>
        public double[] CoreShare { get; private set; } = Array.Empty<double>();

        /// <summary>Energy that the material of all instruments has turned into heat, J.</summary>
        public double MaterialLoss { get; private set; }

        /// <summary>Energy of motion, J.</summary>
        public double KineticEnergy { get; private set; }

        /// <summary>Energy stored in the wire, J.</summary>
        public double ElasticEnergy { get; private set; }

        /// <summary>Minus the work of the loads that have a potential, J.</summary>
        public double PotentialEnergy { get; private set; }

        private double[] JointLength { get; }  // of wire that each joint stands for, m

        /// <summary>Takes the record of the part of a wire that is outside its sheath; the rest is straight, under the
        /// sheath's springs.</summary>
        /// <param name="rod">The whole wire.</param>
        /// <param name="first">The first element outside.</param>
        /// <param name="axis">Of the sheath, a unit vector.</param>
        /// <param name="thrust">Force of the hub along the axis, N.</param>
        /// <param name="torque">Torque of the wire on the sheathed part about it, N m.</param>
        internal void Record(StressRecord outside, MaterialRod rod, int first, in Vector3d axis, double thrust,
            double torque)
        {
            int n = rod.ElementCount - first;
            Array.Copy(outside.Strain, 0, Strain, first, n);
            Array.Copy(outside.Force, 0, Force, first, n);
            Array.Copy(outside.Curvature, 0, Curvature, first, n + 1);
            Array.Copy(outside.Couple, 0, Couple, first, n + 1);
            // Joint 0 of that part has the twist of all of the sheathed part.
            Vector3d bend = outside.Curvature[0];
            Curvature[first] = new Vector3d(bend.X, bend.Y, torque / rod.TwistStiffness[first]);
            for (int j = 0; j < first; j++)
            {
                Strain[j] = (-thrust / rod.StretchStiffness[j]) * Vector3d.UnitZ;
                Force[j] = -thrust * axis;
                Curvature[j] = (torque / rod.TwistStiffness[j]) * Vector3d.UnitZ;
                Couple[j] = torque * axis;
            }
            TakeEnergies(outside.KineticEnergy, outside.ElasticEnergy, outside.PotentialEnergy);
        }

        /// <summary>Takes what the fibres of an instrument are at its nodes; nothing of a linear one.</summary>
        internal void TakeFibres(RodTerms terms, RodShape shape, int instrument)
        {
            if (terms.Fibres?.Memory[instrument] == null)
            {
                return;
            }
            if (CoreStrain.Length == 0)
            {
                CoreStrain = new double[Curvature.Length];
                CoreShare = new double[Curvature.Length];
            }
            Array.Clear(CoreStrain, 0, CoreStrain.Length);
            Array.Clear(CoreShare, 0, CoreShare.Length);
            MaterialLoss = terms.Fibres.Loss;
            terms.Fibres.Visit(shape, (of, node, strain, share, _) =>
            {
                if (of == instrument)
                {
                    CoreStrain[node] = Math.Max(CoreStrain[node], strain);
                    CoreShare[node] = Math.Max(CoreShare[node], share);
                }
            });
        }

        /// <summary>Takes kinetic, elastic and potential energy, J.</summary>
        internal void TakeEnergies(double kinetic, double elastic, double potential)
        {
            KineticEnergy = kinetic;
            ElasticEnergy = elastic;
            PotentialEnergy = potential;
        }

        /// <summary>Takes the wire as it is.</summary>
        internal void Record(RodTerms terms, RodShape shape, double kineticEnergy)
        {
            int n = shape.ElementCount;
            terms.Bending.Measure(shape, Curvature);
            terms.Bending.Couples(shape, Couple);
            for (int k = 0; k <= n; k++)
            {
                Curvature[k] = (1.0 / JointLength[k]) * Curvature[k];
            }
            for (int j = 0; j < n; j++)
            {
                Force[j] = Quaterniond.Rotate(shape.Q[j], terms.Stretch.Stress(shape, j, out Vector3d p));
                Strain[j] = p - Vector3d.UnitZ;
            }
            TakeEnergies(kineticEnergy, terms.ElasticEnergy(shape), terms.LoadPotential(shape));
            if (terms.Supports.Coaxial == null)
            {
                TakeFibres(terms, shape, 0);
            }
        }
    }
}
