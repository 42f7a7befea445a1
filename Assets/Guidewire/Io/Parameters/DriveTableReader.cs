using System;
using System.Collections.Generic;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Reads the file of key driveFile: a CSV file of time in s, insertion in m and rotation in rad.</summary>
    internal static class DriveTableReader
    {
        /// <summary>Sets the table of a drive; the file's name is replaced by the one that was found.</summary>
        /// <param name="values">Its parameters.</param>
        /// <param name="source">The parameter file that names the table, or "command line".</param>
        /// <exception cref="ParameterException">A file that holds no such table.</exception>
        public static void Read(RunParameters values, string source)
        {
            if (values.DriveFile.Length == 0)
            {
                return;
            }
            values.DriveFile = NamedFile.Find(values.DriveFile, source);
            string where = source + ": driveFile: ";
            List<double>[] columns = TableReader.Read(values.DriveFile, where,
                new TableColumn("time", Dimension.Time), new TableColumn("insertion", Dimension.Length),
                new TableColumn("rotation", Dimension.Angle));
            try
            {
                double[] times = columns[0].ToArray();
                values.Simulation.Drive.Table = new DriveTable(new TimeTable(times, columns[1].ToArray()),
                    new TimeTable(times, columns[2].ToArray()));
            }
            catch (ArgumentException error)
            {
                throw new ParameterException(where + values.DriveFile + ": " + error.Message);
            }
        }
    }
}
