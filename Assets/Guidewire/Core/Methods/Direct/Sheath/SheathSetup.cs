using System;

namespace Guidewire.Core
{
    /// <summary>Builds the simulated part of a wire in a sheath, from a given element on, and finds the exit.</summary>
    internal sealed class SheathSetup
    {
        private readonly SimulationParameters _parameters;
        private readonly MaterialScene _whole;
        private readonly double[] _jointLengths;  // m
        private readonly JointPieces _pieces;
        private readonly Barrier _barrier;
        private readonly SupportSpring _support;
        private readonly WorkLimit _work;

        /// <summary>For the wire of this scene.</summary>
        /// <exception cref="ArgumentException">A sheath from which the wire cannot be fed into the vessel.</exception>
        public SheathSetup(SimulationParameters parameters, MaterialScene whole)
        {
            _parameters = parameters;
            _whole = whole;
            Axis = whole.Schedule.Hub.Frame.Director3;
            Stations = new double[whole.Rod.ElementCount + 1];
            for (int j = 0; j < whole.Rod.ElementCount; j++)
            {
                Stations[j + 1] = Stations[j] + whole.Rod.Length[j];
            }
            Exit = whole.Metres * SheathExit.Find(parameters.Scene.Sheath!, whole);
            var even = new RodSupports { Clamp = ClampRule.HalfElement };
            Joints = whole.Rod.Joints(even);
            _jointLengths = whole.Rod.JointLengths(even);
            _pieces = new JointPieces(new InstrumentProfile(
                new WireProfile(parameters.Material, parameters.Scene.GuidewireLength), whole.Metres), Stations);
            _barrier = BarrierDefaults.Of(whole.Rod, parameters.Contact, whole.Walls, whole.Metres,
                parameters.Drive.LargestMove(parameters.Method.TimeStep, whole.Metres));
            _support = new SupportSpring(whole.Rod, parameters.Drive.HubForceLimit);
            _work = new WorkLimit(parameters.Method.MaxNewtonIterations);
        }

        /// <summary>Where the sheath leads, a unit vector.</summary>
        public Vector3d Axis { get; }

        /// <summary>Where it ends, m.</summary>
        public Vector3d Exit { get; }

        /// <summary>Distance at rest of each of the n + 1 nodes from node 0, m.</summary>
        public double[] Stations { get; }

        /// <summary>The n + 1 joints of the whole wire.</summary>
        public Joint[] Joints { get; }

        /// <summary>The last element that is wholly in the sheath, or the first of the least number of
        /// elements.</summary>
        public int FirstElement(RodShape shape, int leastElements)
        {
            int first = shape.ElementCount - leastElements;
            while (first > 0 && Vector3d.Dot(shape.X[first + 1] - Exit, Axis) > 0.0)
            {
                first--;
            }
            return first;
        }

        /// <summary>Lets the hub go along the sheath, on to its exit, and back until the tip is there.</summary>
        public void LimitDrive(RodShape shape)
        {
            int n = shape.ElementCount;
            _whole.Drive.Limit(-Vector3d.Dot(shape.X[n] - Exit, Axis), Vector3d.Dot(Exit - shape.X[0], Axis));
        }

        /// <summary>What the sheathed part is to the elements from one on.</summary>
        public SheathWindow Window(int first)
        {
            return new SheathWindow(_whole.Rod, Joints, _jointLengths, _pieces, first, new SheathEnd(Exit, Axis));
        }

        /// <summary>The elements of a window as a scene of their own, with a hub of its own.</summary>
        /// <param name="drive">Of the window before, as far as it has come.</param>
        /// <param name="shift">How much farther from the hub the window's first node is than that one's, m.</param>
        /// <param name="frameTurn">Where the frame of the first joint is held, radians.</param>
        public MaterialScene Scene(SheathWindow window, RodShape shape, Vector3d[] velocities, Vector3d[] spins,
            MaterialDrive drive, double shift, double frameTurn)
        {
            int first = window.First;
            var part = new RodShape(shape.ElementCount - first);
            Array.Copy(shape.X, first, part.X, 0, part.X.Length);
            Array.Copy(shape.Q, first, part.Q, 0, part.Q.Length);
            var hub = new HubMotion(drive.Hub, shift * Axis, frameTurn);
            part.ProximalFrame = hub.FrameTurned(frameTurn);
            part.DistalFrame = shape.DistalFrame;
            return new MaterialScene(_whole, _whole.Rod.From(first), window, part,
                new MaterialDrive(drive, hub, Axis))
            {
                Velocities = Tail(velocities, first),
                Spins = Tail(spins, first),
            };
        }

        /// <summary>The motion of a window's elements.</summary>
        /// <param name="before">The contact of the window before, which is not to be used any more, or null.</param>
        /// <param name="entered">Elements that have entered since, negative where some have left.</param>
        public RodDynamics Dynamics(MaterialScene scene, SheathWindow window, BarrierEnergy? before, int entered)
        {
            WallTerms walls = DirectSetup.WallTermsOf(_parameters, scene, _barrier,
                _support.InSeries(window.AxialCompliance));
            if (before != null)
            {
                walls.Barrier.TakeNeighbours(before, entered);
            }
            var terms = new RodTerms(scene.Rod, scene.Supports, _parameters.Scene, walls, Array.Empty<EnergyTerm>());
            return DirectSetup.DynamicsOf(_parameters, scene, terms, _work);
        }

        private static Vector3d[] Tail(Vector3d[] all, int first)
        {
            var tail = new Vector3d[all.Length - first];
            Array.Copy(all, first, tail, 0, tail.Length);
            return tail;
        }
    }
}
