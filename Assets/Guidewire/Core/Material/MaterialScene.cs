using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>A scene with a wire that has a material, in SI units: the rod and its supports in addition to the
    /// scene. The input of every method for a material.</summary>
    internal sealed class MaterialScene
    {
        private readonly Scene _scene;

        /// <summary>The scene of these parameters.</summary>
        public MaterialScene(SimulationParameters parameters, Scene scene)
        {
            _scene = scene;
            Shape = scene.Shape;
            Velocities = scene.Velocities;
            Spins = scene.Spins;
            Rod = CreateRod(parameters, scene.ElementLengths);
            Supports = new RodSupports
            {
                Proximal = parameters.Drive.Kind == Core.Drive.Force ? ProximalEnd.Free : parameters.Scene.ProximalEnd,
                Distal = parameters.Scene.DistalEnd,
                Clamp = parameters.Material.ClampRule,
                Mass = parameters.Material.MassRule,
                Bend = parameters.Material.BendLaw,
            };
            SetFrames(parameters.Scene.Start?.Hub == null ? parameters.Scene.Start : null);
            Supports.SlidingAxis = Shape.DistalFrame.Director3;
            bool hasContact = scene.Walls.Length > 0 || parameters.Contact.TouchesItself(0);
            Supports.HasSpring = hasContact && Supports.Proximal != ProximalEnd.Free
                && MethodTable.Of(parameters.Method.Solver).HasBarriers;
            Schedule = scene.Schedule;
            Schedule.Hub.Shift(scene.Displacement);
            Drive = new MaterialDrive(parameters, scene, Supports.HasSpring);
            StartsStraight = parameters.Scene.Start == null && parameters.Scene.StartShape == StartShape.Straight;
            AlignTurns();
            Joints = new JointMonitor(this, parameters.Method.MaxSimulationSteps * parameters.Method.TimeStep);
        }

        /// <summary>Coaxial instruments as one rod, as a scene of its own.</summary>
        /// <param name="outer">The scene of the outer one alone.</param>
        /// <param name="coaxial">The rod.</param>
        /// <param name="shape">Where it is.</param>
        /// <param name="drive">Moves the outer hub.</param>
        /// <param name="inner">The motions of the inner hubs.</param>
        /// <param name="loads">Those that change in time.</param>
        public MaterialScene(MaterialScene outer, CoaxialRod coaxial, RodShape shape, MaterialDrive drive,
            HubMotion[] inner, PrescribedLoads loads)
        {
            _scene = outer._scene;
            Rod = coaxial.Rod;
            Shape = shape;
            Velocities = new Vector3d[shape.X.Length];
            Spins = new Vector3d[shape.Q.Length];
            StartsStraight = true;
            Supports = new RodSupports
            {
                Clamp = ClampRule.HalfElement,
                Mass = outer.Supports.Mass,
                HasSpring = outer.Supports.HasSpring,
                Coaxial = coaxial,
            };
            Drive = drive;
            Schedule = new RodSchedule(loads, drive.Hub, outer.Schedule.Distal, inner);
            Joints = new JointMonitor(this, 0.0);
        }

        /// <summary>Metres per unit.</summary>
        public double Metres => _scene.UnitLength;

        /// <summary>The rod.</summary>
        public MaterialRod Rod { get; }

        /// <summary>How it is held.</summary>
        public RodSupports Supports { get; }

        /// <summary>What moves node 0 in every step.</summary>
        public MaterialDrive Drive { get; }

        /// <summary>Finds joints that are turned too far.</summary>
        public JointMonitor Joints { get; }

        /// <summary>Whether the rod sets out straight, from no shape of its own.</summary>
        public bool StartsStraight { get; }

        /// <summary>Where the rod is at the start, before the displacement of sphere 0, m.</summary>
        public RodShape Shape { get; }

        /// <summary>Whether a run had come there, by an open rim, too.</summary>
        public bool IsReached => _scene.IsReached;

        /// <summary>Where the sheath of that run ends, m; null: where the scene says.</summary>
        public Vector3d? ExitOfSheath => _scene.ExitOfSheath;

        /// <summary>Velocities at the start, m/s.</summary>
        public Vector3d[] Velocities { get; set; }

        /// <summary>Angular velocities at the start along the elements' axes, rad/s.</summary>
        public Vector3d[] Spins { get; set; }

        /// <summary>The vessel and what stands in it, in units.</summary>
        public ContactShape[] Walls => _scene.Walls;

        /// <summary>What is prescribed.</summary>
        public RodSchedule Schedule { get; }

        /// <summary>Takes where the rod is from a start; its hub holds it as that is turned.</summary>
        public void StartFrom(RodStart start)
        {
            _scene.StartFrom(start);
            Shape.ProximalFrame = Schedule.Hub.FrameTurned(Schedule.Hub.TurnAt(0.0));
            AlignTurns();
            Joints.Begin(Shape, 0.0);
        }

        /// <summary>Writes a moment of the rod into a state: positions and velocities in units, orientations and
        /// angular velocities.</summary>
        public void Write(RodState state, RodShape shape, Vector3d[] velocities, Vector3d[] spins)
        {
            double units = 1.0 / Metres;
            int n = shape.ElementCount;
            for (int i = 0; i <= n; i++)
            {
                state.PredictedPositions[i] = units * shape.X[i];
                state.Velocities[i] = units * velocities[i];
            }
            System.Array.Copy(shape.Q, state.PredictedOrientations, n);
            System.Array.Copy(spins, state.AngularVelocities, n);
            state.Advance();
        }

        // Those of a start that does not state them.
        private void SetFrames(RodStart? start)
        {
            if (start != null && start.ProximalFrame == null && Supports.HasProximalJoint)
            {
                Shape.ProximalFrame = ClampExtrapolation.Frame(Shape, Rod.Length, Rod.JointLengths(Supports), true);
                _scene.Schedule.Hub.Begin(Shape.ProximalFrame);
            }
            if (start != null && start.DistalFrame == null && Supports.HasDistalJoint)
            {
                Shape.DistalFrame = ClampExtrapolation.Frame(Shape, Rod.Length, Rod.JointLengths(Supports), false);
            }
        }

        // q and -q are the same orientation. A start counts each joint's turn as the shorter one, with Re(q_a* q_b) of
        // 0 or more; from then on the signs record the turns of joints (JointMonitor).
        private void AlignTurns()
        {
            Quaterniond before = Shape.ProximalFrame;
            for (int j = 0; j < Shape.ElementCount; j++)
            {
                before = Quaterniond.Aligned(before, Shape.Q[j]);
                Shape.Q[j] = before;
            }
            Shape.DistalFrame = Quaterniond.Aligned(before, Shape.DistalFrame);
            Schedule.Distal.Begin(Shape.DistalFrame);
        }

        internal static MaterialRod CreateRod(SimulationParameters parameters, double[] lengths)
        {
            var profile = new WireProfile(parameters.Material, parameters.Scene.GuidewireLength);
            ElementLayout.Lengths(parameters, 1.0, out double[] positions);
            var rod = new MaterialRod(lengths.Length)
            {
                MassDamping = parameters.Material.MassDamping,
                MaterialDamping = parameters.Material.MaterialDamping,
            };
            for (int j = 0; j < lengths.Length; j++)
            {
                rod.Length[j] = lengths[j];
                profile.SetElement(rod, j, positions[j], positions[j + 1]);
            }
            double metres = parameters.Scene.MetresPerUnit;
            rod.Fibres = FibreMemory.Create(new InstrumentProfile(profile, metres),
                System.Array.ConvertAll(positions, position => metres * position));
            if (parameters.Material.Shaped is Shaping shaped && rod.Fibres != null
                && Mandrel.Find(shaped, parameters.Material, metres) is (double bent, _))
            {
                // As bends of the library's tips: towards -d2.
                double sense = shaped.Angle < 0.0 ? 1.0 : -1.0;
                rod.Fibres.Shape(metres * shaped.From, metres * shaped.To, sense * bent);
            }
            return rod;
        }
    }

    /// <summary>Checks where a wire with a material starts: the surface of no element may touch a rigid wall, nor the
    /// limit of a soft one.</summary>
    internal static class MaterialStart
    {
        private const string Wire = "the wire";
        private const double Rounding = 1e-9;  // of the radius
        private const double Apart = 1e-4;     // of the radius, by which barriers begin with an open gap

        /// <summary>What is wrong with the start of a scene, in one phrase, or null. A surface at a wall but for
        /// rounding is moved off it, where barriers need a gap, by a ten-thousandth of the radius. What has no barriers
        /// touches walls, and contact may have let them in a little: of that the core line has to be free.</summary>
        public static string? FindProblem(SimulationParameters parameters, MaterialScene scene)
        {
            if (MethodTable.Of(parameters.Method.Solver).HasBarriers)
            {
                MoveApart(scene);
                return FindProblem(scene, 0, scene.Rod.ElementCount);
            }
            return FindProblem(scene, 0, scene.Rod.ElementCount,
                parameters.Scene.Start != null ? SweptSearch.ClearanceFor(1.0) : 1.0 - Rounding);
        }

        // Elements whose surface touches a wall within rounding.
        private static void MoveApart(MaterialScene scene)
        {
            double units = 1.0 / scene.Metres;
            foreach (ContactShape wall in scene.Walls)
            {
                for (int j = 0; j < scene.Rod.ElementCount && wall.Softness == null && wall.Motion == null; j++)
                {
                    double radius = units * scene.Rod.Radius[j];
                    int hint = -1;
                    if (wall.Nearest(units * scene.Shape.X[j], units * scene.Shape.X[j + 1], (1.0 + Rounding) * radius,
                        ref hint, out SurfaceContact near) && near.Distance >= (1.0 - Rounding) * radius)
                    {
                        Vector3d move = (Apart * scene.Rod.Radius[j]) * near.Normal;
                        scene.Shape.X[j] += move;
                        scene.Shape.X[j + 1] += move;
                    }
                }
            }
        }

        /// <summary>Why the wire from a position on cannot start, with its whole radius, or null. The position, in
        /// units, is in an element.</summary>
        public static string? FindProblemFrom(MaterialScene scene, int element, in Vector3d position,
            string name = Wire)
        {
            Vector3d[] x = Nodes(scene);
            x[element] = position;
            return FindProblem(scene, x, element, scene.Rod.ElementCount, 1.0, name);
        }

        /// <summary>Gives the same for the elements before one, exclusive.</summary>
        /// <param name="fraction">Of the radius, that has to be free.</param>
        /// <param name="name">What the phrase calls it.</param>
        public static string? FindProblem(MaterialScene scene, int from, int to, double fraction = 1.0,
            string name = Wire) => FindProblem(scene, Nodes(scene), from, to, fraction, name);

        private static Vector3d[] Nodes(MaterialScene scene)
        {
            double units = 1.0 / scene.Metres;
            return System.Array.ConvertAll(scene.Shape.X, node => units * node);
        }

        private static string? FindProblem(MaterialScene scene, Vector3d[] x, int from, int to, double fraction,
            string name)
        {
            double units = 1.0 / scene.Metres;
            for (int j = from; j < to; j++)
            {
                foreach (ContactShape wall in scene.Walls)
                {
                    if (wall.Motion != null && scene.IsReached)
                    {
                        continue;    // it was elsewhere then
                    }
                    double radius = units * (scene.Rod.Radius[j] - (wall.Softness?.MaxOf(scene.Rod.Radius[j]) ?? 0.0));
                    double narrowest = wall.Softness == null ? wall.Motion?.Narrowest ?? 1.0 : 1.0;
                    radius /= narrowest;
                    Vector3d[] onWall = wall.Motion == null ? x : OnWall(x, new WallField(wall.Motion));
                    if (!WireStart.IsFree(wall, scene.IsReached, onWall, j, fraction * radius, out double distance))
                    {
                        return name + (narrowest < 1.0 ? System.FormattableString.Invariant(
                            $", by 1/{narrowest:G3} thicker for the lumen that narrows,") : "")
                            + Text(j, x[j], x[j + 1], radius, distance, wall);
                    }
                }
            }
            return null;
        }

        private static Vector3d[] OnWall(Vector3d[] x, WallField field) =>
            System.Array.ConvertAll(x, node => field.AtRest(node));

        private static string Text(int j, in Vector3d a, in Vector3d b, double radius, double distance,
            ContactShape wall)
        {
            double narrowest = wall.NarrowestRadius(0.5 * radius, radius);
            return string.Format(CultureInfo.InvariantCulture,
                " starts outside: rod element {0} from {1} to {2}, radius {3:G4} units, reaches {4:G4} units"
                + " into the wall{5}", j, a, b, radius, radius - distance,
                double.IsInfinity(narrowest) ? "" : string.Format(CultureInfo.InvariantCulture,
                    "; the vessel's radius is {0:G4} units where it is narrowest", narrowest));
        }
    }
}
