using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>How a patient lies in a scene: unit vectors to the left side, the chest and the head.</summary>
    public sealed class PatientAxes : IEquatable<PatientAxes>
    {
        private PatientAxes(in Vector3d left, in Vector3d chest, in Vector3d head)
        {
            Left = left;
            Chest = chest;
            Head = head;
        }

        /// <summary>What a C-arm turns about where nobody says how the patient lies: wires enter scenes along
        /// +z.</summary>
        public static PatientAxes Unknown { get; } =
            new PatientAxes(Vector3d.UnitY, Vector3d.UnitX, Vector3d.UnitZ);

        /// <summary>Towards the patient's left side.</summary>
        public Vector3d Left { get; }

        /// <summary>Points towards the chest.</summary>
        public Vector3d Chest { get; }

        /// <summary>Points towards the head.</summary>
        public Vector3d Head { get; }

        /// <summary>The axes that three letters name: where x, y and z point, with R and L, A and P, S and I; null
        /// where they are none, or left-handed. A signed number behind them turns the patient's chest by so many
        /// degrees towards the left, about the axis to the head.</summary>
        public static PatientAxes? Named(string text)
        {
            string letters = text.Length < 3 ? "" : text.Substring(0, 3);
            double turn = 0.0;
            if (letters.Length == 0 || (text.Length > 3 && (!(text[3] == '+' || text[3] == '-') || !double.TryParse(
                text.Substring(3), NumberStyles.AllowLeadingSign | NumberStyles.AllowDecimalPoint,
                CultureInfo.InvariantCulture, out turn) || !(Math.Abs(turn) <= 360.0))))
            {
                return null;
            }
            Vector3d left = Towards(letters, 'L', 'R');
            Vector3d chest = Towards(letters, 'A', 'P');
            Vector3d head = Towards(letters, 'S', 'I');
            bool isWhole = left.LengthSquared == 1.0 && chest.LengthSquared == 1.0 && head.LengthSquared == 1.0;
            if (!isWhole || Vector3d.Dot(Vector3d.Cross(chest, left), head) < 0.0)
            {
                return null;
            }
            double cos = turn == 0.0 ? 1.0 : Math.Cos(turn * Math.PI / 180.0);
            double sin = turn == 0.0 ? 0.0 : Math.Sin(turn * Math.PI / 180.0);
            return new PatientAxes(cos * left - sin * chest, cos * chest + sin * left, head);
        }

        /// <summary>The same after a vessel that has them was placed in the scene.</summary>
        public PatientAxes Turned(Placement placement)
        {
            Vector3d origin = placement.Apply(Vector3d.Zero);
            return new PatientAxes(Vector3d.Normalize(placement.Apply(Left) - origin),
                Vector3d.Normalize(placement.Apply(Chest) - origin),
                Vector3d.Normalize(placement.Apply(Head) - origin));
        }

        /// <inheritdoc/>
        public bool Equals(PatientAxes? other) =>
            other != null && Left == other.Left && Chest == other.Chest && Head == other.Head;

        /// <inheritdoc/>
        public override bool Equals(object? obj) => Equals(obj as PatientAxes);

        /// <inheritdoc/>
        public override int GetHashCode() => HashCode.Combine(Left, Chest, Head);

        private static Vector3d Towards(string letters, char plus, char minus)
        {
            var found = Vector3d.Zero;
            Vector3d[] axes = { Vector3d.UnitX, Vector3d.UnitY, Vector3d.UnitZ };
            for (int k = 0; k < 3; k++)
            {
                found += (letters[k] == plus ? 1.0 : letters[k] == minus ? -1.0 : 0.0) * axes[k];
            }
            return found;
        }
    }
}
