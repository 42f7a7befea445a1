using System;
using System.Collections.Generic;
using System.IO;
using System.Security.Cryptography;
using System.Text;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>SHA-256 of all effective values but output paths: for files their contents, not their names.</summary>
    internal static class ParameterHash
    {
        /// <summary>Gives the hash, in hex.</summary>
        /// <param name="values">The effective values.</param>
        /// <param name="taken">The keys that the method takes.</param>
        public static string Of(RunParameters values, IEnumerable<ParameterEntry> taken)
        {
            var text = new StringBuilder();
            foreach (ParameterEntry entry in taken)
            {
                if (!entry.IsOutputPath && entry.Key != InstrumentLayer.Key && entry.Key != "startFile"
                    && entry.Key != "patientOrigin"
                    && entry.Key != "vessel" && entry.Key != CatheterReader.Key && entry.Key != "loadTables"
                    && !IsTableFile(entry.Key))
                {
                    text.Append(entry.Key).Append('=').Append(NumberText.Write(entry.Write(values))).Append('\n');
                }
            }
            if (values.StartFile.Length > 0)
            {
                // What the file holds counts, not what it is called.
                text.Append("start=").Append(File.ReadAllText(values.StartFile)).Append('\n');
            }
            text.Append(LoadTableReader.Content(values.LoadTables));
            text.Append(MotionReader.Content(values.Vessel));
            foreach (JToken obstacle in values.Obstacles ?? new JArray())
            {
                text.Append(MotionReader.Content(obstacle));
            }
            AppendFile(text, "drive=", values.DriveFile);
            AppendFile(text, "proximalMotion=", values.ProximalMotionFile);
            AppendFile(text, "distalMotion=", values.DistalMotionFile);
            foreach (Catheter catheter in values.Simulation.Scene.Catheters)
            {
                text.Append("start=").Append(NumberText.Write(new JValue(catheter.Start))).Append('\n');
                if (!double.IsNaN(catheter.FrictionCoefficient))
                {
                    text.Append("friction=").Append(NumberText.Write(new JValue(catheter.FrictionCoefficient)))
                        .Append('\n');
                }
                if (catheter.LumenFriction > 0.0)
                {
                    text.Append("lumen=").Append(NumberText.Write(new JValue(catheter.LumenFriction))).Append('\n');
                }
                if (!double.IsNaN(catheter.Drive.HubForceLimit))
                {
                    text.Append("limit=").Append(NumberText.Write(new JValue(catheter.Drive.HubForceLimit)))
                        .Append('\n');
                }
            }
            text.Append(values.CatheterHashes);
            using SHA256 sha = SHA256.Create();
            if (values.Vessel?.DeepClone() is JObject vessel)
            {
                string mesh = (string?)vessel[WallReader.Sha256] ?? "";
                string anatomy = (string?)vessel["anatomy"] ?? "";
                vessel.Remove("file");
                vessel.Remove("anatomy");
                MotionReader.RemoveFiles(vessel);
                vessel.Remove(WallReader.Sha256);
                text.Append("vessel=").Append(NumberText.Write(vessel)).Append('\n');
                text.Append(Convert.ToBase64String(Bytes(mesh)));
                text.Append(anatomy.Length == 0 ? ""
                    : Convert.ToBase64String(sha.ComputeHash(File.ReadAllBytes(anatomy))));
            }
            byte[] digest = sha.ComputeHash(Encoding.UTF8.GetBytes(text.ToString()));
            return BitConverter.ToString(digest).Replace("-", "").ToLowerInvariant();
        }

        // Of a sum in hex.
        private static byte[] Bytes(string hex)
        {
            var bytes = new byte[hex.Length / 2];
            for (int k = 0; k < bytes.Length; k++)
            {
                bytes[k] = Convert.ToByte(hex.Substring(2 * k, 2), 16);
            }
            return bytes;
        }

        private static bool IsTableFile(string key) =>
            key == "driveFile" || key == "proximalMotionFile" || key == "distalMotionFile";

        private static void AppendFile(StringBuilder text, string name, string file)
        {
            if (file.Length > 0)
            {
                text.Append(name).Append(File.ReadAllText(file)).Append('\n');
            }
        }
    }
}
