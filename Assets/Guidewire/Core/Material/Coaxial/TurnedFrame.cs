using System;

namespace Guidewire.Core
{
    /// <summary>Derivatives by the turns of a frame that is an element's turned about its d3 by an angle, R, as those
    /// of the element: theta' = R^T theta.</summary>
    internal static class TurnedFrame
    {
        /// <summary>Adds a gradient by that frame to the element's.</summary>
        /// <param name="angle">From the element to the frame about d3, radians.</param>
        public static void Add(ref RodVector to, double angle, in RodVector g)
        {
            double c = Math.Cos(angle);
            double s = Math.Sin(angle);
            to.T1 += c * g.T1 - s * g.T2;
            to.T2 += s * g.T1 + c * g.T2;
            to.T3 += g.T3;
        }

        /// <summary>Adds second derivatives by that frame to the element's: R C R^T and F R^T.</summary>
        /// <param name="c">Cosine of the angle.</param>
        /// <param name="s">Its sine.</param>
        public static void Add(ref RodBlock to, in RodBlock from, double c, double s)
        {
            double x1 = c * from.C11 - s * from.C21;
            double x2 = c * from.C21 - s * from.C22;
            double y1 = s * from.C11 + c * from.C21;
            double y2 = s * from.C21 + c * from.C22;
            to.C11 += c * x1 - s * x2;
            to.C21 += c * y1 - s * y2;
            to.C22 += s * y1 + c * y2;
            to.C31 += c * from.C31 - s * from.C32;
            to.C32 += s * from.C31 + c * from.C32;
            to.C33 += from.C33;
            to.F11 += c * from.F11 - s * from.F12; to.F12 += s * from.F11 + c * from.F12; to.F13 += from.F13;
            to.F21 += c * from.F21 - s * from.F22; to.F22 += s * from.F21 + c * from.F22; to.F23 += from.F23;
            to.F31 += c * from.F31 - s * from.F32; to.F32 += s * from.F31 + c * from.F32; to.F33 += from.F33;
        }

        /// <summary>Gives T v with T = (1 - c |phi|^2) 1 + c phi phi^T + [phi]/2 (<see cref="RotationVectorLaw"/>), or
        /// T^T v
        /// with half negative.</summary>
        public static Vector3d TimesT(in Vector3d phi, in Vector3d v, double half)
        {
            double square = phi.LengthSquared;
            double c = RotationVector.CotangentFactor(square);
            return (1.0 - c * square) * v + (c * Vector3d.Dot(phi, v)) * phi + half * Vector3d.Cross(phi, v);
        }
    }
}
