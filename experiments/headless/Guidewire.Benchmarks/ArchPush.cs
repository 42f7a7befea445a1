using System;
using Guidewire.Core;

namespace Guidewire.Benchmarks
{
    /// <summary>A nitinol wire (r = 0.4 mm, 300 mm, 60 elements) that is pushed 150 mm from a straight sheath into an
    /// arch of 180 degrees (radius 30 mm, lumen 3 mm), a tube in closed form, in steps of 10 ms.</summary>
    internal sealed class ArchPush
    {
        private const double Way = 150.0;        // mm
        private const double TimeStep = 0.01;    // s
        private const double BendRadius = 30.0;  // mm
        private const int BendPieces = 40;

        private readonly SimulationParameters _parameters;

        /// <param name="speed">mm/s.</param>
        public ArchPush(double speed)
        {
            _parameters = new SimulationParameters
            {
                Scene =
                {
                    NumberRodElements = 60,
                    GuidewireOffset = -300.0,
                    ProximalEnd = ProximalEnd.Clamped,
                    Walls = new ContactShape[] { Arch() },
                },
                Material = { WireRadius = 0.4e-3 },
                Method =
                {
                    Solver = Solver.Direct,
                    Integrator = Integrator.ImplicitEuler,
                    TimeStep = TimeStep,
                    DeltaThreshold = 0.0,
                    MaxSimulationSteps = (int)Math.Round(Way / (speed * TimeStep)),
                },
                Drive = { Kind = Drive.Displace, Displacement = 0.0, DisplacementPerStep = speed * TimeStep },
            };
            Duration = Way / speed;
        }

        /// <summary>s of simulated time.</summary>
        public double Duration { get; }

        /// <summary>The whole push; its Newton iterations a step.</summary>
        public double Run()
        {
            Simulation run = Simulation.Create(_parameters);
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
            }
            if (run.Outcome != Outcome.Finished || run.Contacts!.Passages > 0)
            {
                throw new InvalidOperationException("the push did not end inside: " + run.Reason);
            }
            return run.Report()!.WallIterations / run.StepCount;
        }

        private static TubeShape Arch()
        {
            var knots = new Vector3d[BendPieces + 3];
            var radii = new double[knots.Length];
            Array.Fill(radii, 3.0);
            knots[0] = new Vector3d(0.0, 0.0, -320.0);
            for (int k = 0; k <= BendPieces; k++)
            {
                double angle = Math.PI * k / BendPieces;
                knots[k + 1] = new Vector3d(0.0, BendRadius * (1.0 - Math.Cos(angle)), BendRadius * Math.Sin(angle));
            }
            knots[BendPieces + 2] = new Vector3d(0.0, 2.0 * BendRadius, -200.0);
            return new TubeShape(knots, radii, true, true);
        }
    }
}
