using System;
using NUnit.Framework;

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
            SetTube(catheter, 0.83e-3, 0.6e-3, 4e9, 1.5e9);
            catheter.Material.Sections = new[]
            {
                new WireSection { From = 210.0, To = 250.0, YoungsModulus = 2e9,
                    RestCurvature = new Vector3d(30.0, 10.0, 0.0) },
            };
            parameters.Scene.Catheters = new[] { catheter };
            return parameters;
        }

        /// <summary>Another number where a node came or went, or a tip came into another element: only then each
        /// element takes the mass of what is in it.</summary>
        public static double ElementsOf(DirectStep run)
        {
            MaterialRod rod = run.Dynamics.Terms.Rod;
            double sum = 0.0;
            for (int j = 0; j < rod.ElementCount; j++)
            {
                sum += (j + 1) * rod.LineDensity[j];
            }
            return sum;
        }

        /// <summary>The same pair in an outer catheter of 160 mm with a bent tip, its hub 30 mm ahead of the
        /// catheter's.</summary>
        public static SimulationParameters Three(Integrator integrator)
        {
            SimulationParameters parameters = Pair(integrator);
            var outer = new Catheter { Length = 160.0, Elements = 16, Start = 130.0 };
            SetTube(outer, 1.35e-3, 1.0e-3, 1e9, 0.4e9);
            outer.Material.Sections = new[]
            {
                new WireSection { From = 123.0, To = 160.0, YoungsModulus = 0.6e9,
                    RestCurvature = new Vector3d(-8.0, 14.0, 0.0) },
            };
            parameters.Scene.Catheters = new[] { outer, parameters.Scene.Catheters[0] };
            return parameters;
        }

        /// <summary>Sets the radii, m, and the moduli, Pa, of a catheter of 1200 kg/m^3.</summary>
        public static void SetTube(Catheter catheter, double radius, double innerRadius, double young, double shear)
        {
            catheter.Material.WireRadius = radius;
            catheter.Material.InnerRadius = innerRadius;
            catheter.Material.YoungsModulus = young;
            catheter.Material.ShearModulus = shear;
            catheter.Material.Density = 1200.0;
        }

        /// <summary>Work of both hubs, J, in one cycle, forth and back and turned, slowly: trapezoids of forces and
        /// torques.</summary>
        /// <param name="perStep">Of an element of 10 mm, by which they move in a step.</param>
        /// <param name="peak">The largest that it was, J.</param>
        public static double CycleWork(SimulationParameters parameters, double perStep, out double peak) =>
            CycleWork(parameters, perStep, out peak, out _);

        /// <summary>The same, and what of it the material has turned into heat and stores still, J.</summary>
        public static double CycleWork(SimulationParameters parameters, double perStep, out double peak,
            out double left)
        {
            double l = 0.01;
            int steps = (int)Math.Round(3.2 / perStep);
            double dt = 40.0 * perStep;
            double top = steps * perStep * l;
            parameters.Material.MassDamping = 0.0;
            parameters.Method.TimeStep = dt;
            parameters.Method.SolverTolerance = 1e-10;
            parameters.Method.MaxSimulationSteps = 10 + 4 * steps;
            double[] times = { 0.0, 10.0 * dt, (10 + steps) * dt, (10 + 2 * steps) * dt, (10 + 3 * steps) * dt,
                (10 + 4 * steps) * dt };
            parameters.Drive.Table = new DriveTable(new TimeTable(times, new[] { 0.0, 0.0, top, top, 0.6 * top, 0.0 }),
                new TimeTable(times, new[] { 0.0, 0.0, 0.5, 0.5, 0.0, 0.0 }));
            parameters.Scene.Catheters[0].Drive.Table = new DriveTable(
                new TimeTable(times, new[] { 0.0, 0.0, 0.0, 0.6 * top, 0.6 * top, 0.0 }),
                new TimeTable(times, new[] { 0.0, 0.0, 0.0, -0.4, -0.4, 0.0 }));
            Simulation run = Simulation.Create(parameters);
            double work = 0.0;
            double before = 0.0;
            double Kept() => run.Stress()!.ElasticEnergy + run.Report()!.Extremes!.MaterialLoss;
            peak = 0.0;
            double[] old = new double[8];
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
                CoaxialRecord record = run.Coaxial()!;
                HubRecord hub = run.Hub()!;
                double[] now = { hub.Force, hub.Torque, record.Force, record.Torque, hub.Insertion, hub.Turn,
                    record.Insertion, record.Turn };
                before = run.StepCount == 5 ? Kept() : before;
                for (int k = 0; k < 4 && run.StepCount > 5; k++)
                {
                    work += 0.5 * (now[k] + old[k]) * (now[k + 4] - old[k + 4]);
                }
                old = now;
                peak = Math.Max(peak, Math.Abs(work));
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            left = Kept() - before;
            return work;
        }
    }
}
