using System;
using System.Globalization;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Stiffness and mass of the whole wire, given instead of moduli and density: E = EI/I, G = GJ/(2 I), rho
    /// = m/A, with A = pi (r^2 - a^2) and I = A (r^2 + a^2)/4; EA is by itself, as in a coiled wire, and then EI is
    /// what E makes of it.</summary>
    internal static class WireStiffness
    {
        // Beyond it the two words disagree: who writes both rounds one of them.
        private const double Rounding = 1e-3;

        // Below it they are the same number, and the modulus stays bit for bit: a run's own parameters repeat it.
        private const double SameNumber = 1e-12;

        private static readonly (string Stiffness, string Modulus)[] Pairs =
        {
            ("bendingStiffness", "youngsModulus"),
            ("torsionalStiffness", "shearModulus"),
            ("massPerLength", "density"),
        };

        /// <summary>What the command line says in one word replaces what the file says in the other.</summary>
        public static void Replace(GivenParameters given, string key, string? file)
        {
            foreach ((string stiffness, string modulus) in Pairs)
            {
                string? other = key == modulus ? stiffness : key == stiffness ? modulus : null;
                if (other != null && given.TryGet(other, out var said) && said.Source == file)
                {
                    given.Remove(other);
                }
            }
        }

        /// <summary>Sets the moduli and the density that the values ask for.</summary>
        /// <exception cref="ParameterException">Of one source, both words stand there and disagree.</exception>
        public static void Apply(RunParameters values, GivenParameters given)
        {
            MaterialParameters material = values.Simulation.Material;
            if (MaterialLaw.Find(material.Material) is MaterialLaw law)
            {
                bool IsFree(int pair) => !given.Has(Pairs[pair].Stiffness) && !given.Has(Pairs[pair].Modulus);
                material.YoungsModulus = IsFree(0) ? law.YoungsModulus : material.YoungsModulus;
                material.ShearModulus = IsFree(1) ? law.ShearModulus : material.ShearModulus;
                material.Density = IsFree(2) ? law.Density : material.Density;
            }
            double area = material.Area;
            double second = material.SecondMomentOfArea;
            if (!(area > 0.0))
            {
                return;    // a hollow as wide as the wire: refused where radii are checked
            }
            material.YoungsModulus = Said(
                given, 0, values.BendingStiffness, second, material.YoungsModulus, "N m^2");
            material.ShearModulus = Said(
                given, 1, values.TorsionalStiffness, 2.0 * second, material.ShearModulus, "N m^2");
            material.Density = Said(given, 2, values.MassPerLength, area, material.Density, "kg/m");
            if (values.BendingStiffness == null && material.AxialStiffness != null)
            {
                values.BendingStiffness = material.YoungsModulus * second;
            }
        }

        // The modulus: stiffness over shape where a stiffness is given.
        private static double Said(GivenParameters given, int pair, double? stiffness, double shape, double modulus,
            string unit)
        {
            if (stiffness == null)
            {
                return modulus;
            }
            (string key, string other) = Pairs[pair];
            double difference = Math.Abs(stiffness.Value - modulus * shape);
            if (difference > Rounding * stiffness.Value && given.TryGet(key, out (JToken Value, string Source) said)
                && given.TryGet(other, out (JToken Value, string Source) against) && said.Source == against.Source)
            {
                throw new ParameterException(string.Format(CultureInfo.InvariantCulture,
                    "{0}: {1} = {2} and {3} = {4} disagree: with the wire's radius it makes {5:G6} {6}: give one of"
                    + " the two", said.Source, key, stiffness, other, modulus, modulus * shape, unit));
            }
            return difference <= SameNumber * stiffness.Value ? modulus : stiffness.Value / shape;
        }
    }

    /// <summary>Lengths that are not given, in scenes whose unit is not a millimetre: the defaults are lengths in mm,
    /// and not as many units.</summary>
    internal static class LengthDefaults
    {
        private const double Millimetre = 1e-3;    // m

        /// <summary>Converts those of a wire with a material.</summary>
        public static void Convert(SimulationParameters parameters, GivenParameters given)
        {
            SceneParameters scene = parameters.Scene;
            if (scene.MetresPerUnit == Millimetre || !MethodTable.Of(parameters.Method.Solver).TakesMaterial)
            {
                return;
            }
            double units = Millimetre / scene.MetresPerUnit;
            scene.GuidewireLength *= given.Has("guidewireLength") ? 1.0 : units;
            scene.GuidewireOffset *= given.Has("guidewireOffset") ? 1.0 : units;
            scene.StartRadius *= given.Has("startRadius") ? 1.0 : units;
            parameters.Method.DeltaThreshold *= given.Has("deltaThreshold") ? 1.0 : units;
        }
    }
}
