using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>What the hubs of a run by the direct solver move, as one rod: it begins steps and their parts, and has
    /// the results of each instrument. This one is a wire alone.</summary>
    internal class InstrumentSet
    {
        private MonitoredRod? _rod;

        /// <summary>Makes a wire alone.</summary>
        public InstrumentSet(MonitoredRod rod)
            : this(new[] { rod.Drive }, new[] { new HubSlip(rod.Drive, 0.0, 0.0) }, rod.Dynamics.Work)
        {
            _rod = rod;
        }

        /// <summary>Instruments on these hubs, the outermost one first, the wire last.</summary>
        /// <param name="slips">What hubs do at a hubForceLimit that only other steps can find.</param>
        /// <param name="work">What the run may take.</param>
        protected InstrumentSet(MaterialDrive[] drives, HubSlip[] slips, WorkLimit work)
        {
            Drives = drives;
            Slips = slips;
            Work = work;
        }

        /// <summary>What moves each hub, the outermost one first, the wire's last.</summary>
        public MaterialDrive[] Drives { get; }

        /// <summary>What they do at a hubForceLimit.</summary>
        public HubSlip[] Slips { get; }

        /// <summary>What the run may take.</summary>
        public WorkLimit Work { get; }

        /// <summary>What is simulated at present.</summary>
        public virtual MonitoredRod Rod => _rod!;

        /// <summary>The forces that act on the wire from outside, and the results of contact; null where nobody asked
        /// for them.</summary>
        public virtual ContactRecord? Contacts => Rod.Contacts;

        /// <summary>Moves the hubs, as far as they may go.</summary>
        public virtual void BeginStep()
        {
            Drives[0].Prepare(Rod.Dynamics.Shape, Rod.Dynamics.Time);
        }

        /// <summary>Takes in and leaves out nodes.</summary>
        /// <param name="left">Of the step, s.</param>
        /// <returns>How long no other ones come or go, at most what is left, s.</returns>
        public virtual double BeginPart(double left)
        {
            return left;
        }

        /// <summary>Takes what a step has come to.</summary>
        public virtual void Take()
        {
        }

        /// <summary>Writes the wire as it is into a state.</summary>
        public virtual void Write(RodState state)
        {
            Rod.Write(state);
        }

        /// <summary>Gives the force of a hub on its instrument, N: of the outermost one first, of the wire
        /// last.</summary>
        public virtual double ForceOf(int hub)
        {
            return Hub()!.Force;
        }

        /// <summary>What is read off at the wire's hub and tip; null without a hub.</summary>
        public virtual HubRecord? Hub()
        {
            return Rod.Hub();
        }

        /// <summary>Strains, forces and couples of the wire, and energies of all.</summary>
        public virtual StressRecord Stress()
        {
            return Rod.Stress();
        }

        /// <summary>Results of the catheters, the outermost one first; null without one.</summary>
        public virtual CoaxialRecord? Coaxial()
        {
            return null;
        }

        /// <summary>Adds what is not as asked.</summary>
        public virtual void AddWarnings(List<RunWarning> warnings)
        {
            Rod.AddWarnings(warnings);
        }

        /// <summary>Writes or restores all that the next step depends on.</summary>
        public virtual void Serialize(Snapshot snapshot)
        {
            Rod.Serialize(snapshot);
        }

        /// <summary>Writes or restores all that a step may touch, for a <see cref="StepStart"/>.</summary>
        public virtual void SerializeStep(Snapshot snapshot)
        {
            Rod.SerializeStep(snapshot);
        }
    }
}
