using Guidewire.Io;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>How a user's error is answered.</summary>
    internal static class Refusal
    {
        /// <summary>The message of the <see cref="ParameterException"/> that a call throws: one line.</summary>
        public static string Of(TestDelegate call)
        {
            string message = Assert.Throws<ParameterException>(call)!.Message;
            Assert.That(message, Does.Not.Contain("\n"));
            return message;
        }
    }
}
