using System;

namespace Guidewire.Core
{
    /// <summary>Moves sphere 0 along the first element and turns that element about its axis, as the user
    /// steers.</summary>
    /// <remarks>The user holds the frame of element 0, also while steering asks for nothing: its orientation has weight
    /// 0. A pbd wire has no force at which the hand would slip: it slips where an element is strained as far as <see
    /// cref="Steering.SlipStrain"/> says, in the direction that strains it further.</remarks>
    internal sealed class SteeredDrive : IDriveMotion
    {
        private readonly Steering _steering;
        private readonly AlongFirstElement _direction = new AlongFirstElement();

        /// <param name="steering">What the user asks.</param>
        public SteeredDrive(Steering steering)
        {
            _steering = steering;
        }

        /// <summary>Takes what the hand slipped; null: nothing does.</summary>
        public ContactRecord? Record { get; set; }

        /// <inheritdoc/>
        public void Move(RodState state)
        {
            Vector3d[] x = state.Positions;
            double push = Slips(state) ? 0.0 : _steering.Push;
            Record?.AddDrive(Math.Abs(_steering.Push - push), Math.Abs(_steering.Push - push));
            state.PredictedPositions[0] = x[0] + push * _direction.At(x[0], x[1]);
            Quaterniond turn = Quaterniond.FromAxisAngle(Vector3d.UnitZ, _steering.Turn);
            state.PredictedOrientations[0] = Quaterniond.Normalize(state.Orientations[0] * turn);
        }

        private bool Slips(RodState state)
        {
            Vector3d[] x = state.Positions;
            for (int i = 1; i < x.Length; i++)
            {
                double strain = Vector3d.Distance(x[i], x[i - 1]) / state.ElementLength - 1.0;
                if (-Math.Sign(_steering.Push) * strain > _steering.SlipStrain)
                {
                    return true;
                }
            }
            return false;
        }
    }
}
