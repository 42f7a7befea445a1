namespace Guidewire.Core
{
    /// <summary>All parameters of a run, as typed values in groups. The initial values are the defaults of the
    /// thesis (table 4.1). Text, units, allowed ranges and the methods that take each stand in the parameter table of
    /// Guidewire.Io.</summary>
    public sealed class SimulationParameters
    {
        /// <summary>Says what is simulated.</summary>
        public SceneParameters Scene { get; private set; } = new SceneParameters();

        /// <summary>Says what moves it.</summary>
        public DriveParameters Drive { get; private set; } = new DriveParameters();

        /// <summary>The wire of solver pbd.</summary>
        public PbdParameters Pbd { get; private set; } = new PbdParameters();

        /// <summary>The wire as a material, for the other solvers.</summary>
        public MaterialParameters Material { get; private set; } = new MaterialParameters();

        /// <summary>How it touches walls.</summary>
        public ContactParameters Contact { get; private set; } = new ContactParameters();

        /// <summary>How it is simulated.</summary>
        public MethodParameters Method { get; private set; } = new MethodParameters();

        /// <summary>The defaults of a method: those of the thesis, but where they would mean something else to
        /// it.</summary>
        public static SimulationParameters DefaultsOf(Solver solver)
        {
            var parameters = new SimulationParameters();
            parameters.Method.Solver = solver;
            MethodTable.Of(solver).SetDefaults(parameters);
            return parameters;
        }

        /// <summary>The same scene with a catheter as if it were the wire.</summary>
        /// <param name="axis">Of the wire at its start, along which the catheter's hub moves.</param>
        internal SimulationParameters OfCatheter(Catheter catheter, in Vector3d axis)
        {
            SimulationParameters own = Copy();
            own.Scene.GuidewireLength = catheter.Length;
            own.Scene.NumberRodElements = catheter.Elements;
            own.Scene.GuidewireOffset += catheter.Start;
            own.Scene.TipForce = catheter.TipForce;
            own.Scene.TipForceTable = null;
            own.Scene.DistributedForce = catheter.DistributedForce;
            own.Scene.DistributedForceTable = null;
            own.Scene.PointLoads = catheter.PointLoads;
            own.Scene.PointLoadsTable = null;
            own.Material = catheter.Material.Copy();
            own.Material.MassRule = Material.MassRule;
            own.Drive = catheter.Drive.Copy();
            own.Drive.Kind = Core.Drive.Displace;
            own.Drive.DisplacementDirection = axis;
            return own;
        }

        /// <summary>The same values; lists, walls and steering are shared.</summary>
        internal SimulationParameters Copy()
        {
            return new SimulationParameters
            {
                Scene = Scene.Copy(),
                Drive = Drive.Copy(),
                Pbd = Pbd.Copy(),
                Material = Material.Copy(),
                Contact = Contact.Copy(),
                Method = Method.Copy(),
            };
        }
    }

    /// <summary>Contact with walls, for methods that support them.</summary>
    public sealed class ContactParameters
    {
        /// <summary>The radius r of a sphere, units.</summary>
        public double SphereRadius { get; set; } = 5.0;

        /// <summary>Distance kept beyond the radius, in units.</summary>
        public double CollisionMargin { get; set; }

        /// <summary>k_C, gain of a contact, dimensionless.</summary>
        public double CollisionStiffness { get; set; } = 1e-4;

        /// <summary>What touches a wall besides the spheres.</summary>
        public ElementContact ElementContact { get; set; } = ElementContact.Barycentric;

        /// <summary>g0, the gap below which barriers act on a wire with a material, m; 0: by rule (<see
        /// cref="BarrierDefaults"/>).</summary>
        public double ContactDistance { get; set; }

        /// <summary>Stiffness of the barrier, N/m; 0: by rule.</summary>
        public double ContactStiffness { get; set; }

        /// <summary>Elastic displacement along a wall from which a contact of a wire with a material slips, m; 0: by
        /// rule (<see cref="FrictionEnergy"/>).</summary>
        public double ElasticSlip { get; set; }

        /// <summary>Whether a wire with a material touches itself; null: where it has walls.</summary>
        public bool? SelfContact { get; set; }

        /// <summary>Friction coefficient of the wire on itself, dimensionless.</summary>
        public double SelfFriction { get; set; }

        /// <summary>Whether a wire between so many walls touches itself, with a method that has barriers.</summary>
        internal bool TouchesItself(int wallCount) => SelfContact ?? wallCount > 0;

        /// <summary>The same values; lists and walls are shared.</summary>
        internal ContactParameters Copy() => (ContactParameters)MemberwiseClone();
    }

    /// <summary>Contact of rod elements with walls, in addition to that of spheres.</summary>
    public enum ElementContact
    {
        /// <summary>Rod elements; the correction is split between their two spheres by the lever rule.</summary>
        Barycentric,

        /// <summary>Elements have no contact of their own.</summary>
        None,

        /// <summary>Rod elements, by the rule as published (thesis 3.1.2).</summary>
        Thesis,
    }
}
