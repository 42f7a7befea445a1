using System;
using System.Collections.Generic;

namespace Guidewire.Core
{
    /// <summary>The features and keys that a method supports: one row of the <see cref="MethodTable"/>.</summary>
    public sealed class MethodTraits
    {
        /// <summary>Names the method.</summary>
        public Solver Solver { get; internal set; }

        /// <summary>Whether its wire is a material in SI units; else it has pbd stiffness, in mass units, units and
        /// seconds.</summary>
        public bool TakesMaterial { get; internal set; }

        /// <summary>Whether it meets walls.</summary>
        public bool MeetsWalls { get; internal set; }

        /// <summary>Whether walls act by barriers, part of an energy: node 0 then follows its support on a
        /// spring.</summary>
        public bool HasBarriers { get; internal set; }

        /// <summary>Largest penetration depth allowed by its contact, in radii of the wire.</summary>
        public double DepthInRadii { get; internal set; }

        /// <summary>Whether a user may steer it.</summary>
        public bool TakesSteering { get; internal set; }

        /// <summary>Whether its distal end can slide along the clamp's axis.</summary>
        public bool Slides { get; internal set; }

        /// <summary>Whether it carries a couple at the tip.</summary>
        public bool TakesTipMoment { get; internal set; }

        /// <summary>Whether it has joints whose couple is K sin(angle), beside K angle.</summary>
        public bool TakesDarbouxLaw { get; internal set; }

        /// <summary>Whether it winds a clamp up that is turned at once by more than a joint can tell from the shorter
        /// way round.</summary>
        public bool TakesSuddenRotation { get; internal set; }

        /// <summary>Its integrators, the default first; empty where it has one of its own.</summary>
        public IReadOnlyList<Integrator> Integrators { get; internal set; } = Array.Empty<Integrator>();

        /// <summary>The default between walls, where it is another.</summary>
        public Integrator? IntegratorBetweenWalls { get; internal set; }

        /// <summary>Sets the defaults that are not those of the thesis (table 4.1).</summary>
        internal Action<SimulationParameters> SetDefaults { get; set; } = _ => { };
    }
}
