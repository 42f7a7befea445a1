using System;
using System.Collections.Generic;

namespace Guidewire.Io
{
    /// <summary>A wire or a catheter in SI, as its file describes it.</summary>
    /// <remarks>The shaft is uniform up to the distal sections, which end at the tip. Of the bending stiffness EI of a
    /// section the value at its distal end is given: a uniform section has it everywhere, a tapered one reaches it
    /// linearly from the value before. GJ is a constant ratio of EI. The axial stiffness and the shear stiffness are
    /// those of a homogeneous section with that EI: EA = 4 EI/(r^2 + a^2), a the inner radius.</remarks>
    internal sealed class Instrument
    {
        /// <summary>The outer radius, m.</summary>
        public double Radius { get; set; }

        /// <summary>Inner radius, m; 0 for a wire.</summary>
        public double InnerRadius { get; set; }

        /// <summary>Diameter of the solid core of the shaft, m; null: the wire is solid, or the wall of a
        /// catheter.</summary>
        public double? CoreDiameter { get; set; }

        /// <summary>What the core is made of, as key material has it; "linear": not known, or linear.</summary>
        public string Material { get; set; } = "linear";

        /// <summary>The length, m.</summary>
        public double Length { get; set; }

        /// <summary>EI of the shaft, N m^2.</summary>
        public double BendingStiffness { get; set; }

        /// <summary>GJ/EI, the same everywhere.</summary>
        public double TorsionalRatio { get; set; }

        /// <summary>The density, kg/m^3.</summary>
        public double Density { get; set; }

        /// <summary>Coulomb's coefficient against a vessel's wall.</summary>
        public double Friction { get; set; }

        /// <summary>Sections behind the shaft in the order in which they stand, the last ends at the tip.</summary>
        public List<DistalSection> Sections { get; } = new List<DistalSection>();

        /// <summary>Bends of the tip at rest, the last one nearest to the tip, all in one plane.</summary>
        public List<TipBend> Bends { get; } = new List<TipBend>();

        /// <summary>What in its wall X-rays see better.</summary>
        public List<Marker> Markers { get; } = new List<Marker>();

        /// <summary>Length of all distal sections, m.</summary>
        public double DistalLength
        {
            get
            {
                double length = 0.0;
                foreach (DistalSection section in Sections)
                {
                    length += section.Length;
                }
                return length;
            }
        }
    }

    /// <summary>A section between shaft and tip.</summary>
    internal struct DistalSection
    {
        /// <summary>The section's length, m.</summary>
        public double Length;

        /// <summary>EI at its distal end, N m^2.</summary>
        public double BendingStiffness;

        /// <summary>Diameter of the thickest solid part there, m, such as the wire of its coil; null: the shaft's core
        /// goes on.</summary>
        public double? CoreDiameter;

        /// <summary>Whether EI changes linearly from that of the section before; else it is uniform.</summary>
        public bool IsTapered;
    }

    /// <summary>A band or coil of platinum in the wall of an instrument.</summary>
    internal struct Marker
    {
        /// <summary>Length between its distal end and the tip, m.</summary>
        public double FromTip;

        /// <summary>Its length, m.</summary>
        public double Length;

        /// <summary>Thickness of solid platinum at the surface that takes as much from X-rays, m.</summary>
        public double Thickness;
    }

    /// <summary>An arc of the wire at rest and the straight piece behind it.</summary>
    internal struct TipBend
    {
        /// <summary>rad; negative: to the other side.</summary>
        public double Angle;

        /// <summary>The radius of the arc, m.</summary>
        public double Radius;

        /// <summary>Straight length between this arc and the next or the tip, m.</summary>
        public double Straight;

        /// <summary>The length of the arc along the wire, m.</summary>
        public readonly double ArcLength => Math.Abs(Angle) * Radius;
    }

    /// <summary>The physical quantity of a number in a file.</summary>
    internal enum Dimension
    {
        /// <summary>The quantity is a length, m.</summary>
        Length,

        /// <summary>The quantity is an angle, rad.</summary>
        Angle,

        /// <summary>The quantity is a time, s.</summary>
        Time,

        /// <summary>The quantity is a modulus, Pa.</summary>
        Modulus,

        /// <summary>A bending or torsional stiffness, N m^2.</summary>
        Stiffness,

        /// <summary>The quantity is a density, kg/m^3.</summary>
        Density,

        /// <summary>The quantity is a force, N.</summary>
        Force,

        /// <summary>The quantity is a plain number.</summary>
        Number,
    }

    /// <summary>The units of instruments' files and of tables, and their size in SI: a French is a third of a
    /// millimetre, an inch 25.4 mm, a gram as a force its standard weight.</summary>
    internal static class UnitTable
    {
        private static readonly (string Unit, Dimension Of, double Size)[] Units =
        {
            ("m", Dimension.Length, 1.0),
            ("cm", Dimension.Length, 1e-2),
            ("mm", Dimension.Length, 1e-3),
            ("um", Dimension.Length, 1e-6),
            ("in", Dimension.Length, 0.0254),
            ("F", Dimension.Length, 1e-3 / 3.0),
            ("deg", Dimension.Angle, Math.PI / 180.0),
            ("rad", Dimension.Angle, 1.0),
            ("s", Dimension.Time, 1.0),
            ("ms", Dimension.Time, 1e-3),
            ("Pa", Dimension.Modulus, 1.0),
            ("MPa", Dimension.Modulus, 1e6),
            ("GPa", Dimension.Modulus, 1e9),
            ("N m2", Dimension.Stiffness, 1.0),
            ("N mm2", Dimension.Stiffness, 1e-6),
            ("kg/m3", Dimension.Density, 1.0),
            ("g/cm3", Dimension.Density, 1e3),
            ("N", Dimension.Force, 1.0),
            ("mN", Dimension.Force, 1e-3),
            ("g", Dimension.Force, 9.80665e-3),
            ("", Dimension.Number, 1.0),
        };

        /// <summary>Gives the value of a text such as "0.035 in", in SI.</summary>
        /// <param name="text">A number, a space and a unit; a number alone where it has no dimension.</param>
        /// <param name="dimension">What it must measure.</param>
        /// <param name="value">The value in SI; finite.</param>
        /// <returns>What is wrong and what is needed, or null.</returns>
        public static string? FindError(string text, Dimension dimension, out double value)
        {
            string trimmed = text.Trim();
            int space = trimmed.IndexOf(' ');
            string number = space < 0 ? trimmed : trimmed.Substring(0, space);
            string unit = space < 0 ? "" : trimmed.Substring(space + 1).Trim();
            if (!NumberText.TryRead(number, out value))
            {
                return "a number, a space and a unit, such as \"" + Words(dimension).Example + "\"";
            }
            foreach ((string known, Dimension of, double size) in Units)
            {
                if (known == unit)
                {
                    value *= size;
                    return of == dimension ? null
                        : Words(dimension).Noun + ", and " + (unit.Length == 0 ? "this has no unit"
                            : unit + " is the unit of " + Words(of).Noun) + ": allowed are " + Of(dimension);
                }
            }
            return Words(dimension).Noun + " in a known unit, not '" + unit + "': allowed are " + Of(dimension);
        }

        /// <summary>Finds the size of a unit in SI.</summary>
        /// <param name="dimension">What it must measure.</param>
        /// <returns>False where it is no unit of that.</returns>
        public static bool TrySize(string unit, Dimension dimension, out double size)
        {
            (string Unit, Dimension Of, double Size) known = Array.Find(Units, one => one.Unit == unit);
            size = known.Size;
            return known.Unit != null && known.Of == dimension;
        }

        /// <summary>Gives the SI unit of a dimension.</summary>
        public static string SIUnitOf(Dimension dimension) =>
            Array.Find(Units, one => one.Of == dimension && one.Size == 1.0).Unit;

        /// <summary>The units of a dimension, with commas between.</summary>
        public static string Of(Dimension dimension)
        {
            var words = new List<string>();
            foreach ((string unit, Dimension of, double _) in Units)
            {
                if (of == dimension)
                {
                    words.Add(unit.Length == 0 ? "a number alone" : unit);
                }
            }
            return string.Join(", ", words);
        }

        private static (string Noun, string Example) Words(Dimension dimension)
        {
            switch (dimension)
            {
                case Dimension.Length:
                    return ("a length", "0.035 in");
                case Dimension.Angle:
                    return ("an angle", "45 deg");
                case Dimension.Time:
                    return ("a time", "1.5 s");
                case Dimension.Modulus:
                    return ("a modulus", "60.3 GPa");
                case Dimension.Stiffness:
                    return ("a stiffness EI or GJ", "1.2e-3 N m2");
                case Dimension.Density:
                    return ("a density", "6450 kg/m3");
                case Dimension.Force:
                    return ("a force", "2 g");
                default:
                    return ("a number without a unit", "0.05");
            }
        }
    }
}
