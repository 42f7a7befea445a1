using System;
using System.Collections.Generic;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Reads the files of keys proximalMotionFile and distalMotionFile: CSV files of time in s, a displacement
    /// in m and a rotation vector in rad, x, y, z each.</summary>
    internal static class EndMotionReader
    {
        private static readonly TableColumn[] Columns =
        {
            new TableColumn("time", Dimension.Time), new TableColumn("x", Dimension.Length),
            new TableColumn("y", Dimension.Length), new TableColumn("z", Dimension.Length),
            new TableColumn("rx", Dimension.Angle), new TableColumn("ry", Dimension.Angle),
            new TableColumn("rz", Dimension.Angle),
        };

        /// <summary>Sets the motions of a scene; the files' names are replaced by those that were found.</summary>
        /// <param name="values">Its parameters.</param>
        /// <param name="sourceOf">Who said what stands at a path.</param>
        /// <exception cref="ParameterException">A file that holds no such motion.</exception>
        public static void Read(RunParameters values, Func<string, string> sourceOf)
        {
            SceneParameters scene = values.Simulation.Scene;
            values.ProximalMotionFile = Find("proximalMotionFile", values.ProximalMotionFile, sourceOf,
                motion => scene.ProximalMotion = motion);
            values.DistalMotionFile = Find("distalMotionFile", values.DistalMotionFile, sourceOf,
                motion => scene.DistalMotion = motion);
        }

        private static string Find(string key, string file, Func<string, string> sourceOf, Action<EndMotion> set)
        {
            if (file.Length == 0)
            {
                return file;
            }
            string found = NamedFile.Find(file, sourceOf(key));
            string where = sourceOf(key) + ": " + key + ": ";
            List<double>[] columns = TableReader.Read(found, where, Columns);
            try
            {
                set(new EndMotion(columns[0].ToArray(), Vectors(columns, 1), Vectors(columns, 4)));
            }
            catch (ArgumentException error)
            {
                throw new ParameterException(where + found + ": " + error.Message);
            }
            return found;
        }

        private static Vector3d[] Vectors(List<double>[] columns, int first)
        {
            var vectors = new Vector3d[columns[0].Count];
            for (int i = 0; i < vectors.Length; i++)
            {
                vectors[i] = new Vector3d(columns[first][i], columns[first + 1][i], columns[first + 2][i]);
            }
            return vectors;
        }
    }
}
