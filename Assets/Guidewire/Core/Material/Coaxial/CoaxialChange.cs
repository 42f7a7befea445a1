using System;

namespace Guidewire.Core
{
    /// <summary>Maps nodes and elements of a chain of coaxial instruments to those of another chain, after nodes have
    /// emerged from tips or were withdrawn, elements have come or gone in a sheath, or another instrument has taken the
    /// place of one.</summary>
    internal sealed class CoaxialChange
    {
        private readonly double[] _oldStation;   // m, by the new leads

        /// <summary>Makes the change from one chain to another.</summary>
        /// <param name="isOther">Which instruments are not those of the old chain; null: none.</param>
        /// <param name="shift">How far the outermost hub is behind that of the old chain, m.</param>
        public CoaxialChange(CoaxialJoints old, CoaxialJoints joints, bool[]? isOther = null, double shift = 0.0)
        {
            Old = old;
            Joints = joints;
            Entered = old.First - joints.First;
            Node = new int[joints.ElementCount + 1];
            Element = new int[joints.ElementCount];
            _oldStation = Array.ConvertAll(old.Stations, station => station + shift);
            for (int i = 1; i < joints.Count; i++)
            {
                for (int k = 0; k < old.BeyondOf(i) && isOther?[i] != true; k++)
                {
                    _oldStation[old.TipOf(i) - k] = joints.StationOf(i, k);
                }
            }
            for (int k = 0; k < Node.Length; k++)
            {
                int carrier = k <= joints.OuterCount ? 0 : joints.CarrierOf(k - 1);
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
        public CoaxialJoints Old { get; }

        /// <summary>The chain that is.</summary>
        public CoaxialJoints Joints { get; }

        /// <summary>Elements that have come in before the first one; negative where some have gone.</summary>
        public int Entered { get; }

        /// <summary>Former index of each node, -1 for a new one.</summary>
        public int[] Node { get; }

        /// <summary>The element that each one goes on from: that which ended at the same node, else the one in which
        /// its end comes in, or the last one; of another instrument, that in which its middle is.</summary>
        public int[] Element { get; }

        /// <summary>The shape with these nodes: what comes in lies on the element that it divides, or on the axis of
        /// the last one.</summary>
        public RodShape Take(RodShape old)
        {
            int n = Joints.ElementCount;
            var shape = new RodShape(n, Joints.InnerCount)
            {
                ProximalFrame = old.ProximalFrame, DistalFrame = old.DistalFrame,
            };
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
            return shape;
        }

        /// <summary>Takes velocities and spins: what comes in moves with the node before it and the element that it
        /// divides.</summary>
        /// <param name="twistRates">Of the angles in the old chain, rad/s.</param>
        public void TakeMotion(RodShape old, Vector3d[] velocities, Vector3d[] spins, double[] twistRates,
            MaterialScene scene)
        {
            int from = 0;
            for (int k = 0; k < Node.Length; k++)
            {
                from = Node[k] >= 0 ? Node[k] : from;
                scene.Velocities[k] = velocities[from];
            }
            for (int j = 0; j < Element.Length; j++)
            {
                int carrier = Joints.CarrierOf(j);
                int was = Old.CarrierOf(Element[j]);
                bool isBeyond = Node[j + 1] < 0 && Joints.Stations[j + 1] > _oldStation[Old.ElementCount];
                scene.Spins[j] = isBeyond ? Vector3d.Zero : was == carrier ? spins[Element[j]]
                    : CoaxialShape.SpinOf(old, twistRates, Old, Element[j], carrier, spins[Element[j]]);
            }
        }

        /// <summary>Places the elements that come in within a sheath: on its axis, with the strain and the twist of the
        /// part of the instrument before them.</summary>
        /// <param name="turn">Of the former first element, radians.</param>
        /// <param name="thrust">Of the hub along the axis, N.</param>
        /// <param name="torque">Of the instrument on its part in the sheath, N m.</param>
        /// <returns>The turn of the first element now.</returns>
        public double Enter(RodShape old, MaterialScene scene, in Vector3d axis, double turn, double thrust,
            double torque)
        {
            RodShape shape = scene.Shape;
            for (int j = 1; j <= -Entered; j++)
            {
                turn += RotationVector.Log(old.Q[j - 1].Conjugate * old.Q[j]).Z;
            }
            for (int j = Entered - 1; j >= 0; j--)
            {
                double joint = torque / Joints[j + 1].Twist + Joints[j + 1].RestTwist;
                double length = scene.Rod.Length[j] * (1.0 - thrust / scene.Rod.StretchStiffness[j]);
                shape.X[j] = shape.X[j + 1] - length * axis;
                shape.Q[j] = shape.Q[j + 1] * Quaterniond.FromAxisAngle(Vector3d.UnitZ, -joint);
                scene.Velocities[j] = Vector3d.Dot(scene.Velocities[j + 1], axis) * axis;
                scene.Spins[j] = new Vector3d(0.0, 0.0, scene.Spins[j + 1].Z);
                turn -= joint;
            }
            return turn;
        }

        /// <summary>Rate of the angle of an inner instrument on an element, rad/s; where its tip comes in, it turns as
        /// it does before.</summary>
        public double RateOf(RodShape old, double[] twistRates, int element, int instrument)
        {
            int from = Math.Min(Element[element], Old.ActiveCountOf(instrument) - 1);
            return CoaxialShape.Angle(old, twistRates, Old, from, instrument, Joints.CarrierOf(element));
        }

        private int Containing(double station)
        {
            int j = 0;
            while (j < _oldStation.Length - 2 && station > _oldStation[j + 1])
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
}
