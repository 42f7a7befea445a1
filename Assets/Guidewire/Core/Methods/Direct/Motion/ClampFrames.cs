using System;

namespace Guidewire.Core
{
    /// <summary>Rotates the frames of the clamps as the schedule prescribes; a large rotation is made in parts, each
    /// solved on its own,
    /// so that the rod winds up in the right sense, also beyond half a turn.</summary>
    internal sealed class ClampFrames
    {
        private readonly RodSchedule _schedule;
        private readonly Func<string?> _solve;
        private double _proximal;  // turn that has been made, radians
        private double _distal;
        private double _time;      // up to which motions of the ends have been made, s

        /// <summary>Frames that have made no turn yet.</summary>
        /// <param name="solve">Solves a part, and says why it has no solution.</param>
        public ClampFrames(RodSchedule schedule, Func<string?> solve)
        {
            _schedule = schedule;
            _solve = solve;
        }

        /// <summary>The turns that the frames have made, radians.</summary>
        public (double Proximal, double Distal) Made
        {
            get => (_proximal, _distal);
            set => (_proximal, _distal) = value;
        }

        /// <summary>The distal frame has already made its turn of time 0.</summary>
        public void Begin() => _distal = _schedule.Distal.TurnAt(0.0);

        /// <summary>Whether the frames are where they should be at this time, to within an angle.</summary>
        public bool AreInPlace(double time, double angle)
        {
            return Math.Abs(_schedule.Hub.FrameTurnAt(time) - _proximal) <= angle
                && Math.Abs(_schedule.Distal.TurnAt(time) - _distal) <= angle
                && _schedule.AngleBetween(_time, time) <= angle;
        }

        /// <summary>Turns the frames of a shape.</summary>
        /// <param name="inParts">Whether it took parts: all but the last are then solved.</param>
        /// <returns>Null, or why a part has no solution.</returns>
        public string? Turn(RodShape shape, double time, out bool inParts)
        {
            inParts = false;
            double proximal = _schedule.Hub.FrameTurnAt(time) - _proximal;
            double distal = _schedule.Distal.TurnAt(time) - _distal;
            double rotation = _schedule.AngleBetween(_time, time);
            if (proximal == 0.0 && distal == 0.0 && rotation == 0.0)
            {
                _time = time;
                return null;
            }
            string? failure = Winding.Split(
                Math.Max(Math.Max(Math.Abs(proximal), Math.Abs(distal)), rotation), out int parts);
            if (failure != null)
            {
                return failure;
            }
            inParts = parts > 1;
            for (int k = 1; k <= parts; k++)
            {
                double fraction = (double)k / parts;
                _schedule.TurnFrames(shape, _proximal + fraction * proximal, _distal + fraction * distal,
                    k < parts ? _time + fraction * (time - _time) : time);
                if (k < parts)
                {
                    failure = _solve();
                    if (failure != null)
                    {
                        return failure;
                    }
                }
            }
            _proximal += proximal;
            _distal += distal;
            _time = time;
            return null;
        }

        /// <summary>Up to when motions of the ends have been made, s.</summary>
        public double Time
        {
            get => _time;
            set => _time = value;
        }

        /// <summary>Writes or restores the turns; for a step also their time.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _proximal);
            snapshot.Serialize(ref _distal);
            if (snapshot.IsStep)
            {
                Time = snapshot.Serialize(Time);
            }
        }
    }

    /// <summary>Divides a sudden rotation of a clamp into increments, each solved before the next, so that a rod is
    /// wound up instead of rotating through the smaller angle.</summary>
    internal static class Winding
    {
        private const double LargestTurn = 0.5;   // radians a part
        private const double MaxTurn = 10_000.0; // radians that are wound up at once at all

        /// <summary>Into how many parts a turn is split.</summary>
        /// <param name="turn">Radians.</param>
        /// <param name="parts">At least 1; of no use with a failure.</param>
        /// <returns>Null, or why it cannot be wound up.</returns>
        public static string? Split(double turn, out int parts)
        {
            double size = Math.Abs(turn);
            if (!(size <= MaxTurn))
            {
                parts = 0;
                return "a clamp turns by more than " + MaxTurn + " rad at once (distalRotation, twistPerStep)";
            }
            parts = 1 + (int)(size / LargestTurn);
            return null;
        }
    }
}
