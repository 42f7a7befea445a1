using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>Three letters for where x, y and z point in the patient; an empty text for axes that are
    /// unknown.</summary>
    internal sealed class AxesEntry : ValueEntry<string>
    {
        public AxesEntry(string key, string help)
            : base(key, "", help)
        {
        }

        public override string Allowed => "\"\" or three letters that say where x, y and z point, one of L and R, one"
            + " of A and P, one of S and I, right-handed, such as \"LPS\"";

        internal override bool TryRead(RunParameters target, JToken value)
        {
            string letters = value.Type == JTokenType.String ? (string)value! : "?";
            if (letters.Length > 0 && PatientAxes.Named(letters) == null)
            {
                return false;
            }
            Set(target, letters);
            return true;
        }

        internal override JToken FromText(string text) => new JValue(text);
    }
}
