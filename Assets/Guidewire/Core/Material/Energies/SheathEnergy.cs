using System;

namespace Guidewire.Core
{
    /// <summary>Energy of a wire held straight in its sheath: only the part of a joint's wire beyond the exit bends. It
    /// cuts the joints of <see cref="BendTwistTerm"/> at the exit, and has the energy of the straightened
    /// part.</summary>
    /// <remarks>With a and f compliance and turn at rest beyond the exit (<see cref="JointPieces"/>), and W the energy
    /// of what is before it, a joint has |theta - f|^2/(2 a) + W. The exit lies at a position along the wire that
    /// follows from the hub's, not from the nodes: so the energy depends on the hub, and its slope is the force by
    /// which a bent wire is driven out of a sheath without friction. It acts on the hub, at any speed. As of coaxial
    /// instruments (<see cref="Release"/>) it is a sum of derivatives: the hat function at the exit times |m + B
    /// kappa|^2/(2 B), over joints.</remarks>
    internal sealed class SheathEnergy : EnergyTerm
    {
        private readonly SheathWindow _window;
        private readonly BendTwistTerm _bending;
        private readonly Joint[] _cutJoint;     // of the first joints, as they are cut
        private readonly double[] _outside;     // fractions of their lengths
        private int _cutCount;
        private double _exit;                   // along the wire, m from node 0 of the whole
        private double _held;                   // J

        /// <summary>For the joints of a window.</summary>
        public SheathEnergy(SheathWindow window, BendTwistTerm bending)
        {
            _window = window;
            _bending = bending;
            _cutJoint = new Joint[window.Joints.Length];
            _outside = new double[window.Joints.Length];
            _exit = double.NaN;
        }

        /// <summary>The fraction of joint k that is outside: 0 where none of it is, above 0 to 1 elsewhere.</summary>
        public double FractionOutside(int k)
        {
            return k < _cutCount ? _outside[k] : 1.0;
        }

        /// <summary>Turn of joint k at rest, as it is cut, rad.</summary>
        public Vector3d RestOf(int k)
        {
            return k < _cutCount ? _cutJoint[k].Rest : _window.Joints[k].Rest;
        }

        /// <summary>The hub is where it would have the window's node 0 here, m, were nothing compressed.</summary>
        public void SetHub(in Vector3d position)
        {
            SetExit(_window.ExitFrom(position));
        }

        /// <summary>Force that the hub has to exert along the axis besides that of its spring, N: dE/dp. Negative where
        /// the wire is driven out.</summary>
        public double HubForce(RodShape shape)
        {
            return -ReleaseAt(shape, _exit);
        }

        /// <summary>Work of the hub, J, against what drives the wire out, while the exit's position along the wire
        /// advances to where a position of the hub puts it, by the moments of a shape.</summary>
        /// <param name="position">As of <see cref="SetHub"/>.</param>
        /// <param name="from">Where the exit was, m from node 0 of the whole.</param>
        public double WorkTo(RodShape shape, in Vector3d position, double from)
        {
            double to = _window.ExitFrom(position);
            double end = Math.Max(from, to);
            double work = 0.0;
            for (double at = Math.Min(from, to); at < end;)
            {
                double next = Math.Min(_window.Pieces.NextBreak(at), end);
                work += (next - at) * ReleaseAt(shape, 0.5 * (at + next));
                at = next;
            }
            return to > from ? work : -work;
        }

        /// <summary>Where the exit is along the wire, m from node 0 of the whole.</summary>
        public double Exit => _exit;

        // What the joints on both sides of a cut release as it moves, J/m.
        private double ReleaseAt(RodShape shape, double cut)
        {
            double[] station = _window.Pieces.Stations;
            double sum = 0.0;
            int last = _window.Joints.Length - 1;
            for (int k = 0; k < last && station[Before(k)] < cut; k++)
            {
                if (station[_window.First + k + 1] > cut)
                {
                    Joint joint = k < _cutCount ? _cutJoint[k] : _window.Joints[k];
                    Vector3d change = _bending.TurnOf(shape, k) - joint.Rest;
                    CoaxialJoint rate = _window.Pieces.RateAt(_window.First + k, cut);
                    sum -= rate.BendingRate(joint.Bend1 * change.X, joint.Bend2 * change.Y,
                        new Vector3d(rate.FixedX, rate.FixedY, 0.0), rate.Held);
                }
            }
            return sum;
        }

        /// <summary>That force where the step began, N.</summary>
        public double StartForce { get; private set; }

        /// <inheritdoc/>
        public override void BeginStep(RodShape shape, double dt)
        {
            StartForce = HubForce(shape);
        }

        /// <summary>Energy of what is kept straight, J, all that is still in the sheath among it.</summary>
        public override double Value(RodShape shape)
        {
            return _held;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
        }

        /// <inheritdoc/>
        public override void Serialize(Snapshot snapshot)
        {
            double exit = _exit;
            snapshot.Serialize(ref exit);
            if (!snapshot.IsWritten && !double.IsNaN(exit))
            {
                SetExit(exit);
            }
        }

        private void SetExit(double exit)
        {
            if (exit == _exit)
            {
                return;
            }
            _exit = exit;
            double[] station = _window.Pieces.Stations;
            int last = _window.Joints.Length - 1;
            int cut = 0;
            _held = _window.HeldBefore;
            for (int k = 0; k < last && (k < _cutCount || station[Before(k)] < exit); k++)
            {
                Joint joint = _window.Joints[k];
                if (station[Before(k)] < exit)
                {
                    joint = Cut(k, joint);
                    cut = k + 1;
                }
                _bending.SetJoint(k, joint);
            }
            _cutCount = cut;
        }

        private Joint Cut(int k, Joint joint)
        {
            CoaxialJoint part = _window.Pieces.CutAt(_window.First + k, _exit);
            _held += part.Held;
            joint.Bend1 = 1.0 / part.Compliance1;
            joint.Bend2 = 1.0 / part.Compliance2;
            joint.Rest = new Vector3d(part.FixedX, part.FixedY, joint.Rest.Z);
            _cutJoint[k] = joint;
            _outside[k] = JointPieces.FractionBeyond(_window.Pieces.Stations, _window.First + k, _exit);
            return joint;
        }

        // The node before joint k of the window, in the whole wire.
        private int Before(int k)
        {
            return Math.Max(_window.First + k - 1, 0);
        }
    }
}
