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
}
