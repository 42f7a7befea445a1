using System;
using System.Collections.Generic;
using System.Linq;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Reads how a vessel gives way as a whole.</summary>
    internal static class BeamReader
    {
        /// <summary>The field of a vessel that says so.</summary>
        public const string Key = "beam";

        private const string Bending = "bendingStiffness";
        private const string Axial = "axialStiffness";
        private const string Modulus = "youngsModulus";
        private const string Thickness = "wallThickness";
        private const string Radius = "lumenRadius";
        private const string Foundation = "foundation";
        private const string Spacing = "spacing";
        private const string Held = "held";
        private const string From = "from";
        private const string To = "to";
        private const string All = "all";
        private const double OfLength = 0.45;   // spacing over (4 EI/k)^(1/4), over which a force displaces the vessel

        /// <summary>The motion of a vessel with what its field says; the same where it says nothing.</summary>
        /// <param name="motion">In time; null: none.</param>
        /// <exception cref="ParameterException">A value that is not allowed.</exception>
        public static WallMotion? Read(JsonFields vessel, RunParameters values, ContactShape wall, WallMotion? motion)
        {
            if (!vessel.Has(Key))
            {
                return motion;
            }
            JsonFields fields = vessel.Object(Key);
            fields.Allow(Bending, Axial, Modulus, Thickness, Radius, Foundation, Spacing, Held, From, To);
            if (wall.Softness?.RelaxationTime > 0.0)
            {
                throw fields.Refused("beside a relaxationTime of its wall: a wall that lags behind stays where it is");
            }
            if (fields.Has(Bending) == fields.Has(Modulus))
            {
                throw fields.Wrong(fields.Has(Bending) ? Modulus : Bending, fields.Has(Bending)
                    ? "no bendingStiffness beside it" : "a number > 0 (N m^2), or youngsModulus, wallThickness and "
                        + "lumenRadius in its place");
            }
            string? idle = Array.Find(new[] { Thickness, Radius }, fields.Has);
            if (fields.Has(Bending) && idle != null)
            {
                throw fields.Wrong(idle, "a youngsModulus beside it, and no bendingStiffness");
            }
            double modulus = fields.Has(Modulus) ? fields.Positive(Modulus, "Pa") : 0.0;
            double inner = fields.Has(Modulus) ? fields.Positive(Radius, "m") : 0.0;
            double outer = fields.Has(Modulus) ? inner + fields.Positive(Thickness, "m") : 0.0;
            double bending = fields.Has(Modulus)
                ? 0.25 * Math.PI * modulus * (Math.Pow(outer, 4.0) - Math.Pow(inner, 4.0))
                : fields.Positive(Bending, "N m^2");
            double axial = fields.Has(Axial) || !fields.Has(Modulus) ? fields.Positive(Axial, "N")
                : Math.PI * modulus * (outer * outer - inner * inner);
            double foundation = fields.Positive(Foundation, "Pa");
            double spacing = fields.Has(Spacing) ? fields.Positive(Spacing, "m")
                : OfLength * Math.Pow(4.0 * bending / foundation, 0.25);
            Vector3d[] centreline = Centreline(fields, values, wall, out string start, out string end);
            double metres = values.Simulation.Scene.MetresPerUnit;
            // The one given may be another run's too.
            motion = motion == null ? new WallMotion(Array.Empty<MotionCycle>(), Array.Empty<Vector3d[]>(), 1.0, 0.0)
                : new WallMotion(motion.Cycles, motion.Branches, motion.Spacing, motion.RampTime);
            try
            {
                motion.Beam = new WallBeam(centreline, bending, axial, foundation, spacing / metres, metres,
                    HeldEnds(fields, start, end));
            }
            catch (ArgumentException error)
            {
                throw fields.Refused(error.Message);
            }
            string? fold = motion.Beam.FindFold(wall);
            return fold == null ? motion : throw fields.Refused(fold);
        }

        private static Vector3d[] Centreline(JsonFields fields, RunParameters values, ContactShape wall,
            out string start, out string end)
        {
            if (wall is TubeShape tube)
            {
                string? other = Array.Find(new[] { From, To }, fields.Has);
                (start, end) = ("start", "end");
                return other == null
                    ? tube.Centreline.ToArray()
                    : throw fields.Wrong(other, "nothing: the beam of a tube goes from its start to its end");
            }
            if (values.Anatomy == null)
            {
                throw fields.Refused("without a centreline: it needs vessel.anatomy, the file that the command anatomy "
                    + "writes beside a mesh");
            }
            VesselEnd[] ends = values.Anatomy.Ends.ToArray();
            VesselEnd? first = fields.Has(From) ? values.Anatomy.Find(fields.Text(From))
                : ends.Length == 2 ? ends[0] : null;
            VesselEnd? last = fields.Has(To) ? values.Anatomy.Find(fields.Text(To)) : ends.Length == 2 ? ends[1] : null;
            if (first == null || last == null || first == last)
            {
                throw fields.Wrong(first == null ? From : To, "the name of an end, another one than the other: "
                    + values.Anatomy.List());
            }
            (start, end) = (first.Name, last.Name);
            return new CentrelinePath(values.Anatomy, first).PointsTo(last.Point);
        }

        private static (bool Start, bool End) HeldEnds(JsonFields fields, string start, string end)
        {
            if (!fields.Has(Held))
            {
                return (true, true);    // what is beyond a free end would swing with it
            }
            IReadOnlyList<string> held = fields.Texts(Held);
            bool holdsAll = held.Contains(All);
            foreach (string name in held)
            {
                if (name != All && name != start && name != end)
                {
                    throw fields.Wrong(Held, "\"all\", or a list of \"" + start + "\" and \"" + end + "\"");
                }
            }
            return (holdsAll || held.Contains(start), holdsAll || held.Contains(end));
        }
    }
}
