using System;
using System.Collections.Generic;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>The parameter keys that an instrument sets.</summary>
    /// <remarks>The tip stands at the end of the wire, whatever its length: a shorter wire has a shorter shaft. Each
    /// piece of a taper is a section of one element, whose EI has the compliance of the taper over it: for EI linear
    /// from a to b its mean is 1/EI = ln(b/a)/(b - a). A core of one material has the diameter c (EI/EI_0)^(1/4)
    /// where the shaft has c and EI_0. Bends are rest curvatures about d1. The
    /// attenuation of platinum is that of NIST's tables (Hubbell and Seltzer, 2004).</remarks>
    internal static class InstrumentKeys
    {
        private const double ShaftElement = 5e-3;   // m, about the length of elements of the shaft and of tapers
        private const double SoftElement = 2.5e-3;  // m, of uniform distal sections
        private const double LargestTurn = 0.35;    // rad, at most, of an arc per element
        private const double Rounding = 1e-9;       // m: shorter pieces are rounding errors
        private const double Platinum = 1e-3 * 0.4339 * 21450.0;    // attenuation, 1/mm: m^2/kg at 60 keV, kg/m^3
        private const double SameNumber = 1e-6;     // relative difference below which EI is uniform

        /// <summary>All keys, with values in the parameter file's units.</summary>
        /// <param name="instrument">The instrument.</param>
        /// <param name="length">Length of the wire in units, or null for the instrument's.</param>
        /// <param name="metresPerUnit">Length of a unit, m.</param>
        /// <param name="radius">Of the wire, m, or null for the instrument's; no core is thicker.</param>
        public static JObject Of(Instrument instrument, double? length, double metresPerUnit, double? radius = null)
        {
            double thickest = 2.0 * Math.Min(radius ?? instrument.Radius, instrument.Radius);
            double whole = length * metresPerUnit ?? instrument.Length;
            List<Piece> pieces = Pieces(instrument, whole);
            double shaft = pieces.Count > 0 ? pieces[0].From : whole;
            var keys = new JObject
            {
                ["guidewireLength"] = whole / metresPerUnit,
                ["numberRodElements"] = Count(shaft, ShaftElement),
                ["wireRadius"] = instrument.Radius,
                ["innerRadius"] = instrument.InnerRadius,
                ["coreDiameter"] = Core(instrument.CoreDiameter, thickest),
                ["material"] = instrument.Material,
                ["shearFactor"] = instrument.InnerRadius > 0.0 ? 0.5 : 0.9,
                ["bendingStiffness"] = instrument.BendingStiffness,
                ["torsionalStiffness"] = instrument.TorsionalRatio * instrument.BendingStiffness,
                ["axialStiffness"] = JValue.CreateNull(),   // that of the modulus which EI sets
                ["density"] = instrument.Density,
                ["restCurvature"] = new JArray(0.0, 0.0, 0.0),
            };
            var sections = new JArray();
            foreach (Marker marker in instrument.Markers)
            {
                AddMarker(instrument, marker, metresPerUnit, whole, sections);
            }
            foreach (Piece piece in pieces)
            {
                JObject section = Section(instrument, piece, metresPerUnit, whole);
                if (CoreOf(instrument, piece, whole) is double core)
                {
                    section["coreDiameter"] = Core(core, thickest);
                }
                if (instrument.Material != "linear" && (piece.IsUniform || piece.Curvature != 0.0))
                {
                    section["material"] = "linear";    // of coils and bent tips nobody knows what core they have
                }
                sections.Add(section);
            }
            keys["wireSections"] = sections;
            return keys;
        }

        // Of the platinum, spread over the wall that is there.
        private static void AddMarker(Instrument instrument, in Marker marker, double metresPerUnit, double whole,
            JArray sections)
        {
            double to = whole - marker.FromTip;
            if (to <= Rounding)
            {
                return;
            }
            double radius = instrument.Radius;
            double inside = radius - marker.Thickness;
            double part = (radius * radius - inside * inside)
                / (radius * radius - instrument.InnerRadius * instrument.InnerRadius);
            sections.Add(new JObject
            {
                ["from"] = Math.Max(0.0, to - marker.Length) / metresPerUnit,
                ["to"] = to / metresPerUnit,
                ["attenuation"] = Platinum * part,
            });
        }

        private static JToken Core(double? diameter, double thickest) =>
            diameter is double core ? Math.Min(core, thickest) : JValue.CreateNull();

        // Of the section that a piece is in, or of the shaft's core, going on with EI.
        private static double? CoreOf(Instrument instrument, in Piece piece, double whole)
        {
            double start = whole - instrument.DistalLength;
            double middle = 0.5 * (piece.From + piece.To);
            (double? core, double stiffness) = (instrument.CoreDiameter, instrument.BendingStiffness);
            foreach (DistalSection section in instrument.Sections)
            {
                if (section.CoreDiameter.HasValue && middle > start && middle < start + section.Length)
                {
                    (core, stiffness) = (section.CoreDiameter, section.BendingStiffness);
                }
                start += section.Length;
            }
            return core * Math.Pow(piece.BendingStiffness / stiffness, 0.25);
        }

        private static double AxialStiffness(Instrument instrument, double bendingStiffness)
        {
            return 4.0 * bendingStiffness
                / (instrument.Radius * instrument.Radius + instrument.InnerRadius * instrument.InnerRadius);
        }

        private static JObject Section(Instrument instrument, in Piece piece, double metresPerUnit, double whole)
        {
            double bending = piece.BendingStiffness;
            double torsional = instrument.TorsionalRatio * bending;
            double shear = instrument.InnerRadius > 0.0 ? 0.5 : 0.9;
            return new JObject
            {
                ["from"] = piece.From / metresPerUnit,
                ["to"] = piece.To >= whole - Rounding ? whole / metresPerUnit : piece.To / metresPerUnit,
                ["numberRodElements"] = piece.Elements,
                ["bendingStiffness1"] = bending,
                ["bendingStiffness2"] = bending,
                ["torsionalStiffness"] = torsional,
                ["axialStiffness"] = AxialStiffness(instrument, bending),
                ["shearStiffness"] = 0.5 * shear * AxialStiffness(instrument, torsional),
                ["restCurvature"] = new JArray(piece.Curvature == 0.0 ? 0.0 : -piece.Curvature, 0.0, 0.0),
            };
        }

        private static int Count(double length, double element) =>
            Math.Max(1, (int)Math.Ceiling(length / element - Rounding));

        // From the first distal section or bend to the tip, cut where the wire begins.
        private static List<Piece> Pieces(Instrument instrument, double whole)
        {
            var curves = new List<(double From, double To, double Curvature)>();
            double end = whole;
            for (int k = instrument.Bends.Count - 1; k >= 0; k--)
            {
                TipBend bend = instrument.Bends[k];
                double to = end - bend.Straight;
                end = to - bend.ArcLength;
                curves.Insert(0, (end, to, Math.Sign(bend.Angle) / bend.Radius));
            }
            var stations = new List<double> { Math.Min(end, whole - instrument.DistalLength), whole };
            foreach ((double from, double to, double _) in curves)
            {
                stations.Add(from);
                stations.Add(to);
            }
            double section = whole - instrument.DistalLength;
            foreach (DistalSection distal in instrument.Sections)
            {
                stations.Add(section);
                section += distal.Length;
            }
            stations.Sort();
            var pieces = new List<Piece>();
            for (int k = 0; k + 1 < stations.Count; k++)
            {
                double from = Math.Max(0.0, stations[k]);
                double to = stations[k + 1];
                if (to - from > Rounding)
                {
                    double middle = 0.5 * (from + to);
                    double curvature = curves.Find(curve => middle > curve.From && middle < curve.To).Curvature;
                    Cut(instrument, whole, from, to, curvature, pieces);
                }
            }
            return pieces;
        }

        // A part between two stations as one piece where EI is uniform, else as one piece an element.
        private static void Cut(Instrument instrument, double whole, double from, double to, double curvature,
            List<Piece> pieces)
        {
            double a = Stiffness(instrument, whole, from, to, atEnd: false);
            double b = Stiffness(instrument, whole, from, to, atEnd: true);
            bool isUniform = Math.Abs(b - a) <= SameNumber * a;
            double element = Math.Min(isUniform ? SoftElement : ShaftElement,
                curvature == 0.0 ? double.PositiveInfinity : LargestTurn / Math.Abs(curvature));
            int count = Count(to - from, element);
            if (isUniform)
            {
                pieces.Add(new Piece
                {
                    From = from, To = to, BendingStiffness = a, Curvature = curvature, Elements = count,
                    IsUniform = true,
                });
                return;
            }
            for (int i = 0; i < count; i++)
            {
                double left = a + (b - a) * i / count;
                double right = a + (b - a) * (i + 1) / count;
                pieces.Add(new Piece
                {
                    From = from + (to - from) * i / count,
                    To = from + (to - from) * (i + 1) / count,
                    BendingStiffness = (right - left) / Math.Log(right / left),
                    Curvature = curvature,
                    Elements = 1,
                });
            }
        }

        // EI at one end of a part that lies within one section.
        private static double Stiffness(Instrument instrument, double whole, double from, double to, bool atEnd)
        {
            double start = whole - instrument.DistalLength;
            double before = instrument.BendingStiffness;
            double middle = 0.5 * (from + to);
            foreach (DistalSection section in instrument.Sections)
            {
                if (middle > start && middle < start + section.Length)
                {
                    double fraction = ((atEnd ? to : from) - start) / section.Length;
                    return section.IsTapered ? before + (section.BendingStiffness - before) * fraction
                        : section.BendingStiffness;
                }
                start += section.Length;
                before = section.BendingStiffness;
            }
            return instrument.BendingStiffness;
        }

        // A part of the wire from the clamp, m, with its EI, N m^2, and its curvature at rest, 1/m.
        private struct Piece
        {
            public double From;
            public double To;
            public double BendingStiffness;
            public double Curvature;
            public int Elements;
            public bool IsUniform;
        }
    }
}
