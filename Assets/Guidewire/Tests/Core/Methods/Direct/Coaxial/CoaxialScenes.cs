namespace Guidewire.Core.Tests
{
    /// <summary>Runs of a wire in a catheter that tests share.</summary>
    internal static class CoaxialScenes
    {
        /// <summary>A wire of 400 mm with a bent soft tip in a catheter of 250 mm with a bent tip, 0.1 m between the
        /// hubs.</summary>
        public static SimulationParameters Pair(Integrator integrator)
        {
            SimulationParameters parameters = SimulationParameters.DefaultsOf(Solver.Direct);
            parameters.Method.Integrator = integrator;
            parameters.Method.TimeStep = 2e-3;
            parameters.Method.DeltaThreshold = 0.0;
            parameters.Scene.GuidewireLength = 400.0;
            parameters.Scene.NumberRodElements = 40;
            parameters.Scene.GuidewireOffset = 0.0;
            parameters.Scene.ProximalEnd = ProximalEnd.Clamped;
            parameters.Drive.Kind = Drive.Displace;
            parameters.Material.WireRadius = 0.445e-3;
            parameters.Material.MassDamping = 20.0;
            parameters.Material.Sections = new[]
            {
                new WireSection { From = 370.0, To = 400.0, YoungsModulus = 9e9, ShearModulus = 3.5e9,
                    RestCurvature = new Vector3d(30.0, 0.0, 0.0) },
            };
            var catheter = new Catheter { Length = 250.0, Elements = 25, Start = 100.0 };
            catheter.Material.WireRadius = 0.83e-3;
            catheter.Material.InnerRadius = 0.6e-3;
            catheter.Material.YoungsModulus = 4e9;
            catheter.Material.ShearModulus = 1.5e9;
            catheter.Material.Density = 1200.0;
            catheter.Material.Sections = new[]
            {
                new WireSection { From = 210.0, To = 250.0, YoungsModulus = 2e9,
                    RestCurvature = new Vector3d(30.0, 10.0, 0.0) },
            };
            parameters.Scene.Catheters = new[] { catheter };
            return parameters;
        }
    }
}
