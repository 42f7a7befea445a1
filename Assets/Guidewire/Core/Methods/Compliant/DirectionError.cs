using System;

namespace Guidewire.Core
{
    /// <summary>Error in the directions of the impulses of a substep: each iteration moved the wire along the gradient
    /// of C in the shape of the moment, whereas implicit Euler requires that of the final shape, x - x~ = M^-1
    /// grad C^T lambda.</summary>
    /// <remarks>The difference d of the two sides is what forces M d/h^2 and couples J d/h^2 from nowhere would do.
    /// Their moment about joint k, summed from the distal end, over the joint's stiffness is an angle that counts like
    /// a residual of that joint.</remarks>
    internal sealed class DirectionError
    {
        private readonly CompliantStretch _stretch;
        private readonly CompliantBendTwist _bendTwist;
        private readonly CompliantContacts? _contacts;
        private readonly NodalInertia _inertia;
        private readonly Joint[] _joint;
        private readonly RodShape _predicted;
        private readonly Vector3d[] _shift;
        private readonly Vector3d[] _turn;

        /// <summary>Makes the measure for these constraints.</summary>
        /// <param name="contacts">Null without walls.</param>
        public DirectionError(MaterialScene scene, NodalInertia inertia, CompliantStretch stretch,
            CompliantBendTwist bendTwist, CompliantContacts? contacts)
        {
            _stretch = stretch;
            _bendTwist = bendTwist;
            _contacts = contacts;
            _inertia = inertia;
            _joint = scene.Rod.Joints(scene.Supports);
            _predicted = new RodShape(scene.Rod.ElementCount);
            _shift = new Vector3d[scene.Rod.ElementCount + 1];
            _turn = new Vector3d[scene.Rod.ElementCount];
        }

        /// <summary>Takes the prediction, before any multiplier has moved it.</summary>
        public void Begin(RodShape shape) => _predicted.CopyFrom(shape);

        /// <summary>Adds the angles of all joints, after the iterations.</summary>
        public void Add(RodShape shape, double substep, ref IterationResidual sum)
        {
            Array.Clear(_shift, 0, _shift.Length);
            Array.Clear(_turn, 0, _turn.Length);
            _stretch.AddMotion(shape, _shift, _turn);
            _bendTwist.AddMotion(shape, _turn);
            _contacts?.AddMotion(shape, _shift, _turn);
            double perSquare = 1.0 / (substep * substep);
            Vector3d force = Vector3d.Zero;
            Vector3d moment = Vector3d.Zero;
            for (int j = _turn.Length - 1; j >= 0; j--)
            {
                double w = _inertia.InverseMass[j + 1];
                if (w > 0.0)
                {
                    force += (perSquare / w) * (shape.X[j + 1] - _predicted.X[j + 1] - _shift[j + 1]);
                }
                Quaterniond q = shape.Q[j];
                Vector3d turn = RotationVector.Log(_predicted.Q[j].Conjugate * q) - _turn[j];
                Vector3d inverse = _inertia.InverseInertia[j];
                var couple = new Vector3d(turn.X / inverse.X, turn.Y / inverse.Y, turn.Z / inverse.Z);
                moment += Vector3d.Cross(shape.X[j + 1] - shape.X[j], force)
                    + perSquare * Quaterniond.Rotate(q, couple);
                Vector3d own = Quaterniond.Rotate(q.Conjugate, moment);
                sum.Bend += Math.Sqrt(own.X * own.X + own.Y * own.Y)
                    / Math.Min(_joint[j].Bend1, _joint[j].Bend2);
                sum.Twist += Math.Abs(own.Z) / _joint[j].Twist;
            }
        }
    }
}
