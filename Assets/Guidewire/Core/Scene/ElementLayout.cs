using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Length of each rod element: L/n, but in sections with a number of elements of their own.</summary>
    /// <remarks>Such a section is cut into its own number of equal elements. What lies between these sections is the
    /// rest of the wire; its elements are numberRodElements altogether, at least one in each piece, the others
    /// distributed out by length with the largest remainders first. Where nothing is left of the wire, that number does
    /// not count.</remarks>
    public static class ElementLayout
    {
        private const int MaxElements = 1_000_000;

        /// <summary>Pieces shorter than this part of the wire's length are rounding errors.</summary>
        public const double Rounding = 1e-9;

        /// <summary>Gives the number of elements of the whole wire.</summary>
        /// <exception cref="ArgumentException">As <see cref="ParameterConflict"/> has it.</exception>
        public static int Count(SimulationParameters parameters)
        {
            int count = 0;
            foreach (Piece piece in Pieces(parameters))
            {
                count += piece.Count;
            }
            return count;
        }

        /// <summary>The same of a catheter around the wire.</summary>
        public static int Count(SimulationParameters parameters, Catheter catheter) =>
            Count(parameters.OfCatheter(catheter, Vector3d.UnitZ));

        /// <summary>Length of the last element at rest, units.</summary>
        /// <exception cref="ArgumentException">As <see cref="ParameterConflict"/> has it.</exception>
        public static double LastLength(SimulationParameters parameters)
        {
            double[] lengths = Lengths(parameters, 1.0, out _);
            return lengths[lengths.Length - 1];
        }

        /// <summary>A section's length over that of the longest element it touches; 0 where it lies beyond the
        /// wire.</summary>
        public static double FractionOfAnElement(SimulationParameters parameters, WireSection section)
        {
            double longest = 0.0;
            double slack = Rounding * parameters.Scene.GuidewireLength;
            foreach (Piece piece in Pieces(parameters))
            {
                if (section.From < piece.To - slack && section.To > piece.From + slack)
                {
                    longest = Math.Max(longest, (piece.To - piece.From) / piece.Count);
                }
            }
            double length = Math.Min(section.To, parameters.Scene.GuidewireLength) - section.From;
            return longest > 0.0 ? length / longest : 0.0;
        }

        /// <summary>What does not fit in the sections' own numbers of elements, as what is needed, or null.</summary>
        internal static string? FindProblem(SimulationParameters parameters)
        {
            double length = parameters.Scene.GuidewireLength;
            double slack = Rounding * length;
            double reached = 0.0;
            int rest = 0;
            long count = parameters.Scene.NumberRodElements;
            foreach (WireSection section in OwnNumbers(parameters))
            {
                if (section.To > length + slack)
                {
                    return "a section with its own numberRodElements to end within guidewireLength";
                }
                if (section.From < reached - slack)
                {
                    return "sections with their own numberRodElements not to overlap";
                }
                rest += section.From > reached + slack ? 1 : 0;
                count += section.NumberRodElements!.Value;
                reached = section.To;
            }
            if (count > MaxElements)
            {
                return "a wire of at most " + MaxElements + " elements altogether";
            }
            rest += reached < length - slack ? 1 : 0;
            return rest > parameters.Scene.NumberRodElements
                ? "a numberRodElements of at least " + rest + ", one for each piece between the sections that have"
                    + " their own"
                : null;
        }

        /// <summary>The length of each element, and where each node stands along the wire.</summary>
        /// <param name="unit">Length of one unit in what is returned.</param>
        /// <param name="stations">n + 1.</param>
        /// <returns>n.</returns>
        internal static double[] Lengths(SimulationParameters parameters, double unit, out double[] stations)
        {
            var lengths = new double[Count(parameters)];
            stations = new double[lengths.Length + 1];
            int first = 0;
            foreach (Piece piece in Pieces(parameters))
            {
                double l = unit * (piece.To - piece.From) / piece.Count;
                for (int i = 0; i < piece.Count; i++)
                {
                    lengths[first + i] = l;
                    stations[first + i + 1] = unit * piece.From + (i + 1) * l;
                }
                first += piece.Count;
            }
            return lengths;
        }

        private static List<WireSection> OwnNumbers(SimulationParameters parameters)
        {
            var own = new List<WireSection>();
            if (MethodTable.Of(parameters.Method.Solver).TakesMaterial)
            {
                foreach (WireSection section in parameters.Material.Sections)
                {
                    if (section.NumberRodElements.HasValue)
                    {
                        own.Add(section);
                    }
                }
                own.Sort((a, b) => a.From.CompareTo(b.From));
            }
            return own;
        }

        private static List<Piece> Pieces(SimulationParameters parameters)
        {
            double length = parameters.Scene.GuidewireLength;
            double slack = Rounding * length;
            var pieces = new List<Piece>();
            double reached = 0.0;
            foreach (WireSection section in OwnNumbers(parameters))
            {
                double from = reached;
                if (section.From > reached + slack)
                {
                    pieces.Add(new Piece { From = reached, To = section.From });
                    from = section.From;
                }
                reached = section.To > length - slack ? length : section.To;
                pieces.Add(new Piece { From = from, To = reached, Count = section.NumberRodElements!.Value });
            }
            if (reached < length)
            {
                pieces.Add(new Piece { From = reached, To = length });
            }
            Distribute(pieces, parameters.Scene.NumberRodElements);
            return pieces;
        }

        /// <summary>Gives the pieces that have no number of their own theirs.</summary>
        private static void Distribute(List<Piece> pieces, int count)
        {
            List<Piece> rest = pieces.FindAll(piece => piece.Count == 0);
            double total = 0.0;
            foreach (Piece piece in rest)
            {
                total += piece.To - piece.From;
            }
            int left = count;
            foreach (Piece piece in rest)
            {
                piece.Wanted = count * ((piece.To - piece.From) / total);
                piece.Count = Math.Max(1, (int)piece.Wanted);
                left -= piece.Count;
            }
            while (left != 0 && rest.Count > 0)
            {
                // One more where most is missing, one less where most is too much.
                Piece next = rest[0];
                foreach (Piece piece in rest)
                {
                    double missing = piece.Wanted - piece.Count;
                    if (left > 0 ? missing > next.Wanted - next.Count
                        : piece.Count > 1 && (next.Count == 1 || missing < next.Wanted - next.Count))
                    {
                        next = piece;
                    }
                }
                next.Count += Math.Sign(left);
                left -= Math.Sign(left);
            }
        }

        private sealed class Piece
        {
            public double From;    // units
            public double To;
            public int Count;      // of elements; 0: not yet known
            public double Wanted;  // its part of the rest's elements, not whole
        }
    }
}
