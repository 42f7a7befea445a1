using System;
using System.Collections.Generic;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Warnings at the end of a run with any method: points beyond walls, a wire of another length, one
    /// that was bent too far, a drive that fell short.</summary>
    internal sealed class RunWarnings
    {
        private const double OddStretch = 0.01;     // of the length, which no wire of metal survives
        private const double OddStrain = 0.2;       // of the outermost fibre: bent to five times its own radius

        private const double ElasticStrain = 0.0085;    // where nitinol and hard steel have left their line

        private const double NearLimit = 0.9;       // of a soft wall's limit

        private readonly bool _isMaterial;
        private readonly double _length;            // at rest, units
        private readonly double _depth;             // that contact allows, units
        private readonly RimMonitor _rims;
        private readonly SelfOverlap _overlap;
        private readonly SimulationParameters _parameters;
        private readonly bool _keepsApart;          // strands of an instrument
        private readonly List<StrandPassages> _strands = new List<StrandPassages>();   // of the wire, then of catheters

        /// <summary>Collects the warnings of a run of these parameters.</summary>
        /// <param name="stepper">Says what covers the tip, and where walls are, for <see cref="RimMonitor"/>.</param>
        public RunWarnings(SimulationParameters parameters, TimeStepper stepper)
        {
            _parameters = parameters;
            _length = parameters.Scene.GuidewireLength;
            _overlap = new SelfOverlap(parameters);
            _rims = new RimMonitor(Array.ConvertAll(parameters.Scene.Walls,
                wall => wall.AtLimit(1.0 / parameters.Scene.MetresPerUnit)), stepper.IsTipCovered, stepper.FieldOf);
            MethodTraits method = MethodTable.Of(parameters.Method.Solver);
            _isMaterial = method.TakesMaterial;
            _keepsApart = method.HasBarriers && parameters.Contact.TouchesItself(parameters.Scene.Walls.Length);
            _depth = method.DepthInRadii * (method.TakesMaterial
                ? parameters.Material.WireRadius / parameters.Scene.MetresPerUnit : parameters.Contact.SphereRadius);
        }

        /// <summary>Gives all of a state.</summary>
        /// <param name="contacts">Null where there are no walls.</param>
        /// <param name="extremes">Null where the method has none.</param>
        /// <param name="coaxial">Null without a catheter.</param>
        public IEnumerable<RunWarning> Of(RodState state, ContactRecord? contacts, RunExtremes? extremes,
            CoaxialRecord? coaxial)
        {
            if (contacts != null && contacts.Passages > 0)
            {
                yield return WarningTable.Passages.With(contacts.Passages);
            }
            if (contacts != null && contacts.MaxPenetration > _depth)
            {
                yield return WarningTable.Penetration.With(contacts.MaxPenetration, _depth);
            }
            TakeStrands(state, coaxial, true);
            if (StrandPassages > 0)
            {
                yield return WarningTable.StrandPassages.With(StrandPassages);
            }
            double change = LengthOf(state) / _length - 1.0;
            if (Math.Abs(change) > OddStretch)
            {
                yield return WarningTable.Length.With(100.0 * Math.Abs(change), change < 0.0 ? "shorter" : "longer");
            }
            if (extremes != null && extremes.Strain > OddStrain)
            {
                yield return WarningTable.Strain.With(100.0 * extremes.Strain,
                    (extremes.IsFirstStep(extremes.StrainTime) ? "in the first step, at t = " : "at t = ")
                    + extremes.StrainTime.ToString("G4", CultureInfo.InvariantCulture));
            }
            if (_overlap.Warning is RunWarning overlap)
            {
                yield return overlap;
            }
            if (extremes != null && extremes.LawShare > 1.0)
            {
                yield return WarningTable.BeyondLaw.With(100.0 * extremes.CoreStrain, 1e3 * extremes.CorePlace);
            }
            if (extremes != null && extremes.MetalStrain > ElasticStrain && extremes.Strain <= OddStrain)
            {
                yield return WarningTable.BeyondElastic.With(100.0 * extremes.MetalStrain);
            }
            if (contacts != null && Shortfall.Counts(contacts.DriveShortfall, contacts.DriveAsked, _length))
            {
                yield return WarningTable.DriveShortfall.With(contacts.DriveAsked, contacts.DriveShortfall);
            }
            for (CoaxialRecord? one = coaxial; one != null; one = one.Inside)
            {
                if (one.PlayWarning is RunWarning play)
                {
                    yield return play;
                }
            }
            if (extremes != null && extremes.LimitShare > NearLimit)
            {
                yield return WarningTable.SoftLimit.With(extremes.WallDisplacement, 100.0 * extremes.LimitShare);
            }
            if (_rims.Warning is RunWarning exit)
            {
                yield return exit;
            }
        }

        /// <summary>How often instruments have passed through themselves so far.</summary>
        public long StrandPassages
        {
            get
            {
                long sum = 0;
                _strands.ForEach(one => sum += one.Total);
                return sum;
            }
        }

        /// <summary>The wire starts in this state.</summary>
        /// <param name="coaxial">Null without a catheter.</param>
        public void Begin(RodState state, CoaxialRecord? coaxial)
        {
            _rims.Begin(state);
            if (_isMaterial)    // with gains the first sphere has moved ahead of the wire
            {
                TakeOverlap(state, coaxial, 0.0);
            }
            _strands.Add(new StrandPassages(_isMaterial
                ? _parameters.Material.WireRadius / _parameters.Scene.MetresPerUnit : _parameters.Contact.SphereRadius,
                state.Positions));
            for (CoaxialRecord? one = coaxial; one != null; one = one.Inside)
            {
                Catheter catheter = _parameters.Scene.Catheters[_strands.Count - 1];
                _strands.Add(new StrandPassages(
                    catheter.Material.WireRadius / _parameters.Scene.MetresPerUnit, one.Positions));
            }
        }

        /// <summary>Takes the state at the end of a step.</summary>
        /// <param name="coaxial">Null without a catheter.</param>
        /// <param name="time">s.</param>
        /// <param name="mayTouch">Whether strands may have come near one another.</param>
        public void Update(RodState state, ContactRecord? contacts, CoaxialRecord? coaxial, double time, bool mayTouch)
        {
            _rims.Update(state, contacts, time);
            TakeOverlap(state, coaxial, time);
            if (mayTouch)
            {
                TakeStrands(state, coaxial, false);
                return;
            }
            _strands[0].Begin(state.Positions);
            int k = 1;
            for (CoaxialRecord? one = coaxial; one != null; one = one.Inside)
            {
                _strands[k++].Begin(one.Positions);
            }
        }

        private void TakeOverlap(RodState state, CoaxialRecord? coaxial, double time)
        {
            _overlap.Update(0, state.Positions, time);
            int k = 1;
            for (CoaxialRecord? one = coaxial; one != null; one = one.Inside)
            {
                _overlap.Update(k++, one.Positions, time);
            }
        }

        private void TakeStrands(RodState state, CoaxialRecord? coaxial, bool isLast)
        {
            _strands[0].Update(state.Positions, _keepsApart, isLast);
            int k = 1;
            for (CoaxialRecord? one = coaxial; one != null; one = one.Inside)
            {
                _strands[k++].Update(one.Positions, _keepsApart, isLast);
            }
        }

        /// <summary>Writes or restores what was seen.</summary>
        /// <param name="state">Where the wire is.</param>
        public void Serialize(Snapshot snapshot, RodState state)
        {
            _rims.Serialize(snapshot, state);
            _overlap.Serialize(snapshot);
            snapshot.Section(string.Join(", ", _strands.ConvertAll(one => one.NodeCount)) + " nodes",
                part => _strands.ForEach(one => one.Serialize(part)));
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
