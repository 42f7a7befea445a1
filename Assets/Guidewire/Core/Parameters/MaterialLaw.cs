using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>What the core of a wire is made of.</summary>
    public enum CoreMaterial
    {
        /// <summary>Elastic at any strain, or what plateau and yieldStress say.</summary>
        Linear,

        /// <summary>Superelastic nickel-titanium.</summary>
        Nitinol,

        /// <summary>Stainless steel, hard drawn.</summary>
        Steel,

        /// <summary>The same annealed.</summary>
        AnnealedSteel,

        /// <summary>Platinum with 8 % of tungsten.</summary>
        Platinum,

        /// <summary>The shaft of a catheter: elastic at any strain.</summary>
        Polymer,
    }

    /// <summary>The plateau of a superelastic material.</summary>
    public sealed class Plateau
    {
        /// <summary>Stress at which it begins, Pa.</summary>
        public double Upper { get; set; }

        /// <summary>Stress at which it ends when the strain goes back, Pa.</summary>
        public double Lower { get; set; }

        /// <summary>Its length, a strain.</summary>
        public double Strain { get; set; }
    }

    /// <summary>How a material leaves its elastic line: on a plateau from which it comes back, or by yield.</summary>
    /// <remarks>Values at 37 degrees Celsius, typical of wire. Nitinol: plateaus of straight superelastic wire by ASTM
    /// F2516 (Duerig, Pelton and Stoeckel 1999; Pelton, DiCello and Miyazaki 2000). Steel: 304V, spring temper (ASTM
    /// A313) and annealed (ASM Handbook, volume 1). Platinum: Pt-8W, annealed (Vines and Wise 1941). Plateaus rise by
    /// some 6 MPa a degree, which is left out.</remarks>
    public sealed class MaterialLaw
    {
        /// <summary>H over E where it is not given.</summary>
        public const double DefaultHardening = 1e-3;

        /// <summary>Rings of fibres where neither material nor user says how many.</summary>
        public const int DefaultRings = 4;

        private static readonly Dictionary<CoreMaterial, MaterialLaw> Named = new Dictionary<CoreMaterial, MaterialLaw>
        {
            [CoreMaterial.Nitinol] = new MaterialLaw
            {
                YoungsModulus = 60e9, ShearModulus = 23e9, Density = 6450.0, IsSuperelastic = true, Upper = 500e6,
                Lower = 250e6, Strain = 0.05, LargestStrain = 500e6 / 60e9 + 0.05,
            },
            [CoreMaterial.Steel] = new MaterialLaw
            {
                YoungsModulus = 190e9, ShearModulus = 74e9, Density = 7900.0, Upper = 1.5e9, LargestStrain = 0.03,
            },
            [CoreMaterial.AnnealedSteel] = new MaterialLaw
            {
                YoungsModulus = 190e9, ShearModulus = 74e9, Density = 7900.0, Upper = 0.25e9, LargestStrain = 0.4,
                Rings = 7,
            },
            [CoreMaterial.Platinum] = new MaterialLaw
            {
                YoungsModulus = 170e9, ShearModulus = 61e9, Density = 21450.0, Upper = 0.3e9, LargestStrain = 0.2,
                Rings = 7,
            },
            [CoreMaterial.Polymer] = new MaterialLaw
            {
                YoungsModulus = 1e9, ShearModulus = 0.36e9, Density = 1100.0, Upper = double.PositiveInfinity,
            },
        };

        /// <summary>E of the fibres, Pa; 0: that of the wire.</summary>
        public double YoungsModulus { get; set; }

        /// <summary>G of the material, Pa.</summary>
        public double ShearModulus { get; set; }

        /// <summary>The density, kg/m^3.</summary>
        public double Density { get; set; }

        /// <summary>Whether it comes back from its plateau; else it yields.</summary>
        public bool IsSuperelastic { get; set; }

        /// <summary>Upper plateau stress, or yield stress, Pa; infinite of a linear material.</summary>
        public double Upper { get; set; }

        /// <summary>Lower plateau stress, Pa.</summary>
        public double Lower { get; set; }

        /// <summary>Length of the plateau, a strain.</summary>
        public double Strain { get; set; }

        /// <summary>H, Pa; null: <see cref="DefaultHardening"/> times E.</summary>
        public double? Hardening { get; set; }

        /// <summary>Rings of fibres in the section, with 4 (rings - 1) fibres on each.</summary>
        public int Rings { get; set; } = DefaultRings;

        /// <summary>Strain up to which it is the material's law; infinite where nobody said.</summary>
        public double LargestStrain { get; set; } = double.PositiveInfinity;

        /// <summary>Gives what is known of a material; null of none.</summary>
        public static MaterialLaw? Find(CoreMaterial? material) =>
            Named.TryGetValue(material ?? CoreMaterial.Linear, out MaterialLaw? law) ? law : null;

        /// <summary>Gives the law of a place of a wire; null where it is linear.</summary>
        /// <param name="rings">Of fibres; 0: as the material needs.</param>
        internal static MaterialLaw? Of(WireSection wire, int rings)
        {
            MaterialLaw? law = Find(wire.Material);
            if (law == null && wire.Plateau is Plateau plateau)
            {
                law = new MaterialLaw
                {
                    IsSuperelastic = true,
                    Upper = plateau.Upper,
                    Lower = plateau.Lower,
                    Strain = plateau.Strain,
                };
            }
            else if (law == null && wire.YieldStress.HasValue)
            {
                law = new MaterialLaw { Upper = wire.YieldStress.Value };
            }
            if (law == null || double.IsPositiveInfinity(law.Upper))
            {
                return null;
            }
            law = (MaterialLaw)law.MemberwiseClone();
            law.Hardening = wire.Hardening ?? law.Hardening;
            law.Rings = rings > 0 ? rings : law.Rings;
            return law;
        }
    }
}
