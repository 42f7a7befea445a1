using System;
using System.Collections.Generic;
using static System.FormattableString;

namespace Guidewire.Core
{
    /// <summary>Warnings at the end of a run with any method: points beyond walls, a wire of another length, one
    /// that was bent too far, a drive that fell short.</summary>
    internal sealed class RunWarnings
    {
        private const double OddStretch = 0.01;     // of the length, which no wire of metal survives
        private const double OddStrain = 0.2;       // of the outermost fibre: bent to five times its own radius
        private const double OddShortfall = 1e-3;   // of what the drive asked

        private readonly double _length;            // at rest, units
        private readonly double _depth;             // that contact allows, units
        private readonly RimMonitor _rims;

        /// <summary>For runs of these parameters.</summary>
        public RunWarnings(SimulationParameters parameters)
        {
            _length = parameters.Scene.GuidewireLength;
            _rims = new RimMonitor(parameters.Scene.Walls);
            MethodTraits method = MethodTable.Of(parameters.Method.Solver);
            _depth = method.DepthInRadii * (method.TakesMaterial
                ? parameters.Material.WireRadius / parameters.Scene.MetresPerUnit : parameters.Contact.SphereRadius);
        }

        /// <summary>One line for each, and one where the tip left a wall by an open rim, which is no error.</summary>
        /// <param name="contacts">Null where there are no walls.</param>
        /// <param name="extremes">Null where the method has none.</param>
        /// <param name="coaxial">Null without a catheter.</param>
        public IReadOnlyList<string> Of(RodState state, ContactRecord? contacts, RunExtremes? extremes,
            CoaxialRecord? coaxial)
        {
            List<string> lines = CollectWarnings(state, contacts, extremes);
            for (CoaxialRecord? one = coaxial; one != null; one = one.Inside)
            {
                string? play = one.PlayWarning;
                if (play != null)
                {
                    lines.Add(play);
                }
            }
            string? exit = _rims.Line;
            if (exit != null)
            {
                lines.Add(exit);
            }
            return lines;
        }

        /// <summary>Whether there is none but that of a rim.</summary>
        public bool IsTrustworthy(RodState state, ContactRecord? contacts, RunExtremes? extremes)
        {
            return CollectWarnings(state, contacts, extremes).Count == 0;
        }

        /// <summary>The wire starts in this state.</summary>
        public void Begin(RodState state)
        {
            _rims.Begin(state);
        }

        /// <summary>Takes the state at the end of a step.</summary>
        /// <param name="time">s.</param>
        public void Update(RodState state, ContactRecord? contacts, double time)
        {
            _rims.Update(state, contacts, time);
        }

        /// <summary>Writes or restores what was seen.</summary>
        /// <param name="state">Where the wire is.</param>
        public void Serialize(Snapshot snapshot, RodState state)
        {
            _rims.Serialize(snapshot, state);
        }

        private List<string> CollectWarnings(RodState state, ContactRecord? contacts, RunExtremes? extremes)
        {
            var lines = new List<string>();
            if (contacts != null && contacts.Passages > 0)
            {
                lines.Add(Invariant($"{contacts.Passages} points of the wire passed a wall"));
            }
            if (contacts != null && contacts.MaxPenetration > _depth)
            {
                lines.Add(Invariant($"the wire penetrated a wall by {contacts.MaxPenetration:G3} units, ")
                    + Invariant($"{_depth:G3} units are allowed"));
            }
            double change = LengthOf(state) / _length - 1.0;
            if (Math.Abs(change) > OddStretch)
            {
                string than = change < 0.0 ? "shorter" : "longer";
                lines.Add(Invariant($"the wire is {100.0 * Math.Abs(change):0.0} % {than} than at rest"));
            }
            if (extremes != null && extremes.Strain > OddStrain)
            {
                lines.Add(Invariant($"the outermost fibre was strained by up to {100.0 * extremes.Strain:0} %: a ")
                    + "real instrument would have kinked");
            }
            if (contacts != null && contacts.DriveShortfall > OddShortfall * contacts.DriveAsked)
            {
                lines.Add(Invariant($"the drive fell short: of {contacts.DriveAsked:G4} units that it asked of the ")
                    + Invariant($"first sphere {contacts.DriveShortfall:G3} are missing"));
            }
            return lines;
        }

        private static double LengthOf(RodState state)
        {
            double length = 0.0;
            for (int i = 1; i < state.SphereCount; i++)
            {
                length += Vector3d.Distance(state.Positions[i - 1], state.Positions[i]);
            }
            return length;
        }
    }
}
