namespace Guidewire.UnityCheck
{
    /// <summary>One source that is checked, with what the compiler knows of it.</summary>
    internal sealed class Source
    {
        private readonly Reply _reply;

        public Source(AssemblyForm assembly, CSharpCompilation compilation, SyntaxTree tree, Usage usage, Reply reply)
        {
            Assembly = assembly;
            Tree = tree;
            Model = compilation.GetSemanticModel(tree);
            Usage = usage;
            _reply = reply;
            Types = Root.DescendantNodes(node => node is CompilationUnitSyntax || node is BaseNamespaceDeclarationSyntax
                    || node is TypeDeclarationSyntax).OfType<BaseTypeDeclarationSyntax>()
                .Select(node => Model.GetDeclaredSymbol(node)).OfType<INamedTypeSymbol>().ToList();
        }

        public AssemblyForm Assembly { get; }

        public SyntaxTree Tree { get; }

        public SemanticModel Model { get; }

        public Usage Usage { get; }

        public string Path => Tree.FilePath;

        public SyntaxNode Root => Tree.GetRoot();

        /// <summary>The name of the file without its ending.</summary>
        public string Stem => StemOf(Tree);

        /// <summary>Every type that the source declares, nested ones behind their outer one.</summary>
        public IReadOnlyList<INamedTypeSymbol> Types { get; }

        /// <summary>The members of a type that stand in this source.</summary>
        public IEnumerable<T> Members<T>(INamedTypeSymbol type)
            where T : ISymbol
        {
            return type.GetMembers().OfType<T>().Where(
                member => member.Locations.Any(place => place.SourceTree == Tree));
        }

        /// <summary>Gives the name of a source's file without its ending.</summary>
        public static string StemOf(SyntaxTree? tree)
        {
            return System.IO.Path.GetFileNameWithoutExtension(tree?.FilePath ?? "");
        }

        /// <summary>Gives the line of a symbol's name in this source, from 1.</summary>
        public int Line(ISymbol symbol)
        {
            return Line(symbol.Locations.FirstOrDefault(place => place.SourceTree == Tree) ?? Location.None);
        }

        public static int Line(Location place)
        {
            return place.GetLineSpan().StartLinePosition.Line + 1;
        }

        public void Report(ISymbol symbol, string rule, string message)
        {
            _reply.Violations.Add(new Violation(Path, Line(symbol), rule, message));
        }

        public void Report(SyntaxNode node, string rule, string message)
        {
            _reply.Violations.Add(new Violation(Path, Line(node.GetLocation()), rule, message));
        }
    }
}
