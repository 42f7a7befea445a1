using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Which spheres a log holds.</summary>
    public enum LoggedSpheres
    {
        /// <summary>All n + 1.</summary>
        All,

        /// <summary>The last one only.</summary>
        Last,
    }

    /// <summary>How a log is written.</summary>
    public enum LogFormat
    {
        /// <summary>The log is positions.json, a text.</summary>
        Json,

        /// <summary>positions.npz, arrays of doubles.</summary>
        Npz,

        /// <summary>positions.npz, arrays of 32 bits a number.</summary>
        Npz32,
    }

    /// <summary>All that a parameter file says: what is simulated, and what is written of it.</summary>
    public sealed class RunParameters
    {
        /// <summary>Makes the defaults of a method.</summary>
        public RunParameters(Solver solver)
        {
            Simulation = SimulationParameters.DefaultsOf(solver);
        }

        /// <summary>The parameters of Core.</summary>
        public SimulationParameters Simulation { get; }

        /// <summary>Folder of the results; empty where the command line must name it.</summary>
        public string LogFilePath { get; set; } = "";

        /// <summary>File with a start other than the straight wire; empty for none.</summary>
        public string StartFile { get; set; } = "";

        /// <summary>The same as given by its key, or null.</summary>
        internal JToken? Start { get; set; }

        /// <summary>When the run ends, s, instead of its largest number of steps; null once that is known.</summary>
        public double? Duration { get; set; }

        /// <summary>The point loads as given by their key, or null.</summary>
        internal JToken? PointLoads { get; set; }

        /// <summary>Name of the instrument that the wire is; empty for none.</summary>
        public string Instrument { get; set; } = "";

        /// <summary>EI of the whole wire instead of its modulus, N m^2; null where the modulus says it.</summary>
        public double? BendingStiffness { get; set; }

        /// <summary>GJ of the whole wire instead of its modulus, N m^2; null where the modulus says it.</summary>
        public double? TorsionalStiffness { get; set; }

        /// <summary>rho A of the whole wire instead of its density, kg/m; null where the density says it.</summary>
        public double? MassPerLength { get; set; }

        /// <summary>Where the vessel's origin lies, in units.</summary>
        public Vector3d Position { get; set; }

        /// <summary>Factors on the vessel's size along its own axes.</summary>
        public Vector3d Scale { get; set; } = new Vector3d(1.0, 1.0, 1.0);

        /// <summary>The vessel's Euler angles in degrees, about z, then x, then y, as in Unity.</summary>
        public Vector3d Rotation { get; set; }

        /// <summary>The vessel as given by its key, or null.</summary>
        internal JToken? Vessel { get; set; }

        /// <summary>The obstacles as their key has them, or null.</summary>
        internal JToken? Obstacles { get; set; }

        /// <summary>The sheath as given by its key, or null.</summary>
        internal JToken? Sheath { get; set; }

        /// <summary>The catheters as their key has them, or null.</summary>
        internal JToken? Catheters { get; set; }

        /// <summary>Of all that makes the catheters, a line each.</summary>
        internal string CatheterHashes { get; set; } = "";

        /// <summary>The end at which the wire starts as given by its key, or null.</summary>
        internal JToken? Inlet { get; set; }

        /// <summary>Where the tip is to come as given by its key, or null.</summary>
        internal JToken? Target { get; set; }

        /// <summary>Ends and centreline of the vessel as it is placed, or null where no file says them.</summary>
        internal Anatomy? Anatomy { get; set; }

        /// <summary>The path from the inlet to the target, or null where there is no inlet.</summary>
        internal CentrelinePath? Path { get; set; }

        /// <summary>Where instruments are in the vessel, or null where there is no inlet.</summary>
        internal LumenPlaces? Places { get; set; }

        /// <summary>Letters of the patient's axes as given by their key; empty where they are not.</summary>
        public string PatientAxes { get; set; } = "";

        /// <summary>The files of loads over time as their key has them, or null.</summary>
        internal JToken? LoadTables { get; set; }

        /// <summary>The file with the hub's displacement and turn over time; empty for none.</summary>
        public string DriveFile { get; set; } = "";

        /// <summary>The file with the proximal end's motion in six degrees of freedom; empty for none.</summary>
        public string ProximalMotionFile { get; set; } = "";

        /// <summary>The same for the distal end.</summary>
        public string DistalMotionFile { get; set; } = "";

        /// <summary>Every k-th step is logged.</summary>
        public int LogEvery { get; set; } = 1;

        /// <summary>Which spheres are logged.</summary>
        public LoggedSpheres LogSpheres { get; set; } = LoggedSpheres.All;

        /// <summary>How the log is written.</summary>
        public LogFormat LogFormat { get; set; } = LogFormat.Json;

        /// <summary>Whether orientations are logged too.</summary>
        public bool LogOrientations { get; set; }

        /// <summary>Whether strains, forces, couples, angular velocities and energies are logged too.</summary>
        public bool LogStrains { get; set; }

        /// <summary>Whether what is read off at the hub is logged too.</summary>
        public bool LogHub { get; set; }

        /// <summary>Whether contact forces are logged too.</summary>
        public bool LogContacts { get; set; }
    }
}
