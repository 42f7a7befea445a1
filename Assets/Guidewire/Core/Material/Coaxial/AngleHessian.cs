namespace Guidewire.Core
{
    /// <summary>Second derivatives of an energy by two angles, J.</summary>
    internal struct AngleHessian
    {
        public double First;
        public double Second;
        public double Mixed;
    }
}
