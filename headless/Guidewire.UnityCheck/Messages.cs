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
    /// <param name="Events">Names of methods that scenes call.</param>
    internal sealed record Request(string Root, AssemblyForm[] Assemblies, Dictionary<string, string> Changes,
        string[]? Only, string[] Words, string[] Events);

    /// <summary>The answer: what is wrong, and what only the compiler can tell of the sources.</summary>
    internal sealed class Reply
    {
        /// <summary>What is wrong, each with its place and rule.</summary>
        public List<Violation> Violations { get; } = new List<Violation>();

        /// <summary>The behaviours that a scene can hold, by the source that is called like them.</summary>
        public Dictionary<string, Script> Scripts { get; } = new Dictionary<string, Script>();

        /// <summary>Methods of the player's and the editor's assemblies by full name.</summary>
        public Dictionary<string, List<Method>> Methods { get; } = new Dictionary<string, List<Method>>();

        /// <summary>Paths of menu entries.</summary>
        public List<string> Menus { get; } = new List<string>();

        /// <summary>Texts of the constants called Marker.</summary>
        public List<string> Markers { get; } = new List<string>();

        /// <summary>Assemblies that are named as friends.</summary>
        public List<Word> Friends { get; } = new List<Word>();

        /// <summary>Places of the words that were asked for.</summary>
        public List<Word> Words { get; } = new List<Word>();

        /// <summary>Calls whose first argument is a text.</summary>
        public List<Call> Calls { get; } = new List<Call>();
    }

    /// <summary>Something wrong.</summary>
    internal sealed record Violation(string Path, int Line, string Rule, string Message);

    /// <summary>A word in a source.</summary>
    internal sealed record Word(string Path, int Line, string Text);

    /// <summary>A call such as <c>owner.name("text")</c>; the owner is empty where there is none.</summary>
    internal sealed record Call(string Path, int Line, string Owner, string Name, string Text);

    /// <summary>A method as command lines and menus see it.</summary>
    internal sealed record Method(string Path, int Line, bool IsStatic, bool HasParameters, bool IsGeneric);

    /// <summary>A behaviour. Bases: the names of its class and of all above it. IsEditorOnly: no player has
    /// it.</summary>
    internal sealed record Script(string Name, bool IsAttachable, bool IsEditorOnly, string[] Bases,
        Dictionary<string, StoredField> Fields);

    /// <summary>A field that Unity stores.</summary>
    /// <param name="Kind">number, bool, text, struct, enum, object, class or other.</param>
    /// <param name="Type">Name of its type, or of its elements' type.</param>
    /// <param name="IsList">Whether it is an array or a list.</param>
    /// <param name="IsNeeded">Whether it is initialised with <c>null!</c>: the scene has to fill it.</param>
    /// <param name="Names">Names under which a scene may hold it besides its own.</param>
    /// <param name="Range">What [Range] allows; empty where there is none.</param>
    /// <param name="Values">The numbers of an enum; null where flags allow any.</param>
    /// <param name="Fields">The names that a class or struct stores.</param>
    internal sealed record StoredField(string Kind, string Type, bool IsList, bool IsNeeded, string[] Names,
        double[] Range, long[]? Values, string[] Fields);
}
