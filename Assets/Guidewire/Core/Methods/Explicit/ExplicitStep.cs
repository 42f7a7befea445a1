using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>The material's forces with explicit steps: half a step of motion, velocities from the forces there, the
    /// other half (position Verlet, order 2), on lumped masses and the wire's own rotary inertia.</summary>
    /// <remarks>Stable below 2/omega_max, with a rest curvature below 1/omega_max. The largest frequency is that of
    /// elements turning against their shear, sqrt(GA/(rho I)) = 2 sqrt(k G/rho)/r with the shear factor k, however
    /// coarse the wire is.</remarks>
    internal sealed class ExplicitStep : MaterialStep
    {
        private readonly NodalInertia _inertia;
        private readonly RodVector[] _gradient;
        private readonly int _substeps;
        private readonly double _remainingVelocity;
        private readonly double _stable;    // s
        private readonly string _remedy;    // of a wire that has blown up
        private double _time;

        /// <summary>Makes a step for this scene.</summary>
        /// <param name="record">Takes the support's force after each step, or null.</param>
        public ExplicitStep(MaterialScene scene, RodTerms terms, MethodParameters method, SolverReport report,
            ContactRecord? record)
            : this(scene, terms, new NodalInertia(terms.Mass, terms.Supports), method, report, record)
        {
        }

        private ExplicitStep(MaterialScene scene, RodTerms terms, NodalInertia inertia, MethodParameters method,
            SolverReport report, ContactRecord? record)
            : base(scene, terms, inertia, scene.Velocities, scene.Spins, method, report)
        {
            _inertia = inertia;
            _gradient = new RodVector[scene.Shape.ElementCount + 2];
            _substeps = method.Substeps;
            _remainingVelocity = Math.Exp(-scene.Rod.MassDamping * method.TimeStep / _substeps);
            _stable = StableTimeStep(scene.Rod, scene.Supports);
            double part = method.TimeStep / _substeps / _stable;
            Energy.Allowance = part < 1.0
                ? Math.Max(EnergyMonitor.MinAllowance, 2.0 / (1.0 - part * part)) : EnergyMonitor.MinAllowance;
            _remedy = Text(": a substep of {0:G4} s, stable in its rest shape below {1:G4} s; raise substeps");
            Contacts = record;
        }

        /// <inheritdoc/>
        public override void AddWarnings(List<RunWarning> warnings)
        {
            base.AddWarnings(warnings);
            if (!(TimeStep / _substeps <= _stable))
            {
                warnings.Add(WarningTable.SubstepUnstable.With(TimeStep / _substeps, _stable));
            }
        }

        /// <inheritdoc/>
        protected override double Time => _time;

        /// <inheritdoc/>
        public override ContactRecord? Contacts { get; }

        /// <inheritdoc/>
        public override void Advance(RodState state)
        {
            int last = Shape.ElementCount;
            double h = TimeStep / _substeps;
            Vector3d free = Shape.X[last] + TimeStep * Velocities[last];
            Drive.Prepare(Shape, _time);
            Vector3d reaction = Vector3d.Zero;
            for (int k = 0; k < _substeps; k++)
            {
                double start = _time + k * h;
                Drift(0.5 * h, start + 0.5 * h);
                Kick(h, start + 0.5 * h);
                reaction += _gradient[0].X;
                Drift(0.5 * h, start + h);
            }
            _time += TimeStep;
            if (HasBlownUp(_remedy))
            {
                return;
            }
            EndStep(free);
            if (Contacts != null)
            {
                Contacts.Reaction = reaction / _substeps;
            }
            Write(state);
        }

        /// <inheritdoc/>
        public override SolverReport? Report()
        {
            Results.Method = Text("explicit; stable below a substep of {1:G4} s");
            Results.StableSubstep = _stable;
            return Results;
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            MaterialSnapshot.Serialize(snapshot, Schedule, Shape, Velocities, Spins, ref _time);
            Ends.Serialize(snapshot);
            if (!snapshot.Section("explicit", SerializeHistory))
            {
                Energy.Start();
            }
            BeginTurns(snapshot, _time);
        }

        private void SerializeHistory(Snapshot snapshot)
        {
            Terms.Serialize(snapshot);
            Energy.Serialize(snapshot);
            Ends.SerializeWork(snapshot);
            Results.Serialize(snapshot);
            Rest.Serialize(snapshot);
        }

        /// <summary>The longest stable substep, s: 2/omega_max of a wire that is straight at rest, the true limit of an
        /// even one being no lower; 1/omega_max of one with a rest curvature.</summary>
        /// <remarks>Elements that turn to and fro by turns strain shear and joints: omega^2 = GA/(rho I) +
        /// 4 GA/(rho A l^2) + (sum of the joints' stiffness, those to neighbours twice)/(rho I l), by Gershgorin's
        /// circles for the joints. Against it stand the chain of axial springs, 4 EA/(rho A l^2), and that of twist.
        ///
        /// 2/omega_max bounds small swings about the rest shape, also of a curved wire. But one with a rest curvature
        /// moves far under forces of higher order in its strains, and its elements all have nearly the one frequency of
        /// shear. A step turns the phase of a swing by a, sin(a/2) = omega h/2, and k swings can feed each other where
        /// k phases make up a whole turn: from omega h = 2 sin(pi/k) on, 1.73 for three, 1.41 for four, 1.18 for five,
        /// 1 for six (numerical resonance; T. Schlick, M. Mandziuk, R. Skeel and K. Srinivas, J. Comput. Phys. 140,
        /// 1998). Wires let go from straight gained energy down to 1.2, and none at 1.1 and below.</remarks>
        public static double StableTimeStep(MaterialRod rod, RodSupports supports)
        {
            Joint[] joints = rod.Joints(supports);
            int n = rod.ElementCount;
            double largest = 0.0;
            for (int j = 0; j < n; j++)
            {
                double l = rod.Length[j];
                double rotary = Math.Min(rod.RotaryInertia1[j], rod.RotaryInertia2[j]);
                double polar = rod.RotaryInertia1[j] + rod.RotaryInertia2[j];
                double before = j > 0 ? 2.0 : supports.HasProximalJoint ? 1.0 : 0.0;
                double after = j < n - 1 ? 2.0 : supports.HasDistalJoint ? 1.0 : 0.0;
                double bend = (before * Stiffer(joints[j]) + after * Stiffer(joints[j + 1])) / (rotary * l);
                double twist = (before * joints[j].Twist + after * joints[j + 1].Twist) / (polar * l);
                double chain = 4.0 / (l * l * MinDensity(rod, j));
                double shear = rod.ShearStiffness[j] * (1.0 / rotary + chain);
                largest = Math.Max(largest, Math.Max(shear + bend, Math.Max(chain * rod.StretchStiffness[j], twist)));
            }
            bool isCurved = Array.Exists(rod.RestCurvature, curvature => curvature != Vector3d.Zero);
            return (isCurved ? 1.0 : 2.0) / Math.Sqrt(largest);
        }

        private static double Stiffer(in Joint joint) => Math.Max(joint.Bend1, joint.Bend2);

        // Line density behind the lighter node of element j: a node has half of each element beside it.
        private static double MinDensity(MaterialRod rod, int j)
        {
            int before = Math.Max(j - 1, 0);
            int after = Math.Min(j + 1, rod.ElementCount - 1);
            double lighter = Math.Min(rod.LineDensity[before] * rod.Length[before],
                rod.LineDensity[after] * rod.Length[after]);
            return 0.5 * (rod.LineDensity[j] + lighter / rod.Length[j]);
        }

        private string Text(string format) =>
            string.Format(CultureInfo.InvariantCulture, format, TimeStep / _substeps, _stable);

        private void Drift(double h, double time)
        {
            for (int i = 0; i < Velocities.Length; i++)
            {
                Shape.X[i] += h * Velocities[i];
            }
            for (int j = 0; j < Spins.Length; j++)
            {
                Quaterniond q = Shape.Q[j] * RotationVector.Exp(h * Spins[j]);
                Shape.Q[j] = (1.5 - 0.5 * q.LengthSquared) * q;
            }
            Ends.Place(Shape, time);
        }

        private void Kick(double h, double time)
        {
            int n = Spins.Length;
            Terms.SetTime(Schedule, time);
            Array.Clear(_gradient, 0, _gradient.Length);
            Terms.AddGradient(Shape, _gradient);
            for (int i = 0; i <= n; i++)
            {
                ref RodVector g = ref _gradient[i];
                Velocities[i] = _remainingVelocity * Velocities[i]
                    - (h * _inertia.InverseMass[i]) * g.X;
                if (i < n)
                {
                    Vector3d w = Spins[i];
                    Vector3d inverse = _inertia.InverseInertia[i];
                    Spins[i] = _remainingVelocity * w - h * (new Vector3d(inverse.X * g.T1, inverse.Y * g.T2,
                        inverse.Z * g.T3) + Terms.Mass.Precession(i, w));
                }
            }
        }
    }
}
