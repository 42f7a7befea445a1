namespace Guidewire.UnityCheck.Rules
{
    /// <summary>What compiles here and not in Unity: members that NUnit 3.6 has and Unity's fork of 3.5 has not, the
    /// editor's interface in a player, and what the profile of editor-only assemblies lacks.</summary>
    internal static class LibraryRules
    {
        private const string NUnit = "nunit.framework";

        /// <summary>What 3.6 added to 3.5 and is still there: by the difference of the two libraries.</summary>
        private static readonly HashSet<string> NewerThanUnitys = new HashSet<string>
        {
            "Assert.Multiple", "Assert.Warn", "Warn.If", "Warn.Unless", "TestContext.Progress",
        };

        /// <summary>Members that Unity's profile has and .NET Framework has not.</summary>
        private static readonly HashSet<string> OnlyUnitys = new HashSet<string>
            { "System.Math.Clamp", "System.Array.Fill" };

        // By the compiler's id of a member of .NET Standard.
        private static readonly Dictionary<string, bool> Missing = new Dictionary<string, bool>();

        public static void Check(Source source)
        {
            if (source.Assembly.IsEditorOnly || source.Assembly.Libraries.Contains(NUnit + ".dll"))
            {
                CheckSymbols(source);
            }
            if (source.Assembly.IsEditorOnly)
            {
                foreach (RangeExpressionSyntax range in source.Root.DescendantNodes().OfType<RangeExpressionSyntax>())
                {
                    source.Report(range, "api-editor", "a range needs System.Range, which .NET Framework lacks");
                }
            }
            else if (source.Assembly.HasEngine)
            {
                CheckPlayer(source);
            }
        }

        private static void CheckSymbols(Source source)
        {
            foreach (SimpleNameSyntax name in source.Root.DescendantNodes().OfType<SimpleNameSyntax>())
            {
                ISymbol? symbol = source.Model.GetSymbolInfo(name).Symbol;
                if (symbol == null)
                {
                    continue;
                }
                string assembly = symbol.ContainingAssembly?.Name ?? "";
                if (assembly == NUnit && symbol.ContainingType != null
                    && NewerThanUnitys.Contains(symbol.ContainingType.Name + "." + symbol.Name))
                {
                    source.Report(name, "nunit", symbol.ContainingType.Name + "." + symbol.Name
                        + " came after NUnit 3.5");
                }
                if (source.Assembly.IsEditorOnly && assembly == "netstandard" && IsMissing(symbol))
                {
                    source.Report(name, "api-editor", symbol.ToDisplayString()
                        + " is not in .NET Framework, for which Unity may compile an editor-only assembly");
                }
            }
        }

        private static bool IsMissing(ISymbol symbol)
        {
            ISymbol definition = symbol.OriginalDefinition;
            if (definition is IMethodSymbol { ReducedFrom: { } whole })
            {
                definition = whole.OriginalDefinition;
            }
            if (definition.Kind != SymbolKind.NamedType && definition.Kind != SymbolKind.Method
                && definition.Kind != SymbolKind.Property && definition.Kind != SymbolKind.Field)
            {
                return false;
            }
            // Names of a tuple's elements are the compiler's alone.
            string? id = definition.ContainingType?.IsTupleType == true ? null : definition.GetDocumentationCommentId();
            if (id == null)
            {
                return false;
            }
            if (!Missing.TryGetValue(id, out bool isMissing))
            {
                isMissing = !OnlyUnitys.Contains(definition.ContainingType?.ToDisplayString() + "." + definition.Name)
                    && DocumentationCommentId.GetFirstSymbolForDeclarationId(id, Libraries.Framework) == null;
                Missing[id] = isMissing;
            }
            return isMissing;
        }

        private static void CheckPlayer(Source source)
        {
            SyntaxNode player = source.Root.ContainsDirectives ? Sources.ForPlayer(source.Tree).GetRoot() : source.Root;
            foreach (IdentifierNameSyntax name in player.DescendantNodes().OfType<IdentifierNameSyntax>())
            {
                bool isRight = name.Parent is MemberAccessExpressionSyntax access && access.Name == name
                    || name.Parent is QualifiedNameSyntax qualified && qualified.Right == name;
                if (name.Identifier.ValueText == "UnityEditor" && !isRight)
                {
                    source.Report(name, "editor-in-player", "UnityEditor in " + source.Assembly.Name
                        + ", which players contain");
                }
            }
        }
    }
}
