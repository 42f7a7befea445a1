using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>Common base of the steps of all methods for a material: the wire, the monitors that end a run, and the
    /// stress.</summary>
    internal abstract class MaterialStep : TimeStepper
    {
        private readonly IKineticEnergy _inertia;
        private StressRecord? _stress;

        /// <summary>Makes a step of this scene's wire.</summary>
        /// <param name="terms">Its energies and loads.</param>
        /// <param name="inertia">How its motion counts against the energy that is put in.</param>
        /// <param name="velocities">Of the nodes, m/s, now and after each step.</param>
        /// <param name="spins">Of the elements along their own axes, rad/s.</param>
        /// <param name="results">The solver's report on its own work.</param>
        /// <param name="contacts">Forces of walls that are not among the terms, or null.</param>
        protected MaterialStep(MaterialScene scene, RodTerms terms, IKineticEnergy inertia, Vector3d[] velocities,
            Vector3d[] spins, MethodParameters method, SolverReport results, EnergyTerm? contacts = null)
        {
            Scene = scene;
            Terms = terms;
            Velocities = velocities;
            Spins = spins;
            TimeStep = method.TimeStep;
            Results = results;
            _inertia = inertia;
            Ends = new HeldEnds(terms, scene.Schedule);
            Energy = new EnergyMonitor(terms, inertia, scene.Shape, velocities, spins, Ends);
            Rest = new RestMonitor(scene, terms, velocities, spins, method, contacts);
        }

        /// <summary>What is prescribed of the wire.</summary>
        public RodSchedule Schedule => Scene.Schedule;

        /// <summary>The wire at its start, and what is beside it.</summary>
        protected MaterialScene Scene { get; }

        /// <summary>Its energies and loads.</summary>
        protected RodTerms Terms { get; }

        /// <summary>Where it is.</summary>
        protected RodShape Shape => Scene.Shape;

        /// <summary>The velocities of the nodes, m/s.</summary>
        protected Vector3d[] Velocities { get; }

        /// <summary>The angular velocities of the elements along their own axes, rad/s.</summary>
        protected Vector3d[] Spins { get; }

        /// <summary>What moves node 0.</summary>
        protected MaterialDrive Drive => Scene.Drive;

        /// <summary>The time step dt, s.</summary>
        protected double TimeStep { get; }

        /// <summary>The solver's report on its own work.</summary>
        protected SolverReport Results { get; }

        /// <summary>Work of the supports.</summary>
        protected HeldEnds Ends { get; }

        /// <summary>Finds a motion that has blown up.</summary>
        protected EnergyMonitor Energy { get; }

        /// <summary>Finds a wire at rest.</summary>
        protected RestMonitor Rest { get; }

        /// <summary>t after the steps so far, s.</summary>
        protected abstract double Time { get; }

        /// <summary>The kinetic energy of the wire as it is, J.</summary>
        protected virtual double KineticEnergy => _inertia.KineticEnergy(Velocities, Spins);

        /// <inheritdoc/>
        public override StressRecord? Stress()
        {
            _stress ??= new StressRecord(Scene.Rod.JointLengths(Scene.Supports));
            Terms.SetTime(Schedule, Time);
            _stress.Record(Terms, Shape, KineticEnergy);
            return _stress;
        }

        /// <summary>Whether the wire moves with more energy than was put in; the reason then ends with this
        /// remedy.</summary>
        protected bool HasBlownUp(string remedy)
        {
            string? divergence = Energy.Blowup();
            Divergence = divergence == null ? null : divergence + remedy;
            return Divergence != null;
        }

        /// <summary>A step is done: finds whether the wire has lost a turn, or is at rest.</summary>
        /// <param name="predictedTip">Position of the last node by the prediction, m.</param>
        protected void EndStep(in Vector3d predictedTip)
        {
            Failure = Scene.Joints.FindLost(Shape, Time);
            SteadyState = Rest.FindRest(Time);
            PredictionError = Vector3d.Distance(predictedTip, Shape.X[Shape.ElementCount]) / Scene.Metres;
        }

        /// <inheritdoc/>
        public override void AddWarnings(List<RunWarning> warnings)
        {
            if (Rest.IsUnstable(Time))
            {
                warnings.Add(WarningTable.Unstable.With());
            }
        }

        /// <summary>A wire that was restored has lost no turns before.</summary>
        protected void BeginTurns(Snapshot snapshot, double time)
        {
            if (!snapshot.IsWritten)
            {
                Scene.Joints.Begin(Shape, time);
            }
        }

        /// <summary>Writes the wire as it is into a state.</summary>
        protected void Write(RodState state) => Scene.Write(state, Shape, Velocities, Spins);
    }

    /// <summary>The state that every method for a material needs to continue, in one common layout, so that each can
    /// read the state of another: time, shape, frames, velocities, and the progress of the prescribed motions. After it
    /// each method writes the turns of both clamps' frames, then one section of its own.</summary>
    internal static class MaterialSnapshot
    {
        /// <summary>Writes or restores the wire's motion.</summary>
        /// <param name="velocities">m/s.</param>
        /// <param name="spins">rad/s along the elements' axes.</param>
        /// <param name="time">s.</param>
        public static void Serialize(Snapshot snapshot, RodSchedule schedule, RodShape shape, Vector3d[] velocities,
            Vector3d[] spins, ref double time)
        {
            snapshot.Serialize(ref time);
            shape.Serialize(snapshot);
            snapshot.Serialize(velocities, shape.ElementCount + 1);
            snapshot.Serialize(spins, shape.ElementCount);
            schedule.Serialize(snapshot, time);
        }
    }
}
