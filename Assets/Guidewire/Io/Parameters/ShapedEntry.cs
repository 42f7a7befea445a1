using System;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>A bend over a mandrel {"from": 290, "to": 295, "radius": 2}, or with the angle that remains, or null
    /// for none.</summary>
    internal sealed class ShapedEntry : ValueEntry<Shaping?>
    {
        public ShapedEntry(string key, string help)
            : base(key, "", help)
        {
        }

        public override string Allowed => "null or {\"from\", \"to\" (units, from < to), and \"radius\" of the mandrel"
            + " (units, > 0) or \"angle\" that remains (rad, not 0)}";

        internal override JToken Write(RunParameters source)
        {
            if (!(Get(source) is Shaping shaped))
            {
                return JValue.CreateNull();
            }
            var item = new JObject { ["from"] = shaped.From, ["to"] = shaped.To };
            item[shaped.Radius.HasValue ? "radius" : "angle"] = shaped.Radius ?? shaped.Angle;
            return item;
        }

        internal override bool TryRead(RunParameters target, JToken value)
        {
            if (value.Type == JTokenType.Null)
            {
                Set(target, null);
                return true;
            }
            double Number(string name) => value[name] is JToken token && NumberEntry.TryNumber(token, out double number)
                ? number : double.NaN;
            if (!(value is JObject item) || item.Count != 3)
            {
                return false;
            }
            var shaped = new Shaping { From = Number("from"), To = Number("to") };
            double radius = Number("radius");
            double angle = Number("angle");
            shaped.Radius = radius > 0.0 ? radius : (double?)null;
            shaped.Angle = Math.Abs(angle) > 0.0 ? angle : (double?)null;
            Set(target, shaped);
            return shaped.From >= 0.0 && shaped.To > shaped.From && shaped.Radius.HasValue != shaped.Angle.HasValue;
        }
    }
}
