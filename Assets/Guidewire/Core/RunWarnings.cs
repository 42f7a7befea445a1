using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;

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

        private readonly bool _hasLead;             // whether the first sphere starts ahead of the wire
        private readonly double _length;            // at rest, units
        private readonly double _depth;             // that contact allows, units
        private readonly RimMonitor _rims;
        private readonly bool _keepsApart;          // strands of an instrument, and counts passages in its own steps
        private readonly StrandMonitor[] _strands;  // of the wire, then of catheters

        /// <summary>Collects the warnings of a run of these parameters.</summary>
        /// <param name="stepper">Says what covers the tip, and where walls are, for <see cref="RimMonitor"/>.</param>
        public RunWarnings(SimulationParameters parameters, TimeStepper stepper)
        {
            _length = parameters.Scene.GuidewireLength;
            _rims = new RimMonitor(Array.ConvertAll(parameters.Scene.Walls,
                wall => wall.AtLimit(1.0 / parameters.Scene.MetresPerUnit)), stepper.IsTipCovered, stepper.FieldOf);
            MethodTraits method = MethodTable.Of(parameters.Method.Solver);
            _hasLead = !method.TakesMaterial;
            _keepsApart = method.HasBarriers && parameters.Contact.TouchesItself(parameters.Scene.Walls.Length);
            _strands = parameters.Scene.Catheters.Select(one => parameters.OfCatheter(one, Vector3d.UnitZ))
                .Prepend(parameters).Select(one => StrandsOf(one, method.TakesMaterial, _keepsApart)).ToArray();
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
            if (StrandPassages(contacts) > 0)
            {
                yield return WarningTable.StrandPassages.With(StrandPassages(contacts));
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
            for (int k = 0; k < _strands.Length; k++)
            {
                string name = k == 0 ? "the wire" : _strands.Length == 2 ? "the catheter" : "catheter " + k;
                if (_strands[k].WarningOf(name) is RunWarning overlap)
                {
                    yield return overlap;
                    break;
                }
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
        /// <param name="contacts">Null where there are no walls.</param>
        public long StrandPassages(ContactRecord? contacts) =>
            _keepsApart && contacts != null ? contacts.StrandPassages : _strands.Sum(one => one.Passages);

        /// <summary>The wire starts in this state.</summary>
        /// <param name="coaxial">Null without a catheter.</param>
        public void Begin(RodState state, CoaxialRecord? coaxial)
        {
            _rims.Begin(state);
            BeginStrands(state, coaxial);
            if (!_hasLead)
            {
                TakeStrands(state, coaxial, 0.0);
            }
        }

        /// <summary>Takes the state at the end of a step.</summary>
        /// <param name="coaxial">Null without a catheter.</param>
        /// <param name="time">s.</param>
        public void Update(RodState state, ContactRecord? contacts, CoaxialRecord? coaxial, double time)
        {
            _rims.Update(state, contacts, time);
            TakeStrands(state, coaxial, time);
        }

        private void BeginStrands(RodState state, CoaxialRecord? coaxial)
        {
            int k = 0;
            _strands[k++].Begin(state.Positions);
            for (CoaxialRecord? one = coaxial; one != null; one = one.Inside)
            {
                _strands[k++].Begin(one.Positions);
            }
        }

        private void TakeStrands(RodState state, CoaxialRecord? coaxial, double time)
        {
            int k = 0;
            _strands[k++].Follow(state.Positions, time);
            for (CoaxialRecord? one = coaxial; one != null; one = one.Inside)
            {
                _strands[k++].Follow(one.Positions, time);
            }
        }

        private static StrandMonitor StrandsOf(SimulationParameters instrument, bool hasMaterial, bool keepsApart)
        {
            double[] lengths = ElementLayout.Lengths(instrument, 1.0, out double[] station);
            var radius = new double[lengths.Length];
            for (int j = 0; j < lengths.Length; j++)
            {
                radius[j] = hasMaterial
                    ? CrossSection.At(instrument.Material, 0.5 * (station[j] + station[j + 1])).Radius
                        / instrument.Scene.MetresPerUnit
                    : instrument.Contact.SphereRadius;
            }
            return new StrandMonitor(lengths, radius, lengths.Length, keepsApart);
        }

        /// <summary>Writes or restores what was seen.</summary>
        /// <param name="state">Where the wire is.</param>
        /// <param name="coaxial">Null without a catheter.</param>
        public void Serialize(Snapshot snapshot, RodState state, CoaxialRecord? coaxial)
        {
            _rims.Serialize(snapshot, state);
            foreach (StrandMonitor one in _strands)
            {
                one.Serialize(snapshot);
            }
            if (!snapshot.IsWritten)
            {
                BeginStrands(state, coaxial);
            }
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
