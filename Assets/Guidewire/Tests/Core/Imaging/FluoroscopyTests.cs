using System;
using System.Collections.Generic;
using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Whole pictures: vessels, the C-arm's angles, noise, blur, and what they cost.</summary>
    public sealed class FluoroscopyTests
    {
        private const int Pixels = 64;
        private static readonly ImagedInstrument[] Nothing = Array.Empty<ImagedInstrument>();

        [Test]
        public void Tube_FilledWithContrast_IsDarkerByItsChord([Values(0.0, 40.0, -50.0)] double cranial)
        {
            const double Mu = 0.03;
            byte[] grey = Draw(Tube(), new FluoroscopySettings { Vessel = VesselContrast.Contrast, Contrast = Mu },
                cranial: cranial);
            // The inscribed polygon of 32 sides is narrower by 0.5 %.
            double chord = 16.0 / Math.Cos(cranial * Math.PI / 180.0);
            Assert.That(grey[Middle], Is.EqualTo(255.0 * 0.75 * Math.Exp(-Mu * chord)).Within(1.5));
            Assert.That(grey[Pixels / 2 * Pixels + 3], Is.EqualTo(191), "beside the vessel");
        }

        [Test]
        public void Ray_ThatEntersThroughAnOpenRim_CountsFromTheRim()
        {
            byte[] grey = Draw(Tube(), new FluoroscopySettings { Vessel = VesselContrast.Contrast, Contrast = 0.01 },
                cranial: 90.0);
            Assert.That(grey[Middle], Is.EqualTo(255.0 * 0.75 * Math.Exp(-0.01 * 40.0)).Within(1.0));
        }

        [Test]
        public void LumenThickness_AddsUpToTheVolume([Values(0.0, 20.0, 77.0)] double leftOblique,
            [Values(0.0, 35.0, 80.0)] double cranial)
        {
            var thickness = new float[Pixels * Pixels];
            new LumenThickness(Tube()[0], Pixels).Add(new CArm(leftOblique, cranial, Vector3d.Zero, Pixels, Pixels),
                thickness);
            double polygon = 0.5 * 32.0 * Math.Sin(2.0 * Math.PI / 32.0) * 8.0 * 8.0;
            Assert.That(thickness.Sum(t => (double)t), Is.EqualTo(40.0 * polygon).Within(0.01 * 40.0 * polygon));
        }

        [Test]
        public void LumenFullOfAgent_IsAsDarkAsContrast_AndEachCellHasItsOwn([Values(0.0, 35.0, 70.0)] double cranial)
        {
            const double Mu = 0.03;
            var middles = Enumerable.Range(0, 20).Select(k => new Vector3d(0.0, 0.0, -19.0 + 2.0 * k)).ToArray();
            double[] radii = Enumerable.Repeat(8.0, 20).ToArray();
            var fluoroscopy = new Fluoroscopy(Tube());
            fluoroscopy.SetCells(middles, radii);
            var arm = new CArm(0.0, cranial, Vector3d.Zero, Pixels, Pixels);
            byte[] Taken(VesselContrast vessel, double[] parts)
            {
                var grey = new byte[Pixels * Pixels];
                fluoroscopy.Draw(Nothing, arm, new FluoroscopySettings { Vessel = vessel, Contrast = Mu }, grey, parts);
                return grey;
            }
            byte[] all = Taken(VesselContrast.Contrast, Array.Empty<double>());
            Assert.That(Taken(VesselContrast.Injected, Enumerable.Repeat(1.0, 20).ToArray()).Zip(all,
                (one, other) => Math.Abs(one - other)).Max(), Is.LessThanOrEqualTo(1));
            Assert.That(Taken(VesselContrast.Injected, new double[20]), Is.All.EqualTo((byte)191));
            double[] half = Enumerable.Range(0, 20).Select(k => k < 10 ? 1.0 : 0.0).ToArray();
            byte[] split = Taken(VesselContrast.Injected, half);
            int column = Pixels / 2;
            double seen = Math.Cos(cranial * Math.PI / 180.0);
            Assert.That(split[(Pixels / 2 - (int)(seen * 17.0)) * Pixels + column], Is.GreaterThan(
                split[(Pixels / 2 + (int)(seen * 17.0)) * Pixels + column]), "towards the head there is none");
            Assert.That(Taken(VesselContrast.Contrast, Array.Empty<double>()), Is.EqualTo(all));
        }

        [Test]
        public void RoadMap_IsBrighter_AndWithoutContrastNoVesselIsSeen()
        {
            Assert.That(Draw(Tube(), new FluoroscopySettings { Vessel = VesselContrast.RoadMap })[Middle],
                Is.InRange(205, 250));
            Assert.That(Draw(Tube(), new FluoroscopySettings { Vessel = VesselContrast.None }),
                Is.All.EqualTo((byte)191));
        }

        [TestCase(0.0, 0.0, 1, 0)]
        [TestCase(90.0, 0.0, 0, 0)]
        [TestCase(-90.0, 0.0, 0, 0)]
        [TestCase(0.0, 90.0, 1, 0)]
        public void LeftOfThePatient_IsRightInThePicture_UntilTheArmIsThere(double leftOblique, double cranial,
            int right, int down)
        {
            var arm = new CArm(leftOblique, cranial, Vector3d.Zero, 10.0, 10);
            Vector3d left = arm.ToDetector(new Vector3d(0.0, 3.0, 0.0)) - arm.ToDetector(Vector3d.Zero);
            Assert.That(left.X, Is.EqualTo(3.0 * right).Within(1e-9));
            Assert.That(left.Y, Is.EqualTo(3.0 * down).Within(1e-9));
        }

        [Test]
        public void LeftAnteriorOblique_SeesTheLeftSideNearer_AndCranialTheHead()
        {
            var arm = new CArm(30.0, 0.0, Vector3d.Zero, 10.0, 10);
            Assert.That(arm.ToDetector(Vector3d.UnitY).Z, Is.EqualTo(0.5).Within(1e-9), "the detector is on the left");
            Assert.That(arm.ToDetector(Vector3d.UnitX).X, Is.EqualTo(5.0 - 0.5).Within(1e-9), "the chest goes right");
            arm = new CArm(0.0, 30.0, Vector3d.Zero, 10.0, 10);
            Assert.That(arm.ToDetector(Vector3d.UnitZ).Z, Is.EqualTo(0.5).Within(1e-9));
            Assert.That(arm.ToDetector(Vector3d.UnitX).Y, Is.EqualTo(5.0 + 0.5).Within(1e-9), "the chest goes down");
        }

        [Test]
        public void Noise_HasItsDeviation_AndComesAgainWithItsSeed()
        {
            var settings = new FluoroscopySettings { Vessel = VesselContrast.None, Noise = 0.05, Seed = 7 };
            byte[] grey = Draw(Tube(), settings);
            double mean = grey.Average(g => (double)g);
            double deviation = Math.Sqrt(grey.Average(g => (g - mean) * (g - mean)));
            Assert.That(mean, Is.EqualTo(191.25).Within(0.6));                        // 3 standard errors: 0.45
            Assert.That(deviation, Is.EqualTo(0.05 * 191.25).Within(0.04 * 9.56));    // 3 standard errors: 3.3 %
            Assert.That(Draw(Tube(), settings), Is.EqualTo(grey));
            settings.Seed = 8;
            byte[] other = Draw(Tube(), settings);
            double together = Enumerable.Range(0, grey.Length).Average(i => (grey[i] - mean) * (other[i] - mean));
            Assert.That(Math.Abs(together / (deviation * deviation)), Is.LessThan(0.05), "they are not correlated");
        }

        [Test]
        public void Blur_HasTheSpotsDeviation_AndKeepsWhatIsTakenAway()
        {
            var picture = new float[Pixels * Pixels];
            picture[20 * Pixels + 30] = 1.0f;
            new SpotBlur(Pixels).Apply(picture, 1.7);
            double sum = 0.0;
            double square = 0.0;
            for (int i = 0; i < picture.Length; i++)
            {
                sum += picture[i];
                square += picture[i] * Math.Pow(i % Pixels - 30, 2);
            }
            Assert.That(sum, Is.EqualTo(1.0).Within(1e-5));
            Assert.That(Math.Sqrt(square), Is.EqualTo(1.7).Within(0.04), "cut at three deviations");
        }

        [Test]
        public void Instruments_OfDifferentKinds_MultiplyWhatPasses()
        {
            ImagedInstrument one = Wire(new Vector3d(0.0, -20.0, 0.0), new Vector3d(0.0, 20.0, 0.0));
            ImagedInstrument two = Wire(new Vector3d(9.0, 0.0, -20.0), new Vector3d(9.0, 0.0, 20.0));
            var settings = new FluoroscopySettings { Vessel = VesselContrast.None, Background = 1.0 };
            byte first = Draw(Tube(), settings, one)[Middle];
            byte both = Draw(Tube(), settings, one, two)[Middle];
            Assert.That(both, Is.EqualTo(255.0 * Math.Pow(first / 255.0, 2.0)).Within(1.0));
        }

        [Test]
        public void Picture_AllocatesNothing_WhenItsSizeHasBeenSeen()
        {
            var fluoroscopy = new Fluoroscopy(Tube());
            var settings = new FluoroscopySettings { Noise = 0.02, Blur = 0.8 };
            ImagedInstrument[] wires = { Wire(new Vector3d(0.0, -20.0, 3.0), new Vector3d(0.0, 20.0, 0.0)) };
            var arm = new CArm(10.0, 0.0, Vector3d.Zero, Pixels, Pixels);
            var grey = new byte[Pixels * Pixels];
            fluoroscopy.Draw(wires, arm, settings, grey);
            Assert.That(Garbage.LeftBy(() => fluoroscopy.Draw(wires, arm, settings, grey)), Is.Zero);
        }

        [Test]
        public void Values_OutOfRange_AreRefused()
        {
            foreach (FluoroscopySettings wrong in new[]
            {
                new FluoroscopySettings { Contrast = -1.0 }, new FluoroscopySettings { Background = 0.0 },
                new FluoroscopySettings { Background = double.NaN }, new FluoroscopySettings { Noise = 2.0 },
                new FluoroscopySettings { Blur = double.PositiveInfinity },
            })
            {
                Assert.Throws<ArgumentException>(() => Draw(Tube(), wrong));
            }
            Assert.Throws<ArgumentException>(() => _ = new CArm(0.0, 0.0, Vector3d.Zero, 0.0, 64));
            Assert.Throws<ArgumentException>(() => _ = new CArm(0.0, 91.0, Vector3d.Zero, 1.0, 64));
            Assert.Throws<ArgumentException>(() => _ = new CArm(0.0, 0.0, Vector3d.Zero, 1.0, 0));
        }

        private static int Middle => Pixels / 2 * Pixels + Pixels / 2;

        private static ImagedInstrument Wire(Vector3d from, Vector3d to) =>
            new ImagedInstrument(new[] { from, to }, new[] { 3.0 }, new[] { 0.0 }, new[] { 0.1 });

        // Along z from -20 to 20, of radius 8.
        private static List<WallSurface> Tube()
        {
            var tube = new TubeShape(new[] { new Vector3d(0.0, 0.0, -20.0), new Vector3d(0.0, 0.0, 20.0) },
                new[] { 8.0, 8.0 }, false, false);
            return new List<WallSurface> { WallSurface.Create(tube, Vector3d.Zero, 1000.0) };
        }

        private static byte[] Draw(List<WallSurface> vessels, FluoroscopySettings settings,
            params ImagedInstrument[] wires) => Draw(vessels, settings, 0.0, wires);

        private static byte[] Draw(List<WallSurface> vessels, FluoroscopySettings settings, double cranial,
            params ImagedInstrument[] wires)
        {
            var grey = new byte[Pixels * Pixels];
            new Fluoroscopy(vessels).Draw(wires.Length == 0 ? Nothing : wires,
                new CArm(0.0, cranial, Vector3d.Zero, Pixels, Pixels), settings, grey);
            return grey;
        }
    }
}
