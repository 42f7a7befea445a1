namespace Guidewire.UnityCheck.Rules
{
    /// <summary>Behaviours: called like their file, and of a form that an object can hold.</summary>
    internal static class ScriptRules
    {
        public static void Check(Source source)
        {
            foreach (INamedTypeSymbol type in source.Types.Where(UnityTypes.IsMadeByUnity))
            {
                bool isBase = type.IsAbstract && source.Usage.IsNamed(source.Tree, type.Name, true);
                if (isBase || source.Assembly.IsTest)
                {
                    continue;
                }
                if (type.ContainingType != null
                    || type.Locations.All(place => Source.StemOf(place.SourceTree) != type.Name))
                {
                    source.Report(type, "script-name", "class " + type.Name
                        + " must be called like its file, and in no other class");
                }
                else if (type.DeclaredAccessibility != Accessibility.Public || type.IsAbstract || type.IsGenericType
                    || (source.Assembly.IsEditorOnly && UnityTypes.IsBehaviour(type)))
                {
                    source.Report(type, "script-form", type.Name
                        + " must be public, not abstract, not generic, and a player's to go on an object");
                }
            }
        }
    }
}
