using System.Collections.Generic;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>The keys of group "contact": how the wire touches walls.</summary>
    internal static class ContactEntries
    {
        /// <summary>The group, a part of the parameter table.</summary>
        public static ParameterGroup Group { get; } = new ParameterGroup(
            "contact", "how the wire touches walls", p => p.Simulation.Contact, new ParameterEntry[]
        {
            Key.Number("sphereRadius", "units", NumberRange.Positive, "r").With(Takers.Pbd),
            Key.Number("contactDistance", "m", NumberRange.NotNegative,
                "gap between the wire's surface and a wall below which the contact force acts; 0: chosen from radius, "
                + "drive and clearance").With(Takers.Only(Solver.Direct)),
            Key.Number("contactStiffness", "N/m", NumberRange.NotNegative,
                "k; direct: the normal force at half the contactDistance is 1.19 k times it, 0: chosen; xpbd: k times "
                + "the penetration depth, 0: rigid").With(Takers.Only(Solver.Xpbd, Solver.Direct)),
            Key.Number("elasticSlip", "m", NumberRange.NotNegative,
                "elastic tangential displacement up to which a contact sticks; 0: a hundredth of the wire's radius")
                .With(Takers.Only(Solver.Direct)),
            Key.OptionalSwitch("selfContact", "whether the wire touches itself; null: where it has walls")
                .With(Takers.Only(Solver.Direct)),
            Key.Number("selfFriction", "", NumberRange.NotNegative, "friction coefficient of the wire on itself")
                .With(Takers.Only(Solver.Direct)),
            Key.Number("collisionMargin", "units", NumberRange.NotNegative, "gap kept beyond the radius")
                .With(Takers.Pbd),
            Key.Number("collisionStiffness", "", NumberRange.Fraction,
                "k_C, stiffness of the contact constraint per iteration").With(Takers.Pbd),
            Key.Choice<ElementContact>("elementContact",
                "contact of rod elements, in addition to spheres: with forces by the lever rule, none, or by "
                + "the thesis's rule", ("seed", "thesis")).With(Takers.Pbd),
        });
    }
}
