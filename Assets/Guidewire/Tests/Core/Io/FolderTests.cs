using System;
using System.IO;
using NUnit.Framework;

namespace Guidewire.Core.Tests
{
    /// <summary>Tests with files: each has an empty folder of its own, which is gone afterwards.</summary>
    public abstract class FolderTests
    {
        /// <summary>The folder.</summary>
        protected string Folder { get; private set; } = "";

        [SetUp]
        public void MakeFolder()
        {
            Folder = Path.Combine(Path.GetTempPath(), "guidewire-" + Guid.NewGuid().ToString("N"));
            Directory.CreateDirectory(Folder);
        }

        [TearDown]
        public void RemoveFolder() => Directory.Delete(Folder, true);
    }
}
