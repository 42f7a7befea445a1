using System;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Two or three coaxial instruments with even pieces, straight along z from the outer hub, and their rest
    /// shapes.</summary>
    internal sealed class CoaxialPair
    {
        public const double Stretch = 1e6;  // EA and GA, N

        private readonly double _stretch;
        private readonly CoaxialInstrument[] _instruments;
        private readonly double[] _hubTwist;

        /// <summary>A pair.</summary>
        /// <param name="nu">GJ = EI/(1 + nu).</param>
        public CoaxialPair(Piece[] outer, int outerElements, Piece[] inner, int innerElements, double nu, double lead,
            int beyond = 0)
            : this(new[] { outer, inner }, new[] { outerElements, innerElements }, nu, new[] { 0.0, lead },
                new[] { 0, beyond })
        {
        }

        /// <summary>Two or three, the outermost one first.</summary>
        /// <param name="nu">GJ = EI/(1 + nu).</param>
        /// <param name="stretch">EA and GA of each, N.</param>
        public CoaxialPair(Piece[][] pieces, int[] elements, double nu, double[] leads, int[] beyond,
            double stretch = Stretch)
        {
            _stretch = stretch;
            Nu = nu;
            _instruments = new CoaxialInstrument[pieces.Length];
            for (int i = 0; i < pieces.Length; i++)
            {
                _instruments[i] = new CoaxialInstrument(RodOf(pieces[i], elements[i]), ProfileOf(pieces[i]));
            }
            _hubTwist = new double[pieces.Length];
            Build(beyond, leads);
            Shape.SetStraight(Vector3d.Zero, Quaterniond.Identity, Coaxial.Joints.Stations);
        }

        /// <summary>Poisson's ratio of both.</summary>
        public double Nu { get; }

        /// <summary>The pair as one rod.</summary>
        public CoaxialRod Coaxial { get; private set; } = null!;

        /// <summary>Each alone.</summary>
        public CoaxialInstrument[] Instruments => _instruments;

        /// <summary>Its terms.</summary>
        public RodTerms Terms { get; private set; } = null!;

        /// <summary>Where it is.</summary>
        public RodShape Shape { get; private set; } = null!;

        /// <summary>Its supports.</summary>
        public RodSupports Supports { get; private set; } = null!;

        /// <summary>Newton iterations of the last search.</summary>
        public int Iterations { get; private set; }

        /// <summary>Of the energy's second derivative where the last search ended.</summary>
        public double SmallestEigenvalue { get; private set; }

        /// <summary>Its bending.</summary>
        public CoaxialBendTwist Bending => (CoaxialBendTwist)Terms.Bending;

        /// <summary>Force on the last node, N.</summary>
        public Vector3d TipForce { get; set; }

        /// <summary>A piece of an instrument.</summary>
        public readonly struct Piece
        {
            public readonly double Length;
            public readonly double Bend;
            public readonly Vector3d Curvature;

            public Piece(double length, double bend, double curvature1, double curvature2 = 0.0, double twist = 0.0)
            {
                Length = length;
                Bend = bend;
                Curvature = new Vector3d(curvature1, curvature2, twist);
            }
        }

        /// <summary>A new number of nodes beyond the outer tip, or lead, with the shape as it is: inner nodes come in
        /// after the tip or go there.</summary>
        /// <param name="sheathed">Length in a sheath, m.</param>
        public void Build(int beyond, double lead, double sheathed = 0.0) =>
            Build(new[] { 0, beyond }, new[] { 0.0, lead }, sheathed);

        /// <summary>The same for all.</summary>
        public void Build(int[] beyond, double[] leads, double sheathed = 0.0)
        {
            RodShape? old = Shape;
            CoaxialJoints? was = Coaxial?.Joints;
            var rod = new CoaxialRod(_instruments, beyond, leads, sheathed);
            Supports = new RodSupports { Clamp = ClampRule.HalfElement, Coaxial = rod };
            Coaxial = rod;
            Terms = new RodTerms(rod.Rod, Supports);
            _hubTwist.CopyTo(Bending.HubTwist, 0);
            Shape = new RodShape(rod.Joints.ElementCount, rod.Joints.InnerCount);
            if (old != null)
            {
                var change = new CoaxialChange(rod.Joints);
                change.Begin(was!);
                change.Convert(old, Shape);
            }
        }

        /// <summary>Gives the pieces cores of four fifths of their stiffness that leave their line at a curvature,
        /// rad/m; the shape stays.</summary>
        /// <param name="isSteel">Whether they yield; else they have a plateau.</param>
        public void GiveWay(double curvature, bool isSteel)
        {
            const double radius = 0.1;
            for (int i = 0; i < _instruments.Length; i++)
            {
                CrossSection[] pieces = _instruments[i].Profile.Pieces;
                for (int p = 0; p < pieces.Length; p++)
                {
                    double young = 0.8 * pieces[p].BendStiffness1 / (0.25 * Math.PI * Math.Pow(radius, 4.0));
                    double stress = young * radius * curvature;
                    pieces[p].Fibres = new FibreSection(new MaterialLaw
                    {
                        IsSuperelastic = !isSteel,
                        Upper = stress,
                        Lower = 0.4 * stress,
                        Strain = 6.0 * radius * curvature,
                        Hardening = 0.03 * young,
                        Rings = 2,
                    }, young, radius, 0.0);
                }
                _instruments[i].Rod.Fibres = FibreMemory.Create(_instruments[i].Profile, _instruments[i].Stations);
            }
            CoaxialJoints joints = Coaxial.Joints;
            var beyond = new int[_instruments.Length];
            for (int i = 1; i < beyond.Length; i++)
            {
                beyond[i] = joints.BeyondOf(i);
            }
            Bending.HubTwist.CopyTo(_hubTwist, 0);
            Build(beyond, (double[])joints.Hubs.Leads.Clone(), joints.Sheathed);
        }

        /// <summary>The rest shape at an angle of the inner hub; throws where there is none.</summary>
        public void Solve(double hubTwist) => Solve(new[] { 0.0, hubTwist });

        /// <summary>The same at angles of all hubs against the outermost one.</summary>
        public void Solve(double[] hubTwists)
        {
            hubTwists.CopyTo(_hubTwist, 0);
            hubTwists.CopyTo(Bending.HubTwist, 0);
            Bending.SetIdleTwists(Shape);
            Terms.Loads.Set(Vector3d.Zero, TipForce);
            EquilibriumResult result = new RodStatics(Terms).Solve(Shape, 1e-11, 300);
            Iterations = result.Iterations;
            SmallestEigenvalue = result.SmallestEigenvalue;
            if (!result.Converged)
            {
                throw new InvalidOperationException(result.Reason);
            }
        }

        /// <summary>Whether the shape with this angle of the inner instrument all along is stable.</summary>
        public bool IsStable(double hubTwist) => IsStable(new[] { 0.0, hubTwist });

        /// <summary>The same with angles of all.</summary>
        public bool IsStable(double[] hubTwists)
        {
            hubTwists.CopyTo(Bending.HubTwist, 0);
            for (int i = 1; i < hubTwists.Length; i++)
            {
                Array.Fill(Shape.Twist, hubTwists[i], (i - 1) * Shape.ElementCount, Shape.ElementCount);
            }
            Bending.RelaxTurns(Shape);
            for (int j = 0; j < Shape.ElementCount; j++)
            {
                Shape.X[j + 1] = Shape.X[j] + Coaxial.Rod.Length[j] * Shape.Q[j].Director3;
            }
            var system = new BlockTridiagonal(Coaxial.Rod, Supports);
            return system.Factorise(Terms.All, Shape, new RodVector[system.VectorCount],
                new RodVector[system.VectorCount], 0.0) == 0;
        }

        /// <summary>Of a relative error at 5, 10 and 20 elements: small, and falling with the square of their
        /// length. Returns that at 10.</summary>
        public static double AssertSecondOrder(Func<int, double> error)
        {
            double coarse = error(5);
            double middle = error(10);
            double fine = error(20);
            TestContext.WriteLine("errors {0:G4} {1:G4} {2:G4}", coarse, middle, fine);
            Assert.That(Math.Abs(middle), Is.LessThan(2.5e-3));
            Assert.That(Math.Log(coarse / middle, 2.0), Is.GreaterThan(1.9));
            Assert.That(Math.Log(middle / fine, 2.0), Is.GreaterThan(1.9));
            return middle;
        }

        /// <summary>Torque of the inner hub, N m.</summary>
        public double Torque => Bending.InnerTorque(Shape);

        /// <summary>Force of the inner hub, N.</summary>
        public double Force => Terms.Release!.InnerForce(Shape, Terms);

        private InstrumentProfile ProfileOf(Piece[] pieces)
        {
            var borders = new double[pieces.Length + 1];
            for (int k = 0; k < pieces.Length; k++)
            {
                borders[k + 1] = borders[k] + pieces[k].Length;
            }
            return new InstrumentProfile(borders, Array.ConvertAll(pieces, SectionOf));
        }

        private CrossSection SectionOf(Piece piece)
        {
            return new CrossSection
            {
                StretchStiffness = _stretch,
                ShearStiffness = _stretch,
                BendStiffness1 = piece.Bend,
                BendStiffness2 = piece.Bend,
                TwistStiffness = piece.Bend / (1.0 + Nu),
                LineDensity = 1e-3,
                RotaryInertia1 = 1e-9,
                RotaryInertia2 = 1e-9,
                RestCurvature = piece.Curvature,
                Radius = 1e-3,
            };
        }

        private MaterialRod RodOf(Piece[] pieces, int elements)
        {
            InstrumentProfile profile = ProfileOf(pieces);
            var rod = new MaterialRod(elements);
            for (int j = 0; j < elements; j++)
            {
                rod.Length[j] = profile.Length / elements;
                profile.Pieces[profile.PieceAt((j + 0.5) * rod.Length[j])].CopyTo(rod, j);
            }
            return rod;
        }
    }
}
