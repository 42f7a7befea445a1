using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Reflection;
using System.Threading;
using Guidewire;
using NUnit.Framework.Api;
using NUnit.Framework.Interfaces;
using NUnit.Framework.Internal;

// Runs the quick tests of Core and Io once for each number on the command line, with the break of that number, until a
// test fails. "7:RodTests,WallTests" tries these classes first, "7:" none. Prints a line for each: number, "found" or
// "missed", tests run, s of processor time, the test that failed.
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
    private const double Patience = 5.0;    // times the first run, after which a test hangs

    private static TestFilter Quick(string which) =>
        TestFilter.FromXml("<filter><and><not><cat>Long</cat></not>" + which + "</and></filter>");

    private static void Main(string[] numbers)
    {
        TextWriter output = Console.Out;    // the runner takes the console's while it runs
        double allowed = double.PositiveInfinity;
        var runner = new NUnitTestAssemblyRunner(new DefaultTestAssemblyBuilder());
        runner.Load(Assembly.LoadFrom(Path.Combine(AppContext.BaseDirectory, "Guidewire.Core.Tests.dll")),
            new Dictionary<string, object> { ["NumberOfTestWorkers"] = 0, ["StopOnError"] = true });
        foreach (string argument in numbers)
        {
            string[] parts = argument.Split(':');
            string number = parts[0];
            var listener = new Listener();
            TimeSpan before = Environment.CpuUsage.TotalTime;
            Breaks.Number = int.Parse(number);
            using var watch = new Timer(_ =>
            {
                output.WriteLine(number + "\tfound\t" + listener.Count + "\t0\thangs: " + listener.Running);
                output.Flush();
                Environment.Exit(0);
            }, null, (long)Math.Min(1e3 * allowed, uint.MaxValue - 1.0), Timeout.Infinite);
            long start = Stopwatch.GetTimestamp();
            if (parts[1].Length > 0)
            {
                runner.Run(listener, Quick("<class re='1'>[.](" + parts[1].Replace(',', '|') + ")$</class>"));
            }
            if (listener.Failed.Length == 0)
            {
                runner.Run(listener, Quick(""));
            }
            allowed = double.IsInfinity(allowed) ? Patience * Stopwatch.GetElapsedTime(start).TotalSeconds : allowed;
            output.WriteLine(number + (listener.Failed.Length > 0 ? "\tfound\t" : "\tmissed\t") + listener.Count + "\t"
                + (Environment.CpuUsage.TotalTime - before).TotalSeconds.ToString("F1") + "\t" + listener.Failed);
        }
    }
}
