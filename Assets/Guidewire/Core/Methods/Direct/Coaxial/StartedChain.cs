using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Lays a chain of coaxial instruments where a start has each of them.</summary>
    /// <remarks>A node of the chain is one of the outermost instrument there. An element has the frame of that, and an
    /// instrument inside the angle between the two frames: of its own element whose middle is in that of the chain, or
    /// between two of those. Angles are counted on from the hubs, without limit. The element that comes out of a tip
    /// may have its own frame inside that tip: its axis is then the line between its nodes.</remarks>
    internal sealed class StartedChain
    {
        private const double Shortest = 0.5;    // of an element's length, where it comes out of a bent tip
        private const double Longest = 1.05;

        private readonly CoaxialSetup _setup;
        private readonly CoaxialHubs _hubs;
        private readonly CoaxialJoints _joints;

        /// <summary>The chain of these joints.</summary>
        public StartedChain(CoaxialSetup setup, CoaxialHubs hubs, CoaxialJoints joints)
        {
            _setup = setup;
            _hubs = hubs;
            _joints = joints;
        }

        /// <summary>Takes the shape and the motion.</summary>
        public void SetFrom(MaterialScene scene)
        {
            RodShape shape = scene.Shape;
            for (int k = 0; k <= shape.ElementCount; k++)
            {
                int carrier = _joints.CarrierAt(k);
                int own = NodeOf(carrier, k);
                shape.X[k] = _setup.Scenes[carrier].Shape.X[own];
                scene.Velocities[k] = _setup.Scenes[carrier].Velocities[own];
            }
            shape.ProximalFrame = _hubs.Outer.FrameTurned(_hubs.Outer.FrameTurnAt(0.0));
            int j = 0;
            for (int i = 0; i < _joints.Count; i++)
            {
                TakeAngles(shape, i);
                for (; j < _joints.TipOf(i); j++)
                {
                    TakeFrame(scene, i, j);
                }
            }
        }

        // Its sign goes on from that of the element before, with the angle there.
        private void TakeFrame(MaterialScene scene, int carrier, int j)
        {
            RodShape shape = scene.Shape;
            int own = NodeOf(carrier, j + 1) - 1;
            Quaterniond frame = _setup.Scenes[carrier].Shape.Q[own];
            if (MiddleOf(carrier, own) < _joints.Stations[j])
            {
                frame = RodStart.Turned(frame, Vector3d.Normalize(shape.X[j + 1] - shape.X[j]));
            }
            Quaterniond before = j == 0 ? shape.ProximalFrame
                : CoaxialShape.FrameOf(shape, _joints, j - 1, carrier);
            shape.Q[j] = Quaterniond.Aligned(before, frame);
            scene.Spins[j] = _setup.Scenes[carrier].Spins[own];
        }

        /// <summary>That a start is one of another instrument, or of another place of its hub, in one phrase; or
        /// null.</summary>
        /// <param name="scene">Of one instrument, where its start has it.</param>
        public static string? FindOther(MaterialScene scene)
        {
            Vector3d[] x = scene.Shape.X;
            double away = (x[0] - scene.Schedule.Hub.PositionAt(0.0)).Length;
            if (away > 0.5 * scene.Rod.Length[0])
            {
                return string.Format(CultureInfo.InvariantCulture,
                    "positions[0] is {0:G4} m from where the hub is by its insertion", away);
            }
            for (int j = 0; j < scene.Rod.ElementCount; j++)
            {
                // One that comes out of a bent tip may be short.
                double part = (x[j + 1] - x[j]).Length / scene.Rod.Length[j];
                if (!(part > Shortest && part < Longest))
                {
                    return string.Format(CultureInfo.InvariantCulture, "positions[{0}] and positions[{1}] are {2:G4}"
                        + " times as far apart as the instrument's element is long: the start is that of another one",
                        j, j + 1, part);
                }
            }
            return null;
        }

        private int NodeOf(int instrument, int node) =>
            _setup.Scenes[instrument].Shape.ElementCount - (_joints.TipOf(instrument) - node);

        // Of an instrument's own element, m along the chain.
        private double MiddleOf(int instrument, int element)
        {
            double[] station = _setup.Instruments[instrument].Stations;
            return 0.5 * (station[element] + station[element + 1]) - _joints.LeadOf(instrument);
        }

        // Angles at the middles of an instrument's own elements, from the hub on.
        private void TakeAngles(RodShape shape, int instrument)
        {
            RodShape own = _setup.Scenes[instrument].Shape;
            int n = shape.ElementCount;
            double angle = _hubs.TwistAt(instrument, 0.0);
            double place = double.NegativeInfinity;
            int next = 0;       // element of the chain whose angle is to be found
            int at = 0;
            for (int e = 0; e < own.ElementCount && next < _joints.ActiveCountOf(instrument); e++)
            {
                double middle = MiddleOf(instrument, e);
                at = CoaxialShape.ElementAt(_joints, middle, at);
                int carrier = _joints.CarrierOf(at);
                if (carrier >= instrument)
                {
                    break;
                }
                Quaterniond turn = OutermostAt(shape, middle, at).Conjugate * own.Q[e];
                double before = angle;
                angle = Nearest(2.0 * Math.Atan2(turn.Z, turn.W), before - Carried(shape, carrier, next));
                for (; next < at && next < _joints.ActiveCountOf(instrument); next++)
                {
                    double between = 0.5 * (_joints.Stations[next] + _joints.Stations[next + 1]);
                    double part = (between - place) / (middle - place);
                    shape.Twist[(instrument - 1) * n + next] = place < 0.0 || !(part > 0.0) ? angle
                        : before + part * (angle - before);
                }
                if (middle > _joints.Stations[0] && next == at)
                {
                    shape.Twist[(instrument - 1) * n + next++] = angle;
                }
                place = middle;
            }
            for (; next < _joints.ActiveCountOf(instrument); next++)
            {
                shape.Twist[(instrument - 1) * n + next] = angle;
            }
        }

        // The outermost frame at a place, in element 'at' of the chain or before it.
        private Quaterniond OutermostAt(RodShape shape, double place, int at)
        {
            if (place <= 0.0)
            {
                return _hubs.Outer.FrameTurned(_hubs.Outer.TurnAt(0.0));
            }
            int own = 0;
            while (own < _joints.First && _setup.Instruments[0].Stations[own + 1] < place)
            {
                own++;
            }
            return own < _joints.First ? _setup.Catheter.Shape.Q[own] : shape.Q[at];
        }

        // By which angle the frame changes where another instrument becomes the outermost one before an element.
        private double Carried(RodShape shape, int carrier, int element)
        {
            return carrier == 0 || element == 0 || _joints.CarrierOf(element - 1) == carrier ? 0.0
                : shape.Twist[(carrier - 1) * shape.ElementCount + element - 1];
        }

        private static double Nearest(double angle, double other) =>
            angle + 2.0 * Math.PI * Math.Round((other - angle) / (2.0 * Math.PI));
    }
}
