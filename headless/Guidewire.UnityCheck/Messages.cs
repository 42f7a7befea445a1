namespace Guidewire.UnityCheck
{
    /// <summary>One assembly of Unity's, as its definition says.</summary>
    /// <param name="Name">Name of the assembly.</param>
    /// <param name="Files">Its sources, as paths from the project's folder.</param>
    /// <param name="References">Names of the assemblies that it references, the project's and packages'.</param>
    /// <param name="Libraries">File names of the libraries that it references.</param>
    /// <param name="IsEditorOnly">Whether players leave it out.</param>
    /// <param name="IsTest">Whether it holds tests.</param>
    /// <param name="HasEngine">Whether it may use Unity's own assemblies.</param>
    /// <param name="IsUnsafeAllowed">Whether it may hold unsafe code.</param>
    internal sealed record AssemblyForm(string Name, string[] Files, string[] References, string[] Libraries,
        bool IsEditorOnly, bool IsTest, bool HasEngine, bool IsUnsafeAllowed);

    /// <summary>What is requested.</summary>
    /// <param name="Root">Folder of the project.</param>
    /// <param name="Assemblies">Its assemblies.</param>
    /// <param name="Changes">Sources with other text than the file has.</param>
    /// <param name="Only">The sources to check; null for all.</param>
    /// <param name="Words">Words whose places are asked for.</param>
    internal sealed record Request(string Root, AssemblyForm[] Assemblies, Dictionary<string, string> Changes,
        string[]? Only, string[] Words);

    /// <summary>The answer: what is wrong, and what only the compiler can tell of the sources.</summary>
    internal sealed class Reply
    {
        /// <summary>What is wrong, each with its place and rule.</summary>
        public List<Violation> Violations { get; } = new List<Violation>();

        /// <summary>The behaviours that an object in a player can hold, by the source that is called like them: the
        /// names under which a scene keeps their fields, former ones included.</summary>
        public Dictionary<string, string[]> Scripts { get; } = new Dictionary<string, string[]>();

        /// <summary>Full names of the methods that a command line can call: static, without parameters, the only ones
        /// of their name, in assemblies of the editor's.</summary>
        public List<string> Entries { get; } = new List<string>();

        /// <summary>Places of the words that were asked for.</summary>
        public List<Word> Words { get; } = new List<Word>();
    }

    /// <summary>Something wrong.</summary>
    internal sealed record Violation(string Path, int Line, string Rule, string Message);

    /// <summary>A word in a source.</summary>
    internal sealed record Word(string Path, int Line, string Text);
}
