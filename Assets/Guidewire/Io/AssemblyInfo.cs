using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("Guidewire.Core.Tests")]
[assembly: InternalsVisibleTo("Guidewire.Benchmarks")]
