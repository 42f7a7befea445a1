using System;
using System.Collections.Generic;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>The methods that take a key.</summary>
    internal static class Takers
    {
        /// <summary>Every method.</summary>
        public static IReadOnlyList<Solver> All { get; } = Where(method => true);

        /// <summary>Those whose wire has a stiffness per iteration.</summary>
        public static IReadOnlyList<Solver> Pbd { get; } = Where(method => !method.TakesMaterial);

        /// <summary>Those whose wire is a material.</summary>
        public static IReadOnlyList<Solver> Material { get; } = Where(method => method.TakesMaterial);

        /// <summary>Those that meet walls.</summary>
        public static IReadOnlyList<Solver> Walls { get; } = Where(method => method.MeetsWalls);

        /// <summary>Gives these methods.</summary>
        public static IReadOnlyList<Solver> Only(params Solver[] methods) => methods;

        private static List<Solver> Where(Predicate<MethodTraits> takes)
        {
            var methods = new List<Solver>();
            foreach (MethodTraits method in MethodTable.All)
            {
                if (takes(method))
                {
                    methods.Add(method.Solver);
                }
            }
            return methods;
        }
    }
}
