namespace Guidewire.Core
{
    /// <summary>Keeps a wire straight in its sheath: each joint bends by the part of its length that is outside. With
    /// phi that part, a joint of stiffness B has B/phi: this adds 1/2 B (1/phi - 1) |theta|^2 to its energy.</summary>
    /// <remarks>A joint stands for the piece of wire that its hat function weighs: 1 at its node, 0 at both neighbours.
    /// phi is the share of that weight beyond the exit, from 0 where the next node is at the exit to 1 where the one
    /// before is; it has a continuous slope, and the shares of all joints sum up to the length outside, so nothing
    /// jumps where a node passes the exit. Its slope is the force by which a bent wire is driven out of a sheath
    /// without friction, M^2/(2 B). A joint wholly inside keeps 1e-6 of its compliance.</remarks>
    internal sealed class SheathEnergy : EnergyTerm
    {
        private const double LeastShare = 1e-6;

        private readonly SheathWindow _window;
        private readonly double[] _length;   // of elements, m
        private readonly RotationVectorLaw _law;
        private RodVector _clampVector;      // what falls on the clamp's frame, which does not move
        private RodBlock _clampBlock;

        /// <summary>For the elements of a window.</summary>
        public SheathEnergy(MaterialRod rod, SheathWindow window)
        {
            _window = window;
            _length = rod.Length;
            _law = default;
        }

        /// <summary>The share of joint k that is outside, above 0 to 1.</summary>
        public double Share(RodShape shape, int k)
        {
            return k < 2 && k < shape.ElementCount ? Share(shape, k, out _, out _) : 1.0;
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            for (int k = 0; k < 2 && k < shape.ElementCount; k++)
            {
                sum += _law.Value(Bending(k, 1.0 / Share(shape, k) - 1.0), Relative(shape, k));
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            if (from > 0)
            {
                return;
            }
            for (int k = 0; k < 2 && k < shape.ElementCount; k++)
            {
                double share = Share(shape, k, out double slope, out _);
                Quaterniond relative = Relative(shape, k);
                _law.AddGradient(Bending(k, 1.0 / share - 1.0), relative, ref Before(gradient, k), ref gradient[k]);
                AddForce(ref gradient[k], k, relative, -slope / (share * share));
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            if (from > 0)
            {
                return;
            }
            for (int k = 0; k < 2 && k < shape.ElementCount; k++)
            {
                double share = Share(shape, k, out double slope, out double change);
                Quaterniond relative = Relative(shape, k);
                _law.AddBlocks(Bending(k, 1.0 / share - 1.0), relative, ref Before(gradient, k), ref gradient[k],
                    ref k == 0 ? ref _clampBlock : ref blocks[0], ref blocks[k]);
                double first = -slope / (share * share);
                AddForce(ref gradient[k], k, relative, first);
                double second = (2.0 * slope * slope / share - change) / (share * share);
                AddAxial(ref blocks[k], second * _law.Value(Bending(k, 1.0), relative));
                RodVector before = default;
                RodVector after = default;
                _law.AddGradient(Bending(k, first), relative, ref before, ref after);
                AddCross(ref blocks[k], after);
                if (k > 0)
                {
                    AddNext(ref blocks[k - 1], before);
                }
            }
        }

        private double Share(RodShape shape, int k, out double slope, out double change)
        {
            double before = k == 0 ? _window.LengthBefore : _length[k - 1];
            double after = _length[k];
            double z = _window.Outside(shape.X[k]);
            double scale = (1.0 - LeastShare) / (before + after);
            double share;
            if (z <= 0.0)
            {
                double part = z > -after ? 1.0 + z / after : 0.0;
                share = after * part * part;
                slope = 2.0 * part;
                change = z > -after ? 2.0 / after : 0.0;
            }
            else
            {
                double part = z < before ? 1.0 - z / before : 0.0;
                share = before + after - before * part * part;
                slope = 2.0 * part;
                change = z < before ? -2.0 / before : 0.0;
            }
            slope *= scale;
            change *= scale;
            return LeastShare + scale * share;
        }

        private Joint Bending(int k, double factor)
        {
            Joint joint = _window.Joints[k];
            return new Joint { Bend1 = factor * joint.Bend1, Bend2 = factor * joint.Bend2 };
        }

        private static Quaterniond Relative(RodShape shape, int k)
        {
            return (k == 0 ? shape.ProximalFrame : shape.Q[k - 1]).Conjugate * shape.Q[k];
        }

        private ref RodVector Before(RodVector[] gradient, int k)
        {
            return ref k == 0 ? ref _clampVector : ref gradient[k - 1];
        }

        private void AddForce(ref RodVector gradient, int k, in Quaterniond relative, double slope)
        {
            double force = slope * _law.Value(Bending(k, 1.0), relative);
            gradient.X1 += force * _window.Axis.X;
            gradient.X2 += force * _window.Axis.Y;
            gradient.X3 += force * _window.Axis.Z;
        }

        private void AddAxial(ref RodBlock block, double stiffness)
        {
            Vector3d a = _window.Axis;
            block.A11 += stiffness * a.X * a.X;
            block.A21 += stiffness * a.Y * a.X;
            block.A22 += stiffness * a.Y * a.Y;
            block.A31 += stiffness * a.Z * a.X;
            block.A32 += stiffness * a.Z * a.Y;
            block.A33 += stiffness * a.Z * a.Z;
        }

        // Of the node's place and the element after it.
        private void AddCross(ref RodBlock block, in RodVector couple)
        {
            Vector3d a = _window.Axis;
            block.B11 += couple.T1 * a.X;
            block.B12 += couple.T1 * a.Y;
            block.B13 += couple.T1 * a.Z;
            block.B21 += couple.T2 * a.X;
            block.B22 += couple.T2 * a.Y;
            block.B23 += couple.T2 * a.Z;
            block.B31 += couple.T3 * a.X;
            block.B32 += couple.T3 * a.Y;
            block.B33 += couple.T3 * a.Z;
        }

        // Of the node's place and the element before it.
        private void AddNext(ref RodBlock block, in RodVector couple)
        {
            Vector3d a = _window.Axis;
            block.E11 += a.X * couple.T1;
            block.E12 += a.X * couple.T2;
            block.E13 += a.X * couple.T3;
            block.E21 += a.Y * couple.T1;
            block.E22 += a.Y * couple.T2;
            block.E23 += a.Y * couple.T3;
            block.E31 += a.Z * couple.T1;
            block.E32 += a.Z * couple.T2;
            block.E33 += a.Z * couple.T3;
        }
    }
}
