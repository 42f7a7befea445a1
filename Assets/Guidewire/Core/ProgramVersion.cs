namespace Guidewire.Core
{
    /// <summary>The program's version, stated here alone: assemblies and packages take it from this file, and a test
    /// compares what other formats have to repeat (package.json, CITATION.cff, CHANGELOG.md).</summary>
    public static class ProgramVersion
    {
        /// <summary>MAJOR.MINOR.PATCH; a new minor may change results, a new patch may not.</summary>
        public const string Number = "0.1.0";
    }
}
