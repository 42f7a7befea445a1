using System;
using System.Globalization;

namespace Guidewire.Core
{
    /// <summary>Describes the forces on a wire between walls whose step has no solution: that of its hub, and the
    /// largest contact force.</summary>
    /// <remarks>A hub that does not slip jams a wire when its thrust exceeds the buckling load of a clamped length of
    /// 90 diameters, 4 pi^2 EI/(180 r)^2: under a larger thrust it bends until walls hold it on both sides at every
    /// such length, and its shape is one of many. Then a hub with a limit ends the jam; below that thrust a shorter
    /// step may follow the wire.</remarks>
    internal sealed class JamReport
    {
        private const double FreeLength = 180.0;  // radii
        private const double ClampedEuler = 4.0 * Math.PI * Math.PI;

        private readonly RodTerms _terms;
        private readonly double _metres;      // per unit
        private readonly double[] _fromTip;   // of the nodes, m
        private readonly double _thrust;      // N

        /// <summary>Of a rod under terms that hold walls.</summary>
        /// <param name="metres">m per unit.</param>
        public JamReport(RodTerms terms, double metres)
        {
            _terms = terms;
            _metres = metres;
            MaterialRod rod = terms.Rod;
            int n = rod.ElementCount;
            _fromTip = new double[n + 1];
            for (int j = n - 1; j >= 0; j--)
            {
                _fromTip[j] = _fromTip[j + 1] + rod.Length[j];
                double free = FreeLength * rod.Radius[j];
                double bend = Math.Max(rod.BendStiffness1[j], rod.BendStiffness2[j]);
                _thrust = Math.Max(_thrust, ClampedEuler * bend / (free * free));
            }
        }

        /// <summary>Whether the hub pushes or pulls harder than a wire that is not jammed can bear.</summary>
        public bool IsJammed(RodShape shape)
        {
            return Math.Abs(HubForce(shape)) > _thrust;
        }

        /// <summary>The hub's force and the largest contact force with its position, in one phrase.</summary>
        public string Text(RodShape shape)
        {
            StructList<WallContact> contacts = _terms.Walls()!.Barrier.ContactsOf(shape);
            string hub = _terms.Walls()!.HoldsStart ? string.Format(CultureInfo.InvariantCulture,
                "the hub {0} with {1:G3} N", HubForce(shape) < 0.0 ? "pulls" : "pushes", Math.Abs(HubForce(shape)))
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
            Vector3d x = (1.0 / _metres) * Vector3d.Lerp(shape.X[j], shape.X[j + 1], s);
            double fromTip = ((1.0 - s) * _fromTip[j] + s * _fromTip[j + 1]) / _metres;
            return string.Format(CultureInfo.InvariantCulture, "{0}; the largest of {1} contact forces is {2:G3} N,"
                + " {3:G4} units of wire before its tip, at ({4:G4}, {5:G4}, {6:G4})", hub, contacts.Count,
                contact.Force, fromTip, x.X, x.Y, x.Z);
        }

        private double HubForce(RodShape shape)
        {
            return Vector3d.Dot(_terms.Walls()!.SupportForce(shape), _terms.HubAxis(shape));
        }
    }
}
