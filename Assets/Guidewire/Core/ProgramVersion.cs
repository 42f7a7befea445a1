namespace Guidewire.Core
{
    /// <summary>The program's version, defined here only: assemblies and packages take it from this file, and a test
    /// compares the files that have to repeat it (package.json, CITATION.cff, CHANGELOG.md).</summary>
    public static class ProgramVersion
    {
        /// <summary>MAJOR.MINOR.PATCH; a new minor may change results, a new patch may not.</summary>
        public const string Number = "0.1.0";
    }
}
