using System;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>Reads the key sheath: an object with an exit and a direction, either of which may be missing.</summary>
    internal static class SheathReader
    {
        /// <summary>Sets the sheath of a scene.</summary>
        /// <param name="values">Its parameters.</param>
        /// <param name="sourceOf">Who said what stands at a path.</param>
        /// <exception cref="ParameterException">An object that is no sheath.</exception>
        public static void Read(RunParameters values, Func<string, string> sourceOf)
        {
            if (values.Sheath == null)
            {
                return;
            }
            var fields = new JsonFields(sourceOf, "sheath", values.Sheath);
            if (values.Sheath["lumenFriction"] != null)
            {
                // Where nothing bends exp(mu angle) is 1. There are two forces M/a at the exit, a = sqrt(12 d B/M).
                throw fields.Wrong("lumenFriction", "no value: along a straight sheath nothing presses on its wall, "
                    + "and at its exit the bent wire presses by a force that follows from the play, which a sheath "
                    + "does not state");
            }
            fields.Allow("exit", "direction");
            var sheath = new Sheath();
            if (values.Sheath["exit"] != null)
            {
                sheath.Exit = fields.Vector("exit", null);
            }
            if (values.Sheath["direction"] != null)
            {
                sheath.Direction = fields.Vector("direction", null);
                if (sheath.Direction.Value.LengthSquared == 0.0)
                {
                    throw fields.Wrong("direction", "three numbers [x, y, z], not all 0");
                }
            }
            values.Simulation.Scene.Sheath = sheath;
        }
    }
}
