namespace Guidewire.Core
{
    /// <summary>The energy of a vessel that gives way as a beam: 1/2 q D q of the displacements of its
    /// splines.</summary>
    internal sealed class VesselEnergy : EnergyTerm
    {
        private readonly WallBeam _beam;
        private readonly Vector3d[] _force;    // N by spline

        /// <summary>Makes the energy of this beam.</summary>
        public VesselEnergy(WallBeam beam)
        {
            _beam = beam;
            _force = new Vector3d[beam.Count];
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            _beam.FindForce(shape.Vessel, _force);
            for (int j = 0; j < _force.Length; j++)
            {
                sum += 0.5 * Vector3d.Dot(_force[j], shape.Vessel[j]);
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            if (to <= shape.ElementCount)
            {
                return;
            }
            _beam.FindForce(shape.Vessel, _force);
            for (int j = 0; j < _force.Length; j++)
            {
                gradient[shape.VesselStart + j].AddX(_force[j]);
            }
        }

        /// <inheritdoc/>
        public override void AddColumns(RodShape shape, LowRank columns)
        {
            for (int row = 0; row < 3 * _beam.Count; row++)
            {
                for (int column = 0; column <= row; column++)
                {
                    columns.Border(row, column) += _beam.Stiffness(row, column);
                }
            }
        }
    }

    /// <summary>What a force on a vessel's wall adds to derivatives by the splines that displace it.</summary>
    internal static class VesselForces
    {
        /// <summary>Adds the gradient by the splines of a force on the point.</summary>
        public static void AddTo(this in BeamWeight weight, RodVector[] gradient, int start, in Vector3d force)
        {
            for (int j = 0; j < WallBeam.Order; j++)
            {
                gradient[start + weight.Splines.First + j].AddX(weight.Of(j).TransposeTimes(force));
            }
        }

        /// <summary>Adds the second derivatives by splines of an energy with the second derivative H by two nodes'
        /// displacements dx - W dq against the wall.</summary>
        /// <param name="node">Of this weight and the rows of H; -1: it does not move.</param>
        /// <param name="other">The weight of the other node.</param>
        /// <param name="column">The other node, or -1.</param>
        /// <param name="arePair">Whether H has a transposed counterpart.</param>
        public static void AddBorder(this in BeamWeight weight, LowRank columns, int node, in BeamWeight other,
            int column, in Matrix3 h, bool arePair)
        {
            for (int j = 0; j < WallBeam.Order; j++)
            {
                Matrix3 right = h.Times(other.Of(j));
                int l = other.Splines.First + j;
                if (node >= 0)
                {
                    columns.AddCoupling(node, l, -1.0 * right);
                }
                for (int i = 0; i < WallBeam.Order; i++)
                {
                    AddBlock(columns, weight.Splines.First + i, l, weight.Of(i).TransposeTimes(right), arePair);
                }
            }
            for (int i = 0; i < WallBeam.Order && arePair && column >= 0; i++)
            {
                columns.AddCoupling(column, weight.Splines.First + i, -1.0 * h.TransposeTimes(weight.Of(i)));
            }
        }

        /// <summary>Adds what an energy with the gradient f by a node has of second derivatives because its section
        /// turns by da: those of -f.(da x (dx - dw)) + f.(da x (da x v))/2.</summary>
        /// <param name="node">-1: it does not move.</param>
        /// <param name="f">N.</param>
        /// <param name="units">Per metre.</param>
        public static void AddTurning(this in BeamWeight weight, LowRank columns, int node, in Vector3d f, double units)
        {
            double along = Vector3d.Dot(f, weight.Arm);
            Matrix3 cross = units * Matrix3.Of(default, f).Times(weight.Turn);
            Matrix3 twice = units * weight.Turn.TransposeTimes(Matrix3.Of(Symmetric3.Pair(0.5, f, weight.Arm)
                + new Symmetric3(-along, 0.0, -along, 0.0, 0.0, -along)).Times(weight.Turn));
            for (int j = 0; j < WallBeam.Order; j++)
            {
                int own = weight.Splines.First + j;
                double slope = weight.Splines.Slope(j);
                if (node >= 0)
                {
                    columns.AddCoupling(node, own, -slope * cross);
                }
                for (int i = 0; i < WallBeam.Order; i++)
                {
                    int row = weight.Splines.First + i;
                    AddBlock(columns, row, own, weight.Splines.Value(i) * slope * cross, true);
                    AddBlock(columns, row, own, weight.Splines.Slope(i) * slope * twice, false);
                }
            }
        }

        /// <summary>Adds second derivatives by an element's turn (row) and the point's place (column).</summary>
        public static void AddTurn(this in BeamWeight weight, LowRank columns, int element, in Matrix3 second)
        {
            for (int j = 0; j < WallBeam.Order; j++)
            {
                columns.AddCoupling(element, weight.Splines.First + j, default, second.Times(weight.Of(j)));
            }
        }

        private static void AddBlock(LowRank columns, int i, int j, in Matrix3 block, bool arePair)
        {
            for (int a = 0; a < 3; a++)
            {
                for (int b = 0; b < 3; b++)
                {
                    double value = block[a, b];
                    columns.Border(3 * i + a, 3 * j + b) += value;
                    if (arePair)
                    {
                        columns.Border(3 * j + b, 3 * i + a) += value;
                    }
                }
            }
        }
    }
}
