using System;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Reads how a wall gives way.</summary>
    internal static class SoftnessReader
    {
        private const string Stiffness = "wallStiffness";
        private const string Limit = "softLimit";
        private const string TipLength = "tipLength";
        private const string Modulus = "modulus";
        private const string Thickness = "wallThickness";
        private const string Radius = "lumenRadius";
        private const string Surrounding = "surroundingModulus";
        private const double Thin = 0.5;    // thickness over radius

        private static readonly string[] OfWall = { Modulus, Thickness, Radius, Surrounding };

        /// <summary>The fields of a wall that say so.</summary>
        public static string[] Keys { get; } =
            { Stiffness, Limit, TipLength, Modulus, Thickness, Radius, Surrounding };

        /// <summary>What the fields of a wall say; null of a rigid one.</summary>
        /// <exception cref="ParameterException">A value that is not allowed.</exception>
        public static WallSoftness? Read(JsonFields fields)
        {
            bool isStated = fields.Has(Stiffness);
            string? ofWall = Array.Find(OfWall, fields.Has);
            if (isStated && ofWall != null)
            {
                throw fields.Wrong(ofWall, "no wallStiffness beside it");
            }
            if (!isStated && ofWall == null)
            {
                string? other = Array.Find(Keys, fields.Has);
                return other == null ? null : throw fields.Wrong(other, "a wallStiffness or a modulus beside it");
            }
            double limit = fields.Number(Limit, 0.0);
            double stiffness = isStated ? Positive(fields, Stiffness, "Pa") : OfTissue(fields);
            double tip = fields.Has(TipLength) ? Positive(fields, TipLength, "m") : WallSoftness.DefaultTipLength;
            return limit >= 0.0 ? new WallSoftness(fields.Key, stiffness, limit, tip)
                : throw fields.Wrong(Limit, "a number >= 0 (m)");
        }

        private static double OfTissue(JsonFields fields)
        {
            double modulus = Positive(fields, Modulus, "Pa");
            double thickness = Positive(fields, Thickness, "m");
            double radius = Positive(fields, Radius, "m");
            double surrounding = Positive(fields, Surrounding, "Pa");
            return thickness <= Thin * radius ? VesselWall.Stiffness(modulus, thickness, radius, surrounding)
                : throw fields.Wrong(Thickness, "half of the lumenRadius or less: the formula is that of a thin wall");
        }

        private static double Positive(JsonFields fields, string key, string unit)
        {
            double value = fields.Has(key) ? fields.Number(key, null) : 0.0;
            return value > 0.0 ? value : throw fields.Wrong(key, "a number > 0 (" + unit + ")");
        }
    }
}
