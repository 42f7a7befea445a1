using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>What a C-arm shows of a patient, however the patient lies in the scene.</summary>
    internal sealed class PatientAxesTests
    {
        // A point 10 to the left, 20 in front of and 30 above the middle, in a picture of 100 units and pixels.
        [TestCase("ALS", 20.0, 10.0, 30.0)]
        [TestCase("LPS", 10.0, -20.0, 30.0)]
        [TestCase("RAS", -10.0, 20.0, 30.0)]
        [TestCase("SLP", 30.0, 10.0, -20.0)]
        [TestCase("ALS+90", -10.0, 20.0, 30.0)]
        [TestCase("LPS-36.86989764584402", -4.0, -22.0, 30.0)] // cosine 4/5
        public void PointOfThePatient_IsSeenAtTheSamePlace(string letters, double x, double y, double z)
        {
            PatientAxes axes = PatientAxes.Named(letters)!;
            var point = new Vector3d(x, y, z);
            Vector3d front = new CArm(0.0, 0.0, Vector3d.Zero, 100.0, 100, axes).ToDetector(point);
            Assert.That(Vector3d.Distance(front, new Vector3d(60.0, 20.0, 20.0)), Is.LessThan(1e-9),
                "the left at right");
            Vector3d lateral = new CArm(90.0, 0.0, Vector3d.Zero, 100.0, 100, axes).ToDetector(point);
            Assert.That(Vector3d.Distance(lateral, new Vector3d(30.0, 20.0, 10.0)), Is.LessThan(1e-9),
                "the chest at left");
            Vector3d below = new CArm(0.0, -90.0, Vector3d.Zero, 100.0, 100, axes).ToDetector(point);
            Assert.That(Vector3d.Distance(below, new Vector3d(60.0, 30.0, -30.0)), Is.LessThan(1e-9),
                "the chest above");
        }

        [TestCase("LAS")]
        [TestCase("RPS")]
        [TestCase("LLS")]
        [TestCase("LP")]
        [TestCase("lps")]
        [TestCase("LPS30")]
        [TestCase("LPS+")]
        [TestCase("LPS+361")]
        [TestCase("LPS+Infinity")]
        public void LeftHandedAxesAndOtherWords_AreNone(string letters) =>
            Assert.That(PatientAxes.Named(letters), Is.Null);

        [Test]
        public void AxesOfAVessel_TurnWithIt()
        {
            var quarter = new Placement(new Vector3d(5.0, 6.0, 7.0),
                Placement.FromEulerDegrees(new Vector3d(0.0, 0.0, 90.0)), new Vector3d(2.0, 2.0, 2.0));
            PatientAxes turned = PatientAxes.Named("LPS")!.Turned(quarter);
            Assert.That(Vector3d.Distance(turned.Left, Vector3d.UnitY), Is.LessThan(1e-12));
            Assert.That(Vector3d.Distance(turned.Chest, Vector3d.UnitX), Is.LessThan(1e-12));
            Assert.That(turned.Head, Is.EqualTo(Vector3d.UnitZ));
        }
    }
}
