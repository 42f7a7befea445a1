using System;
using System.Collections.Generic;
using System.Linq;
using System.Runtime.InteropServices;
using System.Security.Cryptography;
using System.Text;
using Guidewire.Core;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>summary.json: what a run came to, and what made it.</summary>
    public static class RunSummary
    {
        /// <summary>Name of the file in the run's folder.</summary>
        public const string FileName = "summary.json";

        // Changes with every change of the code that simulates, and with nothing else.
        internal static string CoreBuild => typeof(Simulation).Module.ModuleVersionId.ToString("N");

        /// <summary>Gives the summary as text.</summary>
        /// <param name="simulation">The run at its end.</param>
        /// <param name="handler">Its parameters.</param>
        /// <param name="times">Its step times.</param>
        /// <param name="setUpTime">Wall time before the first step in s: building the wire, finding its rest
        /// shape.</param>
        /// <param name="wallTime">Wall time since the start of the run in s, without that.</param>
        /// <param name="repeat">Number of a timed repeat, or null.</param>
        /// <param name="log">Name of the log in the run's folder, or null where there is none.</param>
        /// <param name="notes">What other than the parameters made the run, one line each.</param>
        /// <param name="target">The tip on the vessel's centreline, or null.</param>
        internal static string Text(Simulation simulation, ParameterHandler handler, StepTimes times, double setUpTime,
            double wallTime, int? repeat, string? log, IReadOnlyList<string> notes, TargetRecord? target)
        {
            var moment = new Moment();
            moment.GoTo(simulation);
            var json = new JObject
            {
                ["outcome"] = Word(simulation.Outcome),
                ["reason"] = simulation.Reason,
                ["reliable"] = simulation.IsReliable,
                ["steps"] = simulation.StepCount,
                ["inGameTime"] = Finite(simulation.Time),
                ["computationTime"] = 1e-3 * times.Sum,
                ["setUpTime"] = setUpTime,
                ["wallTime"] = wallTime,
                ["averageStepTime"] = times.Average,
                ["medianStepTime"] = times.Median(),
                ["predictionError"] = Finite(simulation.PredictionError),
                ["steadyStateStep"] = simulation.SteadyStateStep,
                ["passages"] = simulation.Passages,
                ["maxPenetration"] = Finite(simulation.Contacts?.MaxPenetration ?? 0.0),
                ["driveAsked"] = Finite(simulation.Contacts?.DriveAsked ?? double.NaN),
                ["driveShortfall"] = Finite(simulation.Contacts?.DriveShortfall ?? 0.0),
                ["hub"] = moment.Hub == null ? null : Quantities.Summary(Quantities.OfWire, "hub", moment),
                ["largestContactForce"] = Finite(simulation.Contacts?.LargestForce ?? 0.0),
                ["largestWallForce"] = Finite(simulation.Contacts?.LargestTotal ?? 0.0),
                ["wallForces"] = new JArray(Array.ConvertAll(
                    simulation.Contacts?.WallForces ?? Array.Empty<Vector3d>(), force => Vector(force))),
                ["extremes"] = simulation.Report()?.Extremes is RunExtremes extremes ? Extremes(extremes) : null,
                ["timed"] = repeat.HasValue,
                ["repeat"] = repeat,
                ["warnings"] = new JArray(handler.Warnings.Concat(simulation.Warnings)),
                ["ignored"] = new JArray(handler.Ignored),
                ["notes"] = new JArray(notes),
                ["log"] = log,
                ["versions"] = new JObject
                {
                    ["guidewire"] = Version,
                    ["format"] = FileFormat.Version,
                    ["core"] = CoreBuild,
                    ["runtime"] = RuntimeInformation.FrameworkDescription,
                    ["machine"] = RuntimeInformation.OSDescription + ", " + RuntimeInformation.ProcessArchitecture
                    + ", "
                        + Environment.ProcessorCount + " processors",
                },
                ["parameterHash"] = notes.Count == 0 ? handler.Hash : null,
                ["complete"] = true,
            };
            IReadOnlyList<CoaxialRecord> catheters = moment.Catheters;
            if (catheters.Count > 0)
            {
                CoaxialRecord first = catheters[0];
                var hubs = new JArray(
                    HubTravel(first.WireCommandedDisplacement, first.WireDisplacement, first.WireShortfall));
                foreach (CoaxialRecord one in catheters)
                {
                    hubs.Add(HubTravel(one.CommandedDisplacement, one.Displacement, one.Shortfall));
                }
                json.Property("hub")!.AddAfterSelf(new JProperty("hubs", hubs));
                json.Property("hub")!.AddAfterSelf(new JProperty("catheters",
                    new JArray(catheters.Select((one, k) => Catheter(moment, k)))));
            }
            if (target != null)
            {
                json.Property("hub")!.AddAfterSelf(new JProperty("centreline", target.ToJson()));
            }
            SolverReport? report = simulation.Report();
            json.Property("steadyStateStep")!.AddAfterSelf(new JProperty("stiffness",
                report == null ? "gains" : "material"));
            if (report != null)
            {
                json.Property("stiffness")!.AddAfterSelf(new JProperty("solver", Solver(report)));
            }
            return json.ToString(Formatting.Indented) + "\n";
        }

        private static JObject Solver(SolverReport report)
        {
            return new JObject
            {
                ["method"] = report.Method,
                ["factorisations"] = report.Factorisations,
                ["keptSolutions"] = report.KeptSolutions,
                ["searches"] = report.Searches,
                ["equilibriumIterations"] = report.EquilibriumIterations,
                ["equilibriumResidual"] = Finite(report.EquilibriumResidual),
                ["smallestEigenvalue"] = Finite(report.SmallestEigenvalue),
                ["largestError"] = Finite(report.LargestError),
                ["timeStepError"] = Finite(report.TimeStepError),
                ["innerSteps"] = report.InnerSteps,
                ["wallIterations"] = Finite(report.WallIterations),
                ["halvedSteps"] = Finite(report.HalvedSteps),
                ["contactDistance"] = Finite(report.ContactDistance),
                ["contactStiffness"] = Finite(report.ContactStiffness),
                ["stepsNotConverged"] = report.StepsNotConverged,
                ["stableSubstep"] = Finite(report.StableSubstep),
                ["proximalForce"] = Vector(report.ProximalForce),
                ["proximalMoment"] = Vector(report.ProximalMoment),
                ["distalForce"] = Vector(report.DistalForce),
                ["distalMoment"] = Vector(report.DistalMoment),
                ["energy"] = Finite(report.Energy),
            };
        }

        private static JObject Extremes(RunExtremes extremes)
        {
            return new JObject
            {
                ["curvature"] = Finite(extremes.Curvature),
                ["strain"] = Finite(extremes.Strain),
                ["strainTime"] = Finite(extremes.StrainTime),
                ["coreStrain"] = Finite(extremes.CoreStrain),
                ["coreStrainInstrument"] = double.IsNaN(extremes.CoreStrain) ? null : extremes.CoreInstrument,
                ["coreStrainPlace"] = Finite(extremes.CorePlace),
                ["coreStrainTime"] = Finite(extremes.CoreTime),
                ["coreShare"] = Finite(extremes.CoreShare),
                ["keptCurvature"] = Finite(extremes.KeptCurvature),
                ["keptPlace"] = Finite(extremes.KeptPlace),
                ["materialLoss"] = Finite(extremes.MaterialLoss),
                ["axialForce"] = Finite(extremes.AxialForce),
                ["axialForceTime"] = Finite(extremes.AxialForceTime),
                ["axialForceDrag"] = Finite(extremes.AxialForceDrag),
                ["axialTorque"] = Finite(extremes.AxialTorque),
                ["axialTorqueTime"] = Finite(extremes.AxialTorqueTime),
                ["elementForce"] = Finite(extremes.ElementForce),
                ["elementForceTime"] = Finite(extremes.ElementForceTime),
                ["wallPressure"] = Finite(extremes.WallPressure),
                ["strandForce"] = Finite(extremes.StrandForce),
                ["strandForceTime"] = Finite(extremes.StrandForceTime),
                ["wallDisplacement"] = Finite(extremes.WallDisplacement),
                ["wallWork"] = Finite(extremes.WallWork),
                ["frictionPower"] = Finite(extremes.FrictionPower),
                ["frictionWork"] = Finite(extremes.FrictionWork),
                ["inFirstStep"] = new JArray(new[]
                {
                    ("strain", extremes.StrainTime), ("axialForce", extremes.AxialForceTime),
                    ("axialTorque", extremes.AxialTorqueTime), ("elementForce", extremes.ElementForceTime),
                }.Where(one => extremes.IsFirstStep(one.Item2)).Select(one => one.Item1)),
            };
        }

        private static JObject Catheter(Moment moment, int index)
        {
            moment.CatheterIndex = index;
            return Quantities.Summary(Quantities.OfCatheter, "catheters", moment);
        }

        private static JObject HubTravel(double asked, double gone, double shortfall)
        {
            return new JObject
            {
                ["asked"] = Finite(asked),
                ["gone"] = Finite(gone),
                ["shortfall"] = Finite(shortfall),
            };
        }

        private static JToken Vector(Vector3d? vector)
        {
            return vector is Vector3d v ? new JArray(Finite(v.X), Finite(v.Y), Finite(v.Z))
                : (JToken)JValue.CreateNull();
        }

        /// <summary>The product's version.</summary>
        public static string Version => ProgramVersion.Number;

        /// <summary>What makes runs: version, identity of the compiled simulation, runtime.</summary>
        public static string Maker => "guidewire " + Version + ", core " + CoreBuild + ", "
            + RuntimeInformation.FrameworkDescription;

        /// <summary>What a run's results depend on, wall times apart, in 32 hex digits: its parameters but output
        /// paths, and what makes it. Runs with the same address have the same results.</summary>
        public static string Address(ParameterHandler handler)
        {
            using SHA256 sha = SHA256.Create();
            byte[] digest = sha.ComputeHash(Encoding.UTF8.GetBytes(handler.Hash + "\n" + Maker));
            return BitConverter.ToString(digest, 0, 16).Replace("-", "").ToLowerInvariant();
        }

        /// <summary>Gives the outcome's one word.</summary>
        internal static string Word(Outcome outcome) => outcome.ToString().ToLowerInvariant();

        private static JValue Finite(double value) =>
            double.IsNaN(value) || double.IsInfinity(value) ? JValue.CreateNull() : new JValue(value);
    }

    /// <summary>How far a wire has come within its vessel along the centreline, and whether to its target.</summary>
    internal sealed class TargetRecord
    {
        private readonly CentrelinePath _path;
        private readonly LumenPlaces _places;
        private LumenPlace _place;
        private double _farthest = double.NegativeInfinity;
        private double _reachedAt = double.NaN;   // s

        public TargetRecord(CentrelinePath path, LumenPlaces places)
        {
            _path = path;
            _places = places;
        }

        /// <summary>Takes the wire's position.</summary>
        /// <param name="points">Of its spheres, units.</param>
        /// <param name="time">s.</param>
        /// <param name="field">Where the vessel is, if it moves.</param>
        public void Update(Vector3d[] points, double time, WallField? field)
        {
            _place = _places.Of(points, field);
            _farthest = System.Math.Max(_farthest, _place.Distance);
            if (double.IsNaN(_reachedAt) && _place.IsAtTarget)
            {
                _reachedAt = time;
            }
        }

        /// <summary>What the summary says of it: distances along the centreline from the inlet in units, times in s,
        /// the branches from the inlet to there.</summary>
        public JObject ToJson()
        {
            bool isReached = !double.IsNaN(_reachedAt);
            bool isRequested = _path.Target >= 0;
            return new JObject
            {
                ["inlet"] = _path.Inlet.Name,
                ["inLumen"] = _place.IsInside,
                ["distance"] = _place.Distance,
                ["farthest"] = _farthest,
                ["path"] = new JArray(_path.BranchesTo(_place.Near)),
                ["target"] = isRequested ? _path.TargetName : null,
                ["targetDistance"] = isRequested ? _path.Distances[_path.Target] : (double?)null,
                ["reached"] = isRequested ? isReached : (bool?)null,
                ["reachedAt"] = isReached ? _reachedAt : (double?)null,
            };
        }
    }
}
