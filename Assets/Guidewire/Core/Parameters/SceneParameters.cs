using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>What is simulated, independent of the method: the wire's length and start, how its ends are held, what
    /// acts
    /// on it, and the walls around it. Lengths are in units; loads are in mass units, units and seconds with pbd, in SI
    /// units with a material.</summary>
    public sealed class SceneParameters
    {
        /// <summary>The wire's length L, units.</summary>
        public double GuidewireLength { get; set; } = 300.0;

        /// <summary>n; the wire has n + 1 spheres. Where sections of a material have a number of elements of their
        /// own, that of the rest of the wire (see <see cref="ElementLayout"/>).</summary>
        public int NumberRodElements { get; set; } = 30;

        /// <summary>z of sphere 0 before its displacement, or its place on <see cref="StartAxis"/>, in units.</summary>
        public double GuidewireOffset { get; set; } = -120.0;

        /// <summary>Where a straight wire starts and where it points, or null: on z from the origin.</summary>
        public StartAxis? StartAxis { get; set; }

        /// <summary>Length of one unit, m.</summary>
        public double MetresPerUnit { get; set; } = 1e-3;

        /// <summary>How the patient lies in the scene, or null where nobody says it.</summary>
        public PatientAxes? PatientAxes { get; set; }

        /// <summary>Where the scene's origin lies in the generic patient that pages draw, mm to the left, the back and
        /// the head; null where none is drawn.</summary>
        public Vector3d? PatientOrigin { get; set; }

        /// <summary>The shape it starts from.</summary>
        public StartShape StartShape { get; set; } = StartShape.Straight;

        /// <summary>Radius of a helix to start from, units.</summary>
        public double StartRadius { get; set; } = 10.0;

        /// <summary>Turns of a helix to start from.</summary>
        public double StartTurns { get; set; } = 1.0;

        /// <summary>A start other than the straight wire along z at rest, or null.</summary>
        public RodStart? Start { get; set; }

        /// <summary>How the run starts.</summary>
        public InitialState InitialState { get; set; } = InitialState.Straight;

        /// <summary>What holds the proximal end; a drive that moves sphere 0 needs it held or clamped.</summary>
        public ProximalEnd ProximalEnd { get; set; } = ProximalEnd.Held;

        /// <summary>What holds the distal end.</summary>
        public DistalEnd DistalEnd { get; set; } = DistalEnd.Free;

        /// <summary>Turn of the distal frame about its own d3, radians; more than one turn counts.</summary>
        public double DistalRotation { get; set; }

        /// <summary>Displacement of the distal end along its frame's d3, units.</summary>
        public double DistalDisplacement { get; set; }

        /// <summary>Time over which rotation and displacement of the distal end grow, s; 0: at once.</summary>
        public double DistalRampTime { get; set; }

        /// <summary>Motion of the proximal end, instead of what a drive makes, or null.</summary>
        public EndMotion? ProximalMotion { get; set; }

        /// <summary>Motion of the distal end, instead of <see cref="DistalRotation"/> and <see
        /// cref="DistalDisplacement"/>, or null.</summary>
        public EndMotion? DistalMotion { get; set; }

        /// <summary>Acceleration of every free sphere in unit/s^2.</summary>
        public Vector3d Gravity { get; set; }

        /// <summary>Force on the last sphere, N.</summary>
        public Vector3d TipForce { get; set; }

        /// <summary>Force per length of the wire at rest, N/m.</summary>
        public Vector3d DistributedForce { get; set; }

        /// <summary>Forces at points of the wire.</summary>
        public PointLoad[] PointLoads { get; set; } = Array.Empty<PointLoad>();

        /// <summary>Factor on all <see cref="PointLoads"/> over time, or null.</summary>
        public TimeTable? PointLoadsTable { get; set; }

        /// <summary>Factor on <see cref="Gravity"/> over time, or null.</summary>
        public TimeTable? GravityTable { get; set; }

        /// <summary>Factor on <see cref="TipForce"/> over time, or null.</summary>
        public TimeTable? TipForceTable { get; set; }

        /// <summary>Factor on <see cref="DistributedForce"/> over time, or null.</summary>
        public TimeTable? DistributedForceTable { get; set; }

        /// <summary>Factor on <see cref="AxialForce"/> over time, or null.</summary>
        public TimeTable? AxialForceTable { get; set; }

        /// <summary>When the tip force ends, s; it acts up to and including this time.</summary>
        public double TipForceReleaseTime { get; set; } = 1e9;

        /// <summary>Couple at the wire's end along the axes there, N m: it turns with them.</summary>
        public Vector3d TipMoment { get; set; }

        /// <summary>Force on the last sphere along the axes of the wire's end, N: it turns with them.</summary>
        public Vector3d TipFollowerForce { get; set; }

        /// <summary>Factor on <see cref="TipMoment"/> over time, or null.</summary>
        public TimeTable? TipMomentTable { get; set; }

        /// <summary>Factor on <see cref="TipFollowerForce"/> over time, or null.</summary>
        public TimeTable? TipFollowerForceTable { get; set; }

        /// <summary>Force along the axis of a sliding distal end, N; a pull is positive.</summary>
        public double AxialForce { get; set; }

        /// <summary>The vessel and the obstacles, placed; an empty list is free of cost.</summary>
        public ContactShape[] Walls { get; set; } = Array.Empty<ContactShape>();

        /// <summary>The sheath from which the wire is fed into the vessel, or null.</summary>
        public Sheath? Sheath { get; set; }

        /// <summary>Catheters over the wire, outermost first.</summary>
        public IReadOnlyList<Catheter> Catheters { get; set; } = Array.Empty<Catheter>();

        /// <summary>The tables of the loads that there are.</summary>
        internal TimeTable[] UsedLoadTables()
        {
            var tables = new List<TimeTable>();
            Use(GravityTable, Gravity != Vector3d.Zero);
            Use(TipForceTable, TipForce != Vector3d.Zero);
            Use(DistributedForceTable, DistributedForce != Vector3d.Zero);
            Use(PointLoadsTable, PointLoads.Length > 0);
            Use(AxialForceTable, AxialForce != 0.0);
            Use(TipMomentTable, TipMoment != Vector3d.Zero);
            Use(TipFollowerForceTable, TipFollowerForce != Vector3d.Zero);
            return tables.ToArray();

            void Use(TimeTable? table, bool isUsed)
            {
                if (table != null && isUsed)
                {
                    tables.Add(table);
                }
            }
        }

        /// <summary>The same values; lists and walls are shared.</summary>
        internal SceneParameters Copy() => (SceneParameters)MemberwiseClone();
    }

    /// <summary>The initial shape of a run with a material.</summary>
    public enum StartShape
    {
        /// <summary>The wire starts straight along z.</summary>
        Straight,

        /// <summary>A closed circle through sphere 0 in the y-z plane; both ends have one position and one
        /// frame.</summary>
        Ring,

        /// <summary>A helix about the z axis.</summary>
        Helix,
    }

    /// <summary>How a run with a material starts.</summary>
    public enum InitialState
    {
        /// <summary>The wire starts in its start shape, at rest.</summary>
        Straight,

        /// <summary>The wire starts in the rest shape under gravity, tip loads and supports, reached from the start
        /// shape; where that is straight and one end is free, from the shape that the rest curvature alone
        /// gives.</summary>
        Equilibrium,
    }

    /// <summary>An introducer sheath: a straight guide without friction around the wire's proximal part, along the axis
    /// on which the wire starts.</summary>
    public sealed class Sheath
    {
        /// <summary>Where it ends, units; null: one element inside the vessel's inlet.</summary>
        public Vector3d? Exit { get; set; }

        /// <summary>The direction in which it leads, of any length; null: along the wire.</summary>
        public Vector3d? Direction { get; set; }
    }

    /// <summary>A force of constant direction at a point of the wire.</summary>
    public readonly struct PointLoad
    {
        /// <summary>Makes a force at a point of the wire.</summary>
        /// <param name="at">Length along the wire at rest from sphere 0, units.</param>
        /// <param name="force">N.</param>
        public PointLoad(double at, in Vector3d force)
        {
            At = at;
            Force = force;
        }

        /// <summary>Length along the wire at rest from sphere 0, units.</summary>
        public double At { get; }

        /// <summary>The force, N.</summary>
        public Vector3d Force { get; }
    }

    /// <summary>A catheter over the wire: an instrument of its own, fed and turned at its own hub, on the wire's axis
    /// at its start.</summary>
    public sealed class Catheter
    {
        /// <summary>The catheter's length L, units.</summary>
        public double Length { get; set; }

        /// <summary>The number of its elements n.</summary>
        public int Elements { get; set; } = 30;

        /// <summary>Distance of its hub ahead of the wire's at the start, units.</summary>
        public double Start { get; set; }

        /// <summary>Coefficient of friction of its outside with all walls; NaN: those of the walls.</summary>
        public double FrictionCoefficient { get; set; } = double.NaN;

        /// <summary>Coefficient of friction between the wire and its lumen, along the axis; 0: none.</summary>
        public double LumenFriction { get; set; }

        /// <summary>Force on its tip, N.</summary>
        public Vector3d TipForce { get; set; }

        /// <summary>Force per length at rest, N/m.</summary>
        public Vector3d DistributedForce { get; set; }

        /// <summary>Forces at lengths from its hub, units.</summary>
        public PointLoad[] PointLoads { get; set; } = Array.Empty<PointLoad>();

        /// <summary>What it is made of; <see cref="MaterialParameters.InnerRadius"/> is that of its lumen.</summary>
        public MaterialParameters Material { get; set; } = new MaterialParameters();

        /// <summary>What moves its hub; along the wire's axis.</summary>
        public DriveParameters Drive { get; set; } = new DriveParameters();
    }
}
