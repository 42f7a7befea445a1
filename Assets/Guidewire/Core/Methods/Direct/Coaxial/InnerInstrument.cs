using System;

namespace Guidewire.Core
{
    /// <summary>Shape of an instrument for logs: its own nodes and elements, on the shared centreline, and on the axis
    /// before the chain. There it is evenly stretched and twisted.</summary>
    internal sealed class InnerInstrument
    {
        private readonly int _instrument;
        private readonly CoaxialInstrument _own;
        private readonly CoaxialHubs _hubs;
        private readonly Vector3d _axis;
        private readonly Joint[] _joints;       // as if it were alone

        /// <summary>One of the instruments.</summary>
        /// <param name="instrument">Counted from the outermost one, 0.</param>
        public InnerInstrument(CoaxialSetup setup, CoaxialHubs hubs, int instrument)
        {
            _instrument = instrument;
            _own = setup.Instruments[instrument];
            _hubs = hubs;
            _axis = setup.Axis;
            _joints = _own.Rod.Joints(Supports);
            int n = _own.Rod.ElementCount;
            Shape = new RodShape(n);
            Velocities = new Vector3d[n + 1];
            Spins = new Vector3d[n];
        }

        /// <summary>How each is held, as if it were alone.</summary>
        public static RodSupports Supports { get; } = new RodSupports { Clamp = ClampRule.HalfElement };

        /// <summary>Its joints, as if it were alone.</summary>
        public Joint[] Joints => _joints;

        /// <summary>Its nodes and elements.</summary>
        public RodShape Shape { get; }

        /// <summary>Velocities of its nodes, m/s.</summary>
        public Vector3d[] Velocities { get; }

        /// <summary>Spins of its elements, rad/s.</summary>
        public Vector3d[] Spins { get; }

        /// <summary>Force of the hubs along the axis on what is before the chain, N.</summary>
        public double Thrust { get; private set; }

        /// <summary>Its torque on its part before the chain about the axis, N m, positive where it is ahead of the
        /// hub.</summary>
        public double Torque { get; private set; }

        /// <summary>Writes what of it is out of a sheath. One alone is straight up to its first node outside, however
        /// it is stretched.</summary>
        /// <param name="exit">Where the sheath ends along another one, m from its hub.</param>
        public void WriteBody(HubRecord hub, SheathEnd sheath, double exit)
        {
            double[] station = _own.Stations;
            int n = Shape.ElementCount;
            double Beyond(int node) => _instrument == 0 ? sheath.Outside(Shape.X[node]) : station[node] - exit;
            int inside = 0;
            while (inside <= n && Beyond(inside) <= 0.0)
            {
                inside++;
            }
            hub.TakeBody(n + 1 - inside, inside > n ? 0.0 : station[n] - station[inside] + Beyond(inside));
        }

        /// <summary>Takes both from what is simulated, at the time that was set last.</summary>
        public void TakeForces(RodTerms terms, RodShape shape)
        {
            Thrust = terms.Walls() is WallTerms walls ? Vector3d.Dot(walls.Spring.Force(shape), _axis) : 0.0;
            Torque = -terms.Bending.TurnCouple(shape, _instrument);
        }

        /// <summary>Takes it from all as one rod.</summary>
        public void UpdateFrom(RodDynamics dynamics, CoaxialJoints joints)
        {
            TakeForces(dynamics.Terms, dynamics.Shape);
            if (_instrument == 0)
            {
                TakeOutermost(dynamics, joints);
                return;
            }
            RodShape shape = dynamics.Shape;
            double[] chain = joints.Stations;
            double lead = _hubs.LeadAt(_instrument, dynamics.Time);
            int n = shape.ElementCount;
            int j = 0;
            int before = 0;
            AxialForces axial = dynamics.Terms.Supports.Coaxial!.Axial;
            double slide = chain[0] > 0.0 ? axial.SlideAt(_instrument, 0, 0.0) : 0.0;
            for (int i = 0; i < Shape.X.Length; i++)
            {
                double at = _own.Stations[i] - lead;
                j = CoaxialShape.ElementAt(joints, at, j);
                // Before the chain and beyond the last node by what is too short for an element.
                double fraction = (at - chain[j]) / (chain[j + 1] - chain[j]);
                bool isBefore = at <= chain[0];
                Vector3d direction = isBefore ? _axis : shape.Q[j].Director3;
                Shape.X[i] = isBefore
                    ? shape.X[0] + (slide - (chain[0] > 0.0 ? axial.LeadFrom(at, _instrument, Thrust) : -at)) * _axis
                    : fraction > 1.0 ? shape.X[n] + (at - chain[n]) * direction
                    : Vector3d.Lerp(shape.X[j], shape.X[j + 1], fraction)
                        + axial.SlideAt(_instrument, j, fraction) * direction;
                bool isInside = at < chain[joints.TipOf(_instrument - 1)];
                Velocities[i] = (isBefore ? dynamics.Velocities[0]
                    : Vector3d.Lerp(dynamics.Velocities[j], dynamics.Velocities[j + 1], Math.Min(fraction, 1.0)))
                    + (isInside ? _hubs.SlideOf(_instrument, joints.CarrierOf(j)) : 0.0) * direction;
                if (i < Shape.Q.Length)
                {
                    at += 0.5 * _own.Rod.Length[i];
                    before += at <= chain[0] ? 1 : 0;
                    TakeElement(dynamics, joints, i, at, j);
                }
            }
            TakeStraight(dynamics.Time, before);
        }

        // From the first element that is simulated on; before it evenly stretched and twisted.
        private void TakeOutermost(RodDynamics dynamics, CoaxialJoints joints)
        {
            RodShape shape = dynamics.Shape;
            int first = joints.First;
            int n = joints.OuterCount;
            Array.Copy(shape.X, 0, Shape.X, first, n + 1);
            Array.Copy(shape.Q, 0, Shape.Q, first, n);
            Array.Copy(dynamics.Velocities, 0, Velocities, first, n + 1);
            Array.Copy(dynamics.Spins, 0, Spins, first, n);
            AxialForces axial = dynamics.Terms.Supports.Coaxial!.Axial;
            for (int j = first - 1; j >= 0; j--)
            {
                // All that are there have what is no load together.
                double part = joints.AxialBetween(_own.Stations[j], _own.Stations[j + 1], 0, out double own) / own;
                double strain = part * (Thrust + axial.LeadLoad) / _own.Rod.StretchStiffness[j];
                double length = _own.Rod.Length[j] * (1.0 - strain) + own * axial.LeadForceOf(0);
                Shape.X[j] = Shape.X[j + 1] - length * _axis;
                Velocities[j] = Vector3d.Dot(Velocities[first], _axis) * _axis;
                Spins[j] = new Vector3d(0.0, 0.0, Spins[first].Z);
            }
            TakeStraight(dynamics.Time, first);
        }

        // Frames of so many elements from the hub on.
        private void TakeStraight(double time, int count)
        {
            // Most joints are alike: sines are dear beside the rest.
            Quaterniond frame = _hubs.Outer.FrameTurned(_hubs.Outer.TurnAt(time) + _hubs.TwistAt(_instrument, time));
            Quaterniond turned = Quaterniond.Identity;
            double before = 0.0;
            for (int j = 0; j < count; j++)
            {
                double turn = Torque / _joints[j].Twist + _joints[j].Rest.Z;
                turned = turn == before ? turned : Quaterniond.FromAxisAngle(Vector3d.UnitZ, turn);
                before = turn;
                frame = frame * turned;
                Shape.Q[j] = frame;
            }
        }

        private void TakeElement(RodDynamics dynamics, CoaxialJoints joints, int element, double at, int j)
        {
            if (at <= joints.Stations[0])
            {
                Spins[element] = at <= 0.0 ? Vector3d.Zero : new Vector3d(0.0, 0.0, dynamics.Spins[0].Z);
                return;
            }
            j = CoaxialShape.ElementAt(joints, at, j);
            Shape.Q[element] = CoaxialShape.FrameOf(dynamics.Shape, joints, j, _instrument);
            Spins[element] = dynamics.Spins[j];
        }
    }
}
