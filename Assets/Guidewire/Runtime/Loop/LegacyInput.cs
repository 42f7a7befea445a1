using System;
using UnityEngine;

namespace Guidewire.Runtime
{
    /// <summary>Whether keys and mouse can be read: where the Player settings leave input to the Input System package
    /// alone, every call of Unity's Input throws.</summary>
    internal static class LegacyInput
    {
        /// <summary>Checked once; the setting cannot change while the project plays.</summary>
        public static bool IsThere()
        {
            try
            {
                Input.GetKey(KeyCode.Space);
                return true;
            }
            catch (InvalidOperationException)
            {
                return false;
            }
        }
    }
}
