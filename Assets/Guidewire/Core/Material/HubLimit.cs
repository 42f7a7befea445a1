using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>The axial forces at which a hub slips in what holds it: those that its parameters name, or those of a
    /// hand.</summary>
    /// <remarks>Two fingers that pinch a shaft with P hold it by 2 mu P. Women pinch with some 50 N, men with 80 N
    /// (tip pinch, Mathiowetz et al. 1985, Arch Phys Med Rehabil 66:69); mu = 0.1 for wet gloves on a coated shaft is
    /// assumed. A hand pushes no harder than the shaft bears between the fingers and the valve: clamped at both ends of
    /// a free length l it buckles at 4 pi^2 EI/l^2 (Euler). That the fingers hold it 20 mm before the valve is
    /// assumed, too.</remarks>
    public readonly struct HubLimit
    {
        /// <summary>What a hand holds by friction, N.</summary>
        public const double Grip = 2.0 * 0.1 * 50.0;

        private const double FreeLength = 0.02;    // m, before the valve

        private HubLimit(double push, double pull, bool isOfHand)
        {
            Push = push;
            Pull = pull;
            IsOfHand = isOfHand;
        }

        /// <summary>No limit.</summary>
        public static HubLimit None { get; } = OfForce(0.0);

        /// <summary>The largest thrust, N.</summary>
        public double Push { get; }

        /// <summary>The largest pull, N.</summary>
        public double Pull { get; }

        /// <summary>Whether the limit is a hand's, because the parameters name none.</summary>
        public bool IsOfHand { get; }

        /// <summary>Whether there is a limit.</summary>
        public bool IsLimited => Push < double.PositiveInfinity;

        /// <summary>Gives a limit that is the same for push and pull.</summary>
        /// <param name="force">N; 0: no limit.</param>
        public static HubLimit OfForce(double force)
        {
            double limit = force > 0.0 ? force : double.PositiveInfinity;
            return new HubLimit(limit, limit, false);
        }

        /// <summary>Gives the limit of a hand on a shaft of this bending stiffness.</summary>
        /// <param name="bending">EI at the hub, N m^2.</param>
        public static HubLimit OfHand(double bending) =>
            new HubLimit(Math.Min(Grip, 4.0 * Math.PI * Math.PI * bending / (FreeLength * FreeLength)), Grip, true);

        /// <summary>Gives the limit of a drive: a hand's where it names none and moves a hub.</summary>
        public static HubLimit Of(DriveParameters drive, MaterialParameters material)
        {
            if (!double.IsNaN(drive.HubForceLimit))
            {
                return OfForce(drive.HubForceLimit);
            }
            CrossSection atHub = CrossSection.At(material, 0.0);
            return drive.Steering != null || drive.Kind == Drive.Displace || drive.Kind == Drive.Push
                ? OfHand(Math.Max(atHub.BendStiffness1, atHub.BendStiffness2)) : None;
        }

        /// <summary>Gives the limit of a force of this sense, N.</summary>
        public double Of(double force) => force < 0.0 ? Pull : Push;

        /// <summary>What a force has beyond it, N, with its sign; NaN of no number.</summary>
        public double Excess(double force) => force > Push ? force - Push : force < -Pull ? force + Pull : 0.0 * force;
    }

    /// <summary>What a hub does at its limit: since when it has slipped, and what force steps had beyond it.</summary>
    internal sealed class SlipRecord
    {
        private const double Exact = 1e-3;      // of the limit

        private readonly HubLimit _limit;
        private double _first = double.NaN;     // s
        private int _stepsBeyond;
        private double _maxBeyond;              // N

        /// <summary>The record of a hub that has not moved.</summary>
        public SlipRecord(in HubLimit limit)
        {
            _limit = limit;
        }

        /// <summary>The end of the first step in which it slipped, s; NaN where there is none.</summary>
        public double SlippedFrom => _first;

        /// <summary>Says that the hub slipped, in one phrase; null where it did not.</summary>
        public string? Why => double.IsNaN(_first) ? null : string.Format(CultureInfo.InvariantCulture,
            "it slipped at its hubForceLimit of {0:G3} N{1}, first at t = {2:G4} s", _limit.Push,
            _limit.IsOfHand ? ", that of a hand" : "", _first);

        /// <summary>Takes a step that has ended.</summary>
        /// <param name="slipped">Whether it went another way than it was asked, at its limit.</param>
        /// <param name="force">N.</param>
        /// <param name="time">s.</param>
        public void Record(bool slipped, double force, double time)
        {
            bool isBeyond = Math.Abs(force) > (1.0 + Exact) * _limit.Of(force);
            if ((slipped || isBeyond) && double.IsNaN(_first))
            {
                _first = time;
            }
            if (isBeyond)
            {
                _stepsBeyond++;
                _maxBeyond = Math.Max(_maxBeyond, Math.Abs(force));
            }
        }

        /// <summary>Warns of a force of the hub beyond its limit; null where there was none.</summary>
        /// <param name="name">What the warning calls the hub.</param>
        public RunWarning? FindExcess(string name)
        {
            return _stepsBeyond == 0 ? (RunWarning?)null
                : WarningTable.HubForce.With(name, _maxBeyond, Math.Min(_limit.Push, _limit.Pull), _stepsBeyond);
        }

        /// <summary>Writes or restores all of it.</summary>
        public void Serialize(Snapshot snapshot)
        {
            snapshot.Serialize(ref _stepsBeyond);
            snapshot.Serialize(ref _maxBeyond);
            snapshot.Serialize(ref _first);
        }
    }

    /// <summary>Axial forces at which an instrument bows out, by Euler's column. They are the limits of an operator's
    /// gauges, and no part of a step.</summary>
    public static class BucklingLoad
    {
        /// <summary>Length of a tip that is pressed, m: as data sheets of guidewires measure a tip load.</summary>
        public const double TipLength = 0.01;

        /// <summary>Length of a shaft between an operator's fingers and the valve that it is pushed through,
        /// m.</summary>
        public const double ShaftLength = 0.05;

        private const int Places = 64;

        /// <summary>The buckling load of the last <see cref="TipLength"/>, clamped behind it and free at its end, N:
        /// Rayleigh's quotient with the shape of a uniform column, for which it is exact.</summary>
        /// <param name="material">Of the instrument.</param>
        /// <param name="length">Of the instrument, units.</param>
        /// <param name="metres">Of a unit.</param>
        public static double OfTip(MaterialParameters material, double length, double metres)
        {
            double free = Math.Min(TipLength, length * metres);
            double sum = 0.0;
            for (int k = 0; k < Places; k++)
            {
                double along = (k + 0.5) / Places;    // from where it is held
                double cosine = Math.Cos(0.5 * Math.PI * along);
                double at = length - (1.0 - along) * free / metres;
                sum += 2.0 * cosine * cosine * CrossSection.At(material, at).BendStiffness1 / Places;
            }
            return 0.25 * Math.PI * Math.PI * sum / (free * free);
        }

        /// <summary>The buckling load of the shaft at its hub, clamped at both ends of <see cref="ShaftLength"/>,
        /// N.</summary>
        /// <param name="material">Of the instrument.</param>
        public static double OfShaft(MaterialParameters material)
        {
            double stiffness = CrossSection.At(material, 0.0).BendStiffness1;
            return 4.0 * Math.PI * Math.PI * stiffness / (ShaftLength * ShaftLength);
        }
    }
}
