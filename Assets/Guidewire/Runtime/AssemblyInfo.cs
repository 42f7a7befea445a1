using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("Guidewire.Editor")]
[assembly: InternalsVisibleTo("Guidewire.Unity.Tests")]
[assembly: InternalsVisibleTo("Guidewire.Unity.PlayTests")]
