using System;
using System.Collections.Generic;
using System.Linq;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Reads how a wall gives way.</summary>
    internal static class SoftnessReader
    {
        private const string Stiffness = "wallStiffness";
        private const string Limit = "softLimit";
        private const string TipLength = "tipLength";
        private const string Relaxation = "relaxationTime";
        private const string Modulus = "modulus";
        private const string Thickness = "wallThickness";
        private const string Radius = "lumenRadius";
        private const string Surrounding = "surroundingModulus";

        /// <summary>The field of a vessel that has regions.</summary>
        public const string Regions = "regions";

        private const double Thin = 0.5;    // thickness over radius

        private static readonly string[] OfWall = { Modulus, Thickness, Radius, Surrounding };

        /// <summary>The fields of a wall that say so.</summary>
        public static string[] Keys { get; } =
            { Stiffness, Limit, TipLength, Relaxation, Modulus, Thickness, Radius, Surrounding };

        /// <summary>What the fields of a wall say; null of a rigid one.</summary>
        /// <exception cref="ParameterException">A value that is not allowed.</exception>
        public static WallSoftness? Read(JsonFields fields)
        {
            if (!(StiffnessOf(fields) is double stiffness))
            {
                string? other = Array.Find(Keys, fields.Has);
                return other == null ? null : throw fields.Wrong(other, "a wallStiffness or a modulus beside it");
            }
            double limit = fields.Number(Limit, 0.0);
            double tip = fields.Has(TipLength) ? fields.Positive(TipLength, "m") : WallSoftness.DefaultTipLength;
            double relaxation = fields.Number(Relaxation, 0.0);
            if (!(relaxation >= 0.0))
            {
                throw fields.Wrong(Relaxation, "a number >= 0 (s)");
            }
            return limit >= 0.0 ? new WallSoftness(fields.Key, stiffness, limit, tip, relaxation)
                : throw fields.Wrong(Limit, "a number >= 0 (m)");
        }

        /// <summary>Reads the regions of a vessel with a centreline: each has the branches, or the branch of the end,
        /// that it names.</summary>
        /// <exception cref="ParameterException">There is no such branch, or the vessel has no anatomy or is rigid.
        /// </exception>
        public static void ReadRegions(JsonFields fields, WallSoftness? soft, Anatomy? anatomy)
        {
            List<JsonFields> regions = fields.Items(Regions);
            if (regions.Count == 0)
            {
                return;
            }
            if (soft == null || anatomy == null)
            {
                throw fields.Wrong(Regions, soft == null ? "a wallStiffness or a modulus of the rest of the vessel"
                    : "an anatomy beside it, which has the branches");
            }
            var stiffness = new double[anatomy.Points.Length];
            Array.Fill(stiffness, soft.Stiffness);
            foreach (JsonFields region in regions)
            {
                region.Allow("branch", "end", Stiffness, Modulus, Thickness, Radius, Surrounding);
                double own = StiffnessOf(region)
                    ?? throw region.Wrong(Stiffness, "a number > 0 (Pa), or a modulus in its place");
                int branch = BranchOf(region, anatomy);
                for (int k = 0; k < stiffness.Length; k++)
                {
                    stiffness[k] = anatomy.Branches[k] == branch ? own : stiffness[k];
                }
            }
            soft.Regions = new WallRegions(anatomy.Points, anatomy.Radii, stiffness);
        }

        private static int BranchOf(JsonFields region, Anatomy anatomy)
        {
            string key = region.Has("end") ? "end" : "branch";
            if (key == "end" && region.Has("branch"))
            {
                throw region.Wrong("branch", "no end beside it");
            }
            string name = region.Text(key);
            VesselEnd? end = key == "end" ? anatomy.Find(name) : null;
            int branch = end != null ? anatomy.Branches[end.Point] : key == "end" ? -1
                : anatomy.BranchNames.ToList().FindIndex(
                    own => string.Equals(own, name, StringComparison.OrdinalIgnoreCase));
            return branch >= 0 ? branch : throw region.Wrong(key, key == "end" ? "one of the ends " + anatomy.List()
                : "one of the branches " + string.Join(", ", anatomy.BranchNames.Take(12)));
        }

        // K as it is stated, or by the tissue; null where neither is given.
        private static double? StiffnessOf(JsonFields fields)
        {
            string? ofWall = Array.Find(OfWall, fields.Has);
            if (!fields.Has(Stiffness))
            {
                return ofWall == null ? (double?)null : OfTissue(fields);
            }
            return ofWall == null ? fields.Positive(Stiffness, "Pa")
                : throw fields.Wrong(ofWall, "no wallStiffness beside it");
        }

        private static double OfTissue(JsonFields fields)
        {
            double modulus = fields.Positive(Modulus, "Pa");
            double thickness = fields.Positive(Thickness, "m");
            double radius = fields.Positive(Radius, "m");
            double surrounding = fields.Positive(Surrounding, "Pa");
            return thickness <= Thin * radius ? VesselWall.Stiffness(modulus, thickness, radius, surrounding)
                : throw fields.Wrong(Thickness, "half of the lumenRadius or less: the formula is that of a thin wall");
        }
    }
}
