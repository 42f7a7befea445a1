using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>What steers a loop: its own input, or a component of its object. One that is switched off lets go.
    /// </summary>
    internal sealed class InputSource
    {
        private bool _had;

        /// <summary>Sets the loop's push and turn for a frame; without any input they are left as a script has set
        /// them.</summary>
        public void Steer(SimulationLoop loop)
        {
            IWireInput? input = loop.Input;
            if (input == null && loop.TryGetComponent(out IWireInput found))
            {
                input = found;
            }
            bool has = input != null && (!(input is Behaviour component) || component.isActiveAndEnabled);
            if (has || _had)
            {
                loop.Push = has ? input!.Push : 0f;
                loop.Turn = has ? input!.Turn : 0f;
            }
            _had = has;
        }
    }
}
