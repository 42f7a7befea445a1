namespace Guidewire.Core
{
    /// <summary>Moves sphere 0 within a step, after the prediction and before the constraints.</summary>
    internal interface IDriveMotion
    {
        /// <summary>Writes the predicted position of sphere 0.</summary>
        void Move(RodState state);
    }
}
