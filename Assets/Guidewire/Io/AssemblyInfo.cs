using System.Reflection;
using System.Runtime.CompilerServices;
using Guidewire.Core;

// Unity takes it from nowhere else.
[assembly: AssemblyVersion(ProgramVersion.Number)]
[assembly: InternalsVisibleTo("Guidewire.Core.Tests")]
[assembly: InternalsVisibleTo("Guidewire.Benchmarks")]
// What speaks JSON itself; nobody else sees the reader of it.
[assembly: InternalsVisibleTo("Guidewire.Cli")]
[assembly: InternalsVisibleTo("Guidewire.Native")]
[assembly: InternalsVisibleTo("Guidewire.Browser")]
