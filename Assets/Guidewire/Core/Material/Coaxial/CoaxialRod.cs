using System;

namespace Guidewire.Core
{
    /// <summary>An instrument with another one inside it as one rod: elements of the outer one with the mass of both,
    /// one of any length at its tip, and those of the inner one beyond.</summary>
    /// <remarks>The axial force in the overlap is that of both; it strains the elements as the outer instrument alone.
    /// The inner one strains along all of its length from its own hub, and so does the element at the outer tip in its
    /// stead: its EA is l over the compliance of that length.</remarks>
    internal sealed class CoaxialRod
    {
        private const double Viscosity = 1e-3;   // of saline that flushes a lumen, Pa s
        private const double Retained = 1e-4;    // of the shear compliance of what is in a sheath

        private readonly MaterialRod _outer;
        private readonly InstrumentProfile _innerProfile;
        private readonly double _lumenRadius;   // m; 0 where its fluid is left out
        private readonly double[] _shear;       // GA of the elements outside a sheath, N

        /// <summary>Of these instruments.</summary>
        /// <param name="outer">The outer one.</param>
        /// <param name="outerProfile">What it is made of.</param>
        /// <param name="inner">The inner one.</param>
        /// <param name="innerProfile">What it is made of.</param>
        /// <param name="beyond">How many of the inner nodes are beyond the outer tip.</param>
        /// <param name="lead">How far the inner hub is behind the outer one, m.</param>
        /// <param name="lumenRadius">Of the outer one, m; 0 leaves out the drag of the fluid in it.</param>
        /// <param name="sheathed">Length in a sheath, m from the outer hub.</param>
        public CoaxialRod(MaterialRod outer, InstrumentProfile outerProfile, MaterialRod inner,
            InstrumentProfile innerProfile, int beyond, double lead, double lumenRadius = 0.0, double sheathed = 0.0)
        {
            _lumenRadius = lumenRadius;
            InnerSpin = new double[outer.ElementCount];
            LumenDrag = new double[outer.ElementCount];
            _outer = outer;
            _innerProfile = innerProfile;
            Joints = new CoaxialJoints(outerProfile, innerProfile, StationsOf(outer), StationsOf(inner), beyond, lead,
                sheathed);
            Rod = new MaterialRod(Joints.ElementCount) { MassDamping = outer.MassDamping };
            int tip = outer.ElementCount;
            for (int j = 0; j < Rod.ElementCount; j++)
            {
                MaterialRod from = j < tip ? outer : inner;
                int at = j < tip ? j : inner.ElementCount - beyond + j - tip;
                Rod.Take(j, from, at);
            }
            _shear = (double[])Rod.ShearStiffness.Clone();
            SetHubs(lead, sheathed);
            SetMass();
        }

        /// <summary>Where their joints are and what these are made of.</summary>
        public CoaxialJoints Joints { get; }

        /// <summary>Both as one rod.</summary>
        public MaterialRod Rod { get; }

        /// <summary>Where the sheath ends in which they are, or null.</summary>
        public SheathEnd? Sheath { get; set; }

        /// <summary>Inertia about the axis of the inner instrument's part in each element of the outer one, rho (I1 +
        /// I2) times its length, kg m^2.</summary>
        public double[] InnerSpin { get; }

        /// <summary>Couple of the fluid in each element against the spin of one instrument in the other, over that
        /// spin, N m s.</summary>
        public double[] LumenDrag { get; }

        /// <summary>The inner hub is this far behind the outer one.</summary>
        /// <param name="lead">m.</param>
        public void SetLead(double lead)
        {
            SetHubs(lead, Joints.Sheathed);
        }

        /// <summary>The inner hub is this far behind the outer one, and the outer one this far in a sheath.</summary>
        /// <param name="lead">m.</param>
        /// <param name="sheathed">m.</param>
        public void SetHubs(double lead, double sheathed)
        {
            bool isSheathed = sheathed > 0.0 || Joints.Sheathed > 0.0;
            Joints.SetHubs(lead, sheathed);
            if (isSheathed)
            {
                SetShear(sheathed);
            }
            if (Joints.Beyond > 0)
            {
                int tip = Joints.OuterCount;
                double length = Joints.Stations[tip + 1] - Joints.Stations[tip];
                Rod.Length[tip] = length;
                Rod.StretchStiffness[tip] = length / _innerProfile.Integral(0.0, Joints.Stations[tip + 1] + lead,
                    piece => 1.0 / piece.StretchStiffness);
            }
        }

        // An element in parts in series, as far as shear goes: nothing in a sheath leaves its axis.
        private void SetShear(double sheathed)
        {
            double[] station = Joints.Stations;
            for (int j = 0; j < _shear.Length; j++)
            {
                double inside = (sheathed - station[j]) / (station[j + 1] - station[j]);
                inside = Math.Min(1.0, Math.Max(0.0, inside));
                Rod.ShearStiffness[j] = _shear[j] / (1.0 - (1.0 - Retained) * inside);
            }
        }

        /// <summary>Gives each element the mass and the inertia of what is in it at the present lead.</summary>
        public void SetMass()
        {
            double[] station = Joints.Stations;
            for (int j = 0; j < Joints.OuterCount; j++)
            {
                double from = station[j] + Joints.Lead;
                double to = station[j + 1] + Joints.Lead;
                double perLength = 1.0 / (to - from);
                Rod.LineDensity[j] = _outer.LineDensity[j]
                    + perLength * _innerProfile.Integral(from, to, piece => piece.LineDensity);
                Rod.RotaryInertia1[j] = _outer.RotaryInertia1[j]
                    + perLength * _innerProfile.Integral(from, to, piece => piece.RotaryInertia1);
                Rod.RotaryInertia2[j] = _outer.RotaryInertia2[j]
                    + perLength * _innerProfile.Integral(from, to, piece => piece.RotaryInertia2);
                InnerSpin[j] = _innerProfile.Integral(from, to, piece => piece.RotaryInertia1 + piece.RotaryInertia2);
                LumenDrag[j] = _innerProfile.Integral(from, to, DragOf);
            }
        }

        // Flow between two cylinders of which one turns: 4 pi mu r^2 R^2/(R^2 - r^2) per length, N s.
        private double DragOf(CrossSection piece)
        {
            double inner = piece.Radius * piece.Radius;
            double outer = _lumenRadius * _lumenRadius;
            return outer > inner ? 4.0 * Math.PI * Viscosity * inner * outer / (outer - inner) : 0.0;
        }

        /// <summary>Distances of a rod's nodes from its first, m.</summary>
        public static double[] StationsOf(MaterialRod rod)
        {
            var stations = new double[rod.ElementCount + 1];
            for (int j = 0; j < rod.ElementCount; j++)
            {
                stations[j + 1] = stations[j] + rod.Length[j];
            }
            return stations;
        }
    }
}
