using System;
using System.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The shadow of a wire against closed forms: a wire attenuates by mu times the length of the ray in it.
    /// </summary>
    public sealed class InstrumentShadowTests
    {
        private const int Pixels = 96;
        private const double Weak = 1e-4;    // 1/pixel: exp(-mu t) is 1 - mu t to 1e-3 of mu t at most
        private const double OnePercent = 0.01;

        [Test]
        public void WeakWire_CastsItsVolume_AtEveryAngleAndThickness(
            [Values(0.0, 5.0, 20.0, 45.0, 70.0, 85.0, 90.0)] double fromRays,
            [Values(0.0, 30.0, 45.0, 90.0)] double inPicture, [Values(0.1, 0.7, 3.0)] double radius)
        {
            const double Length = 60.0;
            ImagedInstrument wire = Straight(Length, fromRays, inPicture, radius, Weak);
            double capsule = Math.PI * radius * radius * (Length + 4.0 / 3.0 * radius);
            Assert.That(Depths(wire).Sum(depth => (double)depth) / Weak,
                Is.EqualTo(capsule).Within(OnePercent * capsule));
        }

        [Test]
        public void Band_CastsWhatItsWallHoldsMore_WhereverItEnds([Values(20.0, 70.0, 90.0)] double fromRays,
            [Values(0.7, 3.0)] double radius)
        {
            const double Length = 60.0;
            ImagedInstrument wire = Straight(Length, fromRays, 30.0, radius, Weak);
            ImagedInstrument tube = Of(wire.Positions, radius, 0.5 * radius, Weak);
            double without = Depths(tube).Sum(depth => (double)depth);
            tube.Bands = new[] { new OpaqueBand(0, 0.3, 0.55, 3.0 * Weak) };
            double more = 3.0 * Weak * Math.PI * 0.75 * radius * radius * 0.25 * Length;
            Assert.That(Depths(tube).Sum(depth => (double)depth) - without, Is.EqualTo(more).Within(OnePercent * more));
        }

        [Test]
        public void Ray_GoesThroughTheMiddleOfAWire_ByTheClosedForm([Values(30.0, 60.0, 90.0)] double fromRays)
        {
            const double Radius = 8.0;
            float[] depths = Depths(Straight(60.0, fromRays, 0.0, Radius, 0.05));
            double expected = 0.05 * 2.0 * Radius / Math.Sin(fromRays * Math.PI / 180.0);
            Assert.That(depths[(Pixels / 2) * Pixels + Pixels / 2], Is.EqualTo(expected).Within(OnePercent * expected));
        }

        [Test]
        public void Ray_AlongAWire_GoesThroughItsLength()
        {
            float[] depths = Depths(Straight(20.0, 0.0, 0.0, 8.0, 0.05));
            double expected = 0.05 * (20.0 + 4.0 / 3.0 * 8.0);
            Assert.That(depths[(Pixels / 2) * Pixels + Pixels / 2], Is.EqualTo(expected).Within(OnePercent * expected));
        }

        [Test]
        public void OpaqueWireAcross_TakesAwayTheIntegralOfItsProfile([Values(0.2, 0.5, 1.3, 4.0)] double radius,
            [Values(0.5, 2.0, 6.0)] double depth, [Values(0.0, 22.0, 45.0)] double inPicture)
        {
            // Integral over s of 1 - exp(-2 mu sqrt(r^2 - s^2)) by 20,000 midpoints, per length of the wire.
            double mu = 0.5 * depth / radius;
            double profile = 0.0;
            const int Points = 20000;
            for (int k = 0; k < Points; k++)
            {
                double u = (2.0 * k + 1.0) / Points - 1.0;
                profile += 2.0 * radius / Points * (1.0 - Math.Exp(-depth * Math.Sqrt(1.0 - u * u)));
            }
            double taken = Taken(Depths(Straight(40.0, 90.0, inPicture, radius, mu)))
                - Taken(Depths(Straight(20.0, 90.0, inPicture, radius, mu)));
            Assert.That(taken, Is.EqualTo(20.0 * profile).Within(OnePercent * 20.0 * profile));
        }

        [Test]
        public void BentWire_CastsItsVolume([Values(0.3, 1.5)] double radius, [Values(0.0, 40.0)] double tilt)
        {
            const int Elements = 24;
            const double Ring = 20.0;
            var x = new Vector3d[Elements + 1];
            double c = Math.Cos(tilt * Math.PI / 180.0);
            double s = Math.Sin(tilt * Math.PI / 180.0);
            for (int i = 0; i <= Elements; i++)
            {
                double angle = 1.5 * Math.PI * i / Elements;
                // A circle in a plane that is tilted against the picture's.
                x[i] = new Vector3d(s * Ring * Math.Sin(angle), Ring * Math.Cos(angle), c * Ring * Math.Sin(angle));
            }
            double volume = Math.PI * radius * radius * (1.5 * Math.PI * Ring + 4.0 / 3.0 * radius);
            Assert.That(Depths(Of(x, radius, 0.0, Weak)).Sum(depth => (double)depth) / Weak,
                Is.EqualTo(volume).Within(OnePercent * volume));
        }

        [Test]
        public void Catheter_IsItsWall_WithoutItsLumen()
        {
            ImagedInstrument solid = Straight(24.0, 70.0, 20.0, 2.0, Weak);
            ImagedInstrument hollow = Of(solid.Positions, 2.0, 1.5, Weak);
            double wall = Math.PI * (2.0 * 2.0 - 1.5 * 1.5) * (24.0 + 4.0 / 3.0 * 2.0);
            Assert.That(Depths(hollow).Sum(depth => (double)depth) / Weak, Is.EqualTo(wall).Within(OnePercent * wall));
            int middle = (Pixels / 2) * Pixels + Pixels / 2;
            Assert.That(Depths(hollow)[middle] / Depths(solid)[middle], Is.EqualTo(0.25).Within(0.02));
        }

        [Test]
        public void Wire_ThinnerThanAPixel_DoesNotFlickerAsItMoves(
            [Values(0.0, 10.0, 27.0, 45.0, 80.0)] double inPicture, [Values(0.15, 0.46, 1.1)] double radius,
            [Values(0.3, 3.0)] double depth)
        {
            const double OfPicture = 1e-3;    // asked for
            const double OfShadow = 6e-3;     // of what a wire of 30 pixels takes away, its two tips included
            ImagedInstrument wire = Straight(30.0, 90.0, inPicture, radius, 0.5 * depth / radius);
            double before = Taken(Depths(wire));
            for (int k = 1; k <= 10; k++)
            {
                double after = Taken(Depths(Moved(wire, new Vector3d(0.0, 0.06 * k, 0.08 * k))));
                Assert.That(after, Is.EqualTo(before).Within(OfShadow * before), "moved by a tenth of a pixel");
                double rest = Pixels * Pixels;
                Assert.That(rest - after, Is.EqualTo(rest - before).Within(OfPicture * (rest - before)));
                before = after;
            }
        }

        [Test]
        public void Wire_OfManyElements_IsAsTheWireOfOne()
        {
            ImagedInstrument one = Straight(30.0, 60.0, 33.0, 0.9, 0.6);
            var x = new Vector3d[16];
            for (int i = 0; i < x.Length; i++)
            {
                x[i] = Vector3d.Lerp(one.Positions[0], one.Positions[1], i / 15.0);
            }
            float[] first = Depths(one);
            float[] second = Depths(Of(x, 0.9, 0.0, 0.6));
            for (int i = 0; i < first.Length; i++)
            {
                Assert.That(second[i], Is.EqualTo(first[i]).Within(1e-5));
            }
        }

        [Test]
        public void Wire_ThatIsPartlyBesideThePicture_IsSeenAsFarAsItIsInIt()
        {
            ImagedInstrument wire = Straight(500.0, 90.0, 30.0, 0.8, 0.5);
            float[] inside = Depths(Straight(200.0, 90.0, 30.0, 0.8, 0.5));
            Assert.That(Depths(wire), Is.EqualTo(inside).Within(1e-5f));
            Assert.That(Depths(Moved(wire, new Vector3d(0.0, 400.0, 400.0))).Sum(depth => (double)depth), Is.Zero);
        }

        private static ImagedInstrument Straight(double length, double fromRays, double inPicture, double radius,
            double mu)
        {
            double theta = fromRays * Math.PI / 180.0;
            double phi = inPicture * Math.PI / 180.0;
            // At 0 and 0 rays go along x; y is to the right, z upwards. Off the pixels' middles.
            var along = new Vector3d(Math.Cos(theta), Math.Sin(theta) * Math.Cos(phi), Math.Sin(theta) * Math.Sin(phi));
            var middle = new Vector3d(0.0, 0.37, -0.21);
            return Of(new[] { middle - 0.5 * length * along, middle + 0.5 * length * along }, radius, 0.0, mu);
        }

        private static ImagedInstrument Of(Vector3d[] x, double radius, double inner, double mu)
        {
            var radii = new double[x.Length - 1];
            var inners = new double[x.Length - 1];
            var attenuations = new double[x.Length - 1];
            Array.Fill(radii, radius);
            Array.Fill(inners, inner);
            Array.Fill(attenuations, mu);
            return new ImagedInstrument(x, radii, inners, attenuations);
        }

        private static ImagedInstrument Moved(ImagedInstrument wire, Vector3d by)
        {
            return Of(Array.ConvertAll(wire.Positions, x => x + by), wire.Radii[0], wire.InnerRadii[0],
                wire.Attenuations[0]);
        }

        private static float[] Depths(ImagedInstrument wire)
        {
            var depths = new float[Pixels * Pixels];
            var shadow = new InstrumentShadow(depths, Pixels);
            shadow.Add(wire, new CArm(0.0, 0.0, Vector3d.Zero, Pixels, Pixels));
            shadow.AddBands(wire, new CArm(0.0, 0.0, Vector3d.Zero, Pixels, Pixels));
            return depths;
        }

        // What does not reach the detector, in pixels that would be all dark.
        private static double Taken(float[] depths)
        {
            double sum = 0.0;
            foreach (float depth in depths)
            {
                sum += 1.0 - Math.Exp(-depth);
            }
            return sum;
        }
    }
}
