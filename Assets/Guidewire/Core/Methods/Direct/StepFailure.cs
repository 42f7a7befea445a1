using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Says in one line why a step of the direct solver has no solution, or leaves a hub where it cannot be,
    /// and what may help. Between walls it names the force of the hub and the largest contact force.</summary>
    /// <remarks>Between walls a shorter step hardly ever helps: of 13 random runs that failed it cured none, more
    /// elements or a hub that slips all.</remarks>
    internal sealed class StepFailure
    {
        // A step in which a disturbance would grow by much (a thrust beyond buckling) may end in any shape.
        private const string Shorter = "; in a motion a shorter timeStep, or a timeStepError, may help";
        private const string Limit = "; a hubForceLimit lets the hub slip";
        private const string Elements = "; more elements (numberRodElements, or of a catheter or section) may help";
        private const string FewIterations = "; maxNewtonIterations is below its default, which may suffice";

        private const double OfElement = 0.01;     // by which a hub may be past its end
        private const double OffAxis = 1e-3;       // of the radius: a held end gives way by EA/l, some newtons there
        private const int AtHub = 1;               // element, up to which a contact is at the hub

        private readonly MaterialScene _scene;
        private readonly RodDynamics _dynamics;
        private readonly WallTerms? _walls;

        /// <summary>Makes one of the motion of a scene's rod.</summary>
        public StepFailure(MaterialScene scene, RodDynamics dynamics)
        {
            _scene = scene;
            _dynamics = dynamics;
            _walls = dynamics.Terms.Walls();
        }

        /// <summary>What may help.</summary>
        public string Advice
        {
            get
            {
                if (_dynamics.MaxIterations < new MethodParameters().MaxNewtonIterations)
                {
                    return FewIterations;
                }
                string? advice = _walls?.Advice;
                return advice != null ? "; " + advice : _walls == null ? Shorter
                    : _walls.Spring.Limit.IsLimited || _scene.Supports.InnerCount > 0 ? Elements : Elements + Limit;
            }
        }

        /// <summary>That a step has no solution; between walls the wire is where it was last.</summary>
        /// <param name="failure">Why.</param>
        /// <param name="end">Of the step, s.</param>
        public string NoSolution(string failure, double end)
        {
            string why = _walls != null && _walls.Barrier.Nodes.HasBuckled
                ? "the wire buckles at the exit of its sheath and would come out through a wall" : failure;
            return "the step to t = " + end.ToString("G6", CultureInfo.InvariantCulture) + " s has no solution: "
                + (_scene.Joints.FindTurned(_dynamics.Shape, _dynamics.Time) ?? why)
                + (_walls == null ? "" : "; " + Forces(_walls)) + Advice;
        }

        /// <summary>That the drive asks what walls do not allow, or null.</summary>
        /// <remarks>A hub that misses its position by a tenth of an element pulls at node 0 with EA, the force under
        /// which a wire would have no length left.</remarks>
        public string? FindOverdriven(ContactRecord contacts)
        {
            if (_walls == null || !_walls.HoldsStart || !(contacts.DriveAsked > 0.0))
            {
                return null;
            }
            double force = _walls.SupportForce(_dynamics.Shape).Length;
            double most = _scene.Rod.StretchStiffness[0];
            return force <= most ? null : string.Format(CultureInfo.InvariantCulture,
                "the walls keep sphere 0 from the position of the drive at t = {0:G6} s, {1:G3} units away: the "
                + "hub would need {2:G3} N, more than the EA of {5}, {3:G3} N; {4}; a smaller motion "
                + "(displacementPerStep, insertionSpeed, maxSimulationSteps) may help, or a hubForceLimit",
                _dynamics.Time, contacts.DriveShortfall, force, most, Forces(_walls),
                _scene.Supports.InnerCount == 0 ? "the wire" : "all instruments at the hub together");
        }

        /// <summary>That the wire has drawn the hub past the end of its sheath, or null.</summary>
        public string? FindDrivenOut()
        {
            return _scene.Drive.BeyondLimit <= OfElement * _scene.Rod.Length[0] ? null
                : "the wire drives itself out of its sheath: hubForceLimit is too small to hold it";
        }

        /// <summary>That a vessel has moved away from what holds the wire: from the sheath's exit, or from node 0; or
        /// null.</summary>
        public string? FindCarriedOff(double time)
        {
            if (!(_walls?.Barrier.Fields.Carrier >= 0) || !_walls.HoldsStart)
            {
                return null;
            }
            double radius = _scene.Rod.Radius[0];
            Vector3d off = _dynamics.Shape.X[0] - _walls.Spring.Position;
            off -= Vector3d.Dot(off, _dynamics.Terms.HubAxis(_dynamics.Shape)) * _dynamics.Terms.HubAxis(
                _dynamics.Shape);
            bool isOff = _scene.Supports.SheathEnd != null ? _walls.Barrier.Nodes.Clearance < radius
                : off.Length > OffAxis * radius;
            string what = _scene.Supports.SheathEnd != null ? "the sheath's exit" : "the end that is held";
            return !isOff ? null : string.Format(CultureInfo.InvariantCulture, "at t = {0:G6} s the vessel has moved "
                + "away from {1}, which stands still: it presses the wire off it; a motion that is smaller there may "
                + "help", time, what);
        }

        // On the wire along the hub's axis, N.
        private double HubForce => Vector3d.Dot(_walls!.SupportForce(_dynamics.Shape),
            _dynamics.Terms.HubAxis(_dynamics.Shape));

        // That, and the largest contact force with its position.
        private string Forces(WallTerms walls)
        {
            RodShape shape = _dynamics.Shape;
            StructList<WallContact> contacts = walls.Barrier.ContactsOf(shape);
            string hub = walls.HoldsStart ? string.Format(CultureInfo.InvariantCulture,
                "the hub {0} with {1:G3} N", HubForce < 0.0 ? "pulls" : "pushes", Math.Abs(HubForce))
                : "no hub holds the wire";
            if (contacts.Count == 0)
            {
                return hub + ", no wall touches";
            }
            int most = 0;
            for (int k = 1; k < contacts.Count; k++)
            {
                most = contacts[k].Force > contacts[most].Force ? k : most;
            }
            WallContact contact = contacts[most];
            int j = contact.Element;
            double s = contact.Position;
            Vector3d x = (1.0 / _scene.Metres) * Vector3d.Lerp(shape.X[j], shape.X[j + 1], s);
            double fromTip = (1.0 - s) * _scene.Rod.Length[j];
            for (int k = shape.ElementCount - 1; k > j; k--)
            {
                fromTip += _scene.Rod.Length[k];
            }
            string into = j > AtHub || walls.Barrier.Nodes.Inside(shape) > 0 ? ""
                : "; that is at the outermost hub, which goes straight on where the vessel bends away from its axis:"
                + " let it go less far, or start farther outside";
            return string.Format(CultureInfo.InvariantCulture, "{0}; the largest of {1} contact forces is {2:G3} N,"
                + " {3:G4} units of wire before its tip, at ({4:G4}, {5:G4}, {6:G4}){7}", hub, contacts.Count,
                contact.Force, fromTip / _scene.Metres, x.X, x.Y, x.Z, into);
        }
    }

    /// <summary>Residual force that rounding of the positions causes in a rod's equilibrium, N: one unit in the last
    /// place
    /// times EA/l of an element and M/h^2.</summary>
    /// <remarks>The largest of all elements is added to what may be unbalanced, as long as it is less than any force
    /// that matters. In a rod so stiff that it is more (EA about a thousand times that of a wire of steel) it would
    /// hide loads, in soft pieces of the rod too. There each element has only its own: the forces on all nodes beyond
    /// one, summed up from the free tip, are the stress of the one element before it, whose strain alone is rounded;
    /// and so the force on the whole rod, from which its support's is read, has none of it. Rounding of positions is no
    /// error of the shape, since the next step of Newton's method takes it back; so at least one must have been made.
    /// Of a rod held at both ends the supports' forces remain uncertain by it.</remarks>
    internal sealed class BalanceRounding
    {
        private const double MachineEpsilon = 1.0 / (1L << 52);
        private const double Resolution = 1e-7;   // N: forces below do not matter

        private readonly MaterialRod _rod;
        private readonly RodMass _mass;
        private readonly double _factor;
        private double _totalLength;
        private readonly bool _holdsEnd;
        private double _ofMass;                   // N
        private double _distance;                 // of one unit in the last place, m

        /// <summary>Estimates it for a rod.</summary>
        /// <param name="factor">On EA/l: more than 1 where a spring holds node 0 that is stiffer than the
        /// rod.</param>
        public BalanceRounding(MaterialRod rod, RodSupports supports, RodMass mass, double factor)
        {
            _rod = rod;
            _mass = mass;
            _factor = factor;
            _holdsEnd = supports.Distal != DistalEnd.Free;
            Remesh();
        }

        /// <summary>The rod has other elements.</summary>
        public void Remesh()
        {
            _totalLength = _rod.TotalLength;
            AxialSpring = 0.0;
            for (int j = 0; j < _rod.ElementCount; j++)
            {
                AxialSpring = Math.Max(AxialSpring, _rod.StretchStiffness[j] / _rod.Length[j]);
            }
            IsLarge = MachineEpsilon * _totalLength * AxialSpring > Resolution;
        }

        /// <summary>The largest EA/l, N/m.</summary>
        public double AxialSpring { get; private set; }

        /// <summary>Whether it may hide forces that matter.</summary>
        public bool IsLarge { get; private set; }

        /// <summary>By how much the forces of two supports may be wrong, N; 0 of one, or where it does not
        /// matter.</summary>
        public double OfSupports => IsLarge && _holdsEnd ? MachineEpsilon * _totalLength * AxialSpring : 0.0;

        /// <summary>Begins a stage.</summary>
        /// <param name="stageLength">h, s.</param>
        /// <returns>The force that may be unbalanced besides in any element, N; 0 where it is large.</returns>
        public double BeginStage(RodShape shape, double stageLength)
        {
            _distance = MachineEpsilon * (shape.X[0].Length + _totalLength);
            double perMass = _mass.Total / (stageLength * stageLength);
            _ofMass = _distance * perMass;
            return IsLarge ? 0.0 : _distance * (_factor * AxialSpring + perMass);
        }

        /// <summary>The largest force on a piece of the rod from any node to its tip, or the sum of the couples over L,
        /// N, each less the rounding of its element.</summary>
        /// <param name="forces">On nodes, and couples on elements.</param>
        /// <param name="count">Of them.</param>
        public double Unbalanced(RodVector[] forces, int count)
        {
            Vector3d sum = Vector3d.Zero;
            double largest = 0.0;
            double couples = 0.0;
            double ofEnd = _holdsEnd ? Of(_rod.ElementCount - 1) : 0.0;
            for (int i = _rod.ElementCount; i >= 0; i--)
            {
                RodVector f = forces[i];
                double rounding = Of(Math.Max(i - 1, 0)) + ofEnd;
                sum += f.X;
                largest = Math.Max(largest, sum.Length - rounding);
                double couple = Math.Abs(f.T1) + Math.Abs(f.T2) + Math.Abs(f.T3);
                if (i < _rod.ElementCount)
                {
                    couples += Math.Max(0.0, couple - Of(i) * _rod.Length[i]);
                }
            }
            for (int i = _rod.ElementCount + 1; i < count; i++)
            {
                largest = Math.Max(largest, forces[i].X.Length);    // of a vessel
                couples += Math.Abs(forces[i].T1) + Math.Abs(forces[i].T2) + Math.Abs(forces[i].T3);
            }
            return Math.Max(largest, couples / _totalLength);
        }

        /// <summary>Puts the force on the whole rod in the place of that on node 0, where rounding is large and
        /// nothing else holds it.</summary>
        /// <param name="gradient">Of all terms: minus the forces.</param>
        public void SumUp(RodVector[] gradient)
        {
            for (int i = 1; IsLarge && !_holdsEnd && i <= _rod.ElementCount; i++)
            {
                gradient[0].AddX(gradient[i].X);
            }
        }

        // Of element j's force, N.
        private double Of(int j) => _ofMass + _distance * _factor * _rod.StretchStiffness[j] / _rod.Length[j];
    }
}
