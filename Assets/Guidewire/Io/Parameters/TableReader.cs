using System;
using System.Collections.Generic;
using System.Linq;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Reads a CSV file of numbers in columns. Lines that begin with # are passed over. A first line of words
    /// names the columns, in any order and with units: time,rotation_deg,insertion_mm. Without one they are in the
    /// order asked for, in SI.</summary>
    internal static class TableReader
    {
        private static readonly char[] Separators = { ';', '\t', ' ' };

        /// <summary>Gives the columns asked for, each with a number for every row, in SI.</summary>
        /// <param name="file">Its full name.</param>
        /// <param name="where">Parameter file and key, for what is refused; ends in ": ".</param>
        /// <exception cref="ParameterException">The file cannot be read, or a line holds something else.</exception>
        public static List<double>[] Read(string file, string where, params TableColumn[] columns)
        {
            string[] lines;
            try
            {
                lines = PlainFile.ReadText(file, "a table").Split('\n');
            }
            catch (ParameterException error)
            {
                throw new ParameterException(where + error.Message);
            }
            List<double>[] read = Array.ConvertAll(columns, _ => new List<double>());
            int[] order = Enumerable.Range(0, columns.Count(column => !column.Missing.HasValue)).ToArray();
            double[] sizes = Array.ConvertAll(columns, _ => 1.0);
            bool mayBeHead = true;
            for (int i = 0; i < lines.Length; i++)
            {
                string line = lines[i].Trim();
                if (line.Length == 0 || line[0] == '#')
                {
                    continue;
                }
                string[] cells = Array.ConvertAll(line.Split(','), cell => cell.Trim().Trim('"').Trim());
                string? problem = mayBeHead && IsHead(cells) ? FindProblemOfHead(cells, columns, ref order, sizes)
                    : FindProblemOfRow(cells, columns, order, sizes, read);
                if (problem != null)
                {
                    throw new ParameterException(where + file + ": line " + (i + 1) + " " + problem);
                }
                mayBeHead = false;
            }
            for (int c = 0; c < columns.Length; c++)
            {
                if (columns[c].Missing is double missing && Array.IndexOf(order, c) < 0)
                {
                    read[c].AddRange(Enumerable.Repeat(missing, read[order[0]].Count));
                }
            }
            return read;
        }

        // Words alone.
        private static bool IsHead(string[] cells) =>
            Array.TrueForAll(cells, cell => cell.Length > 0 && (char.IsLetter(cell[0]) || cell[0] == '_'));

        // Adds a row, whole or not at all.
        private static string? FindProblemOfRow(string[] cells, TableColumn[] columns, int[] order, double[] sizes,
            List<double>[] read)
        {
            var row = new double[cells.Length];
            for (int c = 0; c < cells.Length; c++)
            {
                if (!NumberText.TryRead(cells[c], out row[c]))
                {
                    return "needs " + Needed(columns) + "; it has '" + cells[c] + "'"
                        + (cells[c].IndexOfAny(Separators) < 0 ? "" : ": commas separate columns, and numbers have a "
                            + "decimal point");
                }
            }
            if (row.Length != order.Length)
            {
                return "needs " + Needed(columns) + "; it has " + row.Length + " numbers"
                    + (row.Length > columns.Length ? ": numbers have a decimal point, not a comma" : "");
            }
            for (int c = 0; c < row.Length; c++)
            {
                read[order[c]].Add(sizes[c] * row[c]);
            }
            return null;
        }

        // Where the columns are, and the size of their units in SI.
        private static string? FindProblemOfHead(string[] cells, TableColumn[] columns, ref int[] order,
            double[] sizes)
        {
            order = cells.Length <= columns.Length ? new int[cells.Length] : order;
            var found = new HashSet<int>();
            for (int c = 0; c < cells.Length; c++)
            {
                string name = cells[c].Split(' ', '_', '(', '[')[0];
                string unit = cells[c].Substring(name.Length).Trim(' ', '_', '(', ')', '[', ']');
                int column = Array.FindIndex(columns, one => string.Equals(one.Name, name,
                    StringComparison.OrdinalIgnoreCase));
                if (column < 0)
                {
                    return "has a column '" + cells[c] + "': allowed are " + Names(columns) + ", with commas between"
                        + (cells[c].Contains(';') ? ", no semicolons" : "");
                }
                if (!found.Add(column))
                {
                    return "has the column '" + columns[column].Name + "' twice";
                }
                double size = 1.0;
                if (unit.Length > 0 && !UnitTable.TrySize(unit, columns[column].Of, out size))
                {
                    return "has the column '" + cells[c] + "' in an unknown unit: allowed are "
                        + UnitTable.Of(columns[column].Of);
                }
                if (c < order.Length)
                {
                    (order[c], sizes[c]) = (column, size);
                }
            }
            int missing = Array.FindIndex(columns,
                one => !one.Missing.HasValue && !found.Contains(Array.IndexOf(columns, one)));
            return missing < 0 ? null
                : "has no column '" + columns[missing].Name + "': needed are " + Names(columns);
        }

        private static string Names(TableColumn[] columns) => string.Join(", ", columns.Select(column => column.Name));

        private static string Needed(TableColumn[] columns) =>
            string.Join(", ", columns.Select(column => column.Words)) + " with commas between";
    }
}
