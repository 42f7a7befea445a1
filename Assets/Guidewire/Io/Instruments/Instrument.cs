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
}
