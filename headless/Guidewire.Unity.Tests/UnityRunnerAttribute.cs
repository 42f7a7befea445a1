using System;
using Guidewire.Unity.Tests;
using NUnit.Framework.Interfaces;
using UnityEngine.TestTools;

[assembly: UnityRunner]

namespace Guidewire.Unity.Tests
{
    /// <summary>Runs Unity's own EditMode tests as Unity's runner does: no game is played, and the log decides, too.
    /// Tests of the scenes, which only .NET has, look at the log themselves.</summary>
    [AttributeUsage(AttributeTargets.Assembly)]
    public sealed class UnityRunnerAttribute : Attribute, ITestAction
    {
        public ActionTargets Targets => ActionTargets.Test;

        public void BeforeTest(ITest test)
        {
            if (IsUnitys(test))
            {
                Engine.Reset(Stage.Root);
                Application.isPlaying = false;
                LogAssert.Begin();
            }
        }

        public void AfterTest(ITest test)
        {
            if (IsUnitys(test))
            {
                Assert.That(LogAssert.Problem(), Is.Empty);
            }
        }

        private static bool IsUnitys(ITest test)
        {
            string folder = Path.Combine(Stage.Root, "Assets", "Guidewire", "Tests", "Unity");
            return test.TypeInfo != null && File.Exists(Path.Combine(folder, test.TypeInfo.Name + ".cs"));
        }
    }
}
