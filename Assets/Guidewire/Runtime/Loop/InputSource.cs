using System.Collections.Generic;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>What steers a wire: a device, a controller, a script. The first enabled component of the loop's object
    /// that has it is asked each frame.</summary>
    public interface IWireInput
    {
        /// <summary>Goes from -1, pull at the loop's full speed, to 1, push.</summary>
        float Push { get; }

        /// <summary>Goes from -1, turn left at the loop's full speed, to 1, turn right.</summary>
        float Turn { get; }
    }

    /// <summary>What steers a loop: its own input, or a component of its object. One that is switched off lets go.
    /// </summary>
    internal sealed class InputSource
    {
        private readonly List<IWireInput> _found = new List<IWireInput>();    // filled anew, without garbage
        private bool _had;

        /// <summary>Sets the loop's push and turn for a frame; without any input they are left as a script has set
        /// them.</summary>
        public void Steer(SimulationLoop loop)
        {
            IWireInput? input = loop.Input;
            if (input == null)
            {
                loop.GetComponents(_found);
                for (int i = 0; i < _found.Count && input == null; i++)
                {
                    input = IsOn(_found[i]) ? _found[i] : null;
                }
            }
            bool has = input != null && IsOn(input);
            if (has || _had)
            {
                loop.Push = has ? input!.Push : 0f;
                loop.Turn = has ? input!.Turn : 0f;
            }
            _had = has;
        }

        private static bool IsOn(IWireInput input) => !(input is Behaviour component) || component.isActiveAndEnabled;
    }
}
