using System.Reflection;
using System.Runtime.CompilerServices;
using Guidewire.Core;

// Unity takes it from nowhere else.
[assembly: AssemblyVersion(ProgramVersion.Number)]
[assembly: InternalsVisibleTo("Guidewire.Core.Tests")]
[assembly: InternalsVisibleTo("Guidewire.Benchmarks")]
