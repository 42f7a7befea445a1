using System;

namespace Guidewire.Core
{
    /// <summary>Forces on the nodes of constant direction in the world: weight, force per length, point loads, tip
    /// force, axial force. Energy -sum f_i . x_i.</summary>
    internal sealed class DeadLoads : EnergyTerm
    {
        private readonly RodMass _mass;
        private readonly double[] _length;  // of the elements, m

        /// <summary>Makes loads of 0 on each of the n+1 nodes.</summary>
        public DeadLoads(RodMass mass, double[] length)
        {
            _mass = mass;
            _length = length;
            Force = new Vector3d[mass.Nodal.Length];
        }

        /// <summary>Force on each node, N.</summary>
        public Vector3d[] Force { get; }

        /// <summary>Sets all that is prescribed at this time, s.</summary>
        public void Set(RodSchedule schedule, double time)
        {
            Set(schedule.Loads.GravityAt(time), schedule.DistalForceAt(time));
            if (schedule.Loads.HasDistributedForce)
            {
                AddPerLength(schedule.Loads.DistributedForceAt(time));
            }
            foreach (PointLoad load in schedule.Loads.PointLoads)
            {
                AddAt(load.At, schedule.Loads.PointLoadsFactor(time) * load.Force);
            }
            Force[0] += schedule.Loads.ProximalForce;
        }

        /// <summary>Adds a force, N, at a length along the wire at rest, m: on the spheres beside it by the lever rule,
        /// so that it does the same work.</summary>
        public void AddAt(double length, in Vector3d force)
        {
            int j = 0;
            while (j < _mass.ElementCount - 1 && length > _length[j])
            {
                length -= _length[j++];
            }
            double fraction = Math.Min(1.0, length / _length[j]);
            Force[j] += (1.0 - fraction) * force;
            Force[j + 1] += fraction * force;
        }

        /// <summary>Sets the weight of the rod under gravity g (m/s^2), by the mass of each node, and adds the force
        /// at the tip (N).</summary>
        public void Set(in Vector3d gravity, in Vector3d tipForce)
        {
            for (int i = 0; i <= _mass.ElementCount; i++)
            {
                Force[i] = _mass.Nodal[i] * gravity;
            }
            Force[_mass.ElementCount] += tipForce;
        }

        /// <summary>Adds a force per length of the wire at rest, N/m: half of each element's on either node.</summary>
        public void AddPerLength(in Vector3d force)
        {
            for (int j = 0; j < _mass.ElementCount; j++)
            {
                Vector3d half = (0.5 * _length[j]) * force;
                Force[j] += half;
                Force[j + 1] += half;
            }
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            for (int i = 0; i <= shape.ElementCount; i++)
            {
                sum -= Vector3d.Dot(Force[i], shape.X[i]);
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            for (int i = from; i < to; i++)
            {
                gradient[i].AddX(-Force[i]);
            }
        }
    }

    /// <summary>A couple on the last element that turns with it: constant along the element's own axes.</summary>
    /// <remarks>In a plane, and about the tip's own axis in a pure twist, it has the potential -m times the angle. In
    /// space it has none: the work on a closed path of frames is not 0. It then enters by its work since the anchor,
    /// -m . log(conj(q_anchor) q), whose second derivative at the anchor is 0; the part of the tangent that no energy
    /// carries, [m]/2 on the last element, the solver adds on its own (<see cref="FollowerTangent"/>). Such a couple
    /// can drive the wire for ever: a straight round wire (GJ = 0.77 EI) without other loads has one equilibrium only,
    /// and that flutters, drag or not, beyond m L/EI = 3.60 across its axis and 4.15 along it.</remarks>
    internal sealed class TipMoment : EnergyTerm
    {
        private Quaterniond _anchor = Quaterniond.Identity;

        /// <summary>m along the axes of the last element, N m.</summary>
        public Vector3d Moment { get; set; }

        /// <summary>Whether the couple changes in time, so that it is one also where it is 0 now.</summary>
        public bool Varies { get; set; }

        /// <summary>True of no couple.</summary>
        public override bool HasPotential => Moment == Vector3d.Zero && !Varies;

        /// <summary>Gives 0: no work yet.</summary>
        public override double AnchoredValue(double before) => 0.0;

        /// <inheritdoc/>
        public override void Anchor(RodShape shape) => _anchor = shape.Q[shape.ElementCount - 1];

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            if (Moment == Vector3d.Zero)
            {
                return 0.0;
            }
            Quaterniond turned = _anchor.Conjugate * shape.Q[shape.ElementCount - 1];
            return -Vector3d.Dot(Moment, RotationVector.Log(turned));
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            int last = shape.ElementCount - 1;
            if (from <= last && last < to)
            {
                gradient[last].AddT(-Moment);
            }
        }
    }

    /// <summary>A force on the last node that turns with the last element: constant along the element's own axes.
    /// </summary>
    /// <remarks>F = R f has no potential, not even in a plane: its work depends on the path. It enters by its work on
    /// the straight path since the anchor, -1/2 (F_anchor + F) . (x - x_anchor), whose second derivative at the anchor
    /// is the symmetric half of the true tangent, d(-F)/dtheta = R [f]: half of it on (x, theta), half on (theta, x).
    /// The other half, R [f]/2 less its transpose, belongs to no energy: rest shapes add it exactly (<see
    /// cref="FollowerTangent"/>); the stages of a motion leave it out of the matrix, since Newton's method evaluates
    /// the force anew in each iterate and ends by the residual force.</remarks>
    internal sealed class TipFollowerForce : EnergyTerm
    {
        private Vector3d _anchorPosition;
        private Vector3d _anchorForce;

        /// <summary>f along the axes of the last element, N.</summary>
        public Vector3d Force { get; set; }

        /// <summary>Whether the force changes in time, so that it is one also where it is 0 now.</summary>
        public bool Varies { get; set; }

        /// <summary>True of no force.</summary>
        public override bool HasPotential => Force == Vector3d.Zero && !Varies;

        /// <summary>Gives 0: no work yet.</summary>
        public override double AnchoredValue(double before) => 0.0;

        /// <inheritdoc/>
        public override void Anchor(RodShape shape)
        {
            _anchorPosition = shape.X[shape.ElementCount];
            _anchorForce = Along(shape);
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            if (Force == Vector3d.Zero)
            {
                return 0.0;
            }
            return -0.5 * Vector3d.Dot(_anchorForce + Along(shape), shape.X[shape.ElementCount] - _anchorPosition);
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            int end = shape.ElementCount;
            if (from <= end && end < to && Force != Vector3d.Zero)
            {
                Vector3d force = Along(shape);
                gradient[end].AddX(-force);
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            base.AddBlocks(shape, blocks, gradient, from, to);
            int last = shape.ElementCount - 1;
            if (from <= last && last < to && Force != Vector3d.Zero)
            {
                HalfTangent(shape, out Vector3d first, out Vector3d second, out Vector3d third);
                ref RodBlock b = ref blocks[last];
                b.E11 += first.X; b.E21 += first.Y; b.E31 += first.Z;
                b.E12 += second.X; b.E22 += second.Y; b.E32 += second.Z;
                b.E13 += third.X; b.E23 += third.Y; b.E33 += third.Z;
            }
        }

        /// <summary>Gives the columns of R [f]/2: R (f x e_k)/2.</summary>
        public void HalfTangent(RodShape shape, out Vector3d first, out Vector3d second, out Vector3d third)
        {
            Quaterniond q = shape.Q[shape.ElementCount - 1];
            first = Quaterniond.Rotate(q, 0.5 * Vector3d.Cross(Force, Vector3d.UnitX));
            second = Quaterniond.Rotate(q, 0.5 * Vector3d.Cross(Force, Vector3d.UnitY));
            third = Quaterniond.Rotate(q, 0.5 * Vector3d.Cross(Force, Vector3d.UnitZ));
        }

        private Vector3d Along(RodShape shape) => Quaterniond.Rotate(shape.Q[shape.ElementCount - 1], Force);
    }

    /// <summary>The follower loads at the wire's end: a couple and a force along the axes of the end, each times a
    /// factor over time.</summary>
    /// <remarks>The end is half an element beyond the middle of the last one, whose axes the terms know. Over that half
    /// the wire turns by l/2 times its mean curvature, rest + B^-1 (m + l/4 e3 x f), which is as constant along these
    /// axes as m and f are; so along the element's axes both are turned by it. Without this turn they would point
    /// wrong by an angle of first order in l, unless the couple bends or twists only (n = 30, m = 2 EI/L and a force
    /// 2 EI/L^2: 0.26 % of L at the tip).</remarks>
    internal sealed class TipFollowers
    {
        private readonly JointSide _end;
        private readonly double _half;          // of the last element, m
        private readonly Vector3d _moment;      // N m
        private readonly Vector3d _force;       // N
        private readonly TimeTable? _momentTable;
        private readonly TimeTable? _forceTable;

        /// <summary>Makes those of a scene.</summary>
        public TipFollowers(MaterialRod rod, SceneParameters scene)
        {
            int last = rod.ElementCount - 1;
            _end = rod.EndOf(last);
            _half = 0.5 * rod.Length[last];
            _moment = scene.TipMoment;
            _force = scene.TipFollowerForce;
            _momentTable = scene.TipMomentTable;
            _forceTable = scene.TipFollowerForceTable;
            Moment.Varies = _momentTable != null && _moment != Vector3d.Zero;
            Force.Varies = _forceTable != null && _force != Vector3d.Zero;
            Set(0.0);
        }

        /// <summary>The couple on the last element.</summary>
        public TipMoment Moment { get; } = new TipMoment();

        /// <summary>The force on the last node.</summary>
        public TipFollowerForce Force { get; } = new TipFollowerForce();

        /// <summary>The keys of those there are.</summary>
        public string Keys => Force.HasPotential ? "tipMoment"
            : Moment.HasPotential ? "tipFollowerForce" : "tipMoment and tipFollowerForce";

        /// <summary>Sets the loads of this time, s.</summary>
        public void SetTime(double time)
        {
            if (Moment.Varies || Force.Varies)
            {
                Set(time);
            }
        }

        /// <summary>Says whether they change after this time, s.</summary>
        public bool ChangeAfter(double time)
        {
            return (Moment.Varies && _momentTable!.ChangesFrom(time))
                || (Force.Varies && _forceTable!.ChangesFrom(time));
        }

        private void Set(double time)
        {
            Vector3d moment = (_momentTable == null ? 1.0 : _momentTable.At(time)) * _moment;
            Vector3d force = (_forceTable == null ? 1.0 : _forceTable.At(time)) * _force;
            Vector3d bend = moment + 0.5 * _half * Vector3d.Cross(Vector3d.UnitZ, force);
            Vector3d curvature = _end.RestCurvature
                + new Vector3d(bend.X / _end.Bend1, bend.Y / _end.Bend2, bend.Z / _end.Twist);
            Quaterniond turn = RotationVector.Exp(_half * curvature);
            Moment.Moment = Quaterniond.Rotate(turn, moment);
            Force.Force = Quaterniond.Rotate(turn, force);
        }
    }
}
