namespace Guidewire.UnityCheck.Rules
{
    /// <summary>Fields that Unity stores, and those that it leaves out though an attribute asks for them.</summary>
    internal static class FieldRules
    {
        private static readonly HashSet<string> Inspector = new HashSet<string>
        {
            "SerializeField", "Range", "Tooltip", "Header", "Min", "TextArea", "Multiline", "ColorUsage", "Delayed",
            "GradientUsage", "ContextMenuItem", "FormerlySerializedAs", "InspectorName", "Space",
        };

        public static void Check(Source source)
        {
            foreach (INamedTypeSymbol type in source.Types)
            {
                bool holds = UnityTypes.IsMadeByUnity(type) || type.IsSerializable;
                foreach (ISymbol member in source.Members<ISymbol>(type))
                {
                    if (member is IFieldSymbol || member is IPropertySymbol)
                    {
                        CheckMember(source, type, member, holds);
                    }
                }
            }
        }

        /// <summary>The fields that a scene may hold for a type, those of its bases included.</summary>
        public static IEnumerable<IFieldSymbol> Stored(INamedTypeSymbol type)
        {
            return UnityTypes.Chain(type).Where(above => above.Locations.Any(place => place.IsInSource))
                .SelectMany(above => above.GetMembers().OfType<IFieldSymbol>())
                .Where(field => IsStored(field) && Refusal(field) == null)
                .GroupBy(field => field.Name).Select(same => same.First());
        }

        /// <summary>The type that an array or list holds, or the type itself.</summary>
        private static ITypeSymbol Element(ITypeSymbol type)
        {
            return type is IArrayTypeSymbol array ? array.ElementType : IsList(type)
                ? ((INamedTypeSymbol)type).TypeArguments[0]
                : type;
        }

        private static bool IsNumber(ITypeSymbol type)
        {
            return type.SpecialType >= SpecialType.System_SByte && type.SpecialType <= SpecialType.System_Double
                && type.SpecialType != SpecialType.System_Decimal;
        }

        /// <summary>Whether Unity stores a field, its type left aside. A property's field has the attributes that are
        /// meant for it.</summary>
        private static bool IsStored(IFieldSymbol field)
        {
            bool asked = UnityTypes.Has(field, "SerializeField") || UnityTypes.Has(field, "SerializeReference");
            bool isOpen = field.DeclaredAccessibility == Accessibility.Public
                && !UnityTypes.Has(field, "NonSerialized");
            return (asked || isOpen) && !field.IsStatic && !field.IsConst && !field.IsReadOnly
                && !(field.AssociatedSymbol is IEventSymbol);
        }

        /// <summary>Why Unity does not store a field of this type; null where it does, or where the type is not known.
        /// </summary>
        private static string? Refusal(IFieldSymbol field)
        {
            if (UnityTypes.Has(field, "SerializeReference"))
            {
                return null;
            }
            ITypeSymbol type = Element(field.Type);
            string name = field.Type.ToDisplayString(SymbolDisplayFormat.MinimallyQualifiedFormat);
            if (type is IArrayTypeSymbol || IsList(type) || field.Type is IArrayTypeSymbol { Rank: > 1 })
            {
                return name + ": arrays and lists of one dimension only";
            }
            if (type.OriginalDefinition.SpecialType == SpecialType.System_Nullable_T)
            {
                return name + ": no value that may be missing";
            }
            if (IsNumber(type) || type.SpecialType == SpecialType.System_Boolean || type.TypeKind == TypeKind.Error
                || type.SpecialType == SpecialType.System_String || type.SpecialType == SpecialType.System_Char
                || UnityTypes.IsEngine(type) || UnityTypes.IsObject(type) || type.TypeKind == TypeKind.TypeParameter)
            {
                return null;
            }
            if (type is INamedTypeSymbol { TypeKind: TypeKind.Enum, EnumUnderlyingType: { } number })
            {
                return number.SpecialType == SpecialType.System_Int64 || number.SpecialType == SpecialType.System_UInt64
                    ? name + " has 64 bits" : null;
            }
            return type.TypeKind == TypeKind.Interface ? name + " is an interface (SerializeReference stores one)"
                : type.Locations.All(place => !place.IsInSource) || type.IsTupleType
                    || type.TypeKind == TypeKind.Delegate
                    ? name + " is no type that it stores"
                : !((INamedTypeSymbol)type).IsSerializable ? name + " is not [Serializable]"
                : type.TypeKind == TypeKind.Class && type.IsAbstract
                    ? name + " is abstract (SerializeReference stores one)"
                : null;
        }

        private static bool IsList(ITypeSymbol type)
        {
            return type.OriginalDefinition.ToDisplayString() == "System.Collections.Generic.List<T>";
        }

        private static void CheckMember(Source source, INamedTypeSymbol type, ISymbol member, bool holds)
        {
            var field = member as IFieldSymbol;
            AttributeData[] asking = member.GetAttributes().Where(IsAsking).ToArray();
            if (asking.Length == 0)
            {
                return;
            }
            var home = field?.AssociatedSymbol ?? member;
            bool asked = UnityTypes.Has(member, "SerializeField");
            string name = type.Name + "." + home.Name;
            string? reason = asked && !holds ? type.Name + " is neither a behaviour nor [Serializable]"
                : field == null ? "a property is not stored; its field is with [field: SerializeField]"
                : field.IsConst || field.IsStatic || field.IsReadOnly
                    ? "constant, static and readonly fields are not stored"
                : UnityTypes.Has(field, "NonSerialized") ? "it is [NonSerialized] as well"
                : !IsStored(field) ? "[" + UnityTypes.Name(asking[0])
                    + "] on a field that is neither public nor [SerializeField]"
                : Refusal(field);
            if (reason != null && (asked || holds))
            {
                source.Report(home, "field-stored", name + " is left out by Unity without a word: " + reason);
            }
        }

        private static bool IsAsking(AttributeData attribute)
        {
            return Inspector.Contains(UnityTypes.Name(attribute))
                || UnityTypes.Chain(attribute.AttributeClass).Any(above => above.Name == "PropertyAttribute");
        }
    }
}
