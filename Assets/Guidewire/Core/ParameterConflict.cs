using System;

namespace Guidewire.Core
{
    /// <summary>A parameter that the method, or another parameter, does not go with.</summary>
    public sealed class ParameterConflict
    {
        private ParameterConflict(string key, string needed)
        {
            Key = key;
            Needed = needed;
        }

        /// <summary>The parameter's key in files.</summary>
        public string Key { get; }

        /// <summary>What it needs, as a noun phrase.</summary>
        public string Needed { get; }

        /// <summary>The first conflict of these parameters, or null; walls and tables need not have been
        /// read.</summary>
        public static ParameterConflict? Find(SimulationParameters parameters)
        {
            MethodTraits method = MethodTable.Of(parameters.Method.Solver);
            return OfMethod(parameters, method) ?? OfEnds(parameters, method) ?? OfHub(parameters, method)
                ?? OfStart(parameters, method);
        }

        /// <summary>The first conflict of parameters that are complete, or null.</summary>
        public static ParameterConflict? FindInScene(SimulationParameters parameters)
        {
            bool hasWalls = parameters.Scene.Walls.Length > 0;
            return Find(parameters) ?? (parameters.Drive.HubForceLimit > 0.0 && !hasWalls
                ? new ParameterConflict("hubForceLimit", "a vessel or obstacles: without walls a hub holds the wire")
                : parameters.Scene.Sheath != null ? OfSheath(parameters, hasWalls) : null);
        }

        private static ParameterConflict? OfSheath(SimulationParameters parameters, bool hasWalls)
        {
            SceneParameters scene = parameters.Scene;
            bool isDriven = parameters.Drive.Steering != null || parameters.Drive.Kind == Drive.Displace
                || parameters.Drive.Kind == Drive.Hold;
            string? needed = !hasWalls ? "a vessel"
                : !IsClamped(parameters) ? "proximalEnd \"clamped\""
                : !isDriven ? "drive \"displace\" or \"hold\""
                : scene.DistalEnd != DistalEnd.Free ? "distalEnd \"free\""
                : scene.StartShape != StartShape.Straight ? "startShape \"straight\""
                : parameters.Method.Integrator != Integrator.ImplicitEuler ? "integrator \"implicitEuler\""
                : parameters.Material.BendLaw != BendLaw.RotationVector ? "bendLaw \"rotationVector\""
                : parameters.Drive.Displacement != 0.0 && parameters.Drive.Kind == Drive.Hold ? "displacement 0"
                : null;
            return needed == null ? null : new ParameterConflict("sheath", needed);
        }

        private static ParameterConflict? OfMethod(SimulationParameters parameters, MethodTraits method)
        {
            if (method.Integrators.Count > 0 && !Contains(method, parameters.Method.Integrator))
            {
                return new ParameterConflict("integrator", "one of \"" + string.Join("\", \"", Words(method))
                    + "\" with solver \"" + Word(method.Solver) + "\"");
            }
            if (!method.MeetsWalls && parameters.Scene.Walls.Length > 0)
            {
                return new ParameterConflict("vessel", "solver pbd, xpbd or direct: explicit meets no walls");
            }
            if (method.TakesMaterial && parameters.Scene.Walls.Length > 0
                && parameters.Scene.InitialState == InitialState.Equilibrium)
            {
                return new ParameterConflict("initialState",
                    "\"straight\" between walls: rest shapes are found without them");
            }
            bool hasFriction = Array.Exists(parameters.Scene.Walls, wall => wall.FrictionCoefficient > 0.0);
            if (hasFriction && method.HasBarriers && parameters.Method.Integrator != Integrator.ImplicitEuler)
            {
                return new ParameterConflict("integrator", "implicitEuler where a wall has a frictionCoefficient");
            }
            if (hasFriction && !method.TakesMaterial && parameters.Contact.ElementContact == ElementContact.Thesis)
            {
                return new ParameterConflict("elementContact",
                    "\"barycentric\" or \"none\" where a wall has a frictionCoefficient");
            }
            if (!method.TakesSteering && parameters.Drive.Steering != null)
            {
                return new ParameterConflict("solver", "pbd or direct where a hand steers");
            }
            if (method.TakesMaterial && parameters.Method.Damping != 0.0)
            {
                return new ParameterConflict("damping", "solver pbd: a material has massDamping (1/s), which is damping"
                    + " over timeStep, and materialDamping (s)");
            }
            if (parameters.Material.MaterialDamping != 0.0 && method.Solver != Solver.Direct && method.TakesMaterial)
            {
                return new ParameterConflict("materialDamping", "solver direct: the others have no rates of strain");
            }
            if (!method.TakesTipMoment && parameters.Scene.TipMoment != Vector3d.Zero)
            {
                return new ParameterConflict("tipMoment", "solver direct or explicit: the others have no couples");
            }
            if (!method.TakesDarbouxLaw && parameters.Material.BendLaw == BendLaw.Darboux)
            {
                return new ParameterConflict("bendLaw",
                    "solver direct or explicit: xpbd has the rotation vector only");
            }
            Integrator integrator = parameters.Method.Integrator;
            if (parameters.Method.TimeStepError > 0.0
                && (integrator == Integrator.ImplicitEuler || integrator == Integrator.Bdf2))
            {
                return new ParameterConflict("timeStepError",
                    "integrator trbdf2, esdirk3 or esdirk4: the others do not tell their error");
            }
            return null;
        }

        private static ParameterConflict? OfEnds(SimulationParameters parameters, MethodTraits method)
        {
            SceneParameters scene = parameters.Scene;
            Drive drive = parameters.Drive.Kind;
            if (!method.TakesMaterial && scene.ProximalEnd == ProximalEnd.Free)
            {
                return new ParameterConflict("proximalEnd",
                    "\"held\" or \"clamped\" with solver pbd; drive \"force\" frees sphere 0");
            }
            // With pbd "held" is the default and says nothing, and there is no "free".
            bool isLetGo = method.TakesMaterial ? scene.ProximalEnd == ProximalEnd.Free
                : scene.ProximalEnd != ProximalEnd.Clamped;
            if (drive == Drive.Force && !isLetGo)
            {
                return new ParameterConflict("drive", method.TakesMaterial
                    ? "proximalEnd \"free\" with \"force\", which holds nothing"
                    : "proximalEnd \"held\" with \"force\", which frees sphere 0");
            }
            if (!method.Slides && scene.DistalEnd == DistalEnd.Sliding)
            {
                return new ParameterConflict("distalEnd",
                    "\"free\" or \"clamped\": only solver direct lets an end slide");
            }
            // The last joint sees a turn at once as one by less than half a turn, and the shorter way round.
            if (!method.WindsUpAtOnce && scene.DistalEnd == DistalEnd.Clamped && scene.DistalRampTime == 0.0
                && Math.Abs(scene.DistalRotation) > 1.0)
            {
                return new ParameterConflict("distalRotation",
                    "solver direct, or a distalRampTime > 0: turned at once by more than 1 rad");
            }
            if (method.TakesMaterial && parameters.Drive.TwistPerStep != 0.0 && !IsClamped(parameters))
            {
                return new ParameterConflict("twistPerStep", "proximalEnd \"clamped\" in a run with a material");
            }
            if (method.TakesMaterial && scene.ProximalEnd == ProximalEnd.Free
                && (drive == Drive.Displace || drive == Drive.Push))
            {
                return new ParameterConflict("proximalEnd",
                    "\"held\" or \"clamped\" with a drive that moves sphere 0");
            }
            return null;
        }

        // Every group of keys says on its own how the hub moves.
        private static ParameterConflict? OfHub(SimulationParameters parameters, MethodTraits method)
        {
            DriveParameters drive = parameters.Drive;
            if (!method.TakesMaterial)
            {
                return null;
            }
            bool hasTable = drive.Table != null;
            if (drive.DisplacementPerStep != 0.0 && (drive.InsertionSpeed != 0.0 || hasTable))
            {
                return new ParameterConflict("displacementPerStep", "0 with an insertionSpeed or a driveFile");
            }
            if (drive.TwistPerStep != 0.0 && (drive.RotationSpeed != 0.0 || hasTable))
            {
                return new ParameterConflict("twistPerStep", "0 with a rotationSpeed or a driveFile");
            }
            if (hasTable && (drive.InsertionSpeed != 0.0 || drive.RotationSpeed != 0.0))
            {
                return new ParameterConflict("driveFile", "insertionSpeed and rotationSpeed to be 0: it has both");
            }
            string? key = hasTable ? "driveFile" : drive.RotationSpeed != 0.0 ? "rotationSpeed" : null;
            if (key != null && !IsClamped(parameters))
            {
                return new ParameterConflict(key, "proximalEnd \"clamped\", and no drive \"force\"");
            }
            if (drive.Steering != null && !IsClamped(parameters))
            {
                return new ParameterConflict("proximalEnd", "\"clamped\" where a hand steers a wire with a material");
            }
            key = hasTable ? key : drive.InsertionSpeed != 0.0 ? "insertionSpeed" : null;
            return key != null && drive.Kind != Drive.Displace && drive.Kind != Drive.Push
                ? new ParameterConflict(key, "drive \"displace\" or \"push\"") : null;
        }

        private static ParameterConflict? OfStart(SimulationParameters parameters, MethodTraits method)
        {
            SceneParameters scene = parameters.Scene;
            if (method.TakesMaterial && parameters.Material.InnerRadius >= parameters.Material.WireRadius)
            {
                return new ParameterConflict("innerRadius", "less than wireRadius");
            }
            if (method.TakesMaterial && HasHollowTooWide(parameters.Material))
            {
                return new ParameterConflict("wireSections", "an innerRadius less than the wireRadius everywhere");
            }
            if (method.TakesMaterial && !HasStiffness(parameters))
            {
                return new ParameterConflict("wireRadius", "a bending stiffness over guidewireLength^2 that is a number"
                    + " > 0, with youngsModulus and metresPerUnit");
            }
            string? layout = ElementLayout.FindProblem(parameters);
            if (layout != null)
            {
                return new ParameterConflict("wireSections", layout);
            }
            if (parameters.Drive.DisplacementDirection.Length == 0.0)
            {
                return new ParameterConflict("displacementDirection", "a length other than 0");
            }
            if (scene.StartShape == StartShape.Helix && 2.0 * Math.PI * Math.Abs(scene.StartTurns)
                * scene.StartRadius >= scene.GuidewireLength)
            {
                return new ParameterConflict("startTurns",
                    "a helix shorter than guidewireLength: 2 pi startTurns startRadius is more");
            }
            if (method.TakesMaterial && scene.InitialState == InitialState.Equilibrium && !IsClamped(parameters)
                && scene.DistalEnd == DistalEnd.Free)
            {
                return new ParameterConflict("initialState",
                    "a clamped end: a wire that turns freely has no single rest shape");
            }
            return null;
        }

        private static bool HasHollowTooWide(MaterialParameters material)
        {
            foreach (WireSection section in material.Sections)
            {
                // Where a section begins or ends is where something changes.
                if (!(CrossSection.At(material, section.From).StretchStiffness > 0.0)
                    || !(CrossSection.At(material, section.To).StretchStiffness > 0.0))
                {
                    return true;
                }
            }
            return false;
        }

        // The scale of all bending forces; 0 or infinite as a double, it measures nothing.
        private static bool HasStiffness(SimulationParameters parameters)
        {
            double length = parameters.Scene.MetresPerUnit * parameters.Scene.GuidewireLength;
            double force = CrossSection.At(parameters.Material, 0.0).BendStiffness1 / (length * length);
            return force > 0.0 && !double.IsInfinity(force);
        }

        private static bool IsClamped(SimulationParameters parameters)
        {
            return parameters.Scene.ProximalEnd == ProximalEnd.Clamped && parameters.Drive.Kind != Drive.Force;
        }

        private static bool Contains(MethodTraits method, Integrator integrator)
        {
            foreach (Integrator own in method.Integrators)
            {
                if (own == integrator)
                {
                    return true;
                }
            }
            return false;
        }

        private static string[] Words(MethodTraits method)
        {
            var words = new string[method.Integrators.Count];
            for (int k = 0; k < words.Length; k++)
            {
                words[k] = Word(method.Integrators[k]);
            }
            return words;
        }

        // As in files: in camelCase.
        private static string Word(Enum value)
        {
            string name = value.ToString();
            return char.ToLowerInvariant(name[0]) + name.Substring(1);
        }
    }
}
