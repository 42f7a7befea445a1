using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Maps nodes and elements of a chain of coaxial instruments to those of another chain, after nodes have
    /// emerged from tips or were withdrawn, elements have come or gone in a sheath, or another instrument has taken the
    /// place of one.</summary>
    internal sealed class CoaxialChange
    {
        private double[] _oldStation;   // m, by the new leads

        /// <summary>Makes changes of a chain.</summary>
        public CoaxialChange(CoaxialJoints joints)
        {
            Old = joints;
            Joints = joints;
            Node = new int[joints.Capacity + 1];
            Element = new int[joints.Capacity];
            _oldStation = new double[joints.Capacity + 1];
        }

        /// <summary>Of the old chain nothing goes on.</summary>
        public void Forget() => Array.Fill(Node, -1);

        /// <summary>The chain was another one.</summary>
        /// <param name="isOther">Which instruments are not those of the old chain; null: none.</param>
        /// <param name="shift">How far the outermost hub is behind that of the old chain, m.</param>
        public void Begin(CoaxialJoints old, bool[]? isOther = null, double shift = 0.0)
        {
            CoaxialJoints joints = Joints;
            Old = old;
            Entered = old.First - joints.First;
            if (_oldStation.Length <= old.ElementCount)
            {
                _oldStation = new double[old.ElementCount + 1];
            }
            for (int k = 0; k <= old.ElementCount; k++)
            {
                _oldStation[k] = old.Stations[k] + shift;
            }
            for (int i = 1; i < joints.Count; i++)
            {
                for (int k = 0; k < old.BeyondOf(i) && isOther?[i] != true; k++)
                {
                    _oldStation[old.TipOf(i) - k] = joints.StationOf(i, k);
                }
            }
            for (int k = 0; k <= joints.ElementCount; k++)
            {
                int carrier = joints.CarrierAt(k);
                int fromTip = joints.TipOf(carrier) - k;
                Node[k] = isOther?[carrier] == true ? -1 : carrier == 0 ? Math.Max(k - Entered, -1)
                    : fromTip < old.BeyondOf(carrier) ? old.TipOf(carrier) - fromTip : -1;
                if (k > 0)
                {
                    Element[k - 1] = k <= Entered ? 0 : Node[k] >= 0 ? Node[k] - 1
                        : isOther?[carrier] == true ? Containing(0.5 * (joints.Stations[k - 1] + joints.Stations[k]))
                        : Containing(joints.Stations[k]);
                }
            }
        }

        /// <summary>The chain that was.</summary>
        public CoaxialJoints Old { get; private set; }

        /// <summary>The chain that is.</summary>
        public CoaxialJoints Joints { get; }

        /// <summary>Elements that have come in before the first one; negative where some have gone.</summary>
        public int Entered { get; private set; }

        /// <summary>Former index of each node, -1 for a new one.</summary>
        public int[] Node { get; }

        /// <summary>The element that each one goes on from: that which ended at the same node, else the one in which
        /// its end comes in, or the last one; of another instrument, that in which its middle is.</summary>
        public int[] Element { get; }

        /// <summary>The shape with these nodes: what comes in lies on the element that it divides, or on the axis of
        /// the last one.</summary>
        public void Convert(RodShape old, RodShape shape)
        {
            int n = Joints.ElementCount;
            shape.ElementCount = n;
            shape.TakeVessel(old);
            (shape.ProximalFrame, shape.DistalFrame) = (old.ProximalFrame, old.DistalFrame);
            Array.Clear(shape.Twist, 0, shape.TwistCount);
            for (int j = 0; j < n; j++)
            {
                int from = Element[j];
                int carrier = Joints.CarrierOf(j);
                shape.Q[j] = CoaxialShape.FrameOf(old, Old, from, carrier);
                for (int i = carrier + 1; i < Joints.Count; i++)
                {
                    shape.Twist[(i - 1) * n + j] = CoaxialShape.Angle(old, old.Twist, Old, from, i, carrier);
                }
            }
            for (int k = 0; k <= n; k++)
            {
                shape.X[k] = Node[k] >= 0 ? old.X[Node[k]] : k < Entered ? old.X[0]
                    : Position(old, Joints.Stations[k]);
            }
        }

        /// <summary>Takes a motion, with its shape: what comes in moves with the node before it and the element that
        /// it divides; where a tip inside comes in, it turns as it does before.</summary>
        public void Convert(RodMotion was, RodMotion motion)
        {
            RodShape old = was.Shape;
            Convert(old, motion.Shape);
            int n = Joints.ElementCount;
            int from = 0;
            for (int k = 0; k <= n; k++)
            {
                from = Node[k] >= 0 ? Node[k] : from;
                motion.Velocities[k] = was.Velocities[from];
            }
            Array.Clear(motion.TwistRates, 0, motion.Shape.TwistCount);
            for (int i = 1; i < Joints.Count; i++)
            {
                for (int j = 0; j < Joints.ActiveCountOf(i); j++)
                {
                    int element = Math.Min(Element[j], Old.ActiveCountOf(i) - 1);
                    motion.TwistRates[(i - 1) * n + j] = element < 0 ? 0.0
                        : CoaxialShape.Angle(old, was.TwistRates, Old, element, i, Joints.CarrierOf(j));
                }
            }
            for (int j = 0; j < n; j++)
            {
                int carrier = Joints.CarrierOf(j);
                int before = Old.CarrierOf(Element[j]);
                bool isBeyond = Node[j + 1] < 0 && Joints.Stations[j + 1] > _oldStation[Old.ElementCount];
                motion.Spins[j] = isBeyond ? Vector3d.Zero : before == carrier ? was.Spins[Element[j]]
                    : CoaxialShape.SpinOf(old, was.TwistRates, Old, Element[j], carrier, was.Spins[Element[j]]);
            }
        }

        /// <summary>Places the elements that come in within a sheath: on its axis, with the strain and the twists of
        /// the part of the instruments before them.</summary>
        /// <param name="turn">Of the former first element, radians.</param>
        /// <param name="thrust">Of the hubs along the axis, N.</param>
        /// <param name="torques">Of each instrument on its part in the sheath, N m.</param>
        /// <returns>The turn of the first element now.</returns>
        public double Enter(RodShape old, MaterialRod rod, RodMotion motion, in Vector3d axis, double turn,
            double thrust, double[] torques)
        {
            RodShape shape = motion.Shape;
            for (int j = 1; j <= -Entered; j++)
            {
                turn += RotationVector.Log(old.Q[j - 1].Conjugate * old.Q[j]).Z;
            }
            for (int j = Entered - 1; j >= 0; j--)
            {
                double joint = torques[0] / Joints[j + 1].Twist + Joints[j + 1].RestTwist;
                double length = rod.Length[j] * (1.0 - thrust / rod.StretchStiffness[j]);
                shape.X[j] = shape.X[j + 1] - length * axis;
                shape.Q[j] = shape.Q[j + 1] * Quaterniond.FromAxisAngle(Vector3d.UnitZ, -joint);
                motion.Velocities[j] = Vector3d.Dot(motion.Velocities[j + 1], axis) * axis;
                motion.Spins[j] = new Vector3d(0.0, 0.0, motion.Spins[j + 1].Z);
                turn -= joint;
                for (int i = 1; i < Joints.Count; i++)
                {
                    int at = (i - 1) * shape.ElementCount + j;
                    shape.Twist[at] = shape.Twist[at + 1] + joint
                        - (i == 1 ? Joints[j + 1].First : Joints[j + 1].Second).TurnBy(torques[i]);
                }
            }
            return turn;
        }

        private int Containing(double station)
        {
            int j = 0;
            while (j < Old.ElementCount - 1 && station > _oldStation[j + 1])
            {
                j++;
            }
            return j;
        }

        private Vector3d Position(RodShape old, double station)
        {
            int last = old.ElementCount;
            int element = Containing(station);
            if (station > _oldStation[last])
            {
                return old.X[last] + (station - _oldStation[last]) * old.Q[last - 1].Director3;
            }
            Vector3d chord = (1.0 / (_oldStation[element + 1] - _oldStation[element]))
                * (old.X[element + 1] - old.X[element]);
            return old.X[element] + (station - _oldStation[element]) * chord;
        }
    }

    /// <summary>Checks whether another instrument can take the place of one of several coaxial ones.</summary>
    /// <remarks>It has to be withdrawn into the sheath, or one that is inside into the first element of the outermost
    /// one: there all are straight and touch no wall, and what takes its place does not move the others.</remarks>
    internal static class CoaxialExchange
    {
        private const double Rounding = 1e-6;   // of an element's length

        /// <summary>Why an instrument is not withdrawn at a time, in one phrase, or null.</summary>
        /// <param name="instrument">0 the outermost one.</param>
        public static string? FindInVessel(CoaxialSetup setup, CoaxialHubs hubs, int instrument, double time)
        {
            double first = setup.Catheter.Rod.Length[0];
            double most = Math.Max(setup.Sheath == null ? 0.0 : hubs.SheathedAt(time), instrument == 0 ? 0.0 : first);
            if (most == 0.0 && setup.Sheath == null)
            {
                return NameOf(setup, instrument) + " cannot be exchanged: without a sheath there is nothing into which "
                    + "it could be withdrawn";
            }
            double beyond = TipOf(setup, hubs, instrument, time) - most;
            return beyond <= Rounding * first ? null : Text(setup,
                "{0} needs to be withdrawn by {1:G4} mm more, into {2}", instrument, beyond,
                setup.Sheath != null ? "the sheath" : "the first element of " + NameOf(setup, 0));
        }

        /// <summary>Why instruments do not fit one another where their hubs are at a time, in one phrase, or
        /// null.</summary>
        public static string? FindMisfit(CoaxialSetup setup, CoaxialHubs hubs, double time)
        {
            double first = setup.Catheter.Rod.Length[0];
            double rounding = Rounding * first;
            for (int i = 1; i < setup.Instruments.Length; i++)
            {
                double behind = hubs.LeadAt(i - 1, time) - hubs.LeadAt(i, time);
                if (behind > rounding)
                {
                    return Text(setup, "{0} is {1:G4} mm too short: the hub of {2} would be behind its own", i,
                        behind, NameOf(setup, i - 1));
                }
                double missing = first - TipOf(setup, hubs, i, time);
                if (missing > rounding)
                {
                    return Text(setup, "{0} needs to reach {1:G4} mm farther, through the first element of {2}", i,
                        missing, NameOf(setup, 0));
                }
            }
            return null;
        }

        // m from the outermost hub.
        private static double TipOf(CoaxialSetup setup, CoaxialHubs hubs, int instrument, double time) =>
            setup.Instruments[instrument].Rod.TotalLength - hubs.LeadAt(instrument, time);

        private static string NameOf(CoaxialSetup setup, int instrument)
        {
            int wire = setup.Instruments.Length - 1;
            return instrument == wire ? "the wire" : wire == 1 ? "the catheter"
                : instrument == 0 ? "the outer catheter" : "the inner catheter";
        }

        // length: m.
        private static string Text(CoaxialSetup setup, string format, int instrument, double length, string more)
        {
            return string.Format(CultureInfo.InvariantCulture, format, NameOf(setup, instrument),
                1e3 * length, more);
        }
    }
}
