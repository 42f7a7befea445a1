using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>One step of extended position-based dynamics (Macklin 2016): the time step is divided into substeps,
    /// each a prediction and m iterations over all constraints with compliance.</summary>
    /// <remarks>Where the iterations have converged a substep is one of implicit Euler, whatever m is.
    ///
    /// Multipliers start from those of the last substep, not from 0, and move the wire before the first iteration, all
    /// in the predicted shape. There are two reasons. A wire at rest then needs no correction at all, so its shape does
    /// not depend on m. And an iteration from 0 passes through shapes in which the first joints already pull and the
    /// last do not yet: elements are turned by h^2 K theta/J in between, and their forces retain the directions that
    /// they had there. No number of iterations takes that out again; such forces have no potential, and a twisted ring
    /// that should hold left its plane at 0.96 of its critical twist. Multipliers that would turn an element, or shift
    /// a node over its length, by more than 0.1 belong to a wave that a substep does not resolve, and are dropped.
    ///
    /// Orientations carry the wire's own rotary inertia rho I l (2 rho I l about the axis), 4 (l/r)^2 times less than a
    /// sphere's mass times l^2: 1,600 times in an element 20 radii long. So bending, shear and twist move as they do
    /// under every other solver, and waves of twist run at sqrt(G/rho). What an element does against its own shear, at
    /// 2 sqrt(G/rho)/r, is too fast for a substep and is damped away, as implicit Euler does; it does not bound the
    /// substep. What bounds it is sound along the wire, because an iteration brings a correction one element back: on
    /// wires with l/r from 2 to 100 runs converge up to h sqrt(E/rho)/l = 0.5 with m = 1, 1 with 3, 2 with 10, and
    /// diverge soon after.
    ///
    /// Between walls <see cref="CompliantWalls"/> stands around each substep, and <see cref="CompliantContacts"/> has a
    /// part in every iteration.
    ///
    /// How far the iterations were from convergence is measured in substeps 1, 2, 4, 8 .. and the last of each step,
    /// each for the time since the one before, because what a step changes is over in its first substeps; see <see
    /// cref="ConvergenceRecord"/>.</remarks>
    internal sealed class CompliantStep : MaterialStep
    {
        private const double LargestStart = 0.1;    // radians, or of an element's length

        private readonly RodVector[] _loadGradient;
        private readonly NodalInertia _inertia;
        private readonly CompliantStretch _stretch;
        private readonly CompliantBendTwist _bendTwist;
        private readonly RodShape _old;
        private readonly Vector3d[] _shift;
        private readonly Vector3d[] _turn;
        private readonly double _remainingVelocity;
        private readonly int _substeps;
        private readonly int _iterations;
        private readonly DirectionError _directions;
        private readonly ConvergenceRecord _convergence;
        private readonly CompliantWalls? _walls;
        private readonly double _contactStiffness;    // N/m
        private Vector3d _supportForce;    // sum over the substeps, N
        private Vector3d _predictedTip;
        private double _time;

        /// <summary>Makes a step for this scene.</summary>
        /// <param name="contactStiffness">Of a contact, N/m; 0 for rigid ones.</param>
        public CompliantStep(MaterialScene scene, RodTerms terms, MethodParameters method, SolverReport report,
            double contactStiffness)
            : this(scene, terms, new NodalInertia(terms.Mass, terms.Supports), method, report, contactStiffness)
        {
        }

        private CompliantStep(MaterialScene scene, RodTerms terms, NodalInertia inertia, MethodParameters method,
            SolverReport report, double contactStiffness)
            : this(scene, terms, inertia, method, report, contactStiffness,
                scene.Walls.Length > 0 ? new CompliantWalls(scene, inertia, contactStiffness) : null)
        {
        }

        private CompliantStep(MaterialScene scene, RodTerms terms, NodalInertia inertia, MethodParameters method,
            SolverReport report, double contactStiffness, CompliantWalls? walls)
            : base(scene, terms, inertia, scene.Velocities, scene.Spins, method, report, walls == null ? null
                : new ContactLoads(walls.Contacts, scene.Rod, contactStiffness, method.TimeStep / method.Substeps))
        {
            int n = scene.Shape.ElementCount;
            _loadGradient = new RodVector[n + 2];
            _inertia = inertia;
            _stretch = new CompliantStretch(scene.Rod, inertia.InverseMass, inertia.InverseInertia);
            _bendTwist = new CompliantBendTwist(scene.Rod, scene.Supports, inertia.InverseInertia);
            _old = new RodShape(n);
            _shift = new Vector3d[n + 1];
            _turn = new Vector3d[n];
            _remainingVelocity = Math.Exp(-scene.Rod.MassDamping * method.TimeStep / method.Substeps);
            _substeps = method.Substeps;
            _iterations = method.ConstraintSolverSteps;
            _contactStiffness = contactStiffness;
            _walls = walls;
            _directions = new DirectionError(scene, inertia, _stretch, _bendTwist, walls?.Contacts);
            _convergence = new ConvergenceRecord(scene.Rod.TotalLength);
        }

        /// <inheritdoc/>
        protected override double Time => _time;

        /// <inheritdoc/>
        public override void AddWarnings(List<RunWarning> warnings)
        {
            base.AddWarnings(warnings);
            _convergence.AddWarnings(warnings);
        }

        /// <inheritdoc/>
        public override ContactRecord? Contacts => _walls?.Record;

        /// <inheritdoc/>
        public override void Advance(RodState state)
        {
            double h = TimeStep / _substeps;
            var residual = default(IterationResidual);
            int measured = 0;
            Drive.Prepare(Shape, _time);
            Ends.Carry(Schedule.Hub.Velocity.Length, Math.Abs(Schedule.Hub.TwistRate));
            Vector3d start = Shape.X[0];
            Vector3d velocity = Velocities[0];
            _supportForce = Vector3d.Zero;
            _walls?.BeginStep(Shape);
            for (int k = 1; k <= _substeps; k++)
            {
                bool isMeasured = k == _substeps || (k & (k - 1)) == 0;
                Substep(_time + k * h, h, isMeasured);
                if (isMeasured)
                {
                    residual.Include(Residual(h), (k - measured) / (double)_substeps);
                    measured = k;
                }
            }
            _time += TimeStep;
            _convergence.Add(residual);
            if (HasBlownUp("; raise substeps or constraintSolverSteps"))
            {
                // The state stays that of the step before, and so does what contact and drive came to.
                return;
            }
            if (_walls != null)
            {
                EndWalls(_walls, h, start, velocity);
            }
            EndStep(_predictedTip);
            Write(state);
        }

        // Between walls: forces, and the displacement of node 0 that the drive asked for and walls prevented.
        private void EndWalls(CompliantWalls walls, double h, in Vector3d start, in Vector3d velocity)
        {
            walls.EndStep(h, _substeps);
            if (Scene.Supports.Proximal == ProximalEnd.Free)
            {
                return;
            }
            ContactRecord record = walls.Record;
            Vector3d inertia = (Terms.Mass.Nodal[0] / TimeStep) * (Velocities[0] - velocity);
            record.Reaction = inertia + (1.0 / _substeps) * _supportForce - record.Forces[0];
            // A drive continues from where node 0 is; a held node keeps a displacement until it has arrived.
            Vector3d position = Schedule.Hub.PositionAt(_time);
            if (Drive.Axis == Vector3d.Zero)
            {
                double owed = record.DriveShortfall;
                record.AddDrive(Vector3d.Distance(position, start) / Scene.Metres - owed,
                    Vector3d.Distance(position, Shape.X[0]) / Scene.Metres - owed);
                return;
            }
            // Of the displacement of node 0 only the component along the drive counts: walls may move it aside.
            double asked = Drive.CommandedDisplacement / Scene.Metres;
            record.AddDrive(asked, asked - Drive.AxialProgress(start, Shape.X[0]) / Scene.Metres);
        }

        /// <inheritdoc/>
        public override SolverReport? Report()
        {
            Results.Method = "Gauss-Seidel with compliance; each converged substep is one of "
                + "implicit Euler";
            Results.LargestError = _convergence.LargestError;
            Results.StepsNotConverged = _convergence.StepsAbove;
            Results.ContactStiffness = _walls == null || _contactStiffness == 0.0 ? double.NaN : _contactStiffness;
            return Results;
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            MaterialSnapshot.Serialize(snapshot, Schedule, Shape, Velocities, Spins, ref _time);
            Ends.Serialize(snapshot);
            int walls = Scene.Walls.Length;
            if (!snapshot.Section(walls == 0 ? "xpbd" : "xpbd, walls " + walls, SerializeHistory))
            {
                Energy.Start();
            }
            BeginTurns(snapshot, _time);
        }

        private void SerializeHistory(Snapshot snapshot)
        {
            Terms.Serialize(snapshot);
            Energy.Serialize(snapshot);
            Ends.SerializeWork(snapshot);
            _convergence.Serialize(snapshot);
            Rest.Serialize(snapshot);
            Results.Serialize(snapshot);
            _walls?.Serialize(snapshot);
            // A multiplier is a force times h^2.
            snapshot.Section((TimeStep / _substeps).ToString("R", CultureInfo.InvariantCulture), kept =>
            {
                _stretch.Serialize(kept);
                _bendTwist.Serialize(kept);
                _walls?.Contacts.Serialize(kept);
            });
        }

        private void Substep(double time, double h, bool isMeasured)
        {
            int last = Shape.ElementCount;
            _old.CopyFrom(Shape);
            Terms.SetTime(Schedule, time);
            Array.Clear(_loadGradient, 0, _loadGradient.Length);
            Terms.AddLoadGradient(Shape, _loadGradient);
            for (int i = 0; i <= last; i++)
            {
                ref RodVector g = ref _loadGradient[i];
                Velocities[i] = _remainingVelocity * Velocities[i]
                    - (h * _inertia.InverseMass[i]) * g.X;
                if (_inertia.InverseMass[i] > 0.0)
                {
                    Shape.X[i] += h * Velocities[i];
                }
            }
            for (int j = 0; j < last; j++)
            {
                ref RodVector g = ref _loadGradient[j];
                Vector3d inverse = _inertia.InverseInertia[j];
                Spins[j] = _remainingVelocity * Spins[j]
                    - h * new Vector3d(inverse.X * g.T1, inverse.Y * g.T2, inverse.Z * g.T3);
                Shape.Q[j] = Quaterniond.Normalize(Shape.Q[j] * RotationVector.Exp(h * Spins[j]));
            }
            Ends.Place(Shape, time);
            _predictedTip = Shape.X[last];
            if (isMeasured)
            {
                _directions.Begin(Shape);
            }
            _walls?.BeginSubstep(_old, Shape, h);
            StartFromMultipliers();
            for (int m = 0; m < _iterations; m++)
            {
                _stretch.Iterate(Shape, h);
                _bendTwist.Iterate(Shape, h);
                _walls?.Contacts.Iterate(Shape);
            }
            if (_walls != null)
            {
                _walls.EndSubstep(Shape);
                RodVector g = _loadGradient[0];
                _supportForce += g.X + (1.0 / (h * h)) * _stretch.FirstMultiplier(Shape);
            }
            double rate = 1.0 / h;
            for (int i = 0; i <= last; i++)
            {
                Velocities[i] = rate * (Shape.X[i] - _old.X[i]);
            }
            for (int j = 0; j < last; j++)
            {
                Spins[j] = rate * RotationVector.Log(_old.Q[j].Conjugate * Shape.Q[j]);
            }
        }

        private IterationResidual Residual(double h)
        {
            var sum = default(IterationResidual);
            _stretch.AddResidual(Shape, h, ref sum);
            _bendTwist.AddResidual(Shape, h, ref sum);
            _walls?.Contacts.AddResidual(Shape, ref sum);
            _directions.Add(Shape, h, ref sum);
            return sum;
        }

        private void StartFromMultipliers()
        {
            Array.Clear(_shift, 0, _shift.Length);
            Array.Clear(_turn, 0, _turn.Length);
            _stretch.AddMotion(Shape, _shift, _turn);
            _bendTwist.AddMotion(Shape, _turn);
            _walls?.Contacts.AddMotion(Shape, _shift, _turn);
            double largest = 0.0;
            double[] length = Scene.Rod.Length;
            for (int j = 0; j < _turn.Length; j++)
            {
                largest = Math.Max(largest, _turn[j].LengthSquared);
                largest = Math.Max(largest, _shift[j + 1].LengthSquared / (length[j] * length[j]));
            }
            if (!(largest < LargestStart * LargestStart))
            {
                _stretch.Reset();
                _bendTwist.Reset();
                _walls?.Contacts.Reset();
                return;
            }
            for (int i = 0; i < _shift.Length; i++)
            {
                Shape.X[i] += _shift[i];
            }
            for (int j = 0; j < _turn.Length; j++)
            {
                Shape.Q[j] = Quaterniond.Normalize(Shape.Q[j] * RotationVector.Exp(_turn[j]));
            }
        }
    }
}
