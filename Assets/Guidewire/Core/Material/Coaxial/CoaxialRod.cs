using System;

namespace Guidewire.Core
{
    /// <summary>An instrument, alone or with one or two others inside it, as one rod: elements of the outermost one
    /// with the mass of all, one of any length at its tip, and those of the next one beyond.</summary>
    /// <remarks>Across the axis all are held together: GA adds, as bending stiffness does. Along it each slides, and
    /// bears its own loads (<see cref="AxialForces"/>).</remarks>
    internal sealed class CoaxialRod
    {
        private const double Viscosity = 1e-3;   // of saline that flushes a lumen, Pa s

        private readonly CoaxialInstrument[] _instrument;

        /// <summary>Of these instruments.</summary>
        /// <param name="instruments">The outermost one first, up to three.</param>
        /// <param name="beyond">How many nodes of each, from its tip on, are nodes of the rod; of the first
        /// all.</param>
        /// <param name="leads">How far the hub of each is behind the outermost one's, m.</param>
        /// <param name="sheathed">Length in a sheath, m from the outer hub.</param>
        /// <param name="first">Elements of the first that are left out, in the sheath.</param>
        public CoaxialRod(CoaxialInstrument[] instruments, int[] beyond, double[] leads, double sheathed = 0.0,
            int first = 0)
        {
            _instrument = instruments;
            Joints = new CoaxialJoints(instruments, beyond, leads, sheathed, first);
            Axial = new AxialForces(Joints);
            InnerSpin = new double[Joints.InnerCount * Joints.Capacity];
            LumenDrag = new double[InnerSpin.Length];
            Rod = new MaterialRod(Joints.ElementCount, Joints.Capacity)
            {
                MassDamping = instruments[0].Rod.MassDamping,
                MaterialDamping = instruments[0].Rod.MaterialDamping,
            };
            TakeElements(leads, sheathed);
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh(int[] beyond, double[] leads, double sheathed, int first)
        {
            Joints.Remesh(beyond, leads, sheathed, first);
            Axial.Remesh();
            Array.Clear(InnerSpin, 0, InnerSpin.Length);
            Array.Clear(LumenDrag, 0, LumenDrag.Length);
            TakeElements(leads, sheathed);
        }

        private void TakeElements(double[] leads, double sheathed)
        {
            Rod.ElementCount = Joints.ElementCount;
            for (int j = 0; j < Joints.ElementCount; j++)
            {
                Rod.CopyElement(j, Carrier(j), OwnElement(j));
            }
            SetHubs(leads, sheathed);
            SetMass();
        }

        /// <summary>The smallest <see cref="MaterialRod.SoftestStiffness"/> of all instruments, N m^2, wherever they
        /// are.</summary>
        public double SoftestStiffness
        {
            get
            {
                double smallest = double.PositiveInfinity;
                foreach (CoaxialInstrument instrument in _instrument)
                {
                    smallest = Math.Min(smallest, instrument.Rod.SoftestStiffness);
                }
                return smallest;
            }
        }

        /// <summary>What the fibres of each instrument remember; null of a linear one.</summary>
        public FibreMemory?[] Memory => Array.ConvertAll(_instrument, instrument => instrument.Rod.Fibres);

        /// <summary>What an instrument is made of.</summary>
        public InstrumentProfile ProfileOf(int instrument) => _instrument[instrument].Profile;

        /// <summary>Where their joints are and what these are made of.</summary>
        public CoaxialJoints Joints { get; }

        /// <summary>The axial forces that stretch each instrument.</summary>
        public AxialForces Axial { get; }

        /// <summary>All as one rod.</summary>
        public MaterialRod Rod { get; }

        /// <summary>Where the sheath ends in which they are, or null.</summary>
        public SheathEnd? Sheath { get; set; }

        /// <summary>Where the hubs are in time; null where they are set by hand.</summary>
        public CoaxialHubs? Hubs { get; set; }

        /// <summary>Inertia about the axis of what is inside of each element, of the first inner instrument and then of
        /// the second, rho (I1 + I2) times its length, kg m^2.</summary>
        public double[] InnerSpin { get; }

        /// <summary>Couple of the fluid in each element against the spin of one instrument in the next one around it,
        /// over that spin, N m s; as <see cref="InnerSpin"/>.</summary>
        public double[] LumenDrag { get; }

        /// <summary>The inner hubs are this far behind the outermost one, and that one this far in a sheath.</summary>
        /// <param name="leads">m, 0 of the outermost one.</param>
        /// <param name="sheathed">m.</param>
        /// <returns>How many joints, from the first on, are others now.</returns>
        public int SetHubs(double[] leads, double sheathed)
        {
            int changed = Joints.SetHubs(leads, sheathed);
            for (int j = 0; j < Joints.ElementCount; j++)
            {
                Rod.ShearStiffness[j] = (Joints.Stations[j + 1] - Joints.Stations[j]) / Joints[j].Shear;
            }
            SetLengths();
            return changed;
        }

        /// <summary>Takes the directions of the loads in a shape.</summary>
        /// <returns>The largest change of what an element is longer by, m.</returns>
        public double TakeLoads(RodShape shape)
        {
            double change = Axial.UpdateDirections(shape);
            SetLengths();
            return change;
        }

        /// <summary>Sets the elements' rest lengths and axial stiffness.</summary>
        public void SetLengths()
        {
            double before = Joints.LeadAxial;
            for (int j = 0; j < Joints.ElementCount; j++)
            {
                double compliance = Axial.FindCompliance(j, ref before);
                Rod.Length[j] = Axial.RestLengthOf(j);
                Rod.StretchStiffness[j] = Rod.Length[j] / compliance;
            }
        }

        /// <summary>Gives each element the mass and the inertia of what is in it at the present leads.</summary>
        public void SetMass()
        {
            double[] station = Joints.Stations;
            for (int j = 0; j < Joints.ElementCount && Joints.CarrierOf(j) < Joints.InnerCount; j++)
            {
                int carrier = Joints.CarrierOf(j);
                MaterialRod own = Carrier(j);
                int element = OwnElement(j);
                Rod.LineDensity[j] = own.LineDensity[element];
                Rod.RotaryInertia1[j] = own.RotaryInertia1[element];
                Rod.RotaryInertia2[j] = own.RotaryInertia2[element];
                for (int i = carrier + 1; i < _instrument.Length; i++)
                {
                    AddInner(j, i, station[j], station[j + 1]);
                }
            }
        }

        private void AddInner(int j, int instrument, double first, double last)
        {
            InstrumentProfile profile = _instrument[instrument].Profile;
            double from = first + Joints.LeadOf(instrument);
            double to = last + Joints.LeadOf(instrument);
            double perLength = 1.0 / (to - from);
            Rod.LineDensity[j] += perLength * profile.Integral(from, to, (piece, _) => piece.LineDensity);
            Rod.RotaryInertia1[j] += perLength * profile.Integral(from, to, (piece, _) => piece.RotaryInertia1);
            Rod.RotaryInertia2[j] += perLength * profile.Integral(from, to, (piece, _) => piece.RotaryInertia2);
            int at = (instrument - 1) * Joints.ElementCount + j;
            InnerSpin[at] = profile.Integral(from, to,
                (piece, _) => piece.RotaryInertia1 + piece.RotaryInertia2);
            LumenDrag[at] = profile.Integral(from, to, (piece, lumenRadius) => DragOf(piece, lumenRadius),
                _instrument[AroundOf(instrument, j)].LumenRadius);
        }

        /// <summary>Gives the next instrument around one on an element.</summary>
        public int AroundOf(int instrument, int element) =>
            instrument == 2 && element < Joints.ActiveCountOf(1) ? 1 : Joints.CarrierOf(element);

        private MaterialRod Carrier(int j) => _instrument[Joints.CarrierOf(j)].Rod;

        // Of the outermost instrument there.
        private int OwnElement(int j)
        {
            int carrier = Joints.CarrierOf(j);
            return _instrument[carrier].Rod.ElementCount - Joints.TipOf(carrier) + j;
        }

        // Flow between two cylinders of which one turns: 4 pi mu r^2 R^2/(R^2 - r^2) per length, N s.
        private static double DragOf(CrossSection piece, double lumenRadius)
        {
            double inner = piece.Radius * piece.Radius;
            double outer = lumenRadius * lumenRadius;
            return outer > inner ? 4.0 * Math.PI * Viscosity * inner * outer / (outer - inner) : 0.0;
        }
    }

    /// <summary>One of several coaxial instruments, described as if it were alone.</summary>
    internal sealed class CoaxialInstrument
    {
        /// <summary>Makes an instrument.</summary>
        /// <param name="rod">Its elements.</param>
        /// <param name="profile">What it is made of.</param>
        /// <param name="lumenRadius">m; 0 leaves out the drag of the fluid in its lumen.</param>
        public CoaxialInstrument(MaterialRod rod, InstrumentProfile profile, double lumenRadius = 0.0)
        {
            Rod = rod;
            Profile = profile;
            LumenRadius = lumenRadius;
            Stations = new double[rod.ElementCount + 1];
            for (int j = 0; j < rod.ElementCount; j++)
            {
                Stations[j + 1] = Stations[j] + rod.Length[j];
            }
        }

        /// <summary>Its elements as a rod.</summary>
        public MaterialRod Rod { get; }

        /// <summary>What it is made of.</summary>
        public InstrumentProfile Profile { get; }

        /// <summary>Radius of its lumen, m; 0: the drag in it is left out.</summary>
        public double LumenRadius { get; }

        /// <summary>Distance of each of its nodes from its hub, m.</summary>
        public double[] Stations { get; }
    }

    /// <summary>Material of an instrument along its length, from its hub: piecewise constant between borders.</summary>
    internal sealed class InstrumentProfile
    {
        private readonly double[] _border;      // m from the hub; first 0, last the length
        private readonly CrossSection[] _piece;

        /// <summary>Makes a profile of these pieces.</summary>
        /// <param name="borders">m, one more than there are pieces; first 0.</param>
        public InstrumentProfile(double[] borders, CrossSection[] pieces)
        {
            _border = borders;
            _piece = pieces;
        }

        /// <summary>Makes that of a wire.</summary>
        /// <param name="metres">Metres in one of the profile's units.</param>
        public InstrumentProfile(WireProfile profile, double metres)
            : this(Array.ConvertAll(profile.Borders, position => metres * position), profile.Pieces)
        {
        }

        /// <summary>The instrument's length, m.</summary>
        public double Length => _border[_border.Length - 1];

        /// <summary>The pieces.</summary>
        public CrossSection[] Pieces => _piece;

        /// <summary>Borders of the pieces, m from the hub.</summary>
        public double[] Borders => _border;

        /// <summary>The piece at a position, m from the hub; beyond its ends the last or first.</summary>
        public int PieceAt(double position)
        {
            int p = 0;
            while (p < _piece.Length - 1 && _border[p + 1] <= position)
            {
                p++;
            }
            return p;
        }

        /// <summary>What the instrument is made of at a position behind which its hub is by a lead, m; at a border what
        /// is before it.</summary>
        public ref readonly CrossSection PieceUpTo(double position, double lead)
        {
            int p = 0;
            while (p < _piece.Length - 1 && _border[p + 1] - lead < position)
            {
                p++;
            }
            return ref _piece[p];
        }

        /// <summary>The next border after a position behind which the hub is by a lead, m; infinite after the
        /// last.</summary>
        public double NextBorder(double position, double lead)
        {
            double next = double.PositiveInfinity;
            foreach (double border in _border)
            {
                next = border - lead > position ? Math.Min(next, border - lead) : next;
            }
            return next;
        }

        /// <summary>Integral over a part of the length of what a piece has per length.</summary>
        /// <param name="from">m from the hub, as is <paramref name="to"/>.</param>
        /// <param name="density">Of a piece, in a lumen of some radius, m.</param>
        public double Integral(double from, double to, Func<CrossSection, double, double> density,
            double lumenRadius = 0.0)
        {
            double sum = 0.0;
            for (int p = 0; p < _piece.Length; p++)
            {
                double length = Math.Min(to, _border[p + 1]) - Math.Max(from, _border[p]);
                sum += length > 0.0 ? length * density(_piece[p], lumenRadius) : 0.0;
            }
            return sum;
        }
    }
}
