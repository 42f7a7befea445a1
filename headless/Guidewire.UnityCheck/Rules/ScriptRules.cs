namespace Guidewire.UnityCheck.Rules
{
    /// <summary>Behaviours: called like their file, attachable, made by Unity alone; and what Unity calls when it
    /// loads.</summary>
    internal static class ScriptRules
    {
        private static readonly string[] Loading =
            { "RuntimeInitializeOnLoadMethod", "InitializeOnLoadMethod", "DidReloadScripts" };

        public static void Check(Source source)
        {
            foreach (INamedTypeSymbol type in source.Types)
            {
                if (UnityTypes.IsMadeByUnity(type))
                {
                    CheckForm(source, type);
                    foreach (IMethodSymbol made in source.Members<IMethodSymbol>(type).Where(method =>
                        method.MethodKind == MethodKind.Constructor && !method.IsImplicitlyDeclared))
                    {
                        source.Report(made, "script-constructor", type.Name
                            + ": Unity makes behaviours by itself; what it has to do stands in Awake");
                    }
                }
                foreach (IMethodSymbol method in source.Members<IMethodSymbol>(type))
                {
                    CheckLoading(source, type, method);
                }
            }
            foreach (ObjectCreationExpressionSyntax made in source.Root.DescendantNodes()
                .OfType<ObjectCreationExpressionSyntax>())
            {
                if (source.Model.GetTypeInfo(made).Type is INamedTypeSymbol type && UnityTypes.IsMadeByUnity(type))
                {
                    source.Report(made, "script-constructor", "new " + type.Name
                        + ": behaviours are made by AddComponent or CreateInstance");
                }
            }
        }

        private static void CheckForm(Source source, INamedTypeSymbol type)
        {
            bool isBase = type.IsAbstract && source.Usage.IsNamed(source.Tree, type.Name, true);
            if (isBase && !type.IsStatic)
            {
                return;
            }
            if (!source.Assembly.IsTest && type.ContainingType != null)
            {
                source.Report(type, "script-name", type.Name + " is nested in " + type.ContainingType.Name
                    + "; no scene can hold it");
            }
            else if (!source.Assembly.IsTest && type.Locations.All(
                place => Source.StemOf(place.SourceTree) != type.Name))
            {
                source.Report(type, "script-name", "class " + type.Name + " must be called like its file");
            }
            if (type.Name != source.Stem)
            {
                return;
            }
            if (type.DeclaredAccessibility != Accessibility.Public || type.IsAbstract || type.IsStatic
                || type.IsGenericType)
            {
                source.Report(type, "script-form", type.Name
                    + " must be public, not abstract, not generic to go on an object");
            }
            if (source.Assembly.IsEditorOnly && UnityTypes.IsBehaviour(type))
            {
                source.Report(type, "script-form", type.Name + " stands in an editor-only assembly");
            }
        }

        private static void CheckLoading(Source source, INamedTypeSymbol type, IMethodSymbol method)
        {
            string? marked = UnityTypes.Attributes(method).FirstOrDefault(name => Loading.Contains(name));
            if (marked == null)
            {
                return;
            }
            string? reason = !method.IsStatic ? "must be static"
                : method.Parameters.Length > 0 ? "must have no parameters"
                : method.IsGenericMethod || type.IsGenericType ? "must not be generic, nor its class"
                : type.GetMembers(method.Name).Length > 1 ? "has an overload, and Unity records the name only" : null;
            if (reason != null)
            {
                source.Report(method, "initialize-method", method.Name + " with [" + marked + "] " + reason);
            }
        }
    }
}
