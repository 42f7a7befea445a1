using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Lengths that are not given, in scenes whose unit is not a millimetre: the defaults are lengths in mm,
    /// and not as many units.</summary>
    internal static class LengthDefaults
    {
        private const double Millimetre = 1e-3;    // m

        /// <summary>Converts those of a wire with a material.</summary>
        public static void Convert(SimulationParameters parameters, GivenParameters given)
        {
            SceneParameters scene = parameters.Scene;
            if (scene.MetresPerUnit == Millimetre || !MethodTable.Of(parameters.Method.Solver).TakesMaterial)
            {
                return;
            }
            double units = Millimetre / scene.MetresPerUnit;
            scene.GuidewireLength *= given.Has("guidewireLength") ? 1.0 : units;
            scene.GuidewireOffset *= given.Has("guidewireOffset") ? 1.0 : units;
            scene.StartRadius *= given.Has("startRadius") ? 1.0 : units;
            parameters.Method.DeltaThreshold *= given.Has("deltaThreshold") ? 1.0 : units;
        }
    }
}
