using System;
using System.Collections.Generic;
using Guidewire.Core;
using Guidewire.Io;

namespace Guidewire.Runtime
{
    /// <summary>A run after one of its steps: a copy, which the thread that steps no longer touches. Its arrays are
    /// made once.</summary>
    public sealed class WireState
    {
        private readonly CatheterState[] _catheters;
        private readonly int[] _hints;              // one a wall and element, see ContactShape.Nearest

        internal WireState(SimulationSession session)
        {
            Simulation run = session.Simulation;
            Rod = new RodState(run.State.ElementCount, run.State.ElementCount * run.State.ElementLength, 1.0, 0.0);
            Array.Copy(run.State.ElementLengths, Rod.ElementLengths, Rod.ElementCount);
            ContactForces = run.Contacts == null ? Array.Empty<Vector3d>() : new Vector3d[Rod.SphereCount];
            ContactWalls = new int[ContactForces.Length];
            _hints = new int[session.Parameters.Scene.Walls.Length * Rod.ElementCount];
            Array.Fill(_hints, -1);
            ContactPoints = new Vector3d[_hints.Length];
            Fields = Array.ConvertAll(session.Parameters.Scene.Walls,
                wall => wall.Motion == null ? null : new WallField(wall.Motion));
            _catheters = new CatheterState[run.Catheters().Count];
            for (int k = 0; k < _catheters.Length; k++)
            {
                _catheters[k] = new CatheterState(run.Catheters()[k].Orientations.Length);
            }
            Centrelines = new Vector3d[1 + _catheters.Length][];
            Centrelines[0] = Rod.Positions;
            for (int k = 0; k < _catheters.Length; k++)
            {
                Centrelines[k + 1] = _catheters[k].Positions;
            }
            WallDisplacements = new List<Vector3d[]>(SoftWallDisplacements.Of(run))
                .ConvertAll(own => new Vector3d[own.Length]).ToArray();
        }

        /// <summary>Where each wall is; null where it stands still.</summary>
        internal WallField?[] Fields { get; }

        /// <summary>Positions, orientations and lengths of the wire; velocities and masses are not copied.</summary>
        public RodState Rod { get; }

        /// <summary>The in-game time, s.</summary>
        public double Time { get; private set; }

        /// <summary>Counts the steps that are done.</summary>
        public int StepCount { get; private set; }

        /// <summary>How the run ended, or Running.</summary>
        public Outcome Outcome { get; private set; }

        /// <summary>Why it ended, in one line; empty while it runs.</summary>
        public string Reason { get; private set; } = "";

        /// <summary>Wall time of a step, ms, smoothed over some 50 steps.</summary>
        public double StepTime { get; private set; }

        /// <summary>The prediction's error in the last step, units.</summary>
        public double PredictionError { get; private set; }

        /// <summary>Force of the walls on each sphere, N with a material; empty without walls.</summary>
        public Vector3d[] ContactForces { get; }

        /// <summary>Index of the wall that acts on each sphere, where one does.</summary>
        internal int[] ContactWalls { get; }

        /// <summary>Whether the tip is at the target of its vessel; false without one.</summary>
        public bool IsAtTarget { get; private set; }

        /// <summary>Nodes of the wire and of each catheter, units.</summary>
        internal Vector3d[][] Centrelines { get; }

        /// <summary>Displacements of soft walls at their elements, m; none where all are rigid.</summary>
        internal Vector3d[][] WallDisplacements { get; }

        /// <summary>The sum of the contact forces.</summary>
        public Vector3d ContactForce { get; private set; }

        /// <summary>Force of the first sphere's support.</summary>
        public Vector3d Reaction { get; private set; }

        /// <summary>Points of the wire that have passed a wall; 0 but with pbd.</summary>
        public long Passages { get; private set; }

        /// <summary>The wire's hub; null where the method has none.</summary>
        public HubState? Hub { get; private set; }

        /// <summary>Largest curvature of the wire, 1/m; 0 with pbd.</summary>
        public double LargestCurvature { get; private set; }

        /// <summary>The catheters, outermost first.</summary>
        public IReadOnlyList<CatheterState> Catheters => _catheters;

        /// <summary>Whether the hub that is held made less than half of what the last step asked of it: the instrument
        /// is jammed. Pulling back frees it.</summary>
        public bool IsJammed { get; private set; }

        /// <summary>Where elements are within reach of a wall, units, if a view has asked for it.</summary>
        internal Vector3d[] ContactPoints { get; }

        /// <summary>How many they are.</summary>
        internal int ContactPointCount { get; private set; }

        /// <summary>Whether nobody has taken it yet; for <see cref="StateExchange"/>.</summary>
        internal volatile bool IsNew;

        /// <summary>Displacement that a hub was asked and has not made, m; 0 where nothing states it.</summary>
        /// <param name="held">0 the wire's, k that of catheter k.</param>
        internal static double ShortfallOf(SimulationSession session, int held)
        {
            CoaxialRecord? outermost = session.Simulation.Coaxial();
            if (outermost == null)
            {
                return (session.Simulation.Contacts?.DriveShortfall ?? 0.0) * session.Parameters.Scene.MetresPerUnit;
            }
            return held == 0 ? outermost.WireShortfall : session.Simulation.Catheters()[held - 1].Shortfall;
        }

        /// <summary>Copies a run as it is.</summary>
        /// <param name="isJammed">Whether its last step lost most of what was asked.</param>
        /// <param name="withPoints">Whether the points of contact are wanted too.</param>
        internal void CopyFrom(SimulationSession session, bool isJammed, bool withPoints)
        {
            Simulation run = session.Simulation;
            Array.Copy(run.State.Positions, Rod.Positions, Rod.SphereCount);
            Array.Copy(run.State.Orientations, Rod.Orientations, Rod.ElementCount);
            (Time, StepCount, StepTime) = (run.Time, run.StepCount, session.StepTime);
            (Outcome, PredictionError, IsJammed) = (run.Outcome, run.PredictionError, isJammed);
            Reason = run.Outcome == Outcome.Running ? "" : run.Reason;
            for (int k = 0; k < Fields.Length; k++)
            {
                Fields[k] = FollowOf(Fields[k], run.FieldOf(k), Time);
            }
            ContactRecord? contacts = run.Contacts;
            if (contacts != null)
            {
                Array.Copy(contacts.Forces, ContactForces, ContactForces.Length);
                FindContactWalls(session.Parameters.Scene.Walls);
                (ContactForce, Reaction, Passages) = (contacts.Total, contacts.Reaction, contacts.Passages);
            }
            IReadOnlyList<CoaxialRecord> catheters = run.Catheters();
            for (int k = 0; k < _catheters.Length; k++)
            {
                _catheters[k].CopyFrom(catheters[k]);
            }
            if (WallDisplacements.Length > 0)
            {
                int next = 0;
                foreach (Vector3d[] own in SoftWallDisplacements.Of(run))
                {
                    own.CopyTo(WallDisplacements[next++], 0);
                }
            }
            HubRecord? hub = run.Hub();
            Hub = null;
            if (hub != null)
            {
                LargestCurvature = hub.LargestCurvature;
                Hub = new HubState
                {
                    Insertion = hub.Insertion,
                    Turn = hub.Turn,
                    Force = hub.Force,
                    Torque = hub.Torque,
                    Shortfall = ShortfallOf(session, 0),
                };
            }
            IsAtTarget = session.Target != null && session.PlaceOf(Rod.Positions)?.IsAtTarget == true;
            ContactPointCount = 0;
            if (withPoints)
            {
                FindContactPoints(session.Parameters);
            }
        }

        /// <summary>Sets positions between two states, and all else as in the newer one.</summary>
        /// <param name="t">0 the older one, 1 the newer one.</param>
        internal void Interpolate(WireState older, WireState newer, double t)
        {
            Interpolate(older.Rod.Positions, newer.Rod.Positions, t, Rod.Positions);
            Interpolate(older.Rod.Orientations, newer.Rod.Orientations, t, Rod.Orientations);
            for (int k = 0; k < Fields.Length; k++)
            {
                Fields[k] = FollowOf(Fields[k], newer.Fields[k], older.Time + t * (newer.Time - older.Time));
            }
            Array.Copy(newer.ContactForces, ContactForces, ContactForces.Length);
            for (int k = 0; k < WallDisplacements.Length; k++)
            {
                newer.WallDisplacements[k].CopyTo(WallDisplacements[k], 0);
            }
            Array.Copy(newer.ContactPoints, ContactPoints, newer.ContactPointCount);
            for (int k = 0; k < _catheters.Length; k++)
            {
                _catheters[k].Interpolate(older._catheters[k], newer._catheters[k], t);
            }
            Time = older.Time + t * (newer.Time - older.Time);
            (StepCount, StepTime, PredictionError) = (newer.StepCount, newer.StepTime, newer.PredictionError);
            (Outcome, Reason, IsJammed) = (newer.Outcome, newer.Reason, newer.IsJammed);
            (ContactForce, Reaction, Passages) = (newer.ContactForce, newer.Reaction, newer.Passages);
            (Hub, LargestCurvature, IsAtTarget) = (newer.Hub, newer.LargestCurvature, newer.IsAtTarget);
            Array.Copy(newer.ContactWalls, ContactWalls, ContactWalls.Length);
            ContactPointCount = newer.ContactPointCount;
        }

        internal static void Interpolate(Vector3d[] older, Vector3d[] newer, double t, Vector3d[] result)
        {
            for (int i = 0; i < result.Length; i++)
            {
                result[i] = t == 1.0 ? newer[i] : Vector3d.Lerp(older[i], newer[i], t);
            }
        }

        // q and -q are one orientation: along the shorter way.
        internal static void Interpolate(Quaterniond[] older, Quaterniond[] newer, double t, Quaterniond[] result)
        {
            for (int j = 0; j < result.Length; j++)
            {
                Quaterniond q = newer[j];
                Quaterniond p = older[j];
                double sign = p.X * q.X + p.Y * q.Y + p.Z * q.Z + p.W * q.W < 0.0 ? -1.0 : 1.0;
                result[j] = t == 1.0 ? q : Quaterniond.Normalize((1.0 - t) * p + (sign * t) * q);
            }
        }

        // The nearest wall of each sphere that one acts on.
        private static WallField? FollowOf(WallField? own, WallField? other, double time)
        {
            own = own?.Motion == other?.Motion ? own : other == null ? null : new WallField(other.Motion);
            own?.Follow(other!, time);
            return own;
        }

        private void FindContactWalls(ContactShape[] walls)
        {
            for (int i = 0; i < ContactWalls.Length && walls.Length > 1; i++)
            {
                double nearest = double.PositiveInfinity;
                for (int k = 0; k < walls.Length && ContactForces[i].LengthSquared > 0.0; k++)
                {
                    int hint = -1;
                    Vector3d x = Fields[k]?.AtRest(Rod.Positions[i]) ?? Rod.Positions[i];
                    if (walls[k].Nearest(x, x, double.PositiveInfinity, ref hint,
                        out SurfaceContact contact) && Math.Abs(contact.Distance) < nearest)
                    {
                        (nearest, ContactWalls[i]) = (Math.Abs(contact.Distance), k);
                    }
                }
            }
        }

        private void FindContactPoints(SimulationParameters parameters)
        {
            double range = parameters.Contact.SphereRadius + parameters.Contact.CollisionMargin;
            for (int k = 0; k < _hints.Length; k++)
            {
                int j = k % Rod.ElementCount;
                ContactShape wall = parameters.Scene.Walls[k / Rod.ElementCount];
                WallField? field = Fields[k / Rod.ElementCount];
                Vector3d a = field?.AtRest(Rod.Positions[j]) ?? Rod.Positions[j];
                Vector3d b = field?.AtRest(Rod.Positions[j + 1]) ?? Rod.Positions[j + 1];
                if (wall.Nearest(a, b, range, ref _hints[k], out SurfaceContact contact))
                {
                    ContactPoints[ContactPointCount++] = field?.Moved(contact.Point) ?? contact.Point;
                }
            }
        }
    }

    /// <summary>A hub after a step, in SI units.</summary>
    public struct HubState
    {
        /// <summary>How far it has gone since the start, m.</summary>
        public double Insertion;

        /// <summary>How far it has turned since the start, rad.</summary>
        public double Turn;

        /// <summary>Its force on its instrument along its axis, N, a thrust positive.</summary>
        public double Force;

        /// <summary>Its torque on its instrument about its axis, N m.</summary>
        public double Torque;

        /// <summary>Displacement that was asked of it and not made, m.</summary>
        public double Shortfall;
    }

    /// <summary>A catheter after a step.</summary>
    public sealed class CatheterState
    {
        internal CatheterState(int elements)
        {
            Positions = new Vector3d[elements + 1];
            Orientations = new Quaterniond[elements];
        }

        /// <summary>Its n + 1 nodes, units.</summary>
        public Vector3d[] Positions { get; }

        /// <summary>The orientations of its n elements.</summary>
        public Quaterniond[] Orientations { get; }

        /// <summary>The state of its hub.</summary>
        public HubState Hub { get; internal set; }

        /// <summary>Length over which the next instrument is in it, m.</summary>
        public double Overlap { get; internal set; }

        internal void CopyFrom(CoaxialRecord record)
        {
            Array.Copy(record.Positions, Positions, Positions.Length);
            Array.Copy(record.Orientations, Orientations, Orientations.Length);
            Overlap = record.Overlap;
            Hub = new HubState
            {
                Insertion = record.Insertion,
                Turn = record.Turn,
                Force = record.Force,
                Torque = record.Torque,
                Shortfall = record.Shortfall,
            };
        }

        internal void Interpolate(CatheterState older, CatheterState newer, double t)
        {
            WireState.Interpolate(older.Positions, newer.Positions, t, Positions);
            WireState.Interpolate(older.Orientations, newer.Orientations, t, Orientations);
            Overlap = newer.Overlap;
            Hub = newer.Hub;
        }
    }
}
