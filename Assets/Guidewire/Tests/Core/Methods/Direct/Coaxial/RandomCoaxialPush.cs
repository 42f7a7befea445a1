using System;
using System.Collections.Generic;

namespace Guidewire.Core.Tests
{
    /// <summary>A wire in a catheter, both of random properties with bent tips, pushed, pulled and turned at both hubs
    /// in one of several vessels, and what came of that.</summary>
    internal sealed class RandomCoaxialPush
    {
        private const int Samples = 10;        // an element
        private const int OtherSeeds = 1 << 20;   // of what is drawn besides, so that the rest stays as it is
        private const int MostWithdrawn = 250;    // steps of a unit
        private const int Advanced = 40;
        private const int Pieces = 6;          // of the manoeuvre, each with speeds of its own

        private SimulationParameters _parameters;
        private readonly double _wireRadius;       // units
        private readonly double _catheterRadius;
        private readonly double _outerRadius;      // of a catheter around both; 0 without one
        private readonly string _vessel;
        private double _extension;
        private double _outerCommandedDisplacement;                // m

        /// <summary>Draws both and takes them to the end.</summary>
        /// <param name="isSheathed">Whether both come out of a sheath.</param>
        /// <param name="hasOuter">Whether both are in another catheter.</param>
        /// <param name="isSoft">Whether walls give way, with 10 kPa to 10 MPa.</param>
        public RandomCoaxialPush(int seed, bool isSheathed = false, bool hasOuter = false, bool isSoft = false)
        {
            Seed = seed;
            var random = new RandomGeometry(seed);
            int vessel = seed % RandomWallPush.Vessels.Length;
            _vessel = RandomWallPush.Vessels[vessel];
            _wireRadius = random.Number(0.15, 0.45);
            _catheterRadius = _wireRadius + random.Number(0.1, 0.4);
            var outer = new RandomGeometry(seed + 3 * OtherSeeds);
            _outerRadius = hasOuter ? _catheterRadius + outer.Number(0.1, 0.4) : 0.0;
            _parameters = Draw(random, vessel);
            if (hasOuter)
            {
                DrawOuter(outer);
            }
            else
            {
                DrawHubs(new RandomGeometry(seed + OtherSeeds));
            }
            if (hasOuter && isSheathed)
            {
                DrawHubs(outer);
                _parameters.Scene.Catheters[1].Drive.HubForceLimit = outer.Index(8) == 0 ? outer.Number(0.1, 1.0) : 0.0;
            }
            if (isSheathed)
            {
                DrawSheath(new RandomGeometry(seed + 2 * OtherSeeds));
            }
            var soft = new RandomGeometry(seed + 4 * OtherSeeds);
            foreach (ContactShape wall in _parameters.Scene.Walls)
            {
                wall.Softness = isSoft ? new WallSoftness("wall", Math.Pow(10.0, soft.Number(4.0, 7.0))) : null;
            }
            Simulation = Simulation.Create(_parameters);
            int steps = 20 + random.Index(20);
            double dt = _parameters.Method.TimeStep;
            Catheter catheter = _parameters.Scene.Catheters[_parameters.Scene.Catheters.Count - 1];
            for (int piece = 0; piece < Pieces; piece++)
            {
                _parameters.Drive.Steering!.Push = dt * Speed(random, 0.65);
                _parameters.Drive.Steering.Turn = dt * random.Number(-10.0, 10.0);
                catheter.Drive.Steering!.Push = dt * Speed(random, 0.6);
                catheter.Drive.Steering.Turn = dt * random.Number(-10.0, 10.0);
                if (hasOuter)
                {
                    Steering steering = _parameters.Scene.Catheters[0].Drive.Steering!;
                    steering.Push = dt * Speed(outer, 0.55);
                    steering.Turn = dt * outer.Number(-10.0, 10.0);
                }
                for (int k = 0; k < steps && Simulation.Outcome == Outcome.Running; k++)
                {
                    Simulation.Step();
                    if (Simulation.Outcome == Outcome.Running)
                    {
                        WireCommandedDisplacement += 1e-3 * Math.Abs(_parameters.Drive.Steering.Push);
                        CatheterCommandedDisplacement += 1e-3 * Math.Abs(catheter.Drive.Steering.Push);
                        _outerCommandedDisplacement += hasOuter
                            ? 1e-3 * Math.Abs(_parameters.Scene.Catheters[0].Drive.Steering!.Push) : 0.0;
                        Look();
                    }
                }
            }
        }

        public int Seed { get; }

        /// <summary>Withdraws one of them, and puts another one of random stiffness, elements and length in its place,
        /// which then goes where that one was, turning.</summary>
        /// <param name="instrument">0 the wire, k catheter k.</param>
        /// <returns>Why it could not be, or null.</returns>
        public string? Exchange(RandomGeometry random, int instrument)
        {
            for (int k = 0; k < MostWithdrawn && Simulation.FindInVessel(instrument) != null; k++)
            {
                Move(instrument, -1.0, 0.0);
            }
            SimulationParameters next = _parameters.Copy();
            var catheters = new List<Catheter>(next.Scene.Catheters);
            if (instrument == 0)
            {
                double longer = random.Number(0.0, 40.0);
                next.Scene.GuidewireLength += longer;
                next.Scene.GuidewireOffset -= longer;
                next.Scene.NumberRodElements = 30 + random.Index(50);
                next.Material.YoungsModulus = Math.Pow(10.0, random.Number(9.5, 11.0));
                next.Material.Sections = new[] { Tip(random, next.Scene.GuidewireLength, 30.0) };
                catheters = catheters.ConvertAll(one => Other(one, one.Length, longer));
            }
            else
            {
                Catheter former = catheters[instrument - 1];
                double shorter = random.Number(0.0, 0.3) * former.Length;
                Catheter other = Other(former, former.Length - shorter, shorter);
                other.Elements = 10 + random.Index(35);
                other.Material = former.Material.Copy();
                other.Material.YoungsModulus = Math.Pow(10.0, random.Number(8.0, 10.0));
                other.Material.Sections = new[] { Tip(random, other.Length, 20.0) };
                catheters[instrument - 1] = other;
            }
            next.Scene.Catheters = catheters;
            try
            {
                Simulation = Simulation.Continue(next);
            }
            catch (ArgumentException refusal)
            {
                return refusal.Message;
            }
            _parameters = next;
            double turn = random.Number(-10.0, 10.0);
            for (int k = 0; k < Advanced; k++)
            {
                Move(instrument, 1.0, turn);
            }
            return null;
        }

        // One step of one hub, units and rad/s.
        private void Move(int instrument, double push, double turn)
        {
            for (int k = 0; k <= _parameters.Scene.Catheters.Count; k++)
            {
                Steering steering = k == 0 ? _parameters.Drive.Steering!
                    : _parameters.Scene.Catheters[k - 1].Drive.Steering!;
                steering.Push = k == instrument ? push : 0.0;
                steering.Turn = k == instrument ? _parameters.Method.TimeStep * turn : 0.0;
            }
            Simulation.Step();
            Look();
        }

        private static Catheter Other(Catheter former, double length, double ahead)
        {
            return new Catheter
            {
                Length = length, Elements = former.Elements, Start = former.Start + ahead,
                FrictionCoefficient = former.FrictionCoefficient, Material = former.Material, Drive = former.Drive,
            };
        }

        public Simulation Simulation { get; private set; }

        public SimulationParameters Parameters => _parameters;

        public ContactRecord Contacts => Simulation.Contacts!;

        /// <summary>Points of the outermost axes outside a wall after a step, summed over the steps.</summary>
        public int PointsOutside { get; private set; }

        /// <summary>Steps after which the sense changed in which one tip is beyond the other.</summary>
        public int Overtakings { get; private set; }

        /// <summary>Whether all numbers were finite.</summary>
        public bool IsFinite { get; private set; } = true;

        /// <summary>Between what either hub was asked, and what it went and fell short, m.</summary>
        public double Missing
        {
            get
            {
                CoaxialRecord outermost = Simulation.Coaxial()!;
                CoaxialRecord record = outermost.Inside ?? outermost;
                double outer = outermost == record ? 0.0
                    : Math.Abs(_outerCommandedDisplacement - outermost.Displacement - outermost.Shortfall);
                double catheter = Math.Abs(CatheterCommandedDisplacement - record.Displacement - record.Shortfall);
                return Math.Max(outer, Math.Max(catheter,
                    Math.Abs(WireCommandedDisplacement - record.WireDisplacement - record.WireShortfall)));
            }
        }

        /// <summary>Largest part by which a hub's force was beyond its limit.</summary>
        public double Beyond { get; private set; }

        /// <summary>Sum of what the wire's hub was asked to go, there and back both counted, m.</summary>
        public double WireCommandedDisplacement { get; private set; }

        /// <summary>The same for the catheter's.</summary>
        public double CatheterCommandedDisplacement { get; private set; }

        public override string ToString()
        {
            return "seed " + Seed + ": beyond the limit by " + Beyond.ToString("P1") + ", "
                + _vessel + ", wire n " + _parameters.Scene.NumberRodElements + ", catheter n "
                + _parameters.Scene.Catheters[0].Elements + ", r " + _wireRadius.ToString("F2") + " in "
                + _catheterRadius.ToString("F2") + ", dt " + _parameters.Method.TimeStep.ToString("G3") + ", "
                + Simulation.Outcome + " after " + Simulation.StepCount + ", passages " + Contacts.Passages
                + ", outside " + PointsOutside + ", deepest " + Contacts.MaxPenetration.ToString("G3") + ": "
                + Simulation.Reason;
        }

        // Forth more often than back, units/s.
        private static double Speed(RandomGeometry random, double forth)
        {
            double speed = Math.Pow(10.0, random.Number(0.5, 2.2));
            return random.Number(0.0, 1.0) < forth ? speed : -speed;
        }

        private SimulationParameters Draw(RandomGeometry random, int vessel)
        {
            SimulationParameters parameters = WallScenes.Wire(30 + random.Index(50), 1e-3 * _wireRadius);
            double length = random.Number(200.0, 270.0);
            double extension = random.Index(2) == 0 ? random.Number(1.0, 40.0) : -random.Number(0.0, 60.0);
            double lead = random.Number(10.0, 100.0);
            // Both tips start before what stands in the vessel.
            double tip = -Math.Max(extension, 0.0) - 1.0;
            parameters.Scene.GuidewireLength = lead + length + extension;
            parameters.Scene.GuidewireOffset = tip - length - lead;
            parameters.Scene.Walls = RandomWallPush.Walls(random, vessel,
                Math.Max(_catheterRadius, _outerRadius));
            foreach (ContactShape wall in parameters.Scene.Walls)
            {
                wall.FrictionCoefficient = random.Index(2) == 0 ? 0.0 : random.Number(0.0, 0.2);
            }
            parameters.Scene.Gravity = random.Number(0.0, 9.81) * random.Direction();
            parameters.Method.TimeStep = Math.Pow(10.0, random.Number(-3.0, -2.0));
            parameters.Method.MaxSimulationSteps = 1000;
            parameters.Drive.Kind = Drive.Displace;
            parameters.Drive.Steering = new Steering();
            parameters.Material.YoungsModulus = Math.Pow(10.0, random.Number(9.5, 11.0));
            parameters.Material.ShearModulus = 0.38 * parameters.Material.YoungsModulus;
            parameters.Material.Sections = new[] { Tip(random, parameters.Scene.GuidewireLength, 30.0) };
            var catheter = new Catheter
            {
                Length = length,
                Elements = 15 + random.Index(30),
                Start = lead,
                Drive = { Steering = new Steering() },
            };
            SetTube(catheter, _catheterRadius, _wireRadius, random.Number(8.5, 10.0));
            catheter.Material.Sections = new[] { Tip(random, length, 20.0) };
            parameters.Scene.Catheters = new[] { catheter };
            return parameters;
        }

        // Its tip behind or before the catheter's, and its hub ahead.
        private void DrawOuter(RandomGeometry random)
        {
            Catheter inner = _parameters.Scene.Catheters[0];
            double hub = _parameters.Scene.GuidewireOffset + inner.Start;
            double tip = hub + inner.Length;
            double ahead = random.Number(0.0, 60.0);
            tip = random.Index(2) == 0 ? tip + random.Number(0.0, -1.0 - tip) : tip - random.Number(0.0, 60.0);
            var outer = new Catheter
            {
                Length = tip - hub - ahead,
                Elements = 10 + random.Index(30),
                Start = inner.Start + ahead,
                FrictionCoefficient = random.Index(3) == 0 ? random.Number(0.0, 0.3) : double.NaN,
                Drive = { Steering = new Steering() },
            };
            SetTube(outer, _outerRadius, _catheterRadius, random.Number(8.0, 9.5));
            outer.Material.Sections = new[] { Tip(random, outer.Length, 15.0) };
            _parameters.Scene.Catheters = new[] { outer, inner };
        }

        // Radii in mm of it and of what is inside; E = 10^power Pa.
        private static void SetTube(Catheter catheter, double radius, double inside, double power)
        {
            double young = Math.Pow(10.0, power);
            CoaxialScenes.SetTube(catheter, 1e-3 * radius, 0.5e-3 * (radius + inside), young, 0.38 * young);
        }

        // In one of four both or one of the hubs slip; in one of three the catheter has friction of its own.
        private void DrawHubs(RandomGeometry random)
        {
            Catheter catheter = _parameters.Scene.Catheters[0];
            double wireLimit = Math.Pow(10.0, random.Number(-1.5, 0.5));
            double catheterLimit = Math.Pow(10.0, random.Number(-1.0, 0.5));
            int which = random.Index(12);
            _parameters.Drive.HubForceLimit = which < 2 ? wireLimit : 0.0;
            catheter.Drive.HubForceLimit = which > 0 && which < 3 ? catheterLimit : 0.0;
            catheter.FrictionCoefficient = random.Index(3) == 0 ? random.Number(0.0, 0.3) : double.NaN;
        }

        // Its exit is behind the wire's tip, and before or behind the catheter's.
        private void DrawSheath(RandomGeometry random)
        {
            double tip = _parameters.Scene.GuidewireOffset + _parameters.Scene.GuidewireLength;
            _parameters.Scene.Sheath = new Sheath { Exit = (tip - random.Number(0.5, 80.0)) * Vector3d.UnitZ };
        }

        private static WireSection Tip(RandomGeometry random, double length, double curvature)
        {
            return new WireSection
            {
                From = length - random.Number(10.0, 60.0),
                To = length,
                RestCurvature = new Vector3d(random.Number(-curvature, curvature), random.Number(-5.0, 5.0), 0.0),
            };
        }

        // The catheter's axis, and the wire's beyond it.
        private void Look()
        {
            CoaxialRecord outermost = Simulation.Coaxial()!;
            CoaxialRecord record = outermost.Inside ?? outermost;
            Overtakings += _extension * record.Extension < 0.0 ? 1 : 0;
            _extension = record.Extension;
            Beyond = Math.Max(Beyond, OverLimit(record.Force,
                _parameters.Scene.Catheters[_parameters.Scene.Catheters.Count - 1].Drive.HubForceLimit));
            Beyond = Math.Max(Beyond, Math.Max(OverLimit(outermost.WireForce, _parameters.Drive.HubForceLimit),
                OverLimit(outermost.Force, _parameters.Scene.Catheters[0].Drive.HubForceLimit)));
            // Beyond the tips around them.
            double outer = outermost == record ? double.PositiveInfinity : outermost.Extension;
            if (outermost != record)
            {
                Look(outermost.Positions, 0, _outerRadius);
            }
            Look(record.Positions, FirstBeyond(record.Positions.Length - 1, CatheterLength, outer), _catheterRadius);
            Vector3d[] wire = Simulation.State.Positions;
            double beyond = Math.Min(record.Extension, record.Extension + outer);
            Look(wire, FirstBeyond(wire.Length - 1, _parameters.Scene.GuidewireLength, beyond), _wireRadius);
        }

        private double CatheterLength => _parameters.Scene.Catheters[_parameters.Scene.Catheters.Count - 1].Length;

        // The first of n + 1 nodes that is out; the last where none is.
        private static int FirstBeyond(int n, double length, double beyond)
        {
            double nodes = Math.Floor(1e3 * beyond * n / length);
            return nodes <= 0.0 ? n : nodes >= n ? 0 : n - (int)nodes;
        }

        private static double OverLimit(double force, double limit)
        {
            return limit > 0.0 ? Math.Abs(force) / limit - 1.0 : 0.0;
        }

        private void Look(Vector3d[] x, int first, double radius)
        {
            foreach (ContactShape wall in _parameters.Scene.Walls)
            {
                for (int k = first * Samples; k <= Samples * (x.Length - 1); k++)
                {
                    int j = Math.Min(k / Samples, x.Length - 2);
                    Vector3d point = Vector3d.Lerp(x[j], x[j + 1], (double)(k - j * Samples) / Samples);
                    IsFinite &= point.IsFinite;
                    int hint = -1;
                    if (wall.Nearest(point, point, radius, ref hint, out SurfaceContact contact))
                    {
                        PointsOutside += contact.Distance <= 0.0 ? 1 : 0;
                    }
                }
            }
        }
    }
}
