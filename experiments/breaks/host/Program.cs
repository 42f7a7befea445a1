using System;
using System.Collections.Generic;
using System.IO;
using System.Reflection;
using System.Threading;
using Guidewire;
using NUnit.Framework.Api;
using NUnit.Framework.Interfaces;
using NUnit.Framework.Internal;

// Runs the quick tests of Core and Io once for each number on the command line, with the break of that number, until a
// test fails. Prints a line for each: number, "found" or "missed", tests run, s of processor time, the test that failed.
internal sealed class Listener : ITestListener
{
    public int Count { get; private set; }

    public string Failed { get; private set; } = "";

    public string Running { get; private set; } = "";

    public void TestStarted(ITest test) => Running = test.IsSuite ? Running : test.FullName;

    public void TestFinished(ITestResult result)
    {
        Count += result.Test.IsSuite ? 0 : 1;
        bool isOwn = !result.Test.IsSuite || result.ResultState.Site == FailureSite.SetUp;
        Failed = isOwn && Failed.Length == 0 && result.ResultState.Status == TestStatus.Failed
            ? result.Test.FullName : Failed;
    }

    public void TestOutput(TestOutput output)
    {
    }

    public void SendMessage(TestMessage message)
    {
    }
}

internal static class Program
{
    private const int Patience = 300;    // s of wall time, after which a test hangs

    private static void Main(string[] numbers)
    {
        var runner = new NUnitTestAssemblyRunner(new DefaultTestAssemblyBuilder());
        runner.Load(Assembly.LoadFrom(Path.Combine(AppContext.BaseDirectory, "Guidewire.Core.Tests.dll")),
            new Dictionary<string, object> { ["NumberOfTestWorkers"] = 0, ["StopOnError"] = true });
        TestFilter quick = TestFilter.FromXml("<filter><not><cat>Long</cat></not></filter>");
        foreach (string number in numbers)
        {
            var listener = new Listener();
            TimeSpan before = Environment.CpuUsage.TotalTime;
            Breaks.Number = int.Parse(number);
            using var watch = new Timer(_ =>
            {
                Console.WriteLine(number + "\tfound\t" + listener.Count + "\t0\thangs: " + listener.Running);
                Environment.Exit(0);
            }, null, 1000 * Patience, Timeout.Infinite);
            runner.Run(listener, quick);
            Console.WriteLine(number + (listener.Failed.Length > 0 ? "\tfound\t" : "\tmissed\t") + listener.Count + "\t"
                + (Environment.CpuUsage.TotalTime - before).TotalSeconds.ToString("F1") + "\t" + listener.Failed);
        }
    }
}
