using System;

namespace Guidewire.Core
{
    /// <summary>Axial Coulomb friction between an instrument and the lumen around it, as a force at its hub.</summary>
    /// <remarks>Where a force T passes along the inner instrument it lies against the lumen with |T kappa| per length,
    /// and with P = 2 B_r dk/a at each end of the overlap, a = sqrt(12 play/dk). So as it slides its force changes by
    /// mu P at either end and by dT/ds = mu |T kappa| between. With theta the angle of the overlap and F the hub's
    /// force without friction, pushed on it has
    /// <code>t = F + mu P,  U(F) = t exp(sign(t) mu theta) + mu P</code>
    /// and drawn back -U(-F). At rest the hub's force is anywhere between the two: the part that is used is the slip
    /// since the sense has changed over an elastic slip, as of contacts with walls.
    ///
    /// With several instruments inside, T and F are their sums, whatever passes between them: the next one inside has
    /// what this lumen adds, and the one around loses it.
    ///
    /// P is that of the largest difference of the two rest curvatures, at both ends: a bound. Friction about the axis
    /// is left out, and so is that the shape feels what friction takes from the force along the overlap.</remarks>
    internal sealed class LumenFriction
    {
        private readonly double _elasticSlip;  // m
        private double _used;                  // of what may be held, 1: pushed on, -1: drawn back

        /// <summary>Nothing has slid so far.</summary>
        /// <param name="coefficient">mu; 0: none.</param>
        /// <param name="elasticSlip">m.</param>
        public LumenFriction(double coefficient, double elasticSlip)
        {
            Coefficient = coefficient;
            _elasticSlip = elasticSlip;
        }

        /// <summary>The coefficient mu.</summary>
        public double Coefficient { get; }

        /// <summary>The inner instrument has slid.</summary>
        /// <param name="slide">Towards its tip against the outer one, m.</param>
        public void Slide(double slide) => _used = Math.Max(-1.0, Math.Min(1.0, _used + slide / _elasticSlip));

        /// <summary>What the hub has to push with in addition to its force without friction, N.</summary>
        /// <param name="force">The latter, N, a thrust positive.</param>
        /// <param name="angle">Of the overlap, rad.</param>
        /// <param name="end">P, N.</param>
        public double Force(double force, double angle, double end)
        {
            return Coefficient == 0.0 || _used == 0.0 ? 0.0
                : _used > 0.0 ? _used * (Pushed(force, angle, end) - force)
                : _used * (Pushed(-force, angle, end) + force);
        }

        /// <summary>Writes or restores what is used.</summary>
        public void Serialize(Snapshot snapshot)
        {
            if (Coefficient > 0.0)
            {
                snapshot.Serialize(ref _used);
            }
        }

        private double Pushed(double force, double angle, double end)
        {
            double t = force + Coefficient * end;
            return t * Math.Exp(Math.Sign(t) * Coefficient * angle) + Coefficient * end;
        }
    }
}
