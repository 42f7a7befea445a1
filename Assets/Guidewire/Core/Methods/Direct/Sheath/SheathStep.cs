using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Steps of a wire in a sheath: only what is outside is simulated, by a <see cref="DirectStep"/> of its
    /// own, and elements come and go with the hub. The sheathed part is straight on the sheath's axis and massless: a
    /// spring along it and one about it, in series with the hub.</summary>
    /// <remarks>What is simulated begins with an element that is wholly in the sheath until the step's end, however far
    /// the hub goes, by the hub's position and, where the wire is stretched, by its own: so every joint that comes out,
    /// or goes in, does so within a step, and no force and no energy changes where an element comes in, with the strain
    /// and the twist that the springs have. It goes again where the next one is well inside too. What is simulated is
    /// rebuilt whenever that happens.</remarks>
    internal sealed class SheathStep : TimeStepper
    {
        private const double Late = 0.3;        // of an element's length, by which it goes late
        private const int LeastElements = 2;

        private readonly SimulationParameters _parameters;
        private readonly MaterialScene _whole;
        private readonly SolverReport _report;
        private readonly SheathSetup _setup;
        private readonly StressRecord _stress;
        private readonly RodShape _shape;         // of the whole wire
        private readonly Vector3d[] _velocities;
        private readonly Vector3d[] _spins;
        private readonly FrictionAnchors _anchors;
        private SheathWindow _window;
        private RodDynamics _dynamics = null!;    // this and the next are set wherever the window is
        private DirectStep _inner = null!;
        private MaterialDrive _drive;             // of what is simulated
        private double _frameTurn;                // of the frame of the window's first joint, radians

        /// <summary>A step for this scene.</summary>
        public SheathStep(SimulationParameters parameters, MaterialScene whole, SolverReport report)
        {
            _parameters = parameters;
            _whole = whole;
            _report = report;
            int n = whole.Rod.ElementCount;
            _shape = new RodShape(n);
            _shape.CopyFrom(whole.Shape);
            _velocities = (Vector3d[])whole.Velocities.Clone();
            _spins = (Vector3d[])whole.Spins.Clone();
            _anchors = new FrictionAnchors(parameters.Scene.Walls.Length, n);
            _stress = new StressRecord(whole.Rod, whole.Supports);
            _setup = new SheathSetup(parameters, whole);
            Contacts = new ContactRecord(n + 1)
            {
                WallForces = new Vector3d[parameters.Scene.Walls.Length],
            };
            Contacts.SetElements(n, whole.Walls);
            int first = _setup.FirstElement(_shape, LeastElements);
            _setup.LimitDrive(_shape);
            _drive = whole.Drive;
            _window = _setup.Window(first);
            Build(0.0, _setup.Stations[first], 0, null);
        }

        /// <inheritdoc/>
        public override ContactRecord? Contacts { get; }

        /// <summary>The motion of what is simulated.</summary>
        public RodDynamics Dynamics => _dynamics;

        /// <summary>Steps what is simulated.</summary>
        public DirectStep Inner => _inner;

        /// <inheritdoc/>
        public override void AddWarnings(List<RunWarning> warnings)
        {
            _inner.AddWarnings(warnings);
        }

        /// <inheritdoc/>
        public override void Advance(RodState state)
        {
            MoveWindow();
            bool isDone = _inner.Step();
            Failure = _inner.Failure;
            Divergence = _inner.Divergence;
            SteadyState = _inner.SteadyState;
            PredictionError = _inner.PredictionError;
            if (isDone)
            {
                TakeWindow();
                _whole.Write(state, _shape, _velocities, _spins);
            }
        }

        /// <inheritdoc/>
        public override StressRecord? Stress()
        {
            double thrust = AxialForce();
            _stress.Take(_inner.Stress()!, _window, thrust, Torque());
            return _stress;
        }

        /// <inheritdoc/>
        public override HubRecord? Hub()
        {
            return _inner.Hub();
        }

        /// <inheritdoc/>
        public override SolverReport? Report()
        {
            return _inner.Report();
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            int first = _window.First;
            double time = _dynamics.Time;
            snapshot.Serialize(ref first);
            snapshot.Serialize(ref _frameTurn);
            snapshot.Serialize(ref time);
            snapshot.Serialize(_shape.X);
            snapshot.Serialize(_shape.Q);
            snapshot.Serialize(_velocities);
            snapshot.Serialize(_spins);
            if (!snapshot.IsWritten)
            {
                _window = _setup.Window(first);
                Build(time, 0.0, 0, null);
            }
            _inner.Serialize(snapshot);
            TakeAnchors();
            Contacts!.Take(_inner.Contacts!, _window.First);
        }

        /// <summary>Begins a step: elements that will reach the exit enter the window, others leave. A second call
        /// changes nothing.</summary>
        public void MoveWindow()
        {
            int first = _window.First;
            double[] station = _setup.Stations;
            double move = Math.Max(0.0, _drive.NextMove(_dynamics.Time));
            double exit = _window.ExitFrom(_drive.Hub.PositionAt(_dynamics.Time)) - move;
            // How far a node will be beyond the exit at most.
            double Beyond(int i) => Math.Max(station[i] - exit, _window.Outside(_shape.X[i]) + move);
            while (first > 0 && Beyond(first + 1) > 0.0)
            {
                first--;
                Enter(first);
            }
            int last = _shape.ElementCount - LeastElements;
            while (first < last && Beyond(first + 2) < -Late * _whole.Rod.Length[first + 1])
            {
                first++;
            }
            if (first == _window.First)
            {
                return;
            }
            double torque = Torque();
            double shift = _setup.Stations[first] - _setup.Stations[_window.First];
            double own = TurnOf(_window.First) - TurnInSheath(_window.First, 0.0, torque);
            for (int j = first; j < _window.First; j++)
            {
                _shape.Q[j] = _drive.Hub.FrameTurned(TurnInSheath(j, own, torque));
            }
            _frameTurn = first < _window.First ? TurnInSheath(first, own, torque) : TurnOf(first);
            int entered = _window.First - first;
            _window = _setup.Window(first);
            Build(_dynamics.Time, shift, entered, _inner);
        }

        // Where a sheathed element enters: on the axis, as long as the axial force leaves it.
        private void Enter(int j)
        {
            Vector3d next = _shape.X[j + 1];
            double length = _whole.Rod.Length[j] * (1.0 - AxialForce() / _whole.Rod.StretchStiffness[j]);
            double position = _window.Outside(next) - length;
            _shape.X[j] = _setup.Exit + position * _setup.Axis;
            _velocities[j] = Vector3d.Dot(_velocities[j + 1], _setup.Axis) * _setup.Axis;
            _spins[j] = new Vector3d(0.0, 0.0, _spins[j + 1].Z);
        }

        // The first node is so far along the wire from that of the window before, m, and so many elements have entered.
        private void Build(double time, double shift, int entered, DirectStep? old)
        {
            double besides = old == null ? 0.0 : _dynamics.Terms.Walls()!.Spring.Besides;
            Vector3d held = old == null ? Vector3d.Zero
                : _dynamics.Terms.Walls()!.Spring.HeldPosition(_dynamics.Shape) + shift * _setup.Axis;
            MaterialScene scene = _setup.Scene(_window, _shape, _velocities, _spins, _drive, shift,
                _frameTurn);
            _drive = scene.Drive;
            BarrierEnergy? before = old == null ? null : _dynamics.Terms.Walls()!.Barrier;
            _dynamics = _setup.Dynamics(scene, _window, before, entered);
            _dynamics.GoOn(time, _frameTurn);
            _dynamics.Terms.SetTime(scene.Schedule, time);
            _dynamics.Terms.Walls()!.Spring.Axis = _setup.Axis;
            _dynamics.Terms.Walls()!.Spring.Besides = besides;  // the hub's force stays within its limit
            _inner = new DirectStep(scene, _dynamics, _parameters.Method, _report,
                new ContactRecord(scene.Shape.X.Length));
            _inner.Contacts!.Take(Contacts!, -_window.First);
            _dynamics.Terms.Walls()!.Friction?.Anchors.Take(_anchors, _window.First);
            if (old != null)
            {
                var counts = new Snapshot();
                old.SerializeCounts(counts);
                _inner.SerializeCounts(counts.ToRead());
                // An element that leaves may have another force than the springs that take its place.
                _inner.Contacts.DriveShortfall -= _drive.Gone(
                    held, _dynamics.Terms.Walls()!.Spring.HeldPosition(_dynamics.Shape)) / scene.Metres;
            }
        }

        private void TakeAnchors()
        {
            FrictionEnergy? friction = _dynamics.Terms.Walls()!.Friction;
            if (friction != null)
            {
                _anchors.Take(friction.Anchors, -_window.First);
            }
        }

        // The whole wire, of what was simulated and what the springs say of the rest.
        private void TakeWindow()
        {
            int first = _window.First;
            RodShape shape = _dynamics.Shape;
            Array.Copy(shape.X, 0, _shape.X, first, shape.X.Length);
            Array.Copy(shape.Q, 0, _shape.Q, first, shape.Q.Length);
            Array.Copy(_dynamics.Velocities, 0, _velocities, first, shape.X.Length);
            Array.Copy(_dynamics.Spins, 0, _spins, first, shape.Q.Length);
            TakeAnchors();
            double thrust = AxialForce();
            double torque = Torque();
            double position = _window.Outside(_shape.X[first]);
            for (int j = first - 1; j >= 0; j--)
            {
                position -= _whole.Rod.Length[j] * (1.0 - thrust / _whole.Rod.StretchStiffness[j]);
                _shape.X[j] = _setup.Exit + position * _setup.Axis;
                _velocities[j] = Vector3d.Dot(_velocities[first], _setup.Axis) * _setup.Axis;
                _spins[j] = new Vector3d(0.0, 0.0, _spins[first].Z);
            }
            // Most joints are alike: sines are dear beside the rest.
            Quaterniond frame = _drive.Hub.FrameTurned(_drive.Hub.TurnAt(_dynamics.Time));
            Quaterniond turned = Quaterniond.Identity;
            double before = 0.0;
            for (int j = 0; j < first; j++)
            {
                double turn = TurnOfJoint(j, torque);
                turned = turn == before ? turned : Quaterniond.FromAxisAngle(Vector3d.UnitZ, turn);
                before = turn;
                frame = frame * turned;
                _shape.Q[j] = frame;
            }
            Contacts!.Take(_inner.Contacts!, first);
        }

        // Of the hub on the wire along the axis, N.
        private double AxialForce()
        {
            return Vector3d.Dot(_dynamics.Terms.Walls()!.Spring.Force(_dynamics.Shape), _setup.Axis);
        }

        // Of the wire on the sheathed part about the axis, N m, positive where it is ahead of the hub.
        private double Torque()
        {
            _dynamics.Terms.SetTime(_inner.Schedule, _dynamics.Time);
            return -_dynamics.Terms.Bending.TurnCouple(_dynamics.Shape);
        }

        private double TurnOfJoint(int k, double torque)
        {
            return torque / _setup.Joints[k].Twist + _setup.Joints[k].Rest.Z;
        }

        // Of a sheathed element, radians, from a turn of the hub on.
        private double TurnInSheath(int element, double hub, double torque)
        {
            for (int k = 0; k <= element; k++)
            {
                hub += TurnOfJoint(k, torque);
            }
            return hub;
        }

        // Of an element that is simulated, radians, joint by joint from the frame.
        private double TurnOf(int element)
        {
            double turn = _frameTurn + _dynamics.Terms.Bending.TurnOf(_dynamics.Shape, 0).Z;
            for (int j = _window.First + 1; j <= element; j++)
            {
                turn += RotationVector.Log(_shape.Q[j - 1].Conjugate * _shape.Q[j]).Z;
            }
            return turn;
        }
    }
}
