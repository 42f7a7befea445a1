using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>What a fluoroscopic picture shows, and its defects.</summary>
    public sealed class FluoroscopySettings
    {
        /// <summary>How the vessel is shown.</summary>
        public VesselContrast Vessel { get; set; } = VesselContrast.RoadMap;

        /// <summary>Linear attenuation coefficient of the contrast agent in the vessel, 1/unit, beyond that of the
        /// tissue that it is in.</summary>
        public double Contrast { get; set; } = 0.1;

        /// <summary>Brightness where there are neither instruments nor vessels, in (0, 1]; 1 is grey level
        /// 255.</summary>
        public double Background { get; set; } = 0.75;

        /// <summary>Standard deviation of the background's noise over its brightness; 0: none. Quanta are counted, so
        /// the variance is in proportion to the brightness.</summary>
        public double Noise { get; set; }

        /// <summary>Which of all noises it is; the same seed gives the same one.</summary>
        public uint Seed { get; set; }

        /// <summary>Standard deviation of the blur by the spot of the tube, units; 0: none.</summary>
        public double Blur { get; set; }

        /// <summary>What is wrong with these values in one phrase, or null.</summary>
        public string? FindProblem()
        {
            return !(Contrast >= 0.0) || double.IsInfinity(Contrast) ? "contrast needs to be a number >= 0"
                : !(Background > 0.0 && Background <= 1.0) ? "background needs to be a number > 0 and <= 1"
                : !(Noise >= 0.0 && Noise <= 1.0) ? "noise needs to be a number from 0 to 1"
                : !(Blur >= 0.0) || double.IsInfinity(Blur) ? "blur needs to be a number >= 0" : null;
        }

        /// <summary>Brightness of the vessel's layer where rays pass so much lumen, over the background's.</summary>
        /// <param name="thickness">Units.</param>
        internal double VesselFactor(double thickness)
        {
            switch (Vessel)
            {
                case VesselContrast.Contrast:
                    return Math.Exp(-Contrast * thickness);
                case VesselContrast.RoadMap:
                    return 1.0 + RoadMapContrast * (1.0 - Math.Exp(-Contrast * thickness));
                default:
                    return 1.0;
            }
        }

        // How much brighter than the background a road map is where it was opaque: at most 0.75 (1 + 0.3) = 0.975.
        private const double RoadMapContrast = 0.3;
    }

    /// <summary>How a fluoroscopic picture shows the vessel.</summary>
    public enum VesselContrast
    {
        /// <summary>Not at all: without contrast agent blood attenuates as the tissue around it.</summary>
        None,

        /// <summary>Filled with contrast agent: darker than the background.</summary>
        Contrast,

        /// <summary>A road map, which is a picture with contrast that is subtracted from those that follow: brighter
        /// than the background, without hiding instruments.</summary>
        RoadMap,

        /// <summary>Where contrast agent is injected: darker by its part of the blood there.</summary>
        Injected,
    }

    /// <summary>The view of a fluoroscopic picture: the angles of a C-arm about the patient, a centre, parallel rays,
    /// and the field of view.</summary>
    /// <remarks>The detector is in front of the chest at 0 and 0; a left anterior oblique angle (LAO) moves it to the
    /// patient's left, a cranial one towards the head; RAO and caudal are negative. The picture is seen from the
    /// detector, with the head above: at 0 and 0 the patient's left side is at its right. With parallel rays nothing is
    /// magnified.</remarks>
    public sealed class CArm : IEquatable<CArm>
    {
        private readonly Vector3d _right;
        private readonly Vector3d _up;
        private readonly Vector3d _towards;

        /// <summary>Makes a position of the C-arm.</summary>
        /// <param name="leftOblique">LAO, degrees; RAO is negative.</param>
        /// <param name="cranial">Degrees; caudal is negative.</param>
        /// <param name="centre">What is in the middle of the picture, units.</param>
        /// <param name="fieldOfView">Side of the square, units, above 0.</param>
        /// <param name="pixels">Pixels of a side, from 1 to <see cref="MaxPixels"/>.</param>
        /// <param name="axes">How the patient lies; null: unknown.</param>
        /// <exception cref="ArgumentException">A value out of its range.</exception>
        public CArm(double leftOblique, double cranial, in Vector3d centre, double fieldOfView, int pixels,
            PatientAxes? axes = null)
        {
            if (!(fieldOfView > 0.0) || double.IsInfinity(fieldOfView) || pixels < 1 || pixels > MaxPixels
                || !(Math.Abs(leftOblique) <= 360.0) || !(Math.Abs(cranial) <= 90.0) || !centre.IsFinite)
            {
                throw new ArgumentException("a C-arm needs angles within 360 and 90 degrees, a finite centre, a field"
                    + " of view above 0 and 1 to " + MaxPixels + " pixels");
            }
            LeftOblique = leftOblique;
            Cranial = cranial;
            Centre = centre;
            FieldOfView = fieldOfView;
            Pixels = pixels;
            Axes = axes ?? PatientAxes.Unknown;
            double a = leftOblique * Math.PI / 180.0;
            double b = cranial * Math.PI / 180.0;
            Vector3d level = Math.Cos(a) * Axes.Chest + Math.Sin(a) * Axes.Left;
            _towards = Math.Cos(b) * level + Math.Sin(b) * Axes.Head;
            _up = Math.Cos(b) * Axes.Head - Math.Sin(b) * level;
            _right = Math.Cos(a) * Axes.Left - Math.Sin(a) * Axes.Chest;
        }

        /// <summary>Most pixels of a picture's side.</summary>
        public static int MaxPixels => 2048;

        /// <summary>LAO, degrees; RAO is negative.</summary>
        public double LeftOblique { get; }

        /// <summary>Degrees; caudal is negative.</summary>
        public double Cranial { get; }

        /// <summary>What is in the middle of the picture, units.</summary>
        public Vector3d Centre { get; }

        /// <summary>Side of the picture, units.</summary>
        public double FieldOfView { get; }

        /// <summary>Pixels of a side.</summary>
        public int Pixels { get; }

        /// <summary>How the patient lies.</summary>
        public PatientAxes Axes { get; }

        /// <summary>The number of pixels per unit.</summary>
        public double Scale => Pixels / FieldOfView;

        /// <summary>A point in pixels: x to the right and y down from the upper left corner of the picture, and z along
        /// the rays, towards the detector.</summary>
        public Vector3d ToDetector(in Vector3d point)
        {
            Vector3d from = Scale * (point - Centre);
            return new Vector3d(0.5 * Pixels + Vector3d.Dot(from, _right), 0.5 * Pixels - Vector3d.Dot(from, _up),
                Vector3d.Dot(from, _towards));
        }

        /// <summary>The point that is seen at x, y and z in pixels, as of <see cref="ToDetector"/>.</summary>
        public Vector3d FromDetector(double x, double y, double z)
        {
            double half = 0.5 * Pixels;
            return Centre + (1.0 / Scale) * ((x - half) * _right + (half - y) * _up + z * _towards);
        }

        /// <inheritdoc/>
        public bool Equals(CArm? other)
        {
            return other != null && LeftOblique == other.LeftOblique && Cranial == other.Cranial
                && Centre == other.Centre && FieldOfView == other.FieldOfView && Pixels == other.Pixels
                && Axes.Equals(other.Axes);
        }

        /// <inheritdoc/>
        public override bool Equals(object? obj) => Equals(obj as CArm);

        /// <inheritdoc/>
        public override int GetHashCode() => HashCode.Combine(LeftOblique, Cranial, Centre, FieldOfView, Pixels, Axes);
    }

    /// <summary>How a patient lies in a scene: unit vectors to the left side, the chest and the head.</summary>
    public sealed class PatientAxes : IEquatable<PatientAxes>
    {
        private PatientAxes(in Vector3d left, in Vector3d chest, in Vector3d head)
        {
            Left = left;
            Chest = chest;
            Head = head;
        }

        /// <summary>What a C-arm turns about where nobody says how the patient lies: wires enter scenes along
        /// +z.</summary>
        public static PatientAxes Unknown { get; } =
            new PatientAxes(Vector3d.UnitY, Vector3d.UnitX, Vector3d.UnitZ);

        /// <summary>Towards the patient's left side.</summary>
        public Vector3d Left { get; }

        /// <summary>Points towards the chest.</summary>
        public Vector3d Chest { get; }

        /// <summary>Points towards the head.</summary>
        public Vector3d Head { get; }

        /// <summary>The axes that three letters name: where x, y and z point, with R and L, A and P, S and I; null
        /// where they are none, or left-handed. A signed number behind them turns the patient's chest by so many
        /// degrees towards the left, about the axis to the head.</summary>
        public static PatientAxes? Named(string text)
        {
            string letters = text.Length < 3 ? "" : text.Substring(0, 3);
            double turn = 0.0;
            if (letters.Length == 0 || (text.Length > 3 && (!(text[3] == '+' || text[3] == '-') || !double.TryParse(
                text.Substring(3), NumberStyles.AllowLeadingSign | NumberStyles.AllowDecimalPoint,
                CultureInfo.InvariantCulture, out turn) || !(Math.Abs(turn) <= 360.0))))
            {
                return null;
            }
            Vector3d left = Towards(letters, 'L', 'R');
            Vector3d chest = Towards(letters, 'A', 'P');
            Vector3d head = Towards(letters, 'S', 'I');
            bool isWhole = left.LengthSquared == 1.0 && chest.LengthSquared == 1.0 && head.LengthSquared == 1.0;
            if (!isWhole || Vector3d.Dot(Vector3d.Cross(chest, left), head) < 0.0)
            {
                return null;
            }
            double cos = turn == 0.0 ? 1.0 : Math.Cos(turn * Math.PI / 180.0);
            double sin = turn == 0.0 ? 0.0 : Math.Sin(turn * Math.PI / 180.0);
            return new PatientAxes(cos * left - sin * chest, cos * chest + sin * left, head);
        }

        /// <summary>Gives the axes after a vessel that has them was placed in the scene.</summary>
        public PatientAxes Turned(Placement placement)
        {
            Vector3d origin = placement.Apply(Vector3d.Zero);
            return new PatientAxes(Vector3d.Normalize(placement.Apply(Left) - origin),
                Vector3d.Normalize(placement.Apply(Chest) - origin),
                Vector3d.Normalize(placement.Apply(Head) - origin));
        }

        /// <inheritdoc/>
        public bool Equals(PatientAxes? other) =>
            other != null && Left == other.Left && Chest == other.Chest && Head == other.Head;

        /// <inheritdoc/>
        public override bool Equals(object? obj) => Equals(obj as PatientAxes);

        /// <inheritdoc/>
        public override int GetHashCode() => HashCode.Combine(Left, Chest, Head);

        private static Vector3d Towards(string letters, char plus, char minus)
        {
            var found = Vector3d.Zero;
            Vector3d[] axes = { Vector3d.UnitX, Vector3d.UnitY, Vector3d.UnitZ };
            for (int k = 0; k < 3; k++)
            {
                found += (letters[k] == plus ? 1.0 : letters[k] == minus ? -1.0 : 0.0) * axes[k];
            }
            return found;
        }
    }
}
