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
            new NumberEntry("sphereRadius", "units", NumberRange.Positive, "r") { Methods = Takers.Pbd },
            new NumberEntry("contactDistance", "m", NumberRange.NotNegative,
                "gap between the wire's surface and a wall below which the contact force acts; 0: chosen from radius, "
                + "drive and clearance") { Methods = Takers.Only(Solver.Direct) },
            new NumberEntry("contactStiffness", "N/m", NumberRange.NotNegative,
                "k; direct: the normal force at half the contactDistance is 1.19 k times it, 0: chosen; xpbd: k times "
                + "the penetration depth, 0: rigid")
            {
                Methods = Takers.Only(Solver.Xpbd, Solver.Direct),
            },
            new NumberEntry("elasticSlip", "m", NumberRange.NotNegative,
                "elastic tangential displacement up to which a contact sticks; 0: a hundredth of the wire's radius")
            {
                Methods = Takers.Only(Solver.Direct),
            },
            new OptionalSwitchEntry("selfContact", "whether the wire touches itself; null: where it has walls")
            {
                Methods = Takers.Only(Solver.Direct),
            },
            new NumberEntry("selfFriction", "", NumberRange.NotNegative, "friction coefficient of the wire on itself")
            {
                Methods = Takers.Only(Solver.Direct),
            },
            new NumberEntry("collisionMargin", "units", NumberRange.NotNegative, "gap kept beyond the radius")
            {
                Methods = Takers.Pbd,
            },
            new NumberEntry("collisionStiffness", "", NumberRange.Fraction,
                "k_C, stiffness of the contact constraint per iteration") { Methods = Takers.Pbd },
            new ChoiceEntry<ElementContact>("elementContact",
                "contact of rod elements, in addition to spheres: with forces by the lever rule, none, or by "
                + "the thesis's rule")
            {
                OlderWords = new Dictionary<string, string> { ["seed"] = "thesis" },
                Methods = Takers.Pbd,
            },
        });
    }
}
