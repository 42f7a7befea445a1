using System;

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
}
