using System.Reflection;
using System.Runtime.CompilerServices;

// Logs name the version by this: Unity takes it from nowhere else.
[assembly: AssemblyVersion("0.1.0")]
[assembly: InternalsVisibleTo("Guidewire.Core.Tests")]
[assembly: InternalsVisibleTo("Guidewire.Benchmarks")]
