using Guidewire.Io;
using Newtonsoft.Json.Linq;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    public sealed class CommandLineHandlerTests
    {
        [Test]
        public void Arguments_NameFileFolderAndParameters()
        {
            CommandLine line = CommandLineHandler.Read(new[]
            {
                "-parameters", "wire.json", "-out", "results", "-guidewireOffset", "-100", "-drive", "push",
                "-repeat", "3",
            }, true);
            Assert.That(line.ParameterFile, Is.EqualTo("wire.json"));
            Assert.That(line.Out, Is.EqualTo("results"));
            Assert.That(line.Repeat, Is.EqualTo(3));
            Assert.That((double)line.Overrides[0].Value, Is.EqualTo(-100.0));
            Assert.That((string?)line.Overrides[1].Value, Is.EqualTo("push"));
        }

        [Test]
        public void LogFile_IsTheFolderInTheConsoleProgram_AndUnknownInUnity()
        {
            Assert.That(CommandLineHandler.Read(new[] { "-logFile", "here" }, true).Out, Is.EqualTo("here"));
            Assert.Throws<ParameterException>(() => CommandLineHandler.Read(new[] { "-logFile", "here" }, false));
        }

        [TestCase("-timStep 0.1", "did you mean '-timeStep'")]
        [TestCase("--timStep 0.1", "unknown key 'timStep': did you mean 'timeStep'")]
        [TestCase("--gravityFacto 0.1", "unknown key 'gravityFacto': --help lists")]
        [TestCase("-timeStep", "-timeStep needs a value: a number > 0 (s)")]
        [TestCase("-timeStep fast", "timeStep = fast is not allowed: needs a number > 0 (s)")]
        [TestCase("-repeat -1", "repeat = -1 is not allowed")]
        [TestCase("wire.json", "'wire.json' stands where a key is expected")]
        [TestCase("-parameters", "-parameters needs a value: a path")]
        public void WhatIsNotAllowed_IsOneLine(string arguments, string expected)
        {
            Assert.That(Refusal.Of(() => CommandLineHandler.Read(arguments.Split(new[] { ' ' }), true)),
                Does.StartWith("command line: ").And.Contain(expected));
        }

        [Test]
        public void Help_NamesEveryParameter()
        {
            string help = CommandLineHandler.Help("");
            foreach (ParameterEntry entry in ParameterTable.Entries)
            {
                Assert.That(help, Does.Contain("-" + entry.Key + ":"));
            }
        }

        [Test]
        public void ListOnTheCommandLine_IsJson()
        {
            CommandLine line = CommandLineHandler.Read(new[] { "-gravity", "[0, -9.81, 0]" }, true);
            Assert.That(line.Overrides[0].Value, Is.InstanceOf<JArray>());
        }
    }
}
