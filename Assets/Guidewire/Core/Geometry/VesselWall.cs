using System;

namespace Guidewire.Core
{
    /// <summary>A vessel's wall as a thin ring in the tissue around it: how stiff it is under a line load along the
    /// vessel.</summary>
    public static class VesselWall
    {
        private const double Incompressible = 4.0 / 3.0;    // 1/(1 - nu^2) with nu = 1/2
        private const double OfCavity = 2.0 / 3.0;          // 1/(1 + nu)
        private const int Harmonics = 20000;

        /// <summary>Gives K, the line load over the displacement of the wall under it, Pa.</summary>
        /// <remarks>A ring of radius R and thickness h has D = E h^3/12 * 4/3 per length of vessel. Harmonic n >= 2 of
        /// its displacement w cos(n t) bends it without stretching, D (n^2 - 1)^2/R^4 (Timoshenko and Gere, Theory of
        /// Elastic Stability); n = 0 stretches it, 4/3 E h/R^2; n = 1 moves it. All press the surrounding tissue by
        /// k w, with k = 2/3 E_s/R that of a round cavity. A line load has 1/(2 pi R) in n = 0 and 1/(pi R) in each
        /// other harmonic. In a wide vessel this is Hetenyi's beam on a foundation, K = 2 sqrt(2) D^(1/4) k^(3/4).
        /// </remarks>
        /// <param name="modulus">E of the wall, Pa.</param>
        /// <param name="thickness">h, m.</param>
        /// <param name="radius">R, of the lumen, m.</param>
        /// <param name="surrounding">E_s, Young's modulus of the surrounding tissue, Pa.</param>
        public static double Stiffness(double modulus, double thickness, double radius, double surrounding)
        {
            double foundation = OfCavity * surrounding / radius;
            double bending = Incompressible * modulus * Math.Pow(thickness, 3) / 12.0 / Math.Pow(radius, 4);
            double compliance = 0.5 / (Incompressible * modulus * thickness / (radius * radius) + foundation)
                + 1.0 / foundation;
            for (int n = Harmonics; n >= 2; n--)
            {
                double bent = ((double)n * n - 1.0) * ((double)n * n - 1.0);
                compliance += 1.0 / (bending * bent + foundation);
            }
            return Math.PI * radius / compliance;
        }
    }
}
