using System;

namespace Guidewire.Core
{
    /// <summary>The largest values in a run of the direct solver, in SI units, taken at the start and after every step.
    /// NaN for quantities that do not exist.</summary>
    public sealed class RunExtremes
    {
        private const double LeastMetal = 30e9;    // E of a core, Pa, that may be one of metal

        private Action<int, int, double, double, FibreSection>? _takeFibres;    // made once: a step leaves no garbage
        private FibreBending? _fibres;
        private double _fibreTime;      // s
        private Vector3d[] _turns = Array.Empty<Vector3d>();      // of the joints, rad
        private double[] _stretch = Array.Empty<double>();        // of the elements, without sign
        private double _curvatureSquared;

        internal RunExtremes()
        {
        }

        /// <summary>Largest curvature of any joint, without twist, 1/m.</summary>
        public double Curvature => Math.Sqrt(_curvatureSquared);

        /// <summary>Largest strain of the outermost fibre of the core: its radius times the change of a joint's
        /// curvature from rest, and the stretch or compression of the element beside it that has more.
        /// Dimensionless.</summary>
        public double Strain { get; private set; }

        /// <summary>When that strain was the largest, s.</summary>
        public double StrainTime { get; private set; }

        /// <summary>Length of the run's first step, s: 0 where it is over. A wire that sets out suddenly often has its
        /// largest values there.</summary>
        internal double FirstStep { get; set; }

        /// <summary>Largest strain by bending of the fibres of a core that may give way; NaN where all are
        /// linear.</summary>
        public double CoreStrain { get; private set; } = double.NaN;

        /// <summary>Instrument of that strain, 0 the outermost one.</summary>
        public int CoreInstrument { get; private set; }

        /// <summary>Where that strain was, m from the instrument's hub.</summary>
        public double CorePlace { get; private set; } = double.NaN;

        /// <summary>When that strain was, s.</summary>
        public double CoreTime { get; private set; } = double.NaN;

        /// <summary>Largest share of a section whose fibres had left their line, from 0 to 1.</summary>
        public double CoreShare { get; private set; } = double.NaN;

        /// <summary>Largest curvature that yielded cores keep at the end, where their couple is gone, rad/m.</summary>
        public double KeptCurvature { get; private set; } = double.NaN;

        /// <summary>Where a core keeps that, m from its hub.</summary>
        public double KeptPlace { get; private set; } = double.NaN;

        /// <summary>Energy that the material has turned into heat, J; NaN where all is linear.</summary>
        public double MaterialLoss { get; private set; } = double.NaN;

        /// <summary>Largest strain beyond that to which its law holds, of the latter.</summary>
        internal double LawShare { get; private set; }

        /// <summary>Largest strain by bending of a linear core as stiff as metal.</summary>
        internal double MetalStrain { get; private set; }

        /// <summary>Largest force of the hub along its axis, thrust or pull, N; NaN without walls.</summary>
        public double AxialForce { get; private set; } = double.NaN;

        /// <summary>When the hub's force was the largest, s; NaN without walls.</summary>
        public double AxialForceTime { get; private set; } = double.NaN;

        /// <summary>What the drag of massDamping was in that force, N; NaN without walls.</summary>
        public double AxialForceDrag { get; private set; } = double.NaN;

        /// <summary>Largest torque of the hub about its axis, in either sense, N m; NaN without walls.</summary>
        public double AxialTorque { get; private set; } = double.NaN;

        /// <summary>When the hub's torque was the largest, s; NaN without walls.</summary>
        public double AxialTorqueTime { get; private set; } = double.NaN;

        /// <summary>Largest normal force of the walls on one element, N; NaN without walls.</summary>
        public double ElementForce { get; private set; } = double.NaN;

        /// <summary>When that force was the largest, s; NaN without walls.</summary>
        public double ElementForceTime { get; private set; } = double.NaN;

        /// <summary>Largest of these forces over the element's length and diameter, Pa; NaN without walls.</summary>
        public double WallPressure { get; private set; } = double.NaN;

        /// <summary>Largest normal force between two elements of the wire that touch, N; NaN where it does not touch
        /// itself.</summary>
        public double StrandForce { get; private set; } = double.NaN;

        /// <summary>When that force was the largest, s.</summary>
        public double StrandForceTime { get; private set; } = double.NaN;

        /// <summary>Largest power of friction in a step, W: friction dissipates energy, so it is never positive. NaN
        /// where no wall has friction.</summary>
        public double FrictionPower { get; private set; } = double.NaN;

        /// <summary>Work of friction on what slips, J, minus the heat of all steps; NaN where no wall has friction.
        /// What its contacts store elastically is energy of the wire.</summary>
        public double FrictionWork { get; private set; } = double.NaN;

        /// <summary>Largest displacement of a soft wall, m; NaN where all are rigid. A snapshot does not have it.
        /// </summary>
        public double WallDisplacement { get; private set; } = double.NaN;

        /// <summary>Work on the wire of walls that move, J, minus the heat of walls that follow with a delay, in all
        /// steps; NaN where there is neither.</summary>
        public double WallWork { get; internal set; } = double.NaN;

        /// <summary>The largest over its wall's limit.</summary>
        internal double LimitShare { get; private set; }

        /// <summary>Takes what the wire's shape alone says.</summary>
        /// <param name="joints">The n + 1 joints.</param>
        /// <param name="lengths">The length that each of them stands for, m.</param>
        /// <param name="time">s.</param>
        internal void TakeShape(RodTerms terms, Joint[] joints, double[] lengths, RodShape shape, double time)
        {
            MaterialRod rod = terms.Rod;
            int n = shape.ElementCount;
            if (_turns.Length < n + 1)
            {
                _turns = new Vector3d[rod.Capacity + 1];
                _stretch = new double[rod.Capacity];
            }
            terms.Bending.Measure(shape, _turns);
            CoaxialJoints? coaxial = terms.Supports.Coaxial?.Joints;
            for (int j = 0; j < n; j++)
            {
                double length = Vector3d.Distance(shape.X[j], shape.X[j + 1]);
                _stretch[j] = coaxial == null ? Math.Abs(length / rod.Length[j] - 1.0)
                    : terms.Supports.Coaxial!.Axial.StrainAt(j, length);
            }
            double largest = _curvatureSquared;
            double strain = Strain;
            for (int k = 0; k <= n; k++)
            {
                Vector3d turn = _turns[k];
                double fraction = terms.Supports.FractionOutside(k);
                Vector3d change = turn - (terms.Supports.Winds ? coaxial![k].Alone.Rest : fraction * joints[k].Rest);
                if (fraction <= CoaxialJoints.MinFraction)
                {
                    continue;
                }
                double length = fraction * lengths[k];
                if (coaxial != null)
                {
                    // Lengths at the outer tip change; there the joint's frame is the inner one's.
                    length = fraction * coaxial.LengthOf(k);
                    change = coaxial.IsTip(k) ? Vector3d.Zero : change;
                }
                double perLength = 1.0 / length;
                largest = Math.Max(largest, perLength * perLength * (turn.X * turn.X + turn.Y * turn.Y));
                int before = Math.Max(k - 1, 0);
                int after = Math.Min(k, n - 1);
                // An end without a clamp has no joint, and no turn.
                double bend = (k > 0 || terms.Supports.HasProximalJoint) && (k < n || terms.Supports.HasDistalJoint)
                    ? perLength * Math.Sqrt(change.X * change.X + change.Y * change.Y) : 0.0;
                double core = Math.Max(rod.CoreRadius[before], rod.CoreRadius[after]);
                strain = Math.Max(strain, core * bend + Math.Max(_stretch[before], _stretch[after]));
                bool isMetal = terms.Fibres == null && rod.BendStiffness1[after]
                    > LeastMetal * 0.25 * Math.PI * Math.Pow(core, 4.0);
                MetalStrain = Math.Max(MetalStrain, isMetal ? core * bend : 0.0);
            }
            _curvatureSquared = largest;
            TakeStrain(strain, time);
        }

        /// <summary>Whether a time is that of the first step, in which the wire sets out.</summary>
        public bool IsFirstStep(double time) => time > 0.0 && time <= FirstStep;

        /// <summary>Takes what the fibres of all instruments are.</summary>
        internal void TakeFibres(RodTerms terms, RodShape shape, double time)
        {
            if (terms.Fibres != null)
            {
                RecordFibres(terms.Fibres, shape, time);
            }
        }

        private void RecordFibres(FibreBending fibres, RodShape shape, double time)
        {
            MaterialLoss = fibres.Loss;
            CoreShare = Larger(CoreShare, 0.0);
            (_fibres, _fibreTime) = (fibres, time);
            fibres.Visit(shape, _takeFibres ??= TakeFibres);
            (KeptCurvature, KeptPlace) = fibres.LargestKept();
        }

        private void TakeFibres(int instrument, int node, double strain, double share, FibreSection section)
        {
            if (!(CoreStrain >= strain))
            {
                (CoreStrain, CoreInstrument, CoreTime) = (strain, instrument, _fibreTime);
                CorePlace = _fibres!.Memory[instrument]!.Stations[node];
            }
            CoreShare = Math.Max(CoreShare, share);
            LawShare = Math.Max(LawShare, strain / section.Law.LargestStrain);
        }

        /// <summary>Takes a strain of an instrument; what is not a number is more than any.</summary>
        /// <param name="time">s.</param>
        internal void TakeStrain(double strain, double time)
        {
            StrainTime = strain <= Strain ? StrainTime : time;
            Strain = strain <= Strain ? Strain : double.IsNaN(strain) ? double.MaxValue : strain;
        }

        /// <summary>Takes what the hub does.</summary>
        /// <param name="force">Along its axis, N.</param>
        /// <param name="torque">About it, N m.</param>
        /// <param name="time">s.</param>
        /// <param name="drag">What of the force the drag takes, N.</param>
        internal void TakeHub(double force, double torque, double time, double drag)
        {
            AxialForceDrag = AxialForce >= Math.Abs(force) ? AxialForceDrag : Math.Sign(force) * drag;
            AxialForceTime = AxialForce >= Math.Abs(force) ? AxialForceTime : time;
            AxialForce = Larger(AxialForce, Math.Abs(force));
            AxialTorqueTime = AxialTorque >= Math.Abs(torque) ? AxialTorqueTime : time;
            AxialTorque = Larger(AxialTorque, Math.Abs(torque));
        }

        /// <summary>Takes the normal forces of walls on elements.</summary>
        /// <param name="force">Largest on an element, N.</param>
        /// <param name="pressure">Largest of an element, Pa.</param>
        /// <param name="time">s.</param>
        internal void TakeWalls(double force, double pressure, double time)
        {
            ElementForceTime = ElementForce >= force ? ElementForceTime : time;
            ElementForce = Larger(ElementForce, force);
            WallPressure = Larger(WallPressure, pressure);
        }

        /// <summary>Takes the largest force between two elements, N.</summary>
        /// <param name="force">NaN where the wire does not touch itself.</param>
        /// <param name="time">s.</param>
        internal void TakeStrands(double force, double time)
        {
            if (force > 0.0 && !(StrandForce >= force))
            {
                StrandForceTime = time;
            }
            StrandForce = Larger(StrandForce, force);
        }

        /// <summary>Takes the displacements of soft walls.</summary>
        /// <param name="largest">m.</param>
        /// <param name="share">Largest over the wall's limit.</param>
        internal void TakeDisplacements(double largest, double share)
        {
            WallDisplacement = Larger(WallDisplacement, largest);
            LimitShare = Larger(LimitShare, share);
        }

        /// <summary>Takes what friction turned into heat in a step of dt (s).</summary>
        /// <param name="heat">J, 0 or more.</param>
        internal void TakeFriction(double heat, double dt)
        {
            FrictionPower = Larger(FrictionPower, 0.0 - heat / dt);
            FrictionWork = (double.IsNaN(FrictionWork) ? 0.0 : FrictionWork) - heat;
        }

        /// <summary>Writes or restores all of it.</summary>
        internal void Serialize(Snapshot snapshot)
        {
            _curvatureSquared = snapshot.Serialize(_curvatureSquared);
            Strain = snapshot.Serialize(Strain);
            StrainTime = snapshot.Serialize(StrainTime);
            AxialForceDrag = snapshot.Serialize(AxialForceDrag);
            AxialForce = snapshot.Serialize(AxialForce);
            AxialForceTime = snapshot.Serialize(AxialForceTime);
            AxialTorque = snapshot.Serialize(AxialTorque);
            AxialTorqueTime = snapshot.Serialize(AxialTorqueTime);
            ElementForce = snapshot.Serialize(ElementForce);
            ElementForceTime = snapshot.Serialize(ElementForceTime);
            WallPressure = snapshot.Serialize(WallPressure);
            StrandForce = snapshot.Serialize(StrandForce);
            StrandForceTime = snapshot.Serialize(StrandForceTime);
            FrictionPower = snapshot.Serialize(FrictionPower);
            FrictionWork = snapshot.Serialize(FrictionWork);
            MetalStrain = snapshot.Serialize(MetalStrain);
            CoreStrain = snapshot.Serialize(CoreStrain);
            CoreInstrument = snapshot.Serialize(CoreInstrument);
            CorePlace = snapshot.Serialize(CorePlace);
            CoreTime = snapshot.Serialize(CoreTime);
            CoreShare = snapshot.Serialize(CoreShare);
            KeptCurvature = snapshot.Serialize(KeptCurvature);
            KeptPlace = snapshot.Serialize(KeptPlace);
            MaterialLoss = snapshot.Serialize(MaterialLoss);
            LawShare = snapshot.Serialize(LawShare);
            if (snapshot.IsStep)
            {
                WallDisplacement = snapshot.Serialize(WallDisplacement);
                LimitShare = snapshot.Serialize(LimitShare);
            }
        }

        // Any number replaces NaN.
        private static double Larger(double before, double now) => before >= now ? before : now;
    }
}
