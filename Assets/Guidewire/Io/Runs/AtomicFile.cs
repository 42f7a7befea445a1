using System.IO;
using System.Text;

namespace Guidewire.Io
{
    /// <summary>Files that are whole or not there: written under a temporary name, then renamed.</summary>
    internal static class AtomicFile
    {
        /// <summary>What follows the name of a file that is not whole yet.</summary>
        public const string Partial = ".partial";

        /// <summary>Writes a text file.</summary>
        /// <exception cref="IOException">The disk is full, or the folder is gone.</exception>
        public static void Write(string path, string text)
        {
            Prepare(path, text);
            Publish(path);
        }

        /// <summary>Writes a text file under its temporary name only.</summary>
        /// <exception cref="IOException">The disk is full, or the folder is gone; nothing is left of it.</exception>
        public static void Prepare(string path, string text)
        {
            try
            {
                File.Delete(path + Partial);
                // Not FileMode.Create: what is truncated goes to the disk when it is closed, and waits for that.
                using var stream = new FileStream(path + Partial, FileMode.CreateNew, FileAccess.Write);
                byte[] bytes = Encoding.UTF8.GetBytes(text);
                stream.Write(bytes, 0, bytes.Length);
            }
            catch (IOException)
            {
                File.Delete(path + Partial);
                throw;
            }
        }

        /// <summary>Gives what was written under the temporary name its own.</summary>
        /// <exception cref="IOException">The file is gone.</exception>
        public static void Publish(string path)
        {
            if (File.Exists(path))
            {
                File.Replace(path + Partial, path, null);
            }
            else
            {
                File.Move(path + Partial, path);
            }
        }
    }
}
