using System;
using System.Linq;
using System.Reflection;
using System.Threading.Tasks;
using Guidewire.Core;

namespace Guidewire.Runtime
{
    /// <summary>Compiles what frames call before they do. Mono compiles a method where it is first called: in the frame
    /// that shows the first wire that took 10 to 20 ms.</summary>
    internal static class Compilation
    {
        // Of Core, what views ask of a state and steps do not.
        private static readonly Type[] Others =
        {
            typeof(RodState), typeof(RodStrain), typeof(Vector3d), typeof(Quaterniond), typeof(SimulationParameters),
        };

        private static Task _done = Task.CompletedTask;
        private static bool _isBegun;

        /// <summary>Begins it beside the frames, once; does nothing for a loop without a thread.</summary>
        public static void Begin(SteppingMode stepping)
        {
#if !ENABLE_IL2CPP    // where all is compiled when the player is built
            if (!_isBegun && WireRun.TakesThread(stepping))
            {
                _isBegun = true;
                _done = Task.Run(Compile);
            }
#endif
        }

        /// <summary>Waits until it is done, in another thread than that of the frames. What could not be compiled is
        /// compiled where it is called.</summary>
        public static void Wait() => Task.WaitAny(_done);

        private static void Compile()
        {
            Array.ForEach(typeof(Compilation).Assembly.GetTypes(), Compile);
            Array.ForEach(Others, Compile);
        }

        private static void Compile(Type type)
        {
            const BindingFlags Own = BindingFlags.DeclaredOnly | BindingFlags.Public | BindingFlags.NonPublic
                | BindingFlags.Instance | BindingFlags.Static;
            foreach (MethodBase method in type.GetMethods(Own).Concat<MethodBase>(type.GetConstructors(Own)))
            {
                if (!method.IsAbstract && !method.ContainsGenericParameters)
                {
                    method.MethodHandle.GetFunctionPointer();
                }
            }
        }
    }
}
