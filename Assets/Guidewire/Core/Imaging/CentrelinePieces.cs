namespace Guidewire.Core
{
    /// <summary>Cuts the centreline of an instrument into straight pieces: a cubic through all points whose slope at
    /// point i is (x_{i+1} - x_{i-1})/2, as other pictures draw it; an element that is straight is one piece.</summary>
    internal static class CentrelinePieces
    {
        /// <summary>Pieces of an element that is not straight.</summary>
        public const int PerBentElement = 4;

        // An element whose chord is this much longer over its neighbours than its distance from their line, squared
        // sine of the angle: 0.02 rad. Over 5 mm the curve is then within 0.013 mm of the chord.
        private const double StraightSquared = 4e-4;

        /// <summary>Whether element j is drawn as several pieces.</summary>
        public static bool IsBent(Vector3d[] x, int j) => IsBentAt(x, j) || IsBentAt(x, j + 1);

        /// <summary>Gives the point of element j at t in [0, 1].</summary>
        public static Vector3d At(Vector3d[] x, int j, double t)
        {
            int last = x.Length - 1;
            Vector3d chord = x[j + 1] - x[j];
            Vector3d before = j > 0 ? 0.5 * (x[j + 1] - x[j - 1]) : chord;
            Vector3d after = j + 2 <= last ? 0.5 * (x[j + 2] - x[j]) : chord;
            double s = 1.0 - t;
            return s * s * (1.0 + 2.0 * t) * x[j] + t * t * (3.0 - 2.0 * t) * x[j + 1] + t * s * s * before
                - t * t * s * after;
        }

        private static bool IsBentAt(Vector3d[] x, int i)
        {
            if (i == 0 || i == x.Length - 1)
            {
                return false;
            }
            Vector3d a = x[i] - x[i - 1];
            Vector3d b = x[i + 1] - x[i];
            return Vector3d.Cross(a, b).LengthSquared > StraightSquared * a.LengthSquared * b.LengthSquared
                || Vector3d.Dot(a, b) < 0.0;
        }
    }
}
