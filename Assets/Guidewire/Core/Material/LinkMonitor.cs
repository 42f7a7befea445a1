using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Detects a wire between two clamps that has lost whole turns of twist by passing through
    /// itself.</summary>
    /// <remarks>The wire does not meet itself. Wound up beyond the couple at which it stays straight (couples of 2
    /// sqrt(EI T) under a tension T) it bends into a loop; a loop that passes through the wire, or over an end, takes
    /// two turns along (Calugareanu: twist and writhe change by 2 together), and what is left may well be in balance.
    /// No wire does that. It shows once the wire is stretched out again: where every element points forward, d3 . axis
    /// above 0, its orientation is a turn psi about the axis and then a tilt of less than 90 degrees, and psi from
    /// clamp to clamp is the turn that the clamps have made, bent or not (Fuller). Where an element points back, or
    /// an end moves in six degrees of freedom, nothing is said.</remarks>
    internal sealed class LinkMonitor
    {
        private readonly RodSchedule _schedule;
        private readonly bool _isOn;
        private readonly double _start;  // psi from clamp to clamp before the clamps turn, radians

        /// <summary>A monitor of a wire at its start, whose clamps have not turned yet.</summary>
        public LinkMonitor(RodSupports supports, RodSchedule schedule, RodShape start)
        {
            _schedule = schedule;
            _isOn = !schedule.HasMotions && supports.HasProximalJoint && supports.HasDistalJoint
                && Measure(start, out _start);
        }

        /// <summary>How many turns the wire has lost, and why, in one line; or null.</summary>
        /// <param name="turn">Of the distal clamp against the proximal one, radians.</param>
        public string? FindLost(RodShape shape, double turn)
        {
            if (!_isOn || turn == 0.0 || !Measure(shape, out double measured))
            {
                return null;
            }
            double lost = Math.Round((turn + _start - measured) / (2.0 * Math.PI));
            if (lost == 0.0)
            {
                return null;
            }
            return string.Format(CultureInfo.InvariantCulture,
                "of {0:G4} turns between its clamps the wire has lost {1}: it has formed loops and passed through "
                + "itself, as there is no self-contact; fewer turns (distalRotation, twistPerStep) or a pull "
                + "(axialForce, distalDisplacement) keep it "
                + "straight", Math.Abs(turn) / (2.0 * Math.PI), Math.Abs(lost));
        }

        /// <summary>psi from clamp to clamp, radians, joint by joint; false where an element does not point
        /// forward.</summary>
        private bool Measure(RodShape shape, out double turn)
        {
            Quaterniond back = _schedule.Hub.Frame.Conjugate;
            turn = 0.0;
            if (!Twist(back * shape.ProximalFrame, out double before))
            {
                return false;
            }
            for (int j = 0; j <= shape.ElementCount; j++)
            {
                if (!Twist(back * (j < shape.ElementCount ? shape.Q[j] : shape.DistalFrame), out double psi))
                {
                    return false;
                }
                turn += Math.IEEERemainder(psi - before, 2.0 * Math.PI);
                before = psi;
            }
            return true;
        }

        // q = tilt times turn about e3: psi = 2 atan2(z, w); d3 . e3 = w^2 + z^2 - x^2 - y^2.
        private static bool Twist(in Quaterniond q, out double psi)
        {
            psi = 2.0 * Math.Atan2(q.Z, q.W);
            return q.W * q.W + q.Z * q.Z > q.X * q.X + q.Y * q.Y;
        }
    }
}
