using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;

namespace Guidewire.Core
{
    /// <summary>Builds the simulation of a wire in a sheath or in one or two catheters: a scene for each instrument,
    /// and one rod for all.</summary>
    internal sealed class CoaxialSetup
    {
        private const double Rounding = 1e-6;   // of a length
        private const int MaxSearches = 8;     // of rest shapes
        private const double SameLength = 1e-12;    // of a length
        private const double OfRadius = 0.01;   // of a radius, by which a hub gives way at first
        private const string CatheterName = "catheters[0]";    // whose hub goes to the exit of a sheath

        private readonly SimulationParameters _parameters;
        private readonly double _drag;
        private readonly Barrier _barrier;
        private readonly HubLimit _limit;       // of the hub of an instrument alone
        private readonly RodStart[] _starts = Array.Empty<RodStart>();    // of each instrument

        /// <summary>For the wire and the catheters of these parameters.</summary>
        public CoaxialSetup(SimulationParameters parameters)
        {
            _parameters = parameters;
            IReadOnlyList<Catheter> catheters = parameters.Scene.Catheters;
            Work = new WorkLimit(parameters.Method.MaxNewtonIterations,
                parameters.Scene.Walls.Length == 0 ? 0
                    : catheters.Select(one => HubLimit.Of(one.Drive, one.Material))
                        .Append(HubLimit.Of(parameters.Drive, parameters.Material)).Count(limit => limit.IsLimited));
            int count = catheters.Count + 1;
            Scenes = new MaterialScene[count];
            Instruments = new CoaxialInstrument[count];
            SimulationParameters wire = parameters.Copy();
            // Without a hub that of catheters is of a run that goes on, and its snapshot says all of it.
            RodStart? start = wire.Scene.Start;
            wire.Scene.Start = count == 1 && start?.Hub == null ? start : null;
            Scenes[count - 1] = SceneOf(wire);
            Instruments[count - 1] = new CoaxialInstrument(Wire.Rod, ProfileOf(wire, Wire.Metres));
            for (int i = 0; i < catheters.Count; i++)
            {
                SimulationParameters own = wire.OfCatheter(catheters[i], Axis);
                Scenes[i] = SceneOf(own);
                Instruments[i] = new CoaxialInstrument(Scenes[i].Rod, ProfileOf(own, Wire.Metres),
                    catheters[i].Material.InnerRadius);
            }
            _drag = parameters.Material.MassDamping;
            if (parameters.Scene.Sheath != null)
            {
                Sheath = new SheathEnd(SheathExit.Find(parameters.Scene.Sheath, Wire), Axis);
            }
            if (start?.Hub != null)
            {
                _starts = start.Catheters.Append(start).ToArray();
                TakeStarts();
            }
            if (HasContact)
            {
                _barrier = FindBarrier();
            }
            _limit = count == 1 ? HubLimit.Of(parameters.Drive, parameters.Material) : HubLimit.None;
        }

        /// <summary>Each instrument as if it were alone, the outermost catheter first, the wire last.</summary>
        public MaterialScene[] Scenes { get; }

        /// <summary>The wire as if it were alone.</summary>
        public MaterialScene Wire => Scenes[Scenes.Length - 1];

        /// <summary>The outermost catheter as if it were alone.</summary>
        public MaterialScene Catheter => Scenes[0];

        /// <summary>What each is made of, in the same order.</summary>
        public CoaxialInstrument[] Instruments { get; }

        /// <summary>Where the sheath ends in which all are, or null.</summary>
        public SheathEnd? Sheath { get; }

        /// <summary>Along which all hubs move, a unit vector.</summary>
        public Vector3d Axis => Wire.Schedule.Hub.Frame.Director3;

        /// <summary>Takes what the forces at the hubs strain the instruments by, friction in lumens among
        /// them.</summary>
        public void TakeStrains(CoaxialRecord[] records, SolverReport report, double time)
        {
            report.Extremes?.TakeStrain(Math.Abs(records[0].WireForce) / StretchAtHub(Instruments.Length - 1), time);
            for (int i = 0; i < records.Length; i++)
            {
                report.Extremes?.TakeStrain(Math.Abs(records[i].Force) / StretchAtHub(i), time);
            }
        }

        /// <summary>Gives all as one rod.</summary>
        /// <param name="beyond">Nodes of each beyond the tips around it.</param>
        /// <param name="leads">How far the hub of each is behind the outermost one's, m.</param>
        /// <param name="first">Elements of the outermost one that are left out.</param>
        /// <param name="sheathed">Length in the sheath, m.</param>
        public CoaxialRod Rod(int[] beyond, double[] leads, int first, CoaxialHubs hubs, double sheathed)
        {
            var rod = new CoaxialRod(Instruments, beyond, leads, sheathed, first)
            {
                Sheath = Sheath,
                Hubs = hubs,
            };
            rod.Rod.MassDamping = _drag;
            return rod;
        }

        /// <summary>Drives of the hubs along the axis.</summary>
        public MaterialDrive[] Drives()
        {
            MaterialDrive[] drives = Array.ConvertAll(Scenes,
                scene => new MaterialDrive(scene.Drive, scene.Schedule.Hub, Axis));
            for (int i = 0; i < _starts.Length; i++)
            {
                (double insertion, double turn) = _starts[i].Hub!.Value;
                drives[i].BeginAt(insertion, turn);
            }
            return drives;
        }

        /// <summary>Whether the run starts where a start has the instruments.</summary>
        public bool HasStart => _starts.Length > 0;

        /// <summary>What hubs with a hubForceLimit do; that of an instrument alone slips on its spring.</summary>
        public HubSlip[] Slips(MaterialDrive[] drives)
        {
            var slips = new HubSlip[drives.Length];
            for (int i = 0; i < slips.Length; i++)
            {
                DriveParameters drive = i == slips.Length - 1 ? _parameters.Drive
                    : _parameters.Scene.Catheters[i].Drive;
                MaterialParameters material = i == slips.Length - 1 ? _parameters.Material
                    : _parameters.Scene.Catheters[i].Material;
                slips[i] = new HubSlip(
                    slips.Length == 1 || Wire.Walls.Length == 0 ? HubLimit.None : HubLimit.Of(drive, material),
                    OfRadius * Scenes[i].Rod.Radius[0], drives[i].LargestSlip);
            }
            return slips;
        }

        /// <summary>Gives the results of each catheter, the outermost one first.</summary>
        public CoaxialRecord[] Records()
        {
            IReadOnlyList<Catheter> catheters = _parameters.Scene.Catheters;
            double slip = _parameters.Contact.ElasticSlip > 0.0 ? _parameters.Contact.ElasticSlip
                : FrictionEnergy.ElasticSlipOf(Wire.Rod);
            var records = new CoaxialRecord[catheters.Count];
            for (int i = records.Length - 1; i >= 0; i--)
            {
                records[i] = new CoaxialRecord(Scenes[i].Rod.ElementCount, Wire.Metres,
                    Instruments[i].LumenRadius, new LumenFriction(catheters[i].LumenFriction, slip), i,
                    ContactRecord.HasSoft(Wire.Walls), _parameters.Contact.TouchesItself(Wire.Walls.Length))
                {
                    Inside = i + 1 < records.Length ? records[i + 1] : null,
                };
            }
            return records;
        }

        /// <summary>Lays a chain, and what moves it, where the start has the instruments: of one alone that is its
        /// shape from an element on.</summary>
        public void CopyStart(MaterialScene scene, int first, CoaxialHubs hubs)
        {
            if (Scenes.Length > 1)
            {
                if (HasStart)
                {
                    new StartedChain(this, hubs, scene.Supports.Coaxial!.Joints).SetFrom(scene);
                }
                return;
            }
            RodShape shape = scene.Shape;
            int n = shape.ElementCount;
            Array.Copy(Wire.Shape.X, first, shape.X, 0, n + 1);
            Array.Copy(Wire.Shape.Q, first, shape.Q, 0, n);
            Array.Copy(Wire.Velocities, first, scene.Velocities, 0, n + 1);
            Array.Copy(Wire.Spins, first, scene.Spins, 0, n);
            shape.DistalFrame = Wire.Shape.DistalFrame;
        }

        /// <summary>Gives the energies and loads of all, which follow their hubs.</summary>
        public RodTerms Terms(MaterialScene scene)
        {
            var hub = new SupportSpring(scene.Rod, _limit) { Axis = Axis };
            Hold(scene, hub);
            WallTerms? walls = !HasContact ? null
                : DirectSetup.WallTermsOf(_parameters, scene, _barrier, hub);
            var terms = new RodTerms(scene.Rod, scene.Supports, _parameters.Scene, walls, Array.Empty<EnergyTerm>());
            terms.CoaxialLoads = Scenes.Length == 1 ? null : new CoaxialLoads(scene.Supports.Coaxial!, Instruments,
                Array.ConvertAll(Scenes, one => one.Schedule.Loads));
            return terms;
        }

        /// <summary>The terms of a scene whose elements are others, as they are made.</summary>
        public void Remesh(MaterialScene scene, RodTerms terms)
        {
            terms.Remesh();
            WallTerms? walls = terms.Walls();
            if (walls != null)
            {
                Hold(scene, walls.Spring);
                walls.Friction?.Remesh(scene.Rod.ElementCount);
                DirectSetup.SetFriction(_parameters, scene, walls.Friction);
            }
        }

        private void Hold(MaterialScene scene, SupportSpring hub)
        {
            CoaxialRod rod = scene.Supports.Coaxial!;
            if (rod.Joints.First == 0)
            {
                hub.Hold(scene.Rod);
                return;
            }
            double all = rod.Joints.AxialBetween(0.0, Catheter.Rod.Length[0], 0, out double own);
            hub.Hold(Catheter.Rod, own / all);
            hub.SetBefore(rod.Axial.LeadLength, rod.Joints.LeadAxial);
        }

        /// <summary>Takes the directions of the loads along the instruments.</summary>
        /// <returns>The largest change of what an element is longer by, m.</returns>
        public static double TakeLoads(MaterialScene scene, RodTerms terms)
        {
            double change = scene.Supports.Coaxial!.TakeLoads(scene.Shape);
            SetLead(scene, terms);
            return change;
        }

        /// <summary>Takes what of the thrust of instruments the tips around them bear, in a shape in balance.</summary>
        /// <returns>The largest change of what an element is longer by, m.</returns>
        public static double TakeBorne(MaterialScene scene, RodTerms terms)
        {
            double change = terms.Release!.TakeBorne(scene.Shape, terms);
            scene.Supports.Coaxial!.Axial.BeginStep();
            scene.Supports.Coaxial.SetLengths();
            return change;
        }

        /// <summary>Sets how long and how soft the part before the chain is where the hubs are.</summary>
        public static void SetLead(MaterialScene scene, RodTerms terms)
        {
            CoaxialRod rod = scene.Supports.Coaxial!;
            if (rod.Joints.First > 0)
            {
                terms.Walls()!.Spring.SetBefore(rod.Axial.LeadLength, rod.Joints.LeadAxial);
            }
        }

        /// <summary>What the run may take.</summary>
        public WorkLimit Work { get; }

        /// <summary>Gives the motion of all.</summary>
        public RodDynamics Dynamics(MaterialScene scene, RodTerms terms) =>
            DirectSetup.DynamicsOf(_parameters, scene, terms, Work);

        /// <summary>Finds the rest shape of all. Along the axis loads have the directions of a shape: so it is found
        /// again until both agree.</summary>
        /// <returns>Why there is none, or null.</returns>
        public string? FindRestShape(MaterialScene scene, RodTerms terms, SolverReport report)
        {
            MethodParameters method = _parameters.Method;
            double change = double.PositiveInfinity;
            string? failure = null;
            for (int k = 0; k < MaxSearches && failure == null && change > SameLength * scene.Rod.TotalLength; k++)
            {
                change = k == 0 ? change : Math.Max(TakeLoads(scene, terms), TakeBorne(scene, terms));
                failure = new RestShape(scene, terms, Math.Min(method.SolverTolerance, 1e-9),
                    RestShape.IterationFactor * method.MaxNewtonIterations, report).Find(scene.Shape);
            }
            return failure;
        }

        /// <summary>What is wrong with the start that parameters describe, in one phrase, or null.</summary>
        public static string? FindProblemOfStart(SimulationParameters parameters)
        {
            try
            {
                return new CoaxialSetup(parameters).FindProblemOfStart();
            }
            catch (ArgumentException error)
            {
                return error.Message;
            }
        }

        /// <summary>What is wrong with the start between walls, in one phrase, or null: of the outermost catheter, and
        /// of the others beyond it; in a sheath, of what is beyond its exit.</summary>
        public string? FindProblemOfStart()
        {
            if (Sheath != null)
            {
                return Scenes.Length == 1 ? null : FindProblemBeyondSheath(Sheath);
            }
            double tip = 0.0;      // the farthest so far, m from the outermost hub
            string? problem = null;
            for (int i = 0; i < Scenes.Length && problem == null; i++)
            {
                double lead = Vector3d.Dot(
                    Catheter.Schedule.Hub.PositionAt(0.0) - Scenes[i].Schedule.Hub.PositionAt(0.0), Axis);
                double around = lead + tip;
                int first = i == 0 ? 1 : Array.FindIndex(Instruments[i].Stations, 1, station => station > around);
                int end = Scenes[i].Rod.ElementCount;
                problem = first < 0 ? null
                    : i == Scenes.Length - 1 ? MaterialStart.FindProblem(Scenes[i], first - 1, end)
                    : MaterialStart.FindProblem(Scenes[i], first - 1, end, name: "catheters[" + i + "]");
                tip = Math.Max(tip, Scenes[i].Rod.TotalLength - lead);
            }
            return problem;
        }

        private void TakeStarts()
        {
            if (_starts.Length != Scenes.Length)
            {
                throw new ArgumentException("the start has " + (_starts.Length - 1) + " catheters, the scene "
                    + (Scenes.Length - 1));
            }
            for (int i = 0; i < _starts.Length; i++)
            {
                if (!(_starts[i].Hub is (double insertion, double turn)))
                {
                    throw new ArgumentException("the start has no hub of each instrument");
                }
                Scenes[i].Schedule.Hub.BeginAt(insertion * Axis, turn);
                Scenes[i].StartFrom(_starts[i]);
                string? other = StartedChain.FindOther(Scenes[i]);
                if (other != null)
                {
                    throw new ArgumentException((i == Scenes.Length - 1 ? "" : "catheters[" + i + "]: ") + other);
                }
            }
            var hubs = new CoaxialHubs(Array.ConvertAll(Scenes, scene => scene.Schedule.Hub), Axis, Sheath);
            string? misfit = CoaxialExchange.FindMisfit(this, hubs, 0.0);
            if (misfit != null)
            {
                throw new ArgumentException(misfit);
            }
        }

        private bool HasContact => Wire.Walls.Length > 0 || _parameters.Contact.TouchesItself(0);

        // The nearest and the stiffest of those of all.
        private Barrier FindBarrier()
        {
            double step = _parameters.Method.TimeStep;
            double move = _parameters.Drive.LargestMove(step, Wire.Metres);
            foreach (Catheter catheter in _parameters.Scene.Catheters)
            {
                DriveParameters drive = _parameters.OfCatheter(catheter, Axis).Drive;
                move = Math.Max(move, drive.LargestMove(step, Wire.Metres));
            }
            double distance = double.PositiveInfinity;
            double product = 0.0;
            foreach (MaterialScene scene in Scenes)
            {
                Barrier one = BarrierDefaults.Of(scene.Rod, _parameters.Contact, Wire.Walls, Wire.Metres, move);
                distance = Math.Min(distance, one.Distance);
                product = Math.Max(product, one.Distance * one.Stiffness);
            }
            return new Barrier(distance, product / distance);
        }

        // That of the wire is found as if it were alone.
        private string? FindProblemBeyondSheath(SheathEnd sheath)
        {
            Vector3d[] x = Catheter.Shape.X;
            int inside = sheath.NodesInside(Catheter.Shape);
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
            string? problem = null;
            for (int i = 0; i < Scenes.Length - 1 && problem == null; i++)
            {
                x = Scenes[i].Shape.X;
                inside = sheath.NodesInside(Scenes[i].Shape);
                problem = inside == x.Length ? null : MaterialStart.FindProblemFrom(Scenes[i], inside - 1,
                    (1.0 / Wire.Metres) * sheath.Exit, "catheters[" + i + "]");
            }
            return problem;
        }

        // EA, N.
        private double StretchAtHub(int instrument) => Instruments[instrument].Profile.Pieces[0].StretchStiffness;

        private static string Text(string format, params object[] numbers) =>
            string.Format(CultureInfo.InvariantCulture, format, numbers);

        private static MaterialScene SceneOf(SimulationParameters parameters) =>
            new MaterialScene(parameters, new Scene(parameters));

        private static InstrumentProfile ProfileOf(SimulationParameters parameters, double metres)
        {
            return new InstrumentProfile(
                new WireProfile(parameters.Material, parameters.Scene.GuidewireLength), metres);
        }
    }
}
