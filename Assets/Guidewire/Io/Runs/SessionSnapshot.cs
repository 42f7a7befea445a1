using System;
using System.Globalization;
using System.Linq;
using System.Security.Cryptography;
using System.Text;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Bytes of a session's state: a line that says of what they are and whether they are whole, and the
    /// numbers that a run goes on from.</summary>
    internal static class SessionSnapshot
    {
        private const string Magic = "guidewire-snapshot";
        private const int LongestHead = 256;       // bytes of the line

        /// <summary>Gives the bytes of a state.</summary>
        /// <param name="numbers">All that the next steps depend on.</param>
        /// <param name="hash">Of the parameters.</param>
        /// <param name="isSteered">Whether a user moves the hubs.</param>
        public static byte[] Of(byte[] numbers, string hash, bool isSteered)
        {
            byte[] head = Encoding.ASCII.GetBytes(Head(numbers, hash, isSteered));
            var saved = new byte[head.Length + numbers.Length];
            head.CopyTo(saved, 0);
            numbers.CopyTo(saved, head.Length);
            return saved;
        }

        /// <summary>Gives the numbers of such bytes, for a session with these parameters.</summary>
        /// <param name="isOfThisBuild">Whether this build of the program has saved them.</param>
        /// <exception cref="ParameterException">They are of other parameters, of another format, or not
        /// whole.</exception>
        public static byte[] NumbersOf(byte[] saved, string hash, bool isSteered, out bool isOfThisBuild)
        {
            int end = Array.IndexOf(saved, (byte)'\n', 0, Math.Min(saved.Length, LongestHead)) + 1;
            var numbers = new byte[saved.Length - end];
            Array.Copy(saved, end, numbers, 0, numbers.Length);
            string[] head = Encoding.ASCII.GetString(saved, 0, end).Split(' ');
            string[] here = Head(numbers, hash, isSteered).Split(' ');
            if (head.Length == here.Length - 1)
            {
                head = head.Take(1).Append("1").Concat(head.Skip(1)).ToArray();    // version 1 did not always state it
            }
            if (head.Length == here.Length && head[0] == Magic && int.TryParse(head[1], NumberStyles.None,
                    CultureInfo.InvariantCulture, out int format) && format != FileFormat.Version)
            {
                throw new ParameterException("the snapshot has format " + format + ": guidewire "
                    + ProgramVersion.Number + " reads format " + FileFormat.Version + ": save it anew");
            }
            // Of another build the parameters may have had fewer keys: their hash says nothing then.
            isOfThisBuild = head.Length == here.Length && head[3] == here[3];
            if (head.Length != here.Length || head[0] != Magic || (isOfThisBuild && head[2] != here[2])
                || head[4] != here[4] || head[5] != here[5])
            {
                throw new ParameterException("the snapshot was not saved by a session with these parameters, "
                    + "or is incomplete");
            }
            return numbers;
        }

        // What a snapshot must agree in with who reads it, and a sum that says whether it is whole.
        private static string Head(byte[] numbers, string hash, bool isSteered)
        {
            using SHA256 sha = SHA256.Create();
            string sum = BitConverter.ToString(sha.ComputeHash(numbers), 0, 8).Replace("-", "");
            string holds = isSteered ? "hand" : "drive";
            return string.Join(" ", Magic, FileFormat.Version, hash, RunSummary.CoreBuild, holds, sum) + "\n";
        }
    }
}
