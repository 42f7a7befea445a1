using System;
using System.Collections.Generic;
using System.Linq;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>The table of all quantities that logs, answers of sessions and summary.json have of a moment: a new one
    /// is one row. <c>Guidewire.Cli --quantities</c> prints it, and Python reads the copy of that.</summary>
    internal static class Quantities
    {
        private const string Xyz = "x y z";

        /// <summary>Those of the wire and the run.</summary>
        public static readonly Quantity[] OfWire =
        {
            Number("step", "1", "steps done", QuantitySwitch.Always, m => m.Of(m.Simulation.StepCount))
                .Typed(QuantityType.Whole),
            Number("totalTime", "s", "in-game time", QuantitySwitch.Always, m => m.Of(m.Simulation.Time))
                .Typed(QuantityType.Exact).Json("totalTime"),
            Number("elapsedMilliseconds", "ms", "wall time since the start of the run", QuantitySwitch.Always,
                m => m.Of(m.Elapsed)).Typed(QuantityType.Exact).Json("elapsedMilliseconds"),
            Number("delta", "units",
                "how far the step moved the last sphere from where it was predicted, with a material by free flight",
                QuantitySwitch.Always,
                m => m.Of(m.Simulation.PredictionError)).Typed(QuantityType.Exact).Json("delta"),
            Number("firstSphere", "1", "index of the first sphere that the entry has", QuantitySwitch.Always,
                m => m.Of(m.FirstSphere)).Typed(QuantityType.Whole),
            Vectors("positions", QuantityPlace.Node, "units", "positions of the nodes", QuantitySwitch.Always,
                m => Logged(m, m.State.Positions)).Json("sphere", QuantityForm.ByIndex).InAnswer(StatePart.Motion),
            new Quantity("velocities", QuantityPlace.Node, "vx vy vz", "units/s", "velocities of the nodes",
                m => Logged(m, m.State.Velocities)) { Switch = QuantitySwitch.Always }
                .Json("sphere", QuantityForm.ByIndex).InAnswer(StatePart.Motion),
            new Quantity("orientations", QuantityPlace.Element, "x y z w", "1", "quaternions of the rod elements",
                m => Moment.Of(m.State.Orientations)) { Switch = QuantitySwitch.Orientations }
                .Json("orientation", QuantityForm.ByIndex).InAnswer(StatePart.Motion),

            Number("kineticEnergy", "J", "energy of motion", QuantitySwitch.Strains,
                m => m.Of(m.Simulation.Energies()?.X)).Json("stress.kineticEnergy")
                .InAnswer(StatePart.Strains, "energy"),
            Number("elasticEnergy", "J", "energy stored in the wire", QuantitySwitch.Strains,
                m => m.Of(m.Simulation.Energies()?.Y)).Json("stress.elasticEnergy")
                .InAnswer(StatePart.Strains, "energy"),
            Number("potentialEnergy", "J", "energy of gravity and of the loads that have a potential",
                QuantitySwitch.Strains, m => m.Of(m.Simulation.Energies()?.Z)).Json("stress.potentialEnergy")
                .InAnswer(StatePart.Strains, "energy"),
            Vectors("curvature", QuantityPlace.Joint, "rad/m",
                "curvature about d1 and d2 and twist about d3 at each joint", QuantitySwitch.Strains,
                m => Moment.Of(m.Stress?.Curvature)).Json("stress.curvature").InAnswer(StatePart.Strains),
            Vectors("couple", QuantityPlace.Joint, "N m", "couple at each joint along the world's axes",
                QuantitySwitch.Strains, m => Moment.Of(m.Stress?.Couple)).Json("stress.couple")
                .InAnswer(StatePart.Strains),
            Vectors("strain", QuantityPlace.Element, "1", "shear along d1 and d2 and stretch along d3 of each element",
                QuantitySwitch.Strains, m => Moment.Of(m.Stress?.Strain)).Json("stress.strain")
                .InAnswer(StatePart.Strains),
            Vectors("force", QuantityPlace.Element, "N", "force in each element along the world's axes",
                QuantitySwitch.Strains, m => Moment.Of(m.Stress?.Force)).Json("stress.force")
                .InAnswer(StatePart.Strains),
            OfCore("coreStrain", "largest strain by bending of the core's fibres at each joint", s => s.CoreStrain),
            OfCore("coreShare", "share of the core's section at each joint whose fibres have left their elastic line",
                s => s.CoreShare),
            Number("materialLoss", "J", "energy that the instruments' material has turned into heat",
                QuantitySwitch.Strains, m => m.Stress?.CoreStrain.Length > 0 ? m.Of(m.Stress.MaterialLoss) : default)
                .Json("stress.materialLoss"),
            Vectors("angularVelocities", QuantityPlace.Element, "rad/s",
                "angular velocity of each element in its own frame", QuantitySwitch.Strains,
                m => Moment.Of(m.State.AngularVelocities)).Json("stress.angularVelocities")
                .InAnswer(StatePart.Motion),

            Number("inBody", "1", "spheres, counted from the last, that are out of the sheath", QuantitySwitch.Sheath,
                m => m.Of(m.Hub?.SpheresInBody ?? 0)).Typed(QuantityType.Whole).Json("inBody"),
            OfHub("hubInsertion", "m", "insertion of the hub since the start", h => h.Insertion, "insertion"),
            OfHub("hubTurn", "rad", "rotation of the hub since the start", h => h.Turn, "turn"),
            OfHub("hubForce", "N", "force of the hub on the wire along its axis; a push is positive", h => h.Force,
                "force"),
            OfHub("hubTorque", "N m", "torque of the hub on the wire about its axis", h => h.Torque, "torque"),
            Number("drag", "N", "what of the hub's force moves the wire against massDamping", QuantitySwitch.Never,
                m => m.Of(m.Hub?.Drag)).InSummary("hub", "drag"),
            Number("hubForceError", "N", "with catheters, by how much the hub's force is uncertain",
                QuantitySwitch.Never,
                m => m.Of(m.Hub?.ForceError)).InSummary("hub", "forceError"),
            Number("hubSlippedFrom", "s", "end of the first step in which the hub slipped", QuantitySwitch.Never,
                m => m.Of(m.Hub?.SlippedFrom)).InSummary("hub", "slippedFrom"),
            Vectors("tipPosition", QuantityPlace.Run, "units", "position of the last node", QuantitySwitch.Never,
                m => m.Hub == null ? default : m.Of(m.State.Positions[m.State.ElementCount]))
                .InAnswer(StatePart.Instruments, "hub").InSummary("hub", "tipPosition"),
            Vectors("tipDirection", QuantityPlace.Run, "1", "direction of the last element, a unit vector",
                QuantitySwitch.Hub, m => m.Of(m.Hub?.TipDirection)).Json("hub.tipDirection")
                .InAnswer(StatePart.Instruments, "hub").InSummary("hub", "tipDirection"),
            OfHub("twist", "rad", "twist of the wire from hub to tip", h => h.Twist, "twist"),
            OfHub("largestCurvature", "rad/m", "largest curvature of any joint", h => h.LargestCurvature,
                "largestCurvature"),
            OfHub("lengthInBody", "m", "length of the wire out of its sheath", h => h.LengthInBody, "lengthInBody"),
            Number("spheresInBody", "1", "spheres out of the sheath", QuantitySwitch.Never,
                m => m.Of(m.Hub?.SpheresInBody)).Typed(QuantityType.Whole).InAnswer(StatePart.Instruments, "hub")
                .InSummary("hub", "spheresInBody"),

            OfContacts("contactTotal", "N", "force of the walls in all", c => c.Total, "contact.total"),
            OfContacts("reaction", "N",
                "force of the held first sphere on the wire; with direct its mean over the step",
                c => c.Reaction, "contact.reaction").InAnswer(StatePart.Motion),
            Vectors("contactForces", QuantityPlace.Node, "N",
                "force of the walls on each sphere; that on an element is divided between its two spheres; of "
                + "instruments in one another the outermost one at a place has it",
                QuantitySwitch.Contacts, m => Moment.Of(m.Contacts?.Forces))
                .Json("contact.sphere", QuantityForm.Nonzero).InAnswer(StatePart.Motion),
            Vectors("wallForces", QuantityPlace.Wall, "N",
                "force of each wall on the wire along its normals, the vessel first",
                QuantitySwitch.Contacts, m => Moment.Of(m.Contacts?.WallForces))
                .Json("contact.wall", QuantityForm.ByIndex),
            OfContacts("contactTotalMean", "N", "mean of contactTotal over the step, to be compared with reaction",
                c => c.MeanTotal,
                "contact.totalMean", needsElements: true),
            OfContacts("reactionAtEnd", "N", "reaction at the end of the step, to be compared with contactTotal",
                c => c.ReactionAtEnd,
                "contact.reactionAtEnd", needsElements: true),
            Number("wallPressure", "Pa", "largest pressure on an element, over its length and diameter",
                QuantitySwitch.Contacts,
                m => m.Contacts?.ElementForces.Length > 0 ? m.Of(m.Contacts!.Pressure) : default)
                .Json("contact.pressure"),
            Vectors("elementForces", QuantityPlace.Element, "N",
                "normal force of the walls on each element; that on a sphere is divided between its two elements",
                QuantitySwitch.Contacts, m => Moment.Of(m.Contacts?.ElementForces))
                .Json("contact.element", QuantityForm.Nonzero),
            Vectors("strandForces", QuantityPlace.Node, "N",
                "force of the wire's other strands on each sphere; as contactForces, where the wire touches itself",
                QuantitySwitch.Contacts, m => Moment.Of(m.Contacts?.StrandForces))
                .Json("contact.strand", QuantityForm.Nonzero).InAnswer(StatePart.Motion),
            OfSoftWalls("largestDisplacement", "largest displacement of soft walls", c => c.LargestDisplacement),
            OfSoftWalls("meanDisplacement", "mean displacement of soft walls over all contacts with them",
                c => c.MeanDisplacement),
            Vectors("wallDisplacements", QuantityPlace.Element, "m",
                "displacement of soft walls at each element, of the contact where it is largest",
                QuantitySwitch.Contacts, m => Moment.Of(m.Contacts?.Displacements))
                .Json("contact.displacement", QuantityForm.Nonzero).InAnswer(StatePart.Motion),
            Number("vesselPhase", "1", "phase of the first cycle of a vessel that moves, 0 to 1", QuantitySwitch.Always,
                m => m.Simulation.FieldOf(0) is WallField field && field.Motion.Cycles.Count > 0
                    ? m.Of(field.PhaseOf(0)) : default).Json("vesselPhase")
                .InAnswer(StatePart.Instruments),
            Vectors("vesselDisplacement", QuantityPlace.Run, "units",
                "displacement of a vessel that moves, at the wire's tip", QuantitySwitch.Always,
                m => m.Simulation.FieldOf(0) is WallField field ? m.Of(m.State.Positions[m.State.ElementCount]
                    - field.AtRest(m.State.Positions[m.State.ElementCount])) : default)
                .Json("vesselDisplacement").InAnswer(StatePart.Instruments),
            new Quantity("vesselCentreline", QuantityPlace.Point, "x y z dx dy dz", "units",
                "points of the centreline, at rest, of a vessel that gives way as a beam, and their displacements",
                m => Moment.Of(m.Simulation.FieldOf(0)?.Centreline())) { Switch = QuantitySwitch.Always }
                .Json("vesselCentreline").InAnswer(StatePart.Instruments),
        };

        /// <summary>Those of a catheter, in the order of its array in an answer.</summary>
        public static readonly Quantity[] OfCatheter =
        {
            Vectors("positions", QuantityPlace.Node, "units", "positions of the catheter's nodes",
                QuantitySwitch.Always, m => Moment.Of(m.Catheter.Positions)).Json("catheters.sphere")
                .InAnswer(StatePart.Instruments),
            Vectors("velocities", QuantityPlace.Node, "units/s", "velocities of the catheter's nodes",
                QuantitySwitch.Never, m => Moment.Of(m.Catheter.Velocities)).InAnswer(StatePart.Instruments),
            new Quantity("orientations", QuantityPlace.Element, "x y z w", "1", "quaternions of its rod elements",
                m => Moment.Of(m.Catheter.Orientations)) { Switch = QuantitySwitch.Orientations }
                .Json("catheters.orientation").InAnswer(StatePart.Instruments),
            Vectors("angularVelocities", QuantityPlace.Element, "rad/s",
                "angular velocity of each element in its own frame", QuantitySwitch.Never,
                m => Moment.Of(m.Catheter.AngularVelocities)).InAnswer(StatePart.Instruments),
            AtCatheter("insertion", "m", "insertion of the catheter's hub since the start", c => c.Insertion),
            AtCatheter("turn", "rad", "rotation of the catheter's hub since the start", c => c.Turn),
            AtCatheter("force", "N", "force of the catheter's hub on it along its axis; a push is positive",
                c => c.Force),
            AtCatheter("torque", "N m", "torque of the catheter's hub on it about its axis", c => c.Torque),
            Number("forceError", "N", "by how much that force is uncertain", QuantitySwitch.Never,
                m => m.Of(m.Catheter.ForceError)).InSummary("catheters", "forceError"),
            Number("slippedFrom", "s", "end of the first step in which the catheter's hub slipped",
                QuantitySwitch.Never, m => m.Of(m.Catheter.SlippedFrom)).InSummary("catheters", "slippedFrom"),
            Vectors("tipPosition", QuantityPlace.Run, "units", "position of the catheter's last node",
                QuantitySwitch.Never, m => m.Of(m.Catheter.Positions[m.Catheter.Positions.Length - 1]))
                .InAnswer(StatePart.Instruments, "catheter").InSummary("catheters", "tipPosition"),
            Vectors("tipDirection", QuantityPlace.Run, "1", "direction of the catheter's last element",
                QuantitySwitch.Never,
                m => m.Of(m.Catheter.Orientations[m.Catheter.Orientations.Length - 1].Director3))
                .InAnswer(StatePart.Instruments, "catheter").InSummary("catheters", "tipDirection"),
            AtCatheter("extension", "m", "how far the tip of what is inside is beyond the catheter's; negative inside",
                c => c.Extension, QuantitySwitch.Always),
            AtCatheter("overlap", "m", "length over which that is inside", c => c.Overlap, QuantitySwitch.Never),
            Lasting("playAngle", "degrees", "largest angle that the play left out would allow", c => c.PlayAngle),
            Lasting("playLength", "m", "length over which that acts", c => c.PlayLength),
            Lasting("lengthNotCoupled", "m", "length at the tip that is not coupled for that reason",
                c => c.LengthLost),
            Lasting("overlapAngle", "rad", "angle by which the overlap is bent", c => c.OverlapAngle),
            Lasting("lumenFriction", "1", "coefficient of friction in the lumen", c => c.FrictionCoefficient),
            Lasting("frictionForce", "N", "friction in the lumen", c => c.FrictionForce),
            Lasting("frictionHeldPerCoefficient", "N", "what the ends of the overlap hold, over that coefficient",
                c => c.FrictionHeld),
            Vectors("contactForces", QuantityPlace.Node, "N", "force of the walls on each of its nodes",
                QuantitySwitch.Contacts, m => m.Contacts == null ? default : Moment.Of(m.Catheter.ContactForces))
                .Json("catheters.contactForces").InAnswer(StatePart.Instruments),
            Vectors("strandForces", QuantityPlace.Node, "N", "force of its other strands on each of its nodes",
                QuantitySwitch.Contacts, m => m.Contacts == null ? default : Moment.Of(m.Catheter.StrandForces))
                .Json("catheters.strandForces").InAnswer(StatePart.Instruments),
            Vectors("wallDisplacements", QuantityPlace.Element, "m", "displacement of soft walls at its elements",
                QuantitySwitch.Contacts, m => m.Contacts == null ? default : Moment.Of(m.Catheter.WallDisplacements))
                .Json("catheters.wallDisplacements").InAnswer(StatePart.Instruments),
        };

        /// <summary>Those of the place of an instrument in its vessel.</summary>
        public static readonly Quantity[] OfLumen =
        {
            InLumen("isInside", "1", "whether the tip is in the lumen, and all of the instrument up to it",
                p => p.IsInside ? 1.0 : 0.0).Typed(QuantityType.Flag),
            InLumen("isAtTarget", "1", "whether it is within a radius of the target along the centreline, or beyond",
                p => p.IsAtTarget ? 1.0 : 0.0).Typed(QuantityType.Flag),
            InLumen("near", "1", "the centreline's point to whose sphere the place belongs, from 0", p => p.Near)
                .Typed(QuantityType.Whole),
            InLumen("branch", "1", "the branch there, from 0", p => p.Branch).Typed(QuantityType.Whole),
            InLumen("distance", "units", "distance from the inlet along the centreline", p => p.Distance),
            InLumen("left", "units", "distance to the target along the centreline; not a number without one",
                p => p.Left),
            Vectors("point", QuantityPlace.Run, "units", "the place", QuantitySwitch.Never, m => m.Of(m.Lumen?.Point))
                .InAnswer(StatePart.Instruments, "lumen"),
        };

        /// <summary>Gives the quantities of a table that a run logs.</summary>
        public static List<Quantity> Logged(Quantity[] table, RunParameters parameters) =>
            table.Where(row => IsOn(row.Switch, parameters)).ToList();

        /// <summary>Gives an object of summary.json or of an answer.</summary>
        /// <param name="group">Its name.</param>
        public static JObject Summary(Quantity[] table, string group, Moment moment)
        {
            var json = new JObject();
            foreach (Quantity row in table)
            {
                if (row.Summary == null || row.Group != group)
                {
                    continue;
                }
                ReadOnlySpan<double> numbers = row.Read(moment);
                json[row.Summary] = numbers.Length == 0 ? JValue.CreateNull()
                    : numbers.Length == 1 ? Finite(numbers[0], row.Type)
                    : (JToken)new JArray(numbers.ToArray().Select(number => Finite(number, row.Type)));
            }
            return json;
        }

        /// <summary>Gives the tables as JSON, a row on each line.</summary>
        public static string ToJson()
        {
            var tables = new[] { ("wire", OfWire), ("catheter", OfCatheter), ("lumen", OfLumen) };
            return "{" + string.Join(",", tables.Select(table => "\n\"" + table.Item1 + "\": [\n"
                + string.Join(",\n", table.Item2.Select(row => new JObject
                {
                    ["name"] = row.Name,
                    ["place"] = Word(row.Place),
                    ["letters"] = new JArray(row.Letters),
                    ["unit"] = row.Unit,
                    ["help"] = row.Help,
                    ["type"] = Word(row.Type),
                    ["switch"] = Word(row.Switch),
                    ["group"] = row.Group,
                    ["key"] = row.Key,
                    ["form"] = Word(row.Form),
                    ["answer"] = row.Answer,
                    ["part"] = (int)row.Part,
                    ["summary"] = row.Summary,
                }.ToString(Newtonsoft.Json.Formatting.None))) + "]")) + "\n}\n";
        }

        private static bool IsOn(QuantitySwitch by, RunParameters parameters)
        {
            return by switch
            {
                QuantitySwitch.Always => true,
                QuantitySwitch.Orientations => parameters.LogOrientations,
                QuantitySwitch.Strains => parameters.LogStrains,
                QuantitySwitch.Hub => parameters.LogHub,
                QuantitySwitch.Contacts => parameters.LogContacts,
                QuantitySwitch.Sheath => parameters.Sheath != null,
                _ => false,
            };
        }

        private static string Word(Enum value) => value.ToString().ToLowerInvariant();

        private static JValue Finite(double value, QuantityType type) =>
            double.IsNaN(value) || double.IsInfinity(value) ? JValue.CreateNull()
            : type == QuantityType.Whole ? new JValue((long)value) : new JValue(value);

        private static ReadOnlySpan<double> Logged(Moment moment, Vector3d[] ofNodes) =>
            Moment.Of(ofNodes).Slice(3 * moment.FirstSphere);

        private static Quantity Number(string name, string unit, string help, QuantitySwitch by, Reading read) =>
            new Quantity(name, QuantityPlace.Run, "value", unit, help, read) { Switch = by };

        private static Quantity Vectors(string name, QuantityPlace place, string unit, string help, QuantitySwitch by,
            Reading read) => new Quantity(name, place, Xyz, unit, help, read) { Switch = by };

        private static Quantity OfHub(string name, string unit, string help, Func<HubRecord, double?> value, string key)
        {
            return Number(name, unit, help, QuantitySwitch.Hub, m => m.Of(m.Hub == null ? null : value(m.Hub)))
                .Json("hub." + key).InAnswer(StatePart.Instruments, "hub").InSummary("hub", key);
        }

        private static Quantity OfCore(string name, string help, Func<StressRecord, double[]> value)
        {
            return new Quantity(name, QuantityPlace.Joint, "value", "1", help,
                m => m.Stress is StressRecord stress ? value(stress) : default(ReadOnlySpan<double>))
                { Switch = QuantitySwitch.Strains }.Json("stress." + name).InAnswer(StatePart.Strains);
        }

        private static Quantity OfContacts(string name, string unit, string help, Func<ContactRecord, Vector3d> value,
            string json, bool needsElements = false)
        {
            return Vectors(name, QuantityPlace.Run, unit, help, QuantitySwitch.Contacts,
                m => m.Contacts is ContactRecord contacts && (!needsElements || contacts.ElementForces.Length > 0)
                    ? m.Of(value(contacts)) : default).Json(json);
        }

        private static Quantity OfSoftWalls(string name, string help, Func<ContactRecord, double> value)
        {
            return Number(name, "m", help, QuantitySwitch.Contacts,
                m => m.Contacts?.Displacements.Length > 0 ? m.Of(value(m.Contacts!)) : default).Json("contact." + name);
        }

        private static Quantity AtCatheter(string name, string unit, string help, Func<CoaxialRecord, double> value,
            QuantitySwitch by = QuantitySwitch.Hub)
        {
            Quantity row = Number(name, unit, help, by, m => m.Of(value(m.Catheter)));
            return (by == QuantitySwitch.Never ? row : row.Json("catheters." + name))
                .InAnswer(StatePart.Instruments, "catheter").InSummary("catheters", name);
        }

        private static Quantity Lasting(string name, string unit, string help, Func<CoaxialRecord, double> value) =>
            Number(name, unit, help, QuantitySwitch.Never, m => m.Of(value(m.Catheter))).InSummary("catheters", name);

        private static Quantity InLumen(string name, string unit, string help, Func<LumenPlace, double> value)
        {
            return Number(name, unit, help, QuantitySwitch.Never,
                m => m.Lumen is LumenPlace place ? m.Of(value(place)) : default)
                .InAnswer(StatePart.Instruments, "lumen");
        }
    }
}
