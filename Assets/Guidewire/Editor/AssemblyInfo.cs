using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("Guidewire.Unity.Tests")]
