using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Text.RegularExpressions;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Every warning of the table is drawn by a run of its own, as reliable as the table says.</summary>
    public sealed class WarningTableTests : FolderTests
    {
        private const string Tube = "'vessel': {'shape': 'tube', 'knots': [[0, 0, -30], [0, 0, 65]], 'radius': 6},"
            + " 'guidewireLength': 60, 'guidewireOffset': 0, 'numberRodElements': 6, 'deltaThreshold': 0";

        private const string Plane = "'vessel': {'shape': 'plane', 'point': [0, 0, 65], 'normal': [0, 0, -1]},"
            + " 'guidewireLength': 60, 'guidewireOffset': 0, 'numberRodElements': 6, 'deltaThreshold': 0,"
            + " 'sphereRadius': 0.5, 'drive': 'displace', 'displacementDirection': [0, 0, 1],"
            + " 'elementContact': 'thesis'";

        private const string Sideways = Tube + ", 'sphereRadius': 0.5, 'drive': 'displace',"
            + " 'displacementDirection': [0, 1, 0], 'displacementPerStep': 1";

        private const string Driven = Tube + ", 'solver': 'direct', 'proximalEnd': 'clamped', 'drive': 'displace',"
            + " 'timeStep': 0.01";

        private const string Pbd = "'guidewireLength': 100, 'numberRodElements': 10, 'deltaThreshold': 0,"
            + " 'displacement': 0, 'maxSimulationSteps': 1";

        private const string Wire = "'solver': 'direct', 'proximalEnd': 'clamped', 'timeStep': 0.01,"
            + " 'guidewireLength': 100, 'deltaThreshold': 0";

        private const string Coaxial = "'solver': 'direct', 'guidewireLength': 120, 'numberRodElements': 30,"
            + " 'guidewireOffset': -20, 'wireRadius': 0.0004, 'proximalEnd': 'clamped', 'drive': 'displace',"
            + " 'massDamping': 20, 'timeStep': 0.02, 'deltaThreshold': 0, 'maxSimulationSteps': 2, 'vessel': {'shape':"
            + " 'tube', 'smooth': true, 'openStart': true, 'openEnd': true, 'radius': 3, 'knots': [[0, 0, -60],"
            + " [0, 0, 200]]}, ";

        private const string Catheter = "'start': 20, 'length': 80, 'elements': 20, 'wireRadius': 0.0008,"
            + " 'lumenRadius': 0.0007, 'restCurvature': [40, 0, 0]";

        // Out of a stiff catheter at 45 degrees to a plane.
        private const string Slant = "'solver': 'direct', 'guidewireLength': 110, 'guidewireOffset': -90,"
            + " 'wireRadius': 0.0004, 'youngsModulus': 1e9, 'shearModulus': 4e8, 'massDamping': 50, 'proximalEnd':"
            + " 'clamped', 'drive': 'displace', 'insertionSpeed': 0.008, 'timeStep': 0.02, 'deltaThreshold': 0,"
            + " 'vessel': {'shape': 'plane', 'point': [0, -1.3435, 21.3435], 'normal': [0, 1, -1]}, ";

        private const string SlantCatheter = "'catheters': [{'start': 90, 'length': 20, 'elements': 8, 'wireRadius':"
            + " 0.0008, 'lumenRadius': 0.0006, 'youngsModulus': 6e13, 'shearModulus': 2.3e13, 'density': 1400}]";

        // In place of its lid it has a spike that goes through its floor.
        private const string PiercedBox = "v -50 -50 -50\nv 50 -50 -50\nv -50 50 -50\nv 50 50 -50\nv -50 -50 50\n"
            + "v 50 -50 50\nv -50 50 50\nv 50 50 50\nv 45 45 -60\nf 1 3 4 2\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\n"
            + "f 2 4 8 6\nf 5 6 9\nf 6 8 9\nf 8 7 9\nf 7 5 9\n";

        private static readonly Dictionary<string, string> Runs = new Dictionary<string, string>
        {
            ["ignoredKeys"] = "'solver': 'direct', 'constraintSolverSteps': 10, 'maxSimulationSteps': 1",
            ["olderName"] = Tube + ", 'displacement': 0, 'elementContact': 'seed', 'maxSimulationSteps': 1",
            ["elementLength"] = Pbd + ", 'rodElementLength': 3",
            ["formerKey"] = Driven + ", 'frictionSpeed': 5, 'maxSimulationSteps': 1",
            ["idleKey"] = Wire + ", 'maxSimulationSteps': 1, 'axialForce': 0.1",
            ["stretchStiffness"] = Pbd + ", 'stretchStiffness': 2.5",
            ["bendStiffness"] = Pbd + ", 'bendStiffness': 50",
            ["sectionBeyond"] = Wire + ", 'maxSimulationSteps': 1, 'numberRodElements': 10, 'wireSections': [{'from':"
                + " 200, 'to': 210, 'wireRadius': 0.001}]",
            ["sectionCut"] = Wire + ", 'maxSimulationSteps': 1, 'numberRodElements': 10, 'wireSections': [{'from':"
                + " 50, 'to': 210, 'wireRadius': 0.001}]",
            ["sectionThin"] = Wire + ", 'maxSimulationSteps': 1, 'numberRodElements': 10, 'wireSections': [{'from':"
                + " 50, 'to': 50.00000001, 'wireRadius': 0.001}]",
            ["sectionOverlap"] = Wire + ", 'maxSimulationSteps': 1, 'numberRodElements': 10, 'wireSections': [{'from':"
                + " 50, 'to': 80, 'density': 7000}, {'from': 70, 'to': 90, 'density': 6000}]",
            ["poissonRatio"] = Wire + ", 'maxSimulationSteps': 1, 'numberRodElements': 10, 'youngsModulus': 200e9",
            ["sectionShort"] = Wire + ", 'maxSimulationSteps': 1, 'numberRodElements': 10, 'wireSections': [{'from':"
                + " 50, 'to': 52, 'wireRadius': 0.001}]",
            ["clampElements"] = Wire + ", 'maxSimulationSteps': 1, 'numberRodElements': 3, 'wireSections':"
                + " [{'from': 0, 'to': 70, 'numberRodElements': 1}]",
            ["shearedStart"] = "'guidewireLength': 100, 'numberRodElements': 2, 'deltaThreshold': 0, 'displacement': 0,"
                + " 'maxSimulationSteps': 1, 'start': {'positions': [[0, 0, 0], [0, 0, 50], [0, 0, 100]],"
                + " 'orientations': [[0, 0, 0, 1], [0.70710678, 0, 0, 0.70710678]]}",
            ["oddSizes"] = Driven.Replace("[0, 0, 65]", "[0, 0, 65000]") + ", 'maxSimulationSteps': 1",
            ["selfIntersection"] = "'vessel': {'shape': 'mesh', 'file': 'box.obj'}, 'guidewireLength': 10,"
                + " 'guidewireOffset': -40, 'numberRodElements': 6, 'displacement': 0, 'maxSimulationSteps': 1",
            ["frameMisfit"] = "'solver': 'direct', 'timeStep': 0.01, 'vessel': {'shape': 'mesh', 'file': 'box.obj',"
                + " 'anatomy': 'box.json', 'motion': {'period': 1, 'frames': ['box.obj', 'other.obj', 'box.obj']}},"
                + " 'guidewireLength': 10, 'guidewireOffset': -40, 'numberRodElements': 6,"
                + " 'displacement': 0, 'maxSimulationSteps': 1",
            ["softStiff"] = Driven.Replace("'radius'", "'wallStiffness': 1e8, 'radius'") + ", 'maxSimulationSteps': 1",
            ["softElements"] = Driven.Replace("'radius'", "'wallStiffness': 1e8, 'radius'")
                + ", 'maxSimulationSteps': 1",
            ["notConverged"] = Tube + ", 'solver': 'xpbd', 'proximalEnd': 'clamped', 'substeps': 1, 'timeStep': 0.01,"
                + " 'drive': 'push', 'insertionSpeed': 0.1, 'constraintSolverSteps': 1, 'maxSimulationSteps': 5,"
                + " 'gravity': [0, -9.81, 0]",
            ["driveStuck"] = Sideways + ", 'maxSimulationSteps': 30",
            ["lostTurn"] = "'guidewireLength': 100, 'numberRodElements': 10, 'deltaThreshold': 0, 'displacement': 0,"
                + " 'twistPerStep': 400, 'maxSimulationSteps': 40",
            ["hubShortfall"] = Driven + ", 'displacementDirection': [0, 1, 0], 'displacementPerStep': 1,"
                + " 'hubForceLimit': 0.1, 'maxSimulationSteps': 12",
            ["hubForce"] = Coaxial + "'insertionSpeed': 0.008, 'hubForceLimit': 1e-6, 'wireSections': [{'from': 100,"
                + " 'to': 120, 'restCurvature': [40, 0, 0]}], 'catheters': [{" + Catheter + ", 'hubForceLimit': 1e-6}]",
            ["hubForceError"] = Slant + "'maxSimulationSteps': 150, 'numberRodElements': 22, " + SlantCatheter,
            ["rounding"] = Wire + ", 'numberRodElements': 10, 'distalEnd': 'clamped', 'youngsModulus': 1e18,"
                + " 'shearModulus': 4e17, 'gravity': [0, 9.81, 0], 'maxSimulationSteps': 2, 'massDamping': 10",
            ["spinLost"] = Wire.Replace("clamped", "free") + ", 'numberRodElements': 10, 'tipForce': [0, 0.05, 0],"
                + " 'maxSimulationSteps': 100",
            ["unstable"] = Wire + ", 'numberRodElements': 10, 'tipForce': [0, 0, -10], 'maxSimulationSteps': 2",
            ["vesselTurn"] = "'solver': 'direct', 'guidewireLength': 120, 'numberRodElements': 40,"
                + " 'guidewireOffset': -115, 'wireRadius': 0.0004, 'massDamping': 20, 'proximalEnd': 'clamped',"
                + " 'drive': 'displace',"
                + " 'insertionSpeed': 0.1, 'timeStep': 0.02, 'maxSimulationSteps': 15, 'sheath': {'exit': [0, 0, 0]},"
                + " 'vessel': {'shape': 'tube', 'radius': 2, 'knots': [[0, 0, -10], [0, 0, 10], [0, 4, 20],"
                + " [0, 12, 30], [0, 22, 38], [0, 32, 44], [0, 42, 50], [0, 60, 60]],"
                + " 'beam': {'bendingStiffness': 1e-5, 'axialStiffness': 1, 'foundation': 100}}",
            ["energyLost"] = Wire.Replace("clamped", "free").Replace("0.01", "0.0005") + ", 'numberRodElements': 10,"
                + " 'startShape': 'helix', 'startRadius': 12, 'integrator': 'esdirk3', 'maxSimulationSteps': 100",
            ["substepUnstable"] = Wire.Replace("direct", "explicit") + ", 'numberRodElements': 10, 'substeps': 1,"
                + " 'maxSimulationSteps': 1",
            ["strandPassages"] = "'guidewireLength': 100, 'numberRodElements': 6, 'sphereRadius': 0.1, 'start':"
                + " {'positions': [[3, -9, 1], [3, 10, 1], [10, 20, 1], [20, 10, 0], [10, 0, 0], [1, 0, 0],"
                + " [-10, 0, 0]]}, 'displacement': 0, 'drive': 'displace', 'displacementDirection': [0, 0, -1],"
                + " 'displacementPerStep': 6, 'maxSimulationSteps': 2, 'deltaThreshold': 0",
            ["passages"] = Plane + ", 'displacementPerStep': 20, 'maxSimulationSteps': 3",
            ["penetration"] = Plane + ", 'displacementPerStep': 0.9, 'maxSimulationSteps': 12",
            ["length"] = "'stretchStiffness': 0.001, 'displacement': 30, 'maxSimulationSteps': 3, 'deltaThreshold': 0",
            ["strain"] = Wire + ", 'numberRodElements': 100, 'tipMoment': [3, 0, 0], 'initialState': 'equilibrium',"
                + " 'maxSimulationSteps': 1",
            ["selfOverlap"] = Wire.Replace("clamped", "free").Replace("0.01", "1e-5") + ", 'numberRodElements': 80,"
                + " 'startShape': 'helix', 'startRadius': 3, 'startTurns': 5.3, 'maxSimulationSteps': 1",
            ["beyondLaw"] = Wire.Replace("100", "10") + ", 'numberRodElements': 20, 'tipMoment': [0.248, 0, 0],"
                + " 'material': 'steel', 'initialState': 'equilibrium', 'maxSimulationSteps': 1",
            ["beyondElastic"] = Wire + ", 'numberRodElements': 100, 'tipMoment': [0.1, 0, 0], 'maxSimulationSteps': 1,"
                + " 'initialState': 'equilibrium'",
            ["driveShortfall"] = Sideways + ", 'maxSimulationSteps': 9",
            ["play"] = Coaxial + "'catheters': [{" + Catheter + "}]",
            ["openRim"] = Driven + ", 'displacementDirection': [0, 0, 1], 'displacementPerStep': 1,"
                + " 'maxSimulationSteps': 8",
            ["softLimit"] = Driven.Replace("'radius'", "'wallStiffness': 1e3, 'softLimit': 1e-5, 'radius'")
                + ", 'displacementDirection': [0, 1, 0], 'displacementPerStep': 0.91825, 'maxSimulationSteps': 6",
        };

        [Test]
        public void EveryWarning_HasARunHere() =>
            Assert.That(Runs.Keys, Is.EqualTo(WarningTable.All.Select(kind => kind.Name)));

        [Test]
        public void RunWithAWarning_IsAsReliableAsTheTableSays([ValueSource(nameof(Names))] string name)
        {
            File.WriteAllText(Path.Combine(Folder, "box.obj"), PiercedBox);
            File.WriteAllText(Path.Combine(Folder, "other.obj"), Regex.Replace(PiercedBox, "v (\\S+)", "v $1.5",
                RegexOptions.None, TimeSpan.FromSeconds(1.0)));
            File.WriteAllText(Path.Combine(Folder, "box.json"), ("{'ends': [{'number': 1, 'name': 'top', 'centre': "
                + "[0, 0, 40], 'radius': 9, 'direction': [0, 0, -1], 'open': false, 'point': 0}], 'centreline': {"
                + "'points': [[0, 0, 40, 9], [0, 0, -40, 9]], 'parents': [-1, 0], 'branches': [1, 1], 'names': "
                + "['one']}}").Replace('\'', '"'));
            string file = Path.Combine(Folder, "wire.json");
            File.WriteAllText(file, "{" + Runs[name].Replace('\'', '"') + "}");
            ParameterHandler handler = ParameterHandler.Load(file, CommandLineHandler.ReadAssignments(
                Array.Empty<string>()));
            RunResult result = new SimulationRun(handler, Path.Combine(Folder, "out"), null).Execute(Existing.Replace);
            JObject summary = JObject.Parse(File.ReadAllText(Path.Combine(Folder, "out", "summary.json")));
            string told = string.Join("\n", summary["warnings"]!.Values<string>()) + "\n" + (string)summary["reason"]!;
            WarningKind drawn = WarningTable.All.Single(kind => kind.Name == name);
            Assert.That(result.Outcome, Is.EqualTo(Outcome.Finished).Or.EqualTo(Outcome.Converged), result.Reason);
            Assert.That(told, Does.Match(PatternOf(drawn)));
            if (drawn.Place == WarningPlace.Reason)
            {
                Assert.That(result.Reason, Does.Match(", but (.*; )?" + PatternOf(drawn)));
            }
            bool isReliable = WarningTable.All.All(kind => kind.IsReliable || !Regex.IsMatch(told, PatternOf(kind)));
            Assert.That(result.IsReliable, Is.EqualTo(isReliable), told);
            Assert.That((bool)summary["reliable"]!, Is.EqualTo(isReliable));
            Assert.That(isReliable, Is.EqualTo(drawn.IsReliable), told);
        }

        [Test]
        public void Text_HasItsValuesInOrder_AndNoOthers()
        {
            Assert.That(WarningTable.Penetration.Line,
                Is.EqualTo("the wire penetrated a wall by *d* units, *r* units are allowed"));
            Assert.That(WarningTable.Penetration.Text(0.123456, 2),
                Is.EqualTo("the wire penetrated a wall by 0.123 units, 2 units are allowed"));
            Assert.That(() => WarningTable.Penetration.Text(1.0), Throws.ArgumentException);
            Assert.That(() => WarningTable.Penetration.Text(1.0, 2.0, 3.0), Throws.ArgumentException);
        }

        private static Dictionary<string, string>.KeyCollection Names() => Runs.Keys;

        private static string PatternOf(WarningKind kind)
        {
            return kind.Name == "shearedStart" ? "is 90 degrees off the line"
                : Regex.Replace(Regex.Escape(kind.Line), @"\\\*[^*]+\\\*", ".+");
        }
    }
}
