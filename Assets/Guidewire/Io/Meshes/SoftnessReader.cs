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

        /// <summary>The fields of a wall that say so.</summary>
        public static string[] Keys { get; } = { Stiffness, Limit, TipLength };

        /// <summary>What the fields of a wall say; null of a rigid one.</summary>
        /// <exception cref="ParameterException">A value that is not allowed.</exception>
        public static WallSoftness? Read(JsonFields fields)
        {
            if (!fields.Has(Stiffness))
            {
                string? other = Array.Find(Keys, fields.Has);
                return other == null ? null : throw fields.Wrong(other, "a wallStiffness beside it");
            }
            double limit = fields.Number(Limit, 0.0);
            double stiffness = Positive(fields, Stiffness, null);
            double tip = Positive(fields, TipLength, WallSoftness.DefaultTipLength);
            return limit >= 0.0 ? new WallSoftness(fields.Key, stiffness, limit, tip)
                : throw fields.Wrong(Limit, "a number >= 0 (m)");
        }

        private static double Positive(JsonFields fields, string key, double? missing)
        {
            double value = fields.Number(key, missing);
            return value > 0.0 ? value : throw fields.Wrong(key, key == Stiffness ? "a number > 0 (Pa)"
                : "a number > 0 (m)");
        }
    }
}
