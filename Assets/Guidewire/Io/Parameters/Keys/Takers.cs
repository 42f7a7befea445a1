using System.Collections.Generic;
using Guidewire.Core;

namespace Guidewire.Io
{
    /// <summary>The methods that take a key.</summary>
    internal static class Takers
    {
        /// <summary>Every method.</summary>
        public static IReadOnlyList<Solver> All { get; } = Where(gains: true, material: true);

        /// <summary>Those whose wire is gains.</summary>
        public static IReadOnlyList<Solver> Pbd { get; } = Where(gains: true, material: false);

        /// <summary>Those whose wire is a material.</summary>
        public static IReadOnlyList<Solver> Material { get; } = Where(gains: false, material: true);

        /// <summary>Those that meet walls.</summary>
        public static IReadOnlyList<Solver> Walls { get; } = WhereWalls();

        /// <summary>These.</summary>
        public static IReadOnlyList<Solver> Only(params Solver[] methods)
        {
            return methods;
        }

        private static List<Solver> WhereWalls()
        {
            var methods = new List<Solver>();
            foreach (MethodTraits method in MethodTable.All)
            {
                if (method.MeetsWalls)
                {
                    methods.Add(method.Solver);
                }
            }
            return methods;
        }

        private static List<Solver> Where(bool gains, bool material)
        {
            var methods = new List<Solver>();
            foreach (MethodTraits method in MethodTable.All)
            {
                if (method.TakesMaterial ? material : gains)
                {
                    methods.Add(method.Solver);
                }
            }
            return methods;
        }
    }
}
