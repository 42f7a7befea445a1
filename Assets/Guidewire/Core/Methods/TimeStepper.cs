using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Advances a wire in time by steps of one method, and reports their success. One implementation per
    /// method, chosen when a run is built.</summary>
    internal abstract class TimeStepper
    {
        /// <summary>Distance in units between the last sphere's prediction and where the constraints left it in the
        /// last step (Delta_p, thesis 4.1.1).</summary>
        public double PredictionError { get; protected internal set; }

        /// <summary>Why the method gave up in the last step, in one line, or null.</summary>
        public string? Failure { get; protected set; }

        /// <summary>How the last step lost the wire, in one line, or null. With a material the state is that of the
        /// step before.</summary>
        public string? Divergence { get; protected set; }

        /// <summary>Why the wire is in a steady state after the last step, in one line, or null.</summary>
        public string? SteadyState { get; protected set; }

        /// <summary>How many steps, up to the last, make that state.</summary>
        public int SteadySteps { get; protected set; } = 1;

        /// <summary>Adds what is not accurate in the steps so far: long steps or few iterations may leave a wire wrong
        /// without losing it.</summary>
        public virtual void AddWarnings(List<RunWarning> warnings)
        {
        }

        /// <summary>The forces that act on the wire from outside, and the results of contact; null where nobody asked
        /// for them.</summary>
        public virtual ContactRecord? Contacts => null;

        /// <summary>Strains, forces, couples and energies of the wire as it is; null with pbd.</summary>
        public virtual StressRecord? Stress() => null;

        /// <summary>Energy of motion, that stored in all instruments, and minus the work of the loads that have a
        /// potential, J; null with pbd.</summary>
        public virtual Vector3d? Energies()
        {
            StressRecord? stress = Stress();
            return stress == null ? (Vector3d?)null
                : new Vector3d(stress.KineticEnergy, stress.ElasticEnergy, stress.PotentialEnergy);
        }

        /// <summary>What is read off at the hub and the tip; null where the method does not compute it.</summary>
        public virtual HubRecord? Hub() => null;

        /// <summary>Gives the results of the outermost catheter, and of the one inside it; null without
        /// one.</summary>
        public virtual CoaxialRecord? Coaxial() => null;

        /// <summary>Where the sheath ends, m; null without one.</summary>
        public virtual Vector3d? ExitOfSheath => null;

        /// <summary>Whether the wire's tip is in its sheath, or in a catheter whose own tip is within a wall and whose
        /// axis the wire's does not follow.</summary>
        /// <param name="field">Where the wall is, if it moves.</param>
        public bool IsTipCovered(ContactShape wall, WallField? field) =>
            Hub()?.SpheresInBody == 0 || Coaxial() is CoaxialRecord outer && IsIn(outer, wall, field, out _);

        // Whether the wire's tip is in this catheter or one inside it, and how far beyond this one, m.
        private static bool IsIn(CoaxialRecord catheter, ContactShape wall, WallField? field, out double beyond)
        {
            double beyondInner = 0.0;
            bool isInInner = catheter.Inside != null && IsIn(catheter.Inside, wall, field, out beyondInner);
            beyond = catheter.Extension + beyondInner;
            Vector3d tip = catheter.Positions[catheter.Positions.Length - 1];
            return isInInner || (beyond <= 0.0 && wall.IsWithin(field?.AtRest(tip) ?? tip));
        }

        /// <summary>Where a wall is now, of which the wire's scene has this number; null where it stands
        /// still.</summary>
        public virtual WallField? FieldOf(int wall) => null;

        /// <summary>Advances the state by one step.</summary>
        public abstract void Advance(RodState state);

        /// <summary>The solver's report on its own work after the steps so far; null with pbd.</summary>
        public virtual SolverReport? Report() => null;

        /// <summary>Writes into a snapshot, or restores from one, all that the next step depends on besides the
        /// <see cref="RodState"/>: history, predictors, counters, what is prescribed.</summary>
        public virtual void Serialize(Snapshot snapshot)
        {
        }

        /// <summary>Does the same for <see cref="PredictionError"/>.</summary>
        protected void SerializePredictionError(Snapshot snapshot) =>
            PredictionError = snapshot.Serialize(PredictionError);
    }
}
