using System;

namespace Guidewire.Core
{
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
}
