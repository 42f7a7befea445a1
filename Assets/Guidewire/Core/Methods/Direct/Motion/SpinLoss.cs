using System;

namespace Guidewire.Core
{
    /// <summary>Estimates the loss of angular momentum of a free wire by a scheme, from its rotation in each
    /// step.</summary>
    /// <remarks>A step that turns a straight wire by theta about a lateral axis takes, relative to what there is,
    ///   1 % theta/(20 pi) (theta/theta_1)^k,
    /// so 1 % in ten turns in steps of theta_1. Implicit Euler: a mass m on a stiff bar has x1 x (v1 - v0) = 0, with
    /// v = (x1 - x0)/h: 2 sin(theta_1) = sin(theta_0 + theta_1), so theta^2 a step. The others' figures are measured
    /// (docs/verification.md): esdirk4 gains above 0.15 rad a step. A spin about the wire's own axis loses nothing, and
    /// bending back and forth has no mean; so theta is by the mean of the elements' lateral angular
    /// velocities.</remarks>
    internal sealed class SpinLoss
    {
        private const double Turns = 20.0 * Math.PI;   // rad
        private const double LossInTurns = 0.01;

        private readonly double _angle;   // theta_1, rad
        private readonly double _power;   // k
        private double _sum;              // of what steps took, relative

        /// <summary>Adds up the loss of this scheme.</summary>
        public SpinLoss(Integrator integrator)
        {
            (_angle, _power) = integrator switch
            {
                Integrator.ImplicitEuler => (LossInTurns / Turns, 1.0),
                Integrator.Bdf2 => (0.057, 3.0),
                Integrator.Trbdf2 => (0.155, 2.2),
                Integrator.Esdirk3 => (0.21, 3.1),
                Integrator.Esdirk4 => (0.37, 4.5),
                _ => (double.PositiveInfinity, 1.0),
            };
        }

        /// <summary>The farthest that the wire turned in a step, rad.</summary>
        public double LargestTurn { get; private set; }

        /// <summary>What is expected to be lost so far, or with esdirk4 gained, of the angular momentum.</summary>
        public double Expected => 1.0 - Math.Exp(-_sum);

        /// <summary>Takes the end of a step, or of several of one length.</summary>
        /// <param name="spins">Angular velocities along the elements' axes, rad/s.</param>
        /// <param name="dt">Of all of them, s.</param>
        public void AddSteps(MaterialRod rod, RodShape shape, Vector3d[] spins, double dt, long steps)
        {
            Vector3d sum = Vector3d.Zero;
            for (int j = 0; j < spins.Length; j++)
            {
                sum += rod.Length[j] * Quaterniond.Rotate(shape.Q[j], new Vector3d(spins[j].X, spins[j].Y, 0.0));
            }
            double turn = dt / steps * sum.Length / rod.TotalLength;
            LargestTurn = Math.Max(LargestTurn, turn);
            _sum += steps * LossInTurns * turn / Turns * Math.Pow(turn / _angle, _power);
        }

        /// <summary>Writes or restores the sums.</summary>
        public void Serialize(Snapshot snapshot)
        {
            LargestTurn = snapshot.Serialize(LargestTurn);
            snapshot.Serialize(ref _sum);
        }
    }
}
