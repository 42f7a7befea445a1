using System;

namespace Guidewire.Core
{
    /// <summary>Maps nodes and elements of a chain of coaxial instruments to those of another chain, after nodes have
    /// emerged from tips or were withdrawn.</summary>
    internal sealed class CoaxialChange
    {
        private readonly double[] _oldStation;   // m, by the new leads

        /// <summary>From one chain to another.</summary>
        public CoaxialChange(CoaxialJoints old, CoaxialJoints joints)
        {
            Old = old;
            Joints = joints;
            Node = new int[joints.ElementCount + 1];
            Element = new int[joints.ElementCount];
            _oldStation = (double[])old.Stations.Clone();
            for (int i = 1; i < joints.Count; i++)
            {
                for (int k = 0; k < old.BeyondOf(i); k++)
                {
                    _oldStation[old.TipOf(i) - k] = joints.StationOf(i, k);
                }
            }
            for (int k = 0; k < Node.Length; k++)
            {
                int carrier = k <= joints.OuterCount ? 0 : joints.CarrierOf(k - 1);
                int fromTip = joints.TipOf(carrier) - k;
                Node[k] = carrier == 0 ? k : fromTip < old.BeyondOf(carrier) ? old.TipOf(carrier) - fromTip : -1;
                if (k > 0)
                {
                    Element[k - 1] = Node[k] >= 0 ? Node[k] - 1 : Containing(joints.Stations[k]);
                }
            }
        }

        /// <summary>The chain that was.</summary>
        public CoaxialJoints Old { get; }

        /// <summary>The chain that is.</summary>
        public CoaxialJoints Joints { get; }

        /// <summary>Former index of each node, -1 for a new one.</summary>
        public int[] Node { get; }

        /// <summary>The element that each one goes on from: that which ended at the same node, else the one in which
        /// its end comes in, or the last one.</summary>
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
                shape.X[k] = Node[k] >= 0 ? old.X[Node[k]] : Position(old, Joints.Stations[k], Element[k - 1]);
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

        private Vector3d Position(RodShape old, double station, int element)
        {
            int last = old.ElementCount;
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
