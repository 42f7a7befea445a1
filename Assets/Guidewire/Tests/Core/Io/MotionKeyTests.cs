using System;
using System.IO;
using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>The keys of vessels and ends that move, and of vessels that give way, against what they stand
    /// for.</summary>
    public sealed class MotionKeyTests : FolderTests
    {
        private static readonly Vector3d[] Knots = { new Vector3d(0.0, 0.0, -40.0), new Vector3d(0.0, 0.0, 40.0) };

        [Test]
        public void RigidTable_HasItsUnits_AndBeginsOverAQuarterOfAPeriod()
        {
            File.WriteAllText(Path.Combine(Folder, "heart.csv"), "phase,x_mm,y_mm,z_mm,rx_deg,ry_deg,rz_deg\n"
                + "0,0,0,0,0,0,0\n0.25,1,-2,3,2,-4,6\n0.5,0,0,0,0,0,0\n");
            WallMotion motion = Vessel("'motion': {'heartRate': 75, 'rigid': 'heart.csv'}",
                ("metresPerUnit", 0.01)).Motion!;
            var values = new double[motion.Cycles[0].Count];
            motion.Cycles[0].Evaluate(0.25, values);
            double degrees = Math.PI / 180.0;
            Assert.That(values, Is.EqualTo(new[] { 0.1, -0.2, 0.3, 2.0 * degrees, -4.0 * degrees, 6.0 * degrees })
                .Within(1e-12));
            Assert.That((motion.Cycles[0].Period, motion.RampTime), Is.EqualTo((0.8, 0.2)));
        }

        [Test]
        public void VesselThatIsReadAgain_BeatsAtItsOwnPace()
        {
            File.WriteAllText(Path.Combine(Folder, "beat.csv"), "station_mm,phase,x_mm,y_mm,z_mm,dx_mm\n"
                + "0,0,0,0,-40,0\n80,0,0,0,40,0\n0,0.3,0,0,-40,0.1\n80,0.3,0,0,40,0\n"
                + "0,0.6,0,0,-40,0\n80,0.6,0,0,40,0\n");
            string file = Write("'motion': {'period': 1, 'centreline': 'beat.csv'}");
            ParameterSource source = ParameterSource.OfFile(file, new LastMesh());
            WallMotion Read(double period, double phase) => ParameterHandler.Load(source, GivenKeys.Of(
                ("vessel.motion.period", period), ("vessel.motion.phase", phase)), false)
                .Values.Simulation.Scene.Walls[0].Motion!;
            WallMotion first = Read(1.0, 0.0);
            WallMotion second = Read(0.5, 0.25);
            Assert.That(second.Branches[0], Is.SameAs(first.Branches[0]), "it is kept");
            Assert.That((second.Cycles[0].Period, second.Cycles[0].Phase), Is.EqualTo((0.5, 0.25)));
            Assert.That((first.Cycles[0].Period, first.Cycles[0].Phase), Is.EqualTo((1.0, 0.0)));
        }

        [TestCase("start", true, false)]
        [TestCase("end", false, true)]
        public void Pipe_IsTheBeamOfItsSection_HeldAtTheEndThatIsNamed(string held, bool start, bool end)
        {
            WallBeam beam = Vessel("'beam': {'youngsModulus': 1e6, 'wallThickness': 1e-3, 'lumenRadius': 2e-3,"
                + " 'foundation': 1000, 'held': ['" + held + "']}").Motion!.Beam!;
            double bending = 1e6 * Math.PI / 4.0 * (81.0 - 16.0) * 1e-12;
            var expected = new WallBeam(Knots, bending, 1e6 * Math.PI * (9.0 - 4.0) * 1e-6, 1000.0,
                0.45 * Math.Pow(4.0 * bending / 1000.0, 0.25) / 1e-3, 1e-3, (start, end));
            Assert.That(beam.Count, Is.EqualTo(expected.Count));
            for (int row = 0; row < 3 * beam.Count; row++)
            {
                for (int column = 0; column <= row; column++)
                {
                    Assert.That(beam.Stiffness(row, column), Is.EqualTo(expected.Stiffness(row, column))
                        .Within(1e-9 * expected.Stiffness(row, row)), row + ", " + column);
                }
            }
        }

        [Test]
        public void EndMotion_IsInMetresAndRadians()
        {
            File.WriteAllText(Path.Combine(Folder, "end.csv"), "time_ms,x_mm,y_mm,z_mm,rx_deg,ry_deg,rz_deg\n"
                + "0,0,0,0,0,0,0\n500,1,2,3,0,0,90\n");
            EndMotion motion = Load(Write(""), ("proximalEnd", "clamped"), ("drive", "hold"),
                ("proximalMotionFile", Path.Combine(Folder, "end.csv"))).Simulation.Scene.ProximalMotion!;
            Assert.That(Vector3d.Distance(motion.DisplacementAt(0.5), new Vector3d(1e-3, 2e-3, 3e-3)),
                Is.LessThan(1e-12));
            Assert.That(Vector3d.Distance(Quaterniond.Rotate(motion.RotationAt(0.5), Vector3d.UnitX), Vector3d.UnitY),
                Is.LessThan(1e-12));
        }

        private ContactShape Vessel(string keys, params (string Key, JToken Value)[] given) =>
            Load(Write(keys), given).Simulation.Scene.Walls[0];

        private static RunParameters Load(string file, params (string Key, JToken Value)[] given) =>
            ParameterHandler.Load(file, GivenKeys.Of(given)).Values;

        private string Write(string vessel)
        {
            string file = Path.Combine(Folder, "scene.json");
            File.WriteAllText(file, ("{'solver': 'direct', 'guidewireLength': 30, 'guidewireOffset': -15, 'vessel':"
                + " {'shape': 'tube', 'knots': [[0, 0, -40], [0, 0, 40]], 'radius': 2"
                + (vessel.Length > 0 ? ", " : "") + vessel + "}}").Replace('\'', '"'));
            return file;
        }
    }
}
