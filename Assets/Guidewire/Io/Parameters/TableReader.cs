using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Io
{
    /// <summary>Reads a CSV file of numbers in columns. A first line of words and lines that begin with # are passed
    /// over.</summary>
    internal static class TableReader
    {
        /// <summary>The columns, each with a number for every row.</summary>
        /// <param name="file">Its full name.</param>
        /// <param name="where">Parameter file and key, for what is refused; ends in ": ".</param>
        /// <param name="count">Of columns.</param>
        /// <param name="needed">What a line needs, as a noun phrase.</param>
        /// <exception cref="ParameterException">The file cannot be read, or a line holds something else.</exception>
        public static List<double>[] Read(string file, string where, int count, string needed)
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
            var columns = new List<double>[count];
            for (int c = 0; c < count; c++)
            {
                columns[c] = new List<double>();
            }
            bool mayBeHead = true;
            for (int i = 0; i < lines.Length; i++)
            {
                if (lines[i].Trim().Length == 0 || lines[i].StartsWith("#", StringComparison.Ordinal))
                {
                    continue;
                }
                if (!TryRow(lines[i].Split(','), columns) && (!mayBeHead || !IsHead(lines[i], count)))
                {
                    throw new ParameterException(where + file + ": line " + (i + 1) + " needs " + needed);
                }
                mayBeHead = false;
            }
            return columns;
        }

        // Adds a row, whole or not at all.
        private static bool TryRow(string[] cells, List<double>[] columns)
        {
            var row = new double[columns.Length];
            if (cells.Length != columns.Length)
            {
                return false;
            }
            for (int c = 0; c < row.Length; c++)
            {
                if (!NumberText.TryRead(cells[c], out row[c]))
                {
                    return false;
                }
            }
            for (int c = 0; c < row.Length; c++)
            {
                columns[c].Add(row[c]);
            }
            return true;
        }

        // Words, one for each column.
        private static bool IsHead(string line, int count)
        {
            string[] cells = line.Split(',');
            return cells.Length == count && Array.TrueForAll(cells, cell => cell.Trim().Length > 0
                && !double.TryParse(cell, NumberStyles.Float, CultureInfo.InvariantCulture, out _));
        }
    }
}
