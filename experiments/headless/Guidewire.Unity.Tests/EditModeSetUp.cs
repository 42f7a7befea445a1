using NUnit.Framework;
using UnityStubs;

namespace Guidewire.Unity.Tests
{
    /// <summary>What an open project gives Unity's own tests: the folder that holds Assets.</summary>
    [SetUpFixture]
    public sealed class EditModeSetUp
    {
        [OneTimeSetUp]
        public void OpenTheProject()
        {
            Engine.Reset(Stage.Root);
        }
    }
}
