using System;

namespace Guidewire.Core.Tests
{
    /// <summary>A term on the nodes alone, k_i/2 |x_i - a_i|^2; what tests need of a term's contract is built on
    /// it.</summary>
    internal class NodeSprings : EnergyTerm
    {
        public NodeSprings(int elementCount)
        {
            Stiffness = new double[elementCount + 1];
            Target = new Vector3d[elementCount + 1];
        }

        /// <summary>N/m.</summary>
        public double[] Stiffness { get; }

        /// <summary>m.</summary>
        public Vector3d[] Target { get; }

        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            for (int i = 0; i < Target.Length; i++)
            {
                sum += 0.5 * Stiffness[i] * (shape.X[i] - Target[i]).LengthSquared;
            }
            return sum;
        }

        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            for (int i = from; i < to; i++)
            {
                Vector3d g = Stiffness[i] * (shape.X[i] - Target[i]);
                gradient[i].X1 += g.X;
                gradient[i].X2 += g.Y;
                gradient[i].X3 += g.Z;
            }
        }

        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            base.AddBlocks(shape, blocks, gradient, from, to);
            for (int i = from; i < to; i++)
            {
                blocks[i].A11 += Stiffness[i];
                blocks[i].A22 += Stiffness[i];
                blocks[i].A33 += Stiffness[i];
            }
        }
    }

    /// <summary>A drive: a spring between node 0 and a target that leaves the origin along z at a given
    /// speed.</summary>
    internal sealed class PullingSpring : NodeSprings
    {
        private readonly double _speed;

        public PullingSpring(int elementCount, double stiffness, double speed)
            : base(elementCount)
        {
            Stiffness[0] = stiffness;
            _speed = speed;
        }

        public override void SetTime(double time) => Target[0] = (_speed * time) * Vector3d.UnitZ;
    }

    /// <summary>A drag -rate m_i v_i on each node, from its place at the start of the step: c/(2 dt) |x -
    /// x_start|^2.</summary>
    internal sealed class StepDrag : NodeSprings
    {
        private readonly RodMass _mass;
        private readonly double _rate;

        public StepDrag(RodMass mass, double rate)
            : base(mass.Rotary.Length)
        {
            _mass = mass;
            _rate = rate;
        }

        public override void BeginStep(RodShape shape, double dt)
        {
            for (int i = 0; i < Target.Length; i++)
            {
                Stiffness[i] = _rate * _mass.Nodal[i] / dt;
            }
            Array.Copy(shape.X, Target, Target.Length);
        }

        public override void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(Target);
            snapshot.Serialize(Stiffness);
        }
    }

    /// <summary>Stores nothing, and cuts the first step after each setting of the time in half.</summary>
    internal sealed class StepCutter : NodeSprings
    {
        private bool _cuts;

        public StepCutter(int elementCount)
            : base(elementCount)
        {
        }

        public override void SetTime(double time) => _cuts = true;

        public override double MaxStep(RodShape shape, RodVector[] direction, double scale)
        {
            double fraction = _cuts ? 0.5 : 1.0;
            _cuts = false;
            return fraction;
        }
    }

    /// <summary>A floor at y = -depth that no node may touch: -strength log(gap/depth) each. It lets a step go no
    /// further than takes a tenth of any gap away, by trying.</summary>
    internal sealed class Floor : EnergyTerm
    {
        private readonly MaterialRod _rod;
        private readonly RodSupports _supports;
        private readonly RodShape _trial;
        private readonly double _strength;
        private readonly double _depth;

        public Floor(MaterialRod rod, RodSupports supports, double strength, double depth)
        {
            _rod = rod;
            _supports = supports;
            _trial = new RodShape(rod.ElementCount);
            _strength = strength;
            _depth = depth;
        }

        /// <summary>The smallest gap of any shape that the term was shown, m.</summary>
        public double SmallestGap { get; private set; } = double.PositiveInfinity;

        /// <summary>Steps that it has cut.</summary>
        public int Cuts { get; private set; }

        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            foreach (Vector3d x in shape.X)
            {
                sum -= _strength * Math.Log(Gap(x) / _depth);
            }
            return sum;
        }

        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            for (int i = from; i < to; i++)
            {
                gradient[i].X2 -= _strength / Gap(shape.X[i]);
            }
        }

        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            base.AddBlocks(shape, blocks, gradient, from, to);
            for (int i = from; i < to; i++)
            {
                double gap = Gap(shape.X[i]);
                blocks[i].A22 += _strength / (gap * gap);
            }
        }

        public override double MaxStep(RodShape shape, RodVector[] direction, double scale)
        {
            double fraction = 1.0;
            while (fraction > 1e-9 && !IsClear(shape, direction, fraction * scale))
            {
                fraction *= 0.5;
            }
            Cuts += fraction < 1.0 ? 1 : 0;
            return fraction;
        }

        private bool IsClear(RodShape shape, RodVector[] direction, double scale)
        {
            RodStep.Apply(_rod, _supports, shape, direction, scale, _trial);
            for (int i = 0; i < shape.X.Length; i++)
            {
                if (_trial.X[i].Y + _depth < 0.1 * (shape.X[i].Y + _depth))
                {
                    return false;
                }
            }
            return true;
        }

        private double Gap(in Vector3d x)
        {
            SmallestGap = Math.Min(SmallestGap, x.Y + _depth);
            return x.Y + _depth;
        }
    }
}
