using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Couples and forces in a wire among catheters, against the balance of what is beyond and its part of the
    /// stiffness of all.</summary>
    public sealed class WireStressTests
    {
        private static readonly Vector3d Load = new Vector3d(0.0, 0.02, -0.05);    // N, at the wire's tip

        // Straight instruments that rest under a force at the wire's tip: the couple in all of them is that of the
        // force
        // about the tip, and the wire has its part by EI where others are around it.
        [Test]
        public void Couple_IsTheWiresPartOfTheMomentOfWhatIsBeyond([Values(2, 3)] int instruments)
        {
            SimulationParameters parameters = Straight(instruments);
            Simulation run = Simulation.Create(parameters);
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Running), run.Reason);
            StressRecord stress = run.Stress()!;
            Vector3d[] x = run.State.Positions;
            Vector3d tip = x[x.Length - 1];
            double worst = 0.0;
            double largest = 0.0;
            for (int k = FirstElement(instruments) + 1; k < x.Length - 1; k++)
            {
                if (k == 29 || k == 35)
                {
                    continue;   // half of the joint is beyond a tip
                }
                Vector3d moment = PartAt(parameters, 10.0 * k, BendOf) * 1e-3 * Vector3d.Cross(tip - x[k], Load);
                largest = Math.Max(largest, moment.Length);
                worst = Math.Max(worst, (stress.Couple[k] - moment).Length);
            }
            TestContext.WriteLine("{0:G3} of {1:G3} N m", worst, largest);
            Assert.That(largest, Is.GreaterThan(1e-4));
            Assert.That(worst, Is.LessThan(1e-5 * largest));
        }

        // A wire that slides bears the force along its tip from there to its hub. Of what else an element has it bears
        // its part, by EA along and by GA across. Behind the outermost hub it has what its hub has.
        [Test]
        public void Force_IsTheWiresLoadAlongIt_AndItsPartOfTheRest([Values(2, 3)] int instruments)
        {
            SimulationParameters parameters = Straight(instruments);
            Simulation run = Simulation.Create(parameters);
            StressRecord stress = run.Stress()!;
            int first = FirstElement(instruments);
            for (int k = 0; k < first; k++)
            {
                Assert.That((stress.Force[k] + run.Hub()!.Force * Vector3d.UnitZ).Length, Is.LessThan(1e-12));
            }
            double pull = Vector3d.Dot(Load, run.State.Orientations[stress.Force.Length - 1].Director3);
            for (int k = first; k < stress.Force.Length; k++)
            {
                Vector3d axis = run.State.Orientations[k].Director3;
                double along = Vector3d.Dot(Load, axis);
                double at = 10.0 * k + 5.0;
                Vector3d expected = (pull + PartAt(parameters, at, StretchOf) * (along - pull)) * axis
                    + PartAt(parameters, at, ShearOf) * (Load - along * axis);
                Assert.That((stress.Force[k] - expected).Length, Is.LessThan(1e-6 * Load.Length), "element " + k);
            }
        }

        // Straight up to the exit of a sheath, wherever that cuts an element, and under the whole moment beyond it.
        [Test]
        public void Couple_IsThatOfBendingBeyondTheExitAlone([Values(200.0, 203.0, 209.9)] double exit)
        {
            SimulationParameters parameters = Straight(2);
            parameters.Scene.Sheath = new Sheath { Exit = new Vector3d(0.0, 0.0, exit) };
            parameters.Scene.Walls = WallScenes.Floor(-500.0);
            parameters.Scene.InitialState = InitialState.Straight;
            parameters.Method.TimeStep = 0.1;
            Simulation run = Simulation.Create(parameters);
            Wires.GoOn(run, 100);    // to rest
            StressRecord stress = run.Stress()!;
            Vector3d[] x = run.State.Positions;
            Vector3d tip = x[x.Length - 1];
            for (int k = 0; k < x.Length - 1; k++)
            {
                if (k == 35 || Math.Abs(10.0 * k - exit) < 10.0)
                {
                    continue;    // half of the joint is beyond a tip, or in the sheath
                }
                Vector3d moment = 10.0 * k < exit ? Vector3d.Zero
                    : PartAt(parameters, 10.0 * k, BendOf) * 1e-3 * Vector3d.Cross(tip - x[k], Load);
                Assert.That((stress.Couple[k] - moment).Length, Is.LessThan(1e-7), "joint " + k);
            }
            int last = (int)Math.Ceiling(0.1 * exit) - 1;
            Assert.That(stress.Couple[last].Length, Is.LessThan(1e-7), "the last joint in the sheath");
        }

        // A wire with a long curve that is turned in its catheter.
        [Test]
        public void TwistBetweenTheHubs_IsTheHubsTorque()
        {
            SimulationParameters parameters = CoaxialScenes.Pair(Integrator.ImplicitEuler);
            parameters.Material.Sections[0].From = 250.0;
            parameters.Drive.RotationSpeed = 20.0;
            Simulation run = Simulation.Create(parameters);
            Wires.GoOn(run, 50);
            StressRecord stress = run.Stress()!;
            double torque = run.Hub()!.Torque;
            Assert.That(Math.Abs(torque), Is.GreaterThan(1e-4));
            for (int k = 0; k < 10; k++)
            {
                Assert.That(stress.Couple[k].Z, Is.EqualTo(-torque).Within(1e-6 * Math.Abs(torque)), "joint " + k);
                Assert.That(stress.Couple[k].X, Is.Zero);
            }
        }

        private static SimulationParameters Straight(int instruments)
        {
            SimulationParameters parameters = instruments == 2 ? CoaxialScenes.Pair(Integrator.ImplicitEuler)
                : CoaxialScenes.Three(Integrator.ImplicitEuler);
            parameters.Scene.InitialState = InitialState.Equilibrium;
            parameters.Scene.TipForce = Load;
            parameters.Material.Sections = Array.Empty<WireSection>();
            foreach (Catheter catheter in parameters.Scene.Catheters)
            {
                catheter.Material.Sections = Array.Empty<WireSection>();
            }
            return parameters;
        }

        // The wire's part of a stiffness of all instruments at a place along it, mm.
        private static double PartAt(SimulationParameters parameters, double at, Func<MaterialParameters, double> of)
        {
            double own = of(parameters.Material);
            double all = own;
            foreach (Catheter catheter in parameters.Scene.Catheters)
            {
                bool isThere = at > catheter.Start && at < catheter.Start + catheter.Length;
                all += isThere ? of(catheter.Material) : 0.0;
            }
            return own / all;
        }

        // Four times EI over pi.
        private static double BendOf(MaterialParameters material) =>
            material.YoungsModulus * (Math.Pow(material.WireRadius, 4.0) - Math.Pow(material.InnerRadius, 4.0));

        // GA over pi and the shear factor.
        private static double ShearOf(MaterialParameters material) =>
            material.ShearModulus * (Math.Pow(material.WireRadius, 2.0) - Math.Pow(material.InnerRadius, 2.0));

        // EA over pi.
        private static double StretchOf(MaterialParameters material) =>
            material.YoungsModulus * (Math.Pow(material.WireRadius, 2.0) - Math.Pow(material.InnerRadius, 2.0));

        // The first at which all are.
        private static int FirstElement(int instruments) => instruments == 2 ? 10 : 13;
    }
}
