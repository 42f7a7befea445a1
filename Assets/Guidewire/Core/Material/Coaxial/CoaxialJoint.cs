using System;

namespace Guidewire.Core
{
    /// <summary>A joint of one or two instruments: its pieces in series. With phi its rotation vector, t the mean twist
    /// angle of the inner instrument at the pieces that both share, delta the difference of the angles,
    ///   E = 1/2 sum_i (phi_i - f_i)^2/A_i + e - C cos t - S sin t + 1/2 K (phi_3 - r)^2
    ///       + 1/2 K' (phi_3 + delta - r')^2,    f = F + R(t) F'.</summary>
    /// <remarks>A_i = sum lambda/B, lambda the integral of the joint's hat function over a piece, B the sum of the
    /// bending stiffnesses of the instruments there; F and F' are the sums of lambda B_o kappa_o/B and lambda B_i
    /// kappa_i/B; and two instruments of different curvature hold the energy 1/2 lambda B_o B_i/B |kappa_o - R(t)
    /// kappa_i|^2 however they are bent (Rucker, Jones and Webster 2010, equations 8 and 9, as an energy). At the tip
    /// of the outer one the joint stands on the inner one's frame, and F' is the outer one's: it turns by -t.</remarks>
    internal struct CoaxialJoint
    {
        private const double Retained = 1e-8;   // of the compliance of a piece in a sheath

        public double Compliance1;   // A_1, 1/(N m)
        public double Compliance2;
        public double FixedX, FixedY;     // F, rad
        public double TurnedX, TurnedY;   // F', rad
        public double Held;          // e, J
        public double Cosine;        // C, J
        public double Sine;          // S, J
        public double Twist;         // K, N m: of the instrument whose frame it is
        public double RestTwist;     // r, rad
        public double InnerTwist;    // K', N m
        public double InnerRestTwist;
        public double Weight;        // of the angle after the joint in t; the rest is that before it

        /// <summary>Adds a piece of one instrument.</summary>
        /// <param name="lambda">m.</param>
        public void AddAlone(double lambda, in CrossSection piece)
        {
            Compliance1 += lambda / piece.BendStiffness1;
            Compliance2 += lambda / piece.BendStiffness2;
            FixedX += lambda * piece.RestCurvature.X;
            FixedY += lambda * piece.RestCurvature.Y;
        }

        /// <summary>Adds a piece of both.</summary>
        /// <param name="isTip">Whether the joint stands on the inner one's frame.</param>
        public void AddShared(double lambda, in CrossSection outer, in CrossSection inner, bool isTip)
        {
            double sum = outer.BendStiffness1 + inner.BendStiffness1;
            double reduced = lambda * outer.BendStiffness1 * inner.BendStiffness1 / sum;
            Vector3d a = outer.RestCurvature;
            Vector3d b = inner.RestCurvature;
            Compliance1 += lambda / sum;
            Compliance2 += lambda / sum;
            Held += 0.5 * reduced * (a.X * a.X + a.Y * a.Y + b.X * b.X + b.Y * b.Y);
            Cosine += reduced * (a.X * b.X + a.Y * b.Y);
            Sine += reduced * (a.Y * b.X - a.X * b.Y);
            double fraction = lambda * outer.BendStiffness1 / sum;
            Vector3d own = fraction * a;
            Vector3d other = (lambda - fraction) * b;
            FixedX += isTip ? other.X : own.X;
            FixedY += isTip ? other.Y : own.Y;
            TurnedX += isTip ? own.X : other.X;
            TurnedY += isTip ? own.Y : other.Y;
        }

        /// <summary>Adds a piece in a sheath: it is straight, whatever it is made of.</summary>
        /// <param name="lambda">m.</param>
        /// <param name="bend">B, of all that is there, N m^2.</param>
        /// <param name="held">Energy that keeps it straight, J/m.</param>
        public void AddSheathed(double lambda, double bend, double held)
        {
            Compliance1 += Retained * lambda / bend;
            Compliance2 += Retained * lambda / bend;
            Held += lambda * held;
        }

        /// <summary>f at an angle t, and its derivative by t.</summary>
        /// <param name="sense">1, or -1 at the tip of the outer instrument.</param>
        public void RestAt(double t, double sense, out Vector3d rest, out Vector3d slope)
        {
            if (TurnedX == 0.0 && TurnedY == 0.0)
            {
                rest = new Vector3d(FixedX, FixedY, 0.0);
                slope = Vector3d.Zero;
                return;
            }
            double c = Math.Cos(t);
            double s = sense * Math.Sin(t);
            double x = c * TurnedX - s * TurnedY;
            double y = s * TurnedX + c * TurnedY;
            rest = new Vector3d(FixedX + x, FixedY + y, 0.0);
            slope = new Vector3d(-sense * y, sense * x, 0.0);
        }

        /// <summary>Energy that does not depend on the joint's rotation, J, and its derivatives by t.</summary>
        public double HeldAt(double t, out double slope, out double second)
        {
            if (Cosine == 0.0 && Sine == 0.0)
            {
                slope = 0.0;
                second = 0.0;
                return Held;
            }
            double c = Math.Cos(t);
            double s = Math.Sin(t);
            slope = Cosine * s - Sine * c;
            second = Cosine * c + Sine * s;
            return Held - second;
        }
    }
}
