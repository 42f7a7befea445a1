using System.Text.RegularExpressions;

namespace Guidewire.UnityCheck.Rules
{
    /// <summary>What the editor finds by attributes: menu entries, drawers and inspectors.</summary>
    internal static class EditorRules
    {
        private static readonly Regex Path = new Regex(@"^[^/\s][^/]*(/[^/]+)+$");

        private static readonly Dictionary<string, string> Drawers = new Dictionary<string, string>
        {
            ["PropertyDrawer"] = "CustomPropertyDrawer", ["DecoratorDrawer"] = "CustomPropertyDrawer",
            ["Editor"] = "CustomEditor",
        };

        public static void Check(Source source)
        {
            foreach (INamedTypeSymbol type in source.Types)
            {
                if (!type.IsAbstract && type.BaseType != null
                    && Drawers.TryGetValue(type.BaseType.Name, out string? needed)
                    && !UnityTypes.Has(type, needed))
                {
                    source.Report(type, "editor-drawer", type.Name + " draws nothing without [" + needed + "]");
                }
                foreach (IMethodSymbol method in source.Members<IMethodSymbol>(type))
                {
                    foreach (AttributeData entry in Entries(method))
                    {
                        string? reason = MenuReason(source, type, method, entry);
                        if (reason != null)
                        {
                            source.Report(method, "menu-item", method.Name + " " + reason);
                        }
                    }
                }
            }
        }

        /// <summary>The path of a menu entry, where it is written as a text.</summary>
        public static string? MenuPath(AttributeData entry)
        {
            return entry.ConstructorArguments.Select(argument => argument.Value as string).FirstOrDefault();
        }

        private static IEnumerable<AttributeData> Entries(ISymbol method)
        {
            return method.GetAttributes().Where(attribute => UnityTypes.Name(attribute) == "MenuItem");
        }

        private static bool IsCheck(AttributeData entry)
        {
            return entry.ConstructorArguments.Any(argument => argument.Value is true);
        }

        private static string? MenuReason(Source source, INamedTypeSymbol type, IMethodSymbol method,
            AttributeData entry)
        {
            string? path = MenuPath(entry);
            bool isCheck = IsCheck(entry);
            bool takesCommand = method.Parameters.Length == 1 && method.Parameters[0].Type.Name == "MenuCommand";
            return !method.IsStatic ? "must be static"
                : method.Parameters.Length > 0 && !takesCommand ? "may have no parameter but a MenuCommand"
                : isCheck && method.ReturnType.SpecialType != SpecialType.System_Boolean
                    ? "checks its entry and must return bool"
                : !isCheck && !method.ReturnsVoid ? "must return void"
                : method.IsGenericMethod || type.IsGenericType ? "is generic"
                : path != null && !Path.IsMatch(path) ? "'" + path + "' is no path such as Menu/Entry"
                : path != null && IsTaken(source, method, path, isCheck) ? "'" + path + "' is another entry's, too"
                : !source.Assembly.IsEditorOnly ? "stands in no editor-only assembly" : null;
        }

        private static bool IsTaken(Source source, IMethodSymbol method, string path, bool isCheck)
        {
            return source.Root.DescendantNodes().OfType<MethodDeclarationSyntax>()
                .Select(node => source.Model.GetDeclaredSymbol(node)).OfType<IMethodSymbol>()
                .Where(other => !SymbolEqualityComparer.Default.Equals(other, method))
                .Concat(OtherSources(source, method)).SelectMany(Entries)
                .Any(entry => MenuPath(entry) == path && IsCheck(entry) == isCheck);
        }

        private static IEnumerable<IMethodSymbol> OtherSources(Source source, IMethodSymbol method)
        {
            return source.Model.Compilation.GetSymbolsWithName(name => true, SymbolFilter.Member)
                .OfType<IMethodSymbol>()
                .Where(other => other.Locations.All(place => place.SourceTree != source.Tree));
        }
    }
}
