using System.Collections;
using System.Threading;
using UnityEngine.TestTools;

namespace Guidewire.Unity.Tests
{
    /// <summary>Unity's own PlayMode test, its frames made by the stub engine.</summary>
    public sealed class PlayModeTests
    {
        [Test]
        public void WirePlayTests_Pass()
        {
            Engine.Reset(Stage.Root);
            LogAssert.Begin();
            IEnumerator frames = new WirePlayTests().Loop_StepsTheWire_FrameByFrame();
            while (frames.MoveNext())
            {
                Engine.Frame(Stage.Frame);
                Thread.Sleep(2);    // a frame gives the loop's thread time
            }
            Assert.That(LogAssert.Problem(), Is.Empty);
        }
    }
}
