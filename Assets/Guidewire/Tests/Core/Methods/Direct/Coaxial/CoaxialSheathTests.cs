using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire in a catheter in a sheath, against one instrument in a sheath and against what is
    /// exact.</summary>
    public sealed class CoaxialSheathTests
    {
        private const double Exit = 157.5;    // units, between two nodes

        // 300 mm of wire, or of a catheter with its material, of which 142.5 are beyond the exit, bent by a load.
        [TestCase(false)]
        [TestCase(true)]
        public void OtherInstrumentOfNoStiffness_LeavesOneAloneInItsSheath(bool isCatheter)
        {
            SimulationParameters alone = Sheathed(60);
            Catheter catheter = alone.Scene.Catheters[0];
            alone.Scene.Catheters = Array.Empty<Catheter>();
            SimulationParameters both = Sheathed(60);
            if (isCatheter)
            {
                both.Material.YoungsModulus *= 1e-7;
                both.Material.ShearModulus *= 1e-7;
                alone.Material.WireRadius = catheter.Material.WireRadius;
                alone.Material.InnerRadius = catheter.Material.InnerRadius;
                alone.Material.YoungsModulus = catheter.Material.YoungsModulus;
                alone.Material.ShearModulus = catheter.Material.ShearModulus;
                alone.Material.Density = catheter.Material.Density;
                both.Scene.GuidewireLength = 290.0;
                both.Scene.NumberRodElements = 58;
                both.Scene.Catheters[0].Length = 300.0;
                both.Scene.Catheters[0].Elements = 60;
            }
            else
            {
                both.Scene.Catheters[0].Material.YoungsModulus *= 1e-7;
                both.Scene.Catheters[0].Material.ShearModulus *= 1e-7;
            }
            Simulation one = Finished(alone);
            Simulation two = Finished(both);
            Vector3d tip = isCatheter ? two.Coaxial()!.Positions[60] : two.State.Positions[60];
            double force = isCatheter ? two.Coaxial()!.Force : two.Hub()!.Force;
            TestContext.WriteLine("{0} and {1}; {2:G6} and {3:G6} N", one.State.Positions[60], tip,
                one.Hub()!.Force, force);
            Assert.That(tip.X, Is.GreaterThan(2.0), "mm: it is bent");
            Assert.That((tip - one.State.Positions[60]).Length, Is.LessThan(1e-4 * 142.5));
            Assert.That(force, Is.EqualTo(one.Hub()!.Force).Within(1e-3 * Math.Abs(one.Hub()!.Force)));
        }

        private static SimulationParameters Sheathed(int elements)
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Scene.GuidewireLength = 300.0;
            parameters.Scene.NumberRodElements = elements;
            parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, Exit) };
            parameters.Scene.TipForce = new Vector3d(0.01, 0.0, 0.0);
            parameters.Scene.Walls = new ContactShape[] { new PlaneShape(new Vector3d(0.0, -500.0, 0.0),
                Vector3d.UnitY) };
            parameters.Material.Sections = Array.Empty<WireSection>();
            parameters.Material.MassDamping = 30.0;
            parameters.Method.TimeStep = 0.05;
            parameters.Method.MaxSimulationSteps = 200;
            Catheter catheter = parameters.Scene.Catheters[0];
            catheter.Start = 0.0;
            catheter.Length = 200.0;
            catheter.Elements = elements * 2 / 3;
            catheter.Material.Sections = Array.Empty<WireSection>();
            return parameters;
        }

        private static Simulation Finished(SimulationParameters parameters)
        {
            Simulation run = Simulation.Create(parameters);
            while (run.Outcome == Outcome.Running)
            {
                run.Step();
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            return run;
        }
    }
}
