using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Builds what is simulated of a wire in a catheter: scenes of both as if alone, and both as one
    /// rod.</summary>
    internal sealed class CoaxialSetup
    {
        private const double Nowhere = 1e9;     // m, farther than any drive goes
        private const double Rounding = 1e-6;   // of a length
        private const string CatheterName = "catheters[0]";

        private readonly SimulationParameters _parameters;
        private readonly InstrumentProfile _wireProfile;
        private readonly InstrumentProfile _catheterProfile;
        private readonly double _drag;
        private readonly Barrier _barrier;

        /// <summary>For the wire and the catheter of these parameters.</summary>
        public CoaxialSetup(SimulationParameters parameters)
        {
            _parameters = parameters;
            SimulationParameters wire = parameters.Copy();
            wire.Scene.Start = null;   // of a run that goes on; its snapshot says all of it
            Wire = SceneOf(wire);
            SimulationParameters catheter = wire.OfCatheter(parameters.Scene.Catheters[0], Axis);
            Catheter = SceneOf(catheter);
            _wireProfile = ProfileOf(wire, Wire.Metres);
            _catheterProfile = ProfileOf(catheter, Wire.Metres);
            _drag = parameters.Material.MassDamping;
            WireStations = CoaxialRod.StationsOf(Wire.Rod);
            if (parameters.Scene.Sheath != null)
            {
                Sheath = new SheathEnd(Wire.Metres * SheathExit.Find(parameters.Scene.Sheath, Wire), Axis);
            }
            if (Wire.Walls.Length > 0)
            {
                double step = parameters.Method.TimeStep;
                double move = Math.Max(parameters.Drive.LargestMove(step, Wire.Metres),
                    catheter.Drive.LargestMove(step, Wire.Metres));
                Barrier one = BarrierDefaults.Of(Wire.Rod, parameters.Contact, Wire.Walls, Wire.Metres, move);
                Barrier two = BarrierDefaults.Of(Catheter.Rod, parameters.Contact, Wire.Walls, Wire.Metres, move);
                double distance = Math.Min(one.Distance, two.Distance);
                _barrier = new Barrier(distance, Math.Max(one.Distance * one.Stiffness, two.Distance * two.Stiffness)
                    / distance);
            }
        }

        /// <summary>The wire as if it were alone.</summary>
        public MaterialScene Wire { get; }

        /// <summary>The catheter as if it were alone.</summary>
        public MaterialScene Catheter { get; }

        /// <summary>Where the sheath ends in which both are, or null.</summary>
        public SheathEnd? Sheath { get; }

        /// <summary>Along which both hubs move, a unit vector.</summary>
        public Vector3d Axis => Wire.Schedule.Hub.Frame.Director3;

        /// <summary>Radius of the catheter's lumen, m.</summary>
        public double LumenRadius => _parameters.Scene.Catheters[0].Material.InnerRadius;

        /// <summary>Distance of each of the wire's nodes from its hub, m.</summary>
        public double[] WireStations { get; }

        /// <summary>Both as one rod.</summary>
        /// <param name="beyond">Wire nodes beyond the catheter's tip.</param>
        /// <param name="lead">How far the wire's hub is behind the catheter's, m.</param>
        /// <param name="sheathed">How far the catheter's hub is from the exit of the sheath, m.</param>
        public CoaxialRod Rod(int beyond, double lead, double sheathed)
        {
            var rod = new CoaxialRod(Catheter.Rod, _catheterProfile, Wire.Rod, _wireProfile, beyond, lead,
                LumenRadius, sheathed) { Sheath = Sheath };
            rod.Rod.MassDamping = _drag;
            return rod;
        }

        /// <summary>A drive of one of the hubs along the axis.</summary>
        public MaterialDrive DriveOf(MaterialScene scene)
        {
            return new MaterialDrive(scene.Drive, scene.Schedule.Hub, Axis);
        }

        /// <summary>Lets hubs go in the step that begins at a time so far that neither passes the other one nor the
        /// exit of a sheath, and that the wire's tip stays in the catheter by an element at least.</summary>
        public void LimitDrives(MaterialDrive outer, MaterialDrive inner, CoaxialHubs hubs, double time)
        {
            double lead = hubs.LeadAt(time);
            double inside = WireStations[WireStations.Length - 1] - lead - Catheter.Rod.Length[0];
            double toExit = Sheath == null ? Nowhere : hubs.SheathedAt(time);
            outer.Limit(-Nowhere, toExit);
            double catheter = outer.NextMove(time);
            inner.Limit(Math.Min(0.0, catheter - inside), Math.Max(0.0, lead + catheter));
            double wire = inner.NextMove(time);
            outer.Limit(Math.Min(0.0, wire - lead), Math.Min(toExit, Math.Max(0.0, inside + wire)));
        }

        /// <summary>Energies and loads of both, which follow their hubs.</summary>
        public RodTerms Terms(MaterialScene scene, CoaxialHubs hubs)
        {
            WallTerms? walls = Wire.Walls.Length == 0 ? null
                : DirectSetup.WallTermsOf(_parameters, scene, _barrier, new SupportSpring(scene.Rod, 0.0),
                    _parameters.Scene.Catheters[0].FrictionCoefficient);
            var terms = new RodTerms(scene.Rod, scene.Supports, _parameters.Scene, walls, Array.Empty<EnergyTerm>());
            ((CoaxialBendTwist)terms.Bending).Hubs = hubs;
            return terms;
        }

        /// <summary>The motion of both.</summary>
        public RodDynamics Dynamics(MaterialScene scene, RodTerms terms)
        {
            return DirectSetup.DynamicsOf(_parameters, scene, terms);
        }

        /// <summary>What is wrong with the start between walls, in one phrase, or null: of the catheter, and of the
        /// wire beyond it; in a sheath, of what is beyond its exit.</summary>
        public string? FindProblemOfStart()
        {
            if (Sheath != null)
            {
                return FindProblemBeyondSheath(Sheath);
            }
            double tip = Catheter.Schedule.Hub.PositionAt(0.0).Z - Wire.Schedule.Hub.PositionAt(0.0).Z
                + Catheter.Rod.TotalLength;
            int n = Wire.Rod.ElementCount;
            int first = Array.FindIndex(WireStations, 1, station => station > tip);
            return MaterialStart.FindProblem(Catheter, 0, Catheter.Rod.ElementCount, name: CatheterName)
                ?? (first < 0 ? null : MaterialStart.FindProblem(Wire, first - 1, n));
        }

        // That of the wire is found as if it were alone.
        private string? FindProblemBeyondSheath(SheathEnd sheath)
        {
            Vector3d[] x = Catheter.Shape.X;
            int inside = sheath.NodesInside(x);
            if (inside == 0)
            {
                return Text(CatheterName + " has to start with its hub in the sheath: it is {0:G4} m beyond the exit",
                    sheath.Outside(x[0]));
            }
            double available = -sheath.Outside(x[0]);
            double asked = _parameters.Scene.Catheters[0].Drive.LargestInsertion(
                _parameters.Method.MaxSimulationSteps * _parameters.Method.TimeStep);
            if (asked > available * (1.0 + Rounding))
            {
                return Text(CatheterName + ": an insertion of {0:G4} m is more than its hub's distance from the"
                    + " sheath's exit, {1:G4} m", asked, available);
            }
            return inside == x.Length ? null : MaterialStart.FindProblemFrom(Catheter, inside - 1,
                (1.0 / Wire.Metres) * sheath.Exit, CatheterName);
        }

        private static string Text(string format, params object[] numbers)
        {
            return string.Format(CultureInfo.InvariantCulture, format, numbers);
        }

        private static MaterialScene SceneOf(SimulationParameters parameters)
        {
            return new MaterialScene(parameters, new Scene(parameters));
        }

        private static InstrumentProfile ProfileOf(SimulationParameters parameters, double metres)
        {
            return new InstrumentProfile(
                new WireProfile(parameters.Material, parameters.Scene.GuidewireLength), metres);
        }
    }
}
