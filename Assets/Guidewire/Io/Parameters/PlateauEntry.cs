using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>A plateau {"upper": 500e6, "lower": 250e6, "strain": 0.05}, or null for none.</summary>
    internal sealed class PlateauEntry : ValueEntry<Plateau?>
    {
        /// <summary>What is allowed of one.</summary>
        public const string Form = "{\"upper\", \"lower\" (Pa, 0 < lower <= upper), \"strain\" (0 < strain < 1)}";

        public PlateauEntry(string key, string help)
            : base(key, "", help)
        {
        }

        public override string Allowed => "null or " + Form;

        internal override JToken Write(RunParameters source) =>
            Get(source) is Plateau plateau ? Write(plateau) : JValue.CreateNull();

        /// <summary>Gives one as it is read.</summary>
        public static JObject Write(Plateau plateau) => new JObject
        {
            ["upper"] = plateau.Upper,
            ["lower"] = plateau.Lower,
            ["strain"] = plateau.Strain,
        };

        /// <summary>Reads one.</summary>
        public static bool TryPlateau(JToken value, out Plateau plateau)
        {
            plateau = new Plateau();
            if (!(value is JObject item) || item.Count != 3)
            {
                return false;
            }
            foreach (JProperty property in item.Properties())
            {
                if (!NumberEntry.TryNumber(property.Value, out double number) || !(number > 0.0))
                {
                    return false;
                }
                plateau.Upper = property.Name == "upper" ? number : plateau.Upper;
                plateau.Lower = property.Name == "lower" ? number : plateau.Lower;
                plateau.Strain = property.Name == "strain" ? number : plateau.Strain;
            }
            return plateau.Lower > 0.0 && plateau.Lower <= plateau.Upper && plateau.Strain > 0.0
                && plateau.Strain < 1.0;
        }

        internal override bool TryRead(RunParameters target, JToken value)
        {
            bool isNull = value.Type == JTokenType.Null;
            Plateau plateau = new Plateau();
            if (!isNull && !TryPlateau(value, out plateau))
            {
                return false;
            }
            Set(target, isNull ? null : plateau);
            return true;
        }
    }
}
