using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>A frictionless wire that was pushed 150 mm into the arch at 50 mm/s ends where its material takes it,
    /// whatever the numbers of the method are.</summary>
    public sealed class WallIndependenceTests
    {
        private const double Insertion = 150.0;    // mm
        private const double Gap = 0.05;     // mm

        [Test]
        public void Tip_DoesNotDependOnTheElements()
        {
            Vector3d coarse = Tip(60, 0.01, Gap);
            Vector3d middle = Tip(120, 0.01, Gap);
            Assert.That(Vector3d.Distance(coarse, middle), Is.LessThan(0.04 * WallScenes.LumenRadius));
            if (Rods.InFull)
            {
                Vector3d fine = Tip(240, 0.01, Gap);
                Assert.That(Vector3d.Distance(middle, fine), Is.LessThan(0.01 * WallScenes.LumenRadius));
            }
        }

        [Test]
        public void Tip_DoesNotDependOnTheTimeStep()
        {
            Vector3d coarse = Tip(60, 0.01, Gap);
            Vector3d fine = Tip(60, 0.002, Gap);
            TestContext.WriteLine(Vector3d.Distance(coarse, fine) + " mm");
            Assert.That(Vector3d.Distance(coarse, fine), Is.LessThan(0.01 * WallScenes.LumenRadius));
        }

        [Test]
        public void Tip_FloatsOffTheWallByTheContactDistance()
        {
            Vector3d coarse = Tip(60, 0.01, Gap);
            Vector3d fine = Tip(60, 0.01, 0.5 * Gap);
            TestContext.WriteLine(Vector3d.Distance(coarse, fine) + " mm");
            Assert.That(Vector3d.Distance(coarse, fine), Is.LessThan(3.0 * Gap));
        }

        [Test]
        public void Tip_DoesNotDependOnTheMesh()
        {
            // Chords along the bend take up to 33 mm (1 - cos(pi/48)) = 0.07 mm off the outer wall of the coarse one;
            // those of a tube of as many straight pieces take off as much, to 0.007 mm.
            Vector3d coarse = FromTube(16, 24);
            Vector3d fine = FromTube(64, 96);
            TestContext.WriteLine(coarse.Length + " and " + fine.Length + " mm");
            Assert.That(Vector3d.Distance(coarse, fine), Is.LessThan(Gap));
            Assert.That(fine.Length, Is.LessThan(0.2 * Gap));
        }

        [TestCase(0.1, 1e-5)]
        [TestCase(0.01, 1e-4)]
        [TestCase(0.001, 1e-3)]
        [TestCase(0.001, 1e-4)]
        public void Turn_IsAsExactAsAsked_HoweverSoftTheWireIsInTorsion(double ofBending, double tolerance)
        {
            if (ofBending != 0.01)
            {
                Rods.OnlyInFull("softer and stiffer wires than this one");
            }
            // A couple S L turns the tip by S L^2/GJ; S is 25 tolerance times 3/2 GJ/L^2.
            Simulation exact = Turned(ofBending, 1e-10);
            Simulation run = Turned(ofBending, tolerance);
            double most = 0.0;
            while (run.Outcome == Outcome.Running)
            {
                exact.Step();
                run.Step();
                for (int j = 0; j < 60; j++)
                {
                    Quaterniond between = exact.State.Orientations[j].Conjugate * run.State.Orientations[j];
                    most = Math.Max(most, RotationVector.Log(between).Length);
                }
            }
            Assert.That(run.Outcome, Is.EqualTo(Outcome.Finished), run.Reason);
            Assert.That(most, Is.LessThan(37.5 * tolerance));
        }

        [TestCase(0.1, 1e-3, 1e-4)]
        [TestCase(0.3, 1e-4, 1e-5, 1e-6)]
        public void Shape_IsAsExactAsAsked_WithFriction(double coefficient, params double[] tolerances)
        {
            if (coefficient < 0.3)
            {
                Rods.OnlyInFull("three times the coefficient of friction");
            }
            // Normal forces of friction are those of a first solution, which may be looser.
            Simulation exact = Rubbed(coefficient, 1e-10);
            Simulation[] runs = Array.ConvertAll(tolerances, tolerance => Rubbed(coefficient, tolerance));
            while (exact.Outcome == Outcome.Running)
            {
                exact.Step();
                for (int k = 0; k < runs.Length; k++)
                {
                    runs[k].Step();
                    Assert.That(Wires.Distance(runs[k].State, exact.State),
                        Is.LessThan(25.0 / 3.0 * tolerances[k] * 300.0), "" + tolerances[k]);
                }
            }
            Assert.That(Array.ConvertAll(runs, run => run.Outcome), Is.All.EqualTo(Outcome.Finished));
        }

        private static Simulation Rubbed(double coefficient, double tolerance)
        {
            SimulationParameters parameters = WallScenes.Arch(60, 0.01, 100.0, 120.0);
            foreach (ContactShape wall in parameters.Scene.Walls)
            {
                wall.FrictionCoefficient = coefficient;
            }
            parameters.Material.RestCurvature = new Vector3d(3.0, 2.0, 0.0);
            parameters.Material.MassDamping = 20.0;    // 1/s
            parameters.Drive.TwistPerStep = 3.0 / parameters.Method.MaxSimulationSteps;
            parameters.Method.SolverTolerance = tolerance;
            return Simulation.Create(parameters);
        }

        // Half of the wire has a torsional stiffness of its own; pushed into the arch and turned by 4 rad.
        private static Simulation Turned(double ofBending, double tolerance)
        {
            SimulationParameters parameters = WallScenes.Arch(60, 0.01, 100.0, 120.0);
            MaterialParameters material = parameters.Material;
            double bending = material.YoungsModulus * Math.PI * Math.Pow(material.WireRadius, 4) / 4.0;
            material.RestCurvature = new Vector3d(5.0, 0.0, 0.0);
            material.Sections = new[]
            {
                new WireSection
                {
                    From = 150.0,
                    To = 300.0,
                    BendingStiffness1 = bending,
                    BendingStiffness2 = bending,
                    TorsionalStiffness = ofBending * bending,
                },
            };
            material.MassDamping = 20.0;    // 1/s
            parameters.Drive.TwistPerStep = 4.0 / parameters.Method.MaxSimulationSteps;
            parameters.Method.SolverTolerance = tolerance;
            return Simulation.Create(parameters);
        }

        // Where the tip ends in a mesh, from where it ends in a tube of as many pieces.
        private static Vector3d FromTube(int around, int pieces)
        {
            return Tip(60, 0.01, Gap, WallScenes.ArchMesh(around, pieces))
                - Tip(60, 0.01, Gap, WallScenes.ArchTube(pieces));
        }

        private static Vector3d Tip(int n, double timeStep, double gap, ContactShape? vessel = null)
        {
            SimulationParameters parameters = WallScenes.Arch(n, timeStep, 50.0, Insertion);
            parameters.Scene.Walls = vessel == null ? parameters.Scene.Walls : new[] { vessel };
            parameters.Contact.ContactDistance = 1e-3 * gap;
            Simulation run = Wires.Finish(parameters);
            return run.State.Positions[n];
        }
    }
}
