using System;

namespace Guidewire.Core
{
    /// <summary>Coulomb friction on walls as an energy over one step: mu N f(|u|) of each contact, u the slip of the
    /// wire's surface along the wall since the step's start. Its slope is the force mu N against the slip, smoothed
    /// below a threshold (Li et al. 2020): with e = threshold speed times dt, f' = 2 y/e - (y/e)^2 below e, 1
    /// beyond.</summary>
    /// <remarks>Below the threshold speed a contact creeps, it does not stick. Pushes N and normals n are lagged: those
    /// of the shape that was last given to <see cref="Lag"/>. The surface of element j at s slips by
    /// u = P ((1 - s) (x_j - x_j0) + s (x_j+1 - x_j+1,0) + r n x R_0 phi), P = 1 - n n^T, phi the turn of the element
    /// since the step's start along its axes there: what turns about its own axis rubs, too, and takes a couple.
    /// With u' = W theta, W = r [n] R_0 J^-1(phi), the second derivative leaves out that of phi, of order |phi|.
    /// </remarks>
    internal sealed class FrictionEnergy : EnergyTerm
    {
        private readonly BarrierEnergy _barrier;
        private readonly double _threshold;       // m/s
        private readonly StructList<WallContact> _contacts = new StructList<WallContact>(64);
        private readonly Vector3d[] _start;       // x_0, m
        private readonly Quaterniond[] _frames;   // q_0
        private double _creep;                    // e, m

        /// <summary>Friction at the contacts of a barrier.</summary>
        /// <param name="threshold">m/s.</param>
        public FrictionEnergy(BarrierEnergy barrier, int elementCount, double threshold)
        {
            _barrier = barrier;
            _threshold = threshold;
            _start = new Vector3d[elementCount + 1];
            _frames = new Quaterniond[elementCount];
            Array.Fill(_frames, Quaterniond.Identity);
            _creep = threshold;
        }

        /// <summary>Its slope is a force; its value is no energy that the wire stores.</summary>
        public override bool StoresEnergy => false;

        /// <inheritdoc/>
        public override void BeginStep(RodShape shape, double dt)
        {
            Array.Copy(shape.X, _start, _start.Length);
            Array.Copy(shape.Q, _frames, _frames.Length);
            _creep = _threshold * dt;
        }

        /// <summary>Takes over pushes and normals from a shape.</summary>
        public void Lag(RodShape shape)
        {
            _contacts.Clear();
            StructList<WallContact> contacts = _barrier.ContactsOf(shape);
            for (int k = 0; k < contacts.Count; k++)
            {
                if (_barrier.Walls[contacts[k].Wall].FrictionCoefficient > 0.0)
                {
                    _contacts.Add(contacts[k]);
                }
            }
        }

        /// <inheritdoc/>
        public override double Value(RodShape shape)
        {
            double sum = 0.0;
            for (int k = 0; k < _contacts.Count; k++)
            {
                double y = Slip(shape, _contacts[k], out _).Length / _creep;
                double f = y < 1.0 ? y * y * (1.0 - y / 3.0) + 1.0 / 3.0 : y;
                sum += Limit(_contacts[k]) * _creep * f;
            }
            return sum;
        }

        /// <inheritdoc/>
        public override void AddGradient(RodShape shape, RodVector[] gradient, int from, int to,
            ref GradientMeasures measured)
        {
            for (int k = 0; k < _contacts.Count; k++)
            {
                WallContact contact = _contacts[k];
                if (contact.Element >= from && contact.Element < to)
                {
                    AddForce(contact, Slip(shape, contact, out Vector3d turn), turn, gradient);
                }
            }
        }

        /// <inheritdoc/>
        public override void AddBlocks(RodShape shape, RodBlock[] blocks, RodVector[] gradient, int from, int to)
        {
            for (int k = 0; k < _contacts.Count; k++)
            {
                WallContact contact = _contacts[k];
                int j = contact.Element;
                if (j < from || j >= to)
                {
                    continue;
                }
                Vector3d slip = Slip(shape, contact, out Vector3d turn);
                AddForce(contact, slip, turn, gradient);
                double y = slip.Length / _creep;
                double across = Limit(contact) / _creep * (y < 1.0 ? 2.0 - y : 1.0 / y);
                double along = y < 1.0 ? Limit(contact) / _creep * (2.0 - 2.0 * y) : 0.0;
                Vector3d n = contact.Normal;
                Vector3d direction = Vector3d.Normalize(slip);
                Symmetric3 h = new Symmetric3(across, 0.0, across, 0.0, 0.0, across)
                    + Symmetric3.Outer(-across, n) + Symmetric3.Outer(along - across, direction);
                AddBlocks(contact, turn, h, ref blocks[j], ref blocks[j + 1]);
            }
        }

        private double Limit(in WallContact contact)
        {
            return _barrier.Walls[contact.Wall].FrictionCoefficient * contact.Force;
        }

        // u, and phi.
        private Vector3d Slip(RodShape shape, in WallContact contact, out Vector3d turn)
        {
            int j = contact.Element;
            double s = contact.Position;
            Vector3d n = contact.Normal;
            turn = RotationVector.Log(_frames[j].Conjugate * shape.Q[j]);
            Vector3d move = (1.0 - s) * (shape.X[j] - _start[j]) + s * (shape.X[j + 1] - _start[j + 1])
                + _barrier.RadiusOf(j) * Vector3d.Cross(n, Quaterniond.Rotate(_frames[j], turn));
            return move - Vector3d.Dot(move, n) * n;
        }

        private void AddForce(in WallContact contact, in Vector3d slip, in Vector3d turn, RodVector[] gradient)
        {
            int j = contact.Element;
            double y = slip.Length / _creep;
            Vector3d force = (Limit(contact) / _creep * (y < 1.0 ? 2.0 - y : 1.0 / y)) * slip;
            Add(ref gradient[j], 1.0 - contact.Position, force);
            Add(ref gradient[j + 1], contact.Position, force);
            Vector3d couple = Quaterniond.Rotate(_frames[j].Conjugate,
                _barrier.RadiusOf(j) * Vector3d.Cross(force, contact.Normal));
            couple = InverseTangent(-turn, couple);
            gradient[j].T1 += couple.X;
            gradient[j].T2 += couple.Y;
            gradient[j].T3 += couple.Z;
        }

        private void AddBlocks(in WallContact contact, in Vector3d turn, in Symmetric3 h, ref RodBlock b,
            ref RodBlock next)
        {
            double s = contact.Position;
            double r = 1.0 - s;
            RodBlock.AddAt(ref b, ref next, s, h);
            Vector3d w1 = Column(contact, turn, Vector3d.UnitX);
            Vector3d w2 = Column(contact, turn, Vector3d.UnitY);
            Vector3d w3 = Column(contact, turn, Vector3d.UnitZ);
            Vector3d h1 = h.Times(w1);
            Vector3d h2 = h.Times(w2);
            Vector3d h3 = h.Times(w3);
            b.B11 += r * h1.X; b.B12 += r * h1.Y; b.B13 += r * h1.Z;
            b.B21 += r * h2.X; b.B22 += r * h2.Y; b.B23 += r * h2.Z;
            b.B31 += r * h3.X; b.B32 += r * h3.Y; b.B33 += r * h3.Z;
            b.E11 += s * h1.X; b.E21 += s * h1.Y; b.E31 += s * h1.Z;
            b.E12 += s * h2.X; b.E22 += s * h2.Y; b.E32 += s * h2.Z;
            b.E13 += s * h3.X; b.E23 += s * h3.Y; b.E33 += s * h3.Z;
            b.C11 += Vector3d.Dot(w1, h1);
            b.C21 += Vector3d.Dot(w2, h1);
            b.C22 += Vector3d.Dot(w2, h2);
            b.C31 += Vector3d.Dot(w3, h1);
            b.C32 += Vector3d.Dot(w3, h2);
            b.C33 += Vector3d.Dot(w3, h3);
        }

        // W e.
        private Vector3d Column(in WallContact contact, in Vector3d turn, in Vector3d e)
        {
            int j = contact.Element;
            return _barrier.RadiusOf(j)
                * Vector3d.Cross(contact.Normal, Quaterniond.Rotate(_frames[j], InverseTangent(turn, e)));
        }

        // J^-1(phi) v: how phi changes with a turn v along the element's own axes; the transpose with -phi.
        private static Vector3d InverseTangent(in Vector3d turn, in Vector3d v)
        {
            Vector3d across = Vector3d.Cross(turn, v);
            return v + 0.5 * across
                + RotationVector.CotangentFactor(turn.LengthSquared) * Vector3d.Cross(turn, across);
        }

        private static void Add(ref RodVector gradient, double weight, in Vector3d force)
        {
            gradient.X1 += weight * force.X;
            gradient.X2 += weight * force.Y;
            gradient.X3 += weight * force.Z;
        }
    }
}
