namespace Guidewire.Core
{
    /// <summary>How the accelerations of a stage are predicted: a_First + Share (a_Second - a_First).</summary>
    internal struct StagePredictor
    {
        public int First;
        public int Second;
        public double Share;
    }
}
