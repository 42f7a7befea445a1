using System;
using System.Collections.Generic;
using System.IO;
using Guidewire.Core;
using Newtonsoft.Json.Linq;

namespace Guidewire.Io
{
    /// <summary>What a new run does with one that its folder holds already.</summary>
    public enum Existing
    {
        /// <summary>The new run replaces it once it is done; until then, and where it is not, the earlier one
        /// stays.</summary>
        Replace,

        /// <summary>One of the same parameters, repeat and build stands in; another one is not touched: the new run is
        /// refused.</summary>
        Keep,
    }

    /// <summary>A run that a folder holds: how it ended, and whether it is the one that is requested.</summary>
    internal sealed class EarlierRun
    {
        private const int DifferencesShown = 2;

        private readonly string _folder;
        private readonly JObject _summary;

        private EarlierRun(string folder, JObject summary, Outcome outcome)
        {
            _folder = folder;
            _summary = summary;
            Outcome = outcome;
        }

        /// <summary>Says how the run ended.</summary>
        public Outcome Outcome { get; }

        /// <summary>The reason for its outcome, in one line.</summary>
        public string Reason => (string?)_summary["reason"] ?? "";

        /// <summary>Whether its result can be trusted, as far as the run could tell.</summary>
        public bool IsReliable => (bool?)_summary["reliable"] == true;

        /// <summary>The run that a folder holds from its start to its own end, or null where there is none: what was
        /// stopped or lost is not done.</summary>
        public static EarlierRun? In(string folder)
        {
            string path = Path.Combine(folder, RunSummary.FileName);
            if (!File.Exists(path))
            {
                return null;
            }
            try
            {
                JObject summary = JsonText.ReadObject(path);
                var log = (string?)summary["log"];    // null: none was asked for
                bool isWhole = (bool?)summary["complete"] == true
                    && (log == null || File.Exists(Path.Combine(folder, log)));
                bool hasOutcome = Enum.TryParse((string?)summary["outcome"], true, out Outcome outcome);
                bool isDone = outcome == Outcome.Converged || outcome == Outcome.Finished
                    || outcome == Outcome.Diverged;
                return isWhole && hasOutcome && isDone ? new EarlierRun(folder, summary, outcome) : null;
            }
            catch (Exception error) when (error is ParameterException || error is ArgumentException
                || error is FormatException || error is InvalidCastException)
            {
                return null;    // not a summary that this program wrote
            }
        }

        /// <summary>Whether it is the run of these parameters and this repeat, by this build.</summary>
        public bool IsSame(ParameterHandler handler, int? repeat) =>
            HasHash(handler) && IsOfThisBuild && Repeat == repeat;

        /// <summary>Says in a few words in what it differs from a run of these parameters and this repeat.</summary>
        public string Difference(ParameterHandler handler, int? repeat)
        {
            if (HasHash(handler))
            {
                return Repeat != repeat ? (Repeat.HasValue ? "timed repeat " + Repeat : "a run that is not timed")
                    : "the same parameters, by another build of the program";
            }
            if (((JArray?)_summary["notes"] ?? new JArray()).Count > 0)
            {
                return "a run that was " + (string?)_summary["notes"]![0];
            }
            List<string> keys = DifferentKeys(handler);
            return keys.Count == 0 ? "other parameters, or other files that they name"
                : "other parameters: " + string.Join(", ", keys);
        }

        private int? Repeat => (int?)_summary["repeat"];

        private bool IsOfThisBuild => (string?)_summary["versions"]?["core"] == RunSummary.CoreBuild;

        private bool HasHash(ParameterHandler handler) => (string?)_summary["parameterHash"] == handler.Hash;

        private List<string> DifferentKeys(ParameterHandler handler)
        {
            var lines = new List<string>();
            JObject there;
            try
            {
                there = JsonText.ReadObject(Path.Combine(_folder, RunFolder.ParametersFile));
            }
            catch (ParameterException)
            {
                return lines;
            }
            int count = 0;
            foreach (JProperty here in handler.ToJson().Properties())
            {
                string then = Text(there[here.Name]);
                string now = Text(here.Value);
                if (then == now || ParameterTable.Find(here.Name)!.IsOutputPath)
                {
                    continue;
                }
                if (++count <= DifferencesShown)
                {
                    lines.Add(here.Name + " is " + then + " there and " + now + " here");
                }
            }
            if (count > DifferencesShown)
            {
                lines.Add("and " + (count - DifferencesShown) + " more");
            }
            return lines;
        }

        private static string Text(JToken? value)
        {
            const int longest = 40;
            string text = value == null ? "not given" : NumberText.Write(value);
            return text.Length <= longest ? text : text.Substring(0, longest) + "...";
        }
    }
}
