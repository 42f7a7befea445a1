namespace Guidewire.UnityCheck
{
    /// <summary>What Unity's own rules ask of symbols.</summary>
    internal static class UnityTypes
    {
        public static bool IsBehaviour(INamedTypeSymbol type)
        {
            return DerivesFrom(type, "MonoBehaviour");
        }

        /// <summary>Whether Unity makes the objects of a class: behaviours, and assets of one's own.</summary>
        public static bool IsMadeByUnity(INamedTypeSymbol type)
        {
            return IsBehaviour(type) || DerivesFrom(type, "ScriptableObject");
        }

        /// <summary>Whether a class stands below one of the engine's, by that one's name.</summary>
        public static bool DerivesFrom(ITypeSymbol type, string name)
        {
            return Chain(type).Skip(1).Any(above => above.Name == name
                && !above.Locations.Any(place => place.IsInSource));
        }

        /// <summary>Gives a type and those above it, nearest first.</summary>
        public static IEnumerable<ITypeSymbol> Chain(ITypeSymbol? type)
        {
            for (ITypeSymbol? above = type; above != null; above = above.BaseType)
            {
                yield return above;
            }
        }

        /// <summary>The names of a symbol's attributes, without the ending Attribute.</summary>
        public static IEnumerable<string> Attributes(ISymbol symbol)
        {
            return symbol.GetAttributes().Select(Name);
        }

        public static bool Has(ISymbol symbol, string attribute)
        {
            return Attributes(symbol).Contains(attribute);
        }

        public static string Name(AttributeData attribute)
        {
            string name = attribute.AttributeClass?.Name ?? "";
            return name.EndsWith("Attribute", StringComparison.Ordinal) ? name.Substring(0, name.Length - 9) : name;
        }

        /// <summary>Whether a type is one of the engine's objects, to which a field may refer.</summary>
        public static bool IsObject(ITypeSymbol type)
        {
            return Chain(type).Any(above => above.Name == "Object" && IsEngine(above));
        }

        public static bool IsEngine(ITypeSymbol type)
        {
            string space = type.ContainingNamespace?.ToDisplayString() ?? "";
            return space == "UnityEngine" || space.StartsWith("UnityEngine.", StringComparison.Ordinal);
        }
    }
}
